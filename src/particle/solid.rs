//! The shape of a particle: its validated definition, and what is derived from it once.
//!
//! Local frame, planes i = 1..N with outward normals n_i = (a_i, b_i, c_i) and offsets d_i:
//!
//! ```text
//! S(x) = (1-k)/r² · Σ ⟨n_i·x − d_i⟩²  +  k/R² · |x|²        ⟨t⟩ = max(t, 0)
//! f(x) = S(x) − 1                                            paper eqs (2), (32)
//! ```
//!
//! f = 0 is the surface, f < 0 the inside. Normals are used as given and never renormalised, so that the particle is
//! exactly the one that the caller defined.

use super::numbers::{SIZES, SQUARABLE};
use crate::linalg::symmetric::Symmetric;
use crate::particle::bounding_volumes::{self, Bounds, Extent};
use crate::particle::coplanar;
use crate::particle::error::ParticleError;
use crate::particle::neighbours::Neighbours;
use crate::particle::plane::{MAX_PLANES, Plane};
use crate::particle::plane_clusters::PlaneClusters;
use crate::particle::potential::Weights;
use nalgebra::Vector3;
use std::ops::Range;

/// A validated definition with its bounding volumes.
#[derive(Clone, Debug)]
pub struct Solid {
    /// (a, b, c, d) of each plane in the order of `clusters`, which evaluation reads one after the other.
    pub(super) rows: Box<[[f64; 4]]>,
    /// Number of coordinates in which a point of it may move: 3, or 2 where only the cut at z = 0 is meant
    /// (`in_plane`); of a boundary 2, 1 or 0.
    pub(crate) dimensions: usize,
    pub(crate) rounding_radius: f64,
    pub(crate) sphericity: f64,
    pub(crate) shadow_radius: f64,
    /// (1-k)/r², the weight of the planes in S; 0 for k = 1.
    pub(crate) plane_weight: f64,
    /// k/R², the weight of the shadow sphere in S; 0 for k = 0.
    pub(crate) sphere_weight: f64,
    /// See `Particle::depth_length`.
    pub(crate) depth_length: f64,
    /// Length over which s = √S changes by 1 at most; 0 where none is known.
    pub(crate) slope_length: f64,
    pub(crate) bounds: Bounds,
    pub(crate) clusters: PlaneClusters,
    /// Of planes in several clusters.
    pub(crate) neighbours: Neighbours,
    /// For each row, the index of its plane among those given.
    order: Box<[usize]>,
}

impl Solid {
    /// The weights of S.
    #[inline(always)]
    pub(crate) fn weights(&self) -> Weights {
        Weights { plane: self.plane_weight, sphere: self.sphere_weight }
    }

    /// Checks and completes a definition. With two dimensions every plane is (a, b, 0, d), and only the cut at z = 0
    /// has to be bounded. Of planes that are one within the bounding ball the first counts.
    pub(crate) fn new(
        planes: &[Plane],
        r: f64,
        k: f64,
        shadow_radius: f64,
        dimensions: usize,
    ) -> Result<Self, ParticleError> {
        if planes.len() > MAX_PLANES {
            return Err(ParticleError::TooManyPlanes(planes.len()));
        }
        let (plane_weight, sphere_weight) = weights(r, k, shadow_radius)?;
        check_planes(planes, plane_weight)?;
        let (clusters, order) =
            if plane_weight > 0.0 { PlaneClusters::of(planes) } else { PlaneClusters::none(planes.len()) };
        let rows: Box<[[f64; 4]]> = order.iter().map(|&i| row(&planes[i])).collect();
        let at_origin = potential_at_origin(&rows, plane_weight);
        if !(at_origin < 1.0) {
            return Err(centre_outside(planes, at_origin - 1.0));
        }
        let extent = Extent::new(plane_weight, sphere_weight, at_origin, dimensions);
        let bounds = Bounds::of(&rows, &extent).ok_or(ParticleError::Unbounded)?;
        if !rows.is_empty() && plane_weight.sqrt() * bounds.radius > SQUARABLE {
            return Err(ParticleError::RoundingTooSmall { r, radius: bounds.radius });
        }
        if !SIZES.contains(&bounds.radius) {
            return Err(ParticleError::Size { radius: bounds.radius });
        }
        if plane_weight > 0.0 {
            if let Some(distinct) = coplanar::distinct_planes(planes, bounds.radius) {
                return Self::new(&distinct, r, k, shadow_radius, dimensions);
            }
        }
        let single = clusters.is_single();
        let neighbours = if single { Neighbours::default() } else { Neighbours::of(&rows, &bounds) };
        let depth_length = depth_length(&rows, plane_weight, sphere_weight, shadow_radius);
        Ok(Self {
            slope_length: slope_length(&rows, plane_weight, sphere_weight),
            rows,
            depth_length,
            dimensions,
            rounding_radius: r,
            sphericity: k,
            shadow_radius,
            plane_weight,
            sphere_weight,
            bounds,
            clusters,
            neighbours,
            order,
        })
    }

    /// A plane, a line or a point through the origin along the first `dimensions` axes: S = 0 on all of it.
    pub(super) fn boundary(dimensions: usize) -> Self {
        let (clusters, order) = PlaneClusters::none(0);
        Self {
            rows: Box::default(),
            depth_length: f64::INFINITY,
            slope_length: 0.0,
            dimensions,
            rounding_radius: 0.0,
            sphericity: 1.0,
            shadow_radius: f64::INFINITY,
            plane_weight: 0.0,
            sphere_weight: 0.0,
            bounds: Bounds::unbounded(),
            clusters,
            neighbours: Neighbours::default(),
            order,
        }
    }

    /// Number of planes.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether the planes alone enclose a volume.
    pub(super) fn planes_enclose(&self) -> bool {
        bounding_volumes::planes_enclose(&self.rows, self.dimensions)
    }

    /// The planes in the order in which they were given.
    pub(crate) fn given_planes(&self) -> Vec<Plane> {
        let mut planes = vec![Plane { normal: Vector3::zeros(), offset: 0.0 }; self.rows.len()];
        for (&given, &row) in self.order.iter().zip(&self.rows) {
            planes[given] = row.into();
        }
        planes
    }

    /// The index among the given planes of that at this place.
    pub(crate) fn given_index(&self, place: usize) -> usize {
        self.order[place]
    }

    /// Whether S has no plane term: planes count only for k < 1.
    pub(crate) fn is_sphere(&self) -> bool {
        self.plane_weight == 0.0 || self.rows.is_empty()
    }

    pub(crate) fn normal(&self, i: usize) -> Vector3<f64> {
        let [a, b, c, _] = self.rows[i];
        Vector3::new(a, b, c)
    }

    pub(crate) fn offset(&self, i: usize) -> f64 {
        self.rows[i][3]
    }

    /// The normals of all planes, in the order of the clusters.
    pub(crate) fn normals(&self) -> impl Iterator<Item = Vector3<f64>> {
        self.rows.iter().map(|[a, b, c, _]| Vector3::new(*a, *b, *c))
    }

    /// Calls `visit` with index, normal n and excess n·y − d of each plane whose excess may be above −`early`. Returns
    /// an upper bound on the excess of all other planes.
    #[inline(always)]
    pub(crate) fn visit_near(
        &self,
        y: &Vector3<f64>,
        early: f64,
        mut visit: impl FnMut(usize, Vector3<f64>, f64),
    ) -> f64 {
        self.clusters.visit_near(y, early, |run| {
            let first = run.start;
            // A single cluster holds all planes: no slice has to be checked.
            let rows = if self.clusters.is_single() { &self.rows[..] } else { &self.rows[run] };
            for (j, [a, b, c, d]) in rows.iter().enumerate() {
                visit(first + j, Vector3::new(*a, *b, *c), a * y.x + b * y.y + c * y.z - d);
            }
        })
    }

    /// n·y − d of a plane.
    #[inline(always)]
    pub(crate) fn excess(&self, place: usize, y: &Vector3<f64>) -> f64 {
        let [a, b, c, d] = self.rows[place];
        a * y.x + b * y.y + c * y.z - d
    }

    /// The largest n·y − d and the index of its plane; −∞ when there are no planes.
    #[inline]
    pub(crate) fn farthest_excess(&self, y: &Vector3<f64>) -> (f64, usize) {
        self.clusters.largest(y, |run| self.largest_of(run, y))
    }

    fn largest_of(&self, run: Range<usize>, y: &Vector3<f64>) -> (f64, usize) {
        let mut largest = (f64::NEG_INFINITY, 0);
        for (i, [a, b, c, d]) in run.clone().zip(&self.rows[run]) {
            let excess = a * y.x + b * y.y + c * y.z - d;
            if excess > largest.0 {
                largest = (excess, i);
            }
        }
        largest
    }

    /// An excess that no neighbour exceeds, and its plane: the largest of the most likely cluster, then uphill over
    /// neighbours. It is seldom less than the largest of all, which takes several times as long to find. −∞ without
    /// planes.
    #[inline]
    pub(crate) fn likely_excess(&self, y: &Vector3<f64>) -> (f64, usize) {
        if self.clusters.is_single() {
            return self.largest_of(0..self.len(), y);
        }
        self.climbed(y, self.largest_of(self.clusters.most_likely(y), y).1)
    }

    /// The same from a plane on, from neighbour to neighbour.
    #[inline]
    pub(crate) fn climbed(&self, y: &Vector3<f64>, from: usize) -> (f64, usize) {
        let mut highest = (self.excess(from, y), from);
        loop {
            let here = highest.1;
            for &other in self.neighbours.around(here) {
                let excess = self.excess(usize::from(other), y);
                if excess > highest.0 {
                    highest = (excess, usize::from(other));
                }
            }
            if highest.1 == here {
                return highest;
            }
        }
    }

    /// Radius of a ball about the origin that holds {S ≤ level}.
    pub(crate) fn reach(&self, level: f64) -> f64 {
        self.bounds.reach(level)
    }
}

/// (1-k)/r² and k/R².
fn weights(r: f64, k: f64, shadow_radius: f64) -> Result<(f64, f64), ParticleError> {
    if !(0.0..=1.0).contains(&k) {
        return Err(ParticleError::Sphericity(k));
    }
    let plane_weight = if k == 1.0 { 0.0 } else { (1.0 - k) / (r * r) };
    // The weight itself must be a normal number: r = 1e-200 would make it infinite.
    if k < 1.0 && !(r > 0.0 && r.is_finite() && plane_weight.is_normal()) {
        return Err(ParticleError::RoundingRadius(r));
    }
    let sphere_weight = if k == 0.0 { 0.0 } else { k / (shadow_radius * shadow_radius) };
    if k > 0.0 && !(shadow_radius > 0.0 && shadow_radius.is_finite() && sphere_weight.is_normal()) {
        return Err(ParticleError::ShadowRadius(shadow_radius));
    }
    Ok((plane_weight, sphere_weight))
}

fn check_planes(planes: &[Plane], plane_weight: f64) -> Result<(), ParticleError> {
    for (index, Plane { normal, offset: d }) in planes.iter().enumerate() {
        let (a, b, c, d) = (normal.x, normal.y, normal.z, *d);
        if ![a, b, c, d].iter().all(|v| v.is_finite()) {
            return Err(ParticleError::PlaneNotFinite { index, a, b, c, d });
        }
        if a == 0.0 && b == 0.0 && c == 0.0 {
            return Err(ParticleError::ZeroNormal { index, d });
        }
        // |n|²/r² is the curvature of S across the plane; it must be a normal number, as (1-k)/r² must.
        let square = normal.norm_squared();
        if !(square.is_normal() && (plane_weight == 0.0 || (plane_weight * square).is_normal())) {
            return Err(ParticleError::NormalLength { index, length: normal.amax() });
        }
    }
    Ok(())
}

/// S(0), where every excess is −d.
fn potential_at_origin(rows: &[[f64; 4]], plane_weight: f64) -> f64 {
    if plane_weight == 0.0 {
        return 0.0;
    }
    plane_weight * rows.iter().map(|row| (-row[3]).max(0.0)).fold(0.0, |sum, excess| sum + excess * excess)
}

/// The inverse of the slope of s where the ray along the normal of the nearest plane leaves S = 1 with this plane
/// alone.
fn depth_length(rows: &[[f64; 4]], plane_weight: f64, sphere_weight: f64, shadow_radius: f64) -> f64 {
    let nearest = rows
        .iter()
        .map(|[a, b, c, d]| (a.hypot(*b).hypot(*c), *d))
        .min_by(|(n, d), (m, e)| (d / n).total_cmp(&(e / m)))
        .filter(|_| plane_weight > 0.0);
    let Some((length, offset)) = nearest else {
        return if sphere_weight > 0.0 { 1.0 / sphere_weight.sqrt() } else { shadow_radius };
    };
    // The larger root h of w (|n| h − d)² + m h² = 1, and the excess |n| h − d there.
    let curvature = plane_weight * length * length + sphere_weight;
    let root = (curvature - sphere_weight * plane_weight * offset * offset).sqrt();
    if !(root > 0.0) {
        // The shadow sphere ends before the plane.
        return 1.0 / sphere_weight.sqrt();
    }
    let height = (plane_weight * length * offset + root) / curvature;
    let excess = (length * root - offset * sphere_weight) / curvature;
    1.0 / (plane_weight * length * excess + sphere_weight * height)
}

/// s is the length of the vector of all √w⟨n_i·x − d_i⟩ and √m x, each of which changes no faster than without the
/// brackets: so |∇s|² is at most w times the largest eigenvalue of Σ n_i n_iᵀ, plus m.
fn slope_length(rows: &[[f64; 4]], plane_weight: f64, sphere_weight: f64) -> f64 {
    let mut squares = Symmetric::default();
    for [a, b, c, _] in rows.iter().filter(|_| plane_weight > 0.0) {
        squares.add_square(&(plane_weight.sqrt() * Vector3::new(*a, *b, *c)));
    }
    // What has left the range of numbers says nothing.
    if !(squares.trace() + sphere_weight >= 1e-280 && squares.trace() < 1e280) {
        return 0.0;
    }
    1.0 / (squares.matrix().symmetric_eigenvalues().max() + sphere_weight).sqrt()
}

/// The error that names the plane furthest behind the origin.
fn centre_outside(planes: &[Plane], f: f64) -> ParticleError {
    let behind = |&i: &usize, &j: &usize| planes[i].offset.total_cmp(&planes[j].offset);
    let worst = (0..planes.len()).min_by(behind).unwrap_or(0);
    ParticleError::CentreOutside { f, worst, d: planes.get(worst).map_or(f64::NAN, |p| p.offset) }
}

fn row(plane: &Plane) -> [f64; 4] {
    [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset]
}
