//! The potentials in the frame of a patch: origin at the contact point, axes u, v across the normal, z along it, from A
//! to B.

use super::numbers::ROUNDING;
use crate::linalg::root::MOST_STEPS;
use crate::particle::particle::Particle;
use crate::particle::potential::Weights;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// Which body a plane belongs to; the edges of a triangle bound the patch and belong to none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    A,
    B,
    Edge,
}

/// A plane of a body that may be active on the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct FramePlane {
    pub normal: [f64; 3],
    /// n·y − d at the origin of the frame.
    pub excess: f64,
    pub owner: Owner,
}

/// A particle as seen from the frame.
#[derive(Clone, Copy)]
pub(super) struct Placed<'a> {
    particle: &'a Particle,
    /// The axes of the frame (columns) and its origin, in the local frame of the particle.
    axes: Matrix3<f64>,
    origin: Vector3<f64>,
    /// From the centre of the particle to the origin, in the frame.
    pub from_centre: [f64; 3],
    pub plane_weight: f64,
    pub sphere_weight: f64,
}

impl<'a> Placed<'a> {
    /// `branch`: from the centre of the particle to the origin of the frame, world axes; `frame`: its axes as columns,
    /// world axes.
    pub fn new(
        particle: &'a Particle,
        pose: &Pose,
        branch: &Vector3<f64>,
        frame: &Matrix3<f64>,
        least_sphericity: f64,
    ) -> Self {
        let weights = Weights::of(particle, least_sphericity);
        Self {
            particle,
            axes: pose.rotation().tr_mul(frame),
            origin: pose.rotation().tr_mul(branch),
            from_centre: frame.tr_mul(branch).into(),
            plane_weight: weights.plane,
            sphere_weight: weights.sphere,
        }
    }
}

/// Both potentials at a point ([`Field::look`]).
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub s: [f64; 2],
    pub gradients: [[f64; 3]; 2],
    pub active: u128,
}

impl Look {
    /// The slope of S along the patch, over the frame's plane: it points to the nearest part of the rim.
    pub fn slope(&self, of_two: bool) -> [f64; 2] {
        let ([of_a, _], (_, rises)) = (&self.gradients, self.difference(of_two));
        [0, 1].map(|i| of_a[i] - of_a[2] * rises[i] / rises[2])
    }

    /// S_A − S_B and its gradient; of a boundary the height and its.
    pub fn difference(&self, of_two: bool) -> (f64, [f64; 3]) {
        let [a, b] = &self.gradients;
        if of_two { (self.s[0] - self.s[1], std::array::from_fn(|i| a[i] - b[i])) } else { (self.s[1], *b) }
    }
}

/// One or two bodies, and those of their planes that may be active within a distance of the origin.
pub(super) struct Field<'a, 's> {
    pub a: Placed<'a>,
    /// `None` for a rigid boundary: the patch then lies in the plane z = 0.
    pub b: Option<Placed<'a>>,
    pub planes: &'s mut Vec<FramePlane>,
    loaded: f64,
    radius: f64,
}

impl<'a, 's> Field<'a, 's> {
    /// With the planes within a distance, and edges that bound the patch (empty but for triangles).
    pub fn new(
        a: Placed<'a>,
        b: Option<Placed<'a>>,
        edges: &[FramePlane],
        distance: f64,
        planes: &'s mut Vec<FramePlane>,
    ) -> Self {
        planes.clear();
        planes.extend_from_slice(edges);
        let reach = |body: &Placed| body.particle.bounding_radius() + body.origin.norm();
        let radius = b.iter().map(reach).fold(reach(&a), f64::min);
        let mut field = Self { a, b, planes, loaded: -1.0, radius };
        field.load(distance);
        field
    }

    /// Whether the bodies are particles in the plane, which is v = 0 in their frame.
    pub fn is_in_plane(&self) -> bool {
        self.a.particle.is_in_plane()
    }

    /// Distance from the origin within which no plane is missing.
    pub fn loaded(&self) -> f64 {
        if self.loaded >= self.radius { f64::INFINITY } else { self.loaded }
    }

    /// Distance from the origin beyond which no point of the patch lies.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The rounding of s over the depth 1 − s of a patch whose least S this is: the relative error of its force by
    /// rounding, at most about. √w makes the rounding of distances from planes a part of s.
    pub fn rounding(&self, deepest: f64) -> f64 {
        let of = |body: &Placed| body.plane_weight.sqrt() * (body.particle.bounding_radius() + body.origin.norm());
        ROUNDING * (1.0 + self.b.iter().map(of).fold(of(&self.a), f64::max)) / (1.0 - deepest.max(0.0).sqrt())
    }

    /// The edges of the triangle, a bit each.
    pub fn edges(&self) -> u128 {
        let edges = self.planes.iter().enumerate().filter(|(_, plane)| plane.owner == Owner::Edge);
        edges.fold(0, |bits, (bit, _)| bits | 1 << bit)
    }

    /// Number of planes of both bodies.
    pub fn plane_count(&self) -> usize {
        self.a.particle.plane_count() + self.b.map_or(0, |b| b.particle.plane_count())
    }

    /// The planes that are loaded, for [`Self::restore`].
    pub fn state(&self) -> (usize, f64) {
        (self.planes.len(), self.loaded)
    }

    /// Forgets what was loaded since.
    pub fn restore(&mut self, (count, loaded): (usize, f64)) {
        self.planes.truncate(count);
        self.loaded = loaded;
    }

    /// Loads the planes that may be active within a distance.
    pub fn load(&mut self, distance: f64) {
        let first = self.loaded < 0.0;
        let distance = distance.min(self.radius * (1.0 + 1e-9));
        let bodies = [(Some(self.a), Owner::A), (self.b, Owner::B)];
        for (body, owner) in bodies.into_iter().filter_map(|(body, owner)| Some((body?, owner))) {
            if body.particle.is_sphere() {
                continue;
            }
            let longest = body.particle.bounds.longest_normal;
            let (early, known) = (distance * longest, self.loaded * longest);
            let planes = &mut *self.planes;
            body.particle.visit_near(&body.origin, early, |_, n, excess| {
                if excess > -early && (first || excess <= -known) {
                    planes.push(FramePlane { normal: body.axes.tr_mul(&n).into(), excess, owner });
                }
            });
        }
        self.loaded = distance;
    }

    /// S_A and S_B (0 where there is none) and their slopes along z at a point of the frame.
    pub fn values(&self, x: &[f64; 3]) -> [(f64, f64); 2] {
        let mut sums = [(0.0, 0.0); 2];
        for plane in self.planes.iter().filter(|plane| plane.owner != Owner::Edge) {
            let excess = plane.excess + dot(&plane.normal, x);
            if excess > 0.0 {
                let sum = &mut sums[usize::from(plane.owner == Owner::B)];
                *sum = (sum.0 + excess * excess, sum.1 + excess * plane.normal[2]);
            }
        }
        let of = |body: &Placed, (square, slope): (f64, f64)| {
            let y: [f64; 3] = std::array::from_fn(|i| body.from_centre[i] + x[i]);
            let (w, m) = (body.plane_weight, body.sphere_weight);
            (w * square + m * dot(&y, &y), 2.0 * (w * slope + m * y[2]))
        };
        [of(&self.a, sums[0]), self.b.map_or((0.0, 0.0), |b| of(&b, sums[1]))]
    }

    /// The weight of the planes of a body in its potential; 0 of edges.
    #[inline(always)]
    pub fn plane_weight(&self, owner: Owner) -> f64 {
        match owner {
            Owner::A => self.a.plane_weight,
            Owner::B => self.b.as_ref().map_or(0.0, |b| b.plane_weight),
            Owner::Edge => 0.0,
        }
    }

    /// S and its gradient of both bodies at a point of the frame (of a boundary the height), and the active planes and
    /// the edges beyond which it lies, a bit each.
    pub fn look(&self, x: &[f64; 3]) -> Look {
        // The last of three is that of the edges, which have no weight and change nothing.
        let (mut s, mut gradients) = ([0.0, x[2], 0.0], [[0.0; 3], [0.0, 0.0, 1.0], [0.0; 3]]);
        let mut weights = [self.a.plane_weight, 0.0, 0.0];
        let mut active = 0;
        for (i, body) in [Some(&self.a), self.b.as_ref()].into_iter().enumerate() {
            let Some(body) = body else { continue };
            let y: [f64; 3] = std::array::from_fn(|j| body.from_centre[j] + x[j]);
            s[i] = body.sphere_weight * dot(&y, &y);
            gradients[i] = y.map(|c| 2.0 * body.sphere_weight * c);
            weights[i] = body.plane_weight;
        }
        for (bit, plane) in self.planes.iter().enumerate() {
            let excess = plane.excess + dot(&plane.normal, x);
            if excess > 0.0 {
                // Planes beyond the last bit get none: users of the bits have fewer.
                active |= 1_u128.checked_shl(bit as u32).unwrap_or(0);
                let i = plane.owner as usize;
                let weighted = weights[i] * excess;
                s[i] += weighted * excess;
                (0..3).for_each(|j| gradients[i][j] += 2.0 * weighted * plane.normal[j]);
            }
        }
        Look { s: [s[0], s[1]], gradients: [gradients[0], gradients[1]], active }
    }

    /// The height where S_A = S_B above a point of the plane z = 0, sought from one nearby; `None` on a boundary.
    ///
    /// Newton's method with a bracket: S_A − S_B rises with z where the patch is a graph.
    pub fn height(&self, u: f64, v: f64, from: f64) -> Option<f64> {
        self.b?;
        let (mut below, mut above) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut z = from;
        for _ in 0..MOST_STEPS {
            let [(a, slope_a), (b, slope_b)] = self.values(&[u, v, z]);
            let (value, slope) = (a - b, slope_a - slope_b);
            if value == 0.0 {
                return Some(z);
            }
            if value < 0.0 {
                below = z
            } else {
                above = z
            }
            let mut next = z - value / slope;
            if !(next > below && next < above) {
                let bracketed = below.is_finite() && above.is_finite();
                if !bracketed && !(slope > 0.0) {
                    return None;
                }
                next = if bracketed { 0.5 * (below + above) } else { next };
            }
            if (next - z).abs() <= 4.0 * f64::EPSILON * (z.abs() + (a + b) / slope.abs()) || next == z {
                return Some(next);
            }
            z = next;
        }
        Some(z)
    }
}

pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
