//! The gauge (Minkowski functional) of a particle, g(p) = 1/τ where the ray through p leaves the particle at τ p, over
//! a piece of a plane or a line.
//!
//! g is convex, and homogeneous of degree 1: its gradient q(p) at any p gives the supporting plane q·x ≤ 1 of the
//! particle at p/g(p), and q(p)·y ≤ g(y) for all y. With x = p/g and P = I − x qᵀ its Hessian is
//!
//! ```text
//! ∇²g(p) = Pᵀ ∇²S(x) P / (g · ∇S(x)·x)
//! ```
//!
//! A plane is active at x where h(p) = n·p − d g(p) > 0. For d ≥ 0 that is a concave function, so that a plane that is
//! active at the corners of a piece is active all over it, and with g replaced by a linear lower bound, one that is
//! inactive at the corners is inactive all over it. For d < 0 it is the other way round. Where no plane is left
//! undecided, the surface is a single quadric over the piece, and g is analytic.

use super::numbers::{LEAST_STEP, Limits, UNDECIDED_SLOPE};
use crate::particle::solid::Solid;
use crate::particle::{potential, ray_cast};
use nalgebra::Vector3;

/// A particle with what does not depend on the piece.
pub(crate) struct Gauge<'a> {
    shape: &'a Solid,
    /// Planes behind which the origin lies: they may be active anywhere.
    behind: Vec<usize>,
}

/// The particle over the convex hull of some corners: the planes that may be active there.
pub(crate) struct Piece {
    planes: Vec<Counted>,
    plane_weight: f64,
    sphere_weight: f64,
    /// 1 over the bounding radius: g ≥ |p| times it.
    least: f64,
    /// The gradient of g at the middle of the piece, if rounding leaves one.
    tangent: Vector3<f64>,
    /// A lower bound of g at each corner; between them, their linear interpolant is one.
    lower: Vec<f64>,
}

struct Counted {
    n: Vector3<f64>,
    d: f64,
    length: f64,
    /// Largest n·p over the corners, less d times the lower bound of g there.
    most: f64,
}

/// What planes add on rays: Σ e², and half of its slope and of its curvature.
struct Sums<const N: usize> {
    squares: [f64; N],
    mixed: [f64; N],
    steep: [f64; N],
}

/// The surface on the ray through p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnRay {
    /// g(p).
    pub gauge: f64,
    /// ∇g(p).
    pub tangent: Vector3<f64>,
    /// ∇S(x)·x at x = p/g.
    pub slope: f64,
    /// Bound on the rounding of g.
    pub rounding: f64,
}

/// What the planes do over a piece.
#[derive(Clone, Debug)]
pub(crate) struct Activity {
    /// The planes that are neither active nor inactive all over it.
    pub undecided: Vec<Undecided>,
    /// A lower bound of ∇S(x)·x.
    ///
    /// With e_i the excess of each plane and w their weight it is 2 (1 + w Σ e_i d_i). Σ e_i is at least the root of Σ
    /// e_i², and e_i g is concave for d_i ≥ 0, so that it is least at a corner. Where a plane has the origin behind it,
    /// S(x) − S(0) is a bound, since S is convex.
    pub least_slope: f64,
}

/// A plane that is active in some part of the piece only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Undecided {
    pub n: Vector3<f64>,
    pub d: f64,
    /// Its excess where it is active, or what lacks where it is not, is at most this.
    pub excess: f64,
}

impl<'a> Gauge<'a> {
    pub fn of(shape: &'a Solid) -> Self {
        let behind = (0..shape.len()).filter(|&i| shape.offset(i) < 0.0).collect();
        Self { shape, behind }
    }

    /// Over the hull of `corners`, which lies in a plane or on a line at this distance from the origin.
    pub fn on(&self, corners: &[Vector3<f64>], height: f64) -> Piece {
        let shape = self.shape;
        let least = 1.0 / shape.bounds.radius;
        let tangent = self.tangent(&middle(corners)).unwrap_or_else(Vector3::zeros);
        let lower = lower_bounds(corners, &tangent, height * least);
        let mut found = Vec::new();
        if !shape.is_sphere() {
            found.extend_from_slice(&self.behind);
            for (corner, bound) in corners.iter().zip(&lower) {
                let early = UNDECIDED_SLOPE * shape.bounds.longest_normal * corner.norm() / bound;
                shape.visit_near(&(corner / *bound), early, |i, _, excess| {
                    if excess > -early {
                        found.push(i);
                    }
                });
            }
            found.sort_unstable();
            found.dedup();
        }
        let counted = |i: usize| Counted::of(shape.normal(i), shape.offset(i), corners, &lower);
        Piece {
            planes: found.into_iter().map(counted).collect(),
            plane_weight: shape.plane_weight,
            sphere_weight: shape.sphere_weight,
            least,
            tangent,
            lower,
        }
    }

    fn tangent(&self, p: &Vector3<f64>) -> Option<Vector3<f64>> {
        let direction = p.normalize();
        let x = ray_cast::distance(self.shape, &Vector3::zeros(), &direction)? * direction;
        let gradient = potential::tangent(self.shape, &x).gradient;
        let tangent = gradient / gradient.dot(&x);
        tangent.iter().all(|part| part.is_finite()).then_some(tangent)
    }
}

impl Counted {
    fn of(n: Vector3<f64>, d: f64, corners: &[Vector3<f64>], lower: &[f64]) -> Self {
        let most = corners.iter().zip(lower).map(|(p, bound)| n.dot(p) - d * bound).fold(f64::NEG_INFINITY, f64::max);
        Self { n, d, length: n.norm(), most }
    }
}

fn middle(corners: &[Vector3<f64>]) -> Vector3<f64> {
    corners.iter().sum::<Vector3<f64>>() / corners.len() as f64
}

/// Lower bounds of g at the corners of a piece: the tangent plane at its middle, or where that says less the bounding
/// ball, `floor`.
fn lower_bounds(corners: &[Vector3<f64>], tangent: &Vector3<f64>, floor: f64) -> Vec<f64> {
    let bounds: Vec<f64> = corners.iter().map(|corner| tangent.dot(corner)).collect();
    if bounds.iter().all(|&bound| bound >= floor) { bounds } else { vec![floor; corners.len()] }
}

impl Piece {
    /// Over a part of the piece, of the same height.
    pub fn within(&self, corners: &[Vector3<f64>], height: f64) -> Self {
        let tangent = self.at(&middle(corners), &Vector3::zeros()).tangent;
        let lower = lower_bounds(corners, &tangent, height * self.least);
        let longest = corners.iter().map(|p| p.norm()).fold(0.0, f64::max);
        let counted = self.planes.iter().map(|plane| Counted::of(plane.n, plane.d, corners, &lower));
        let may_count = |plane: &Counted| plane.d < 0.0 || plane.most > -UNDECIDED_SLOPE * plane.length * longest;
        Self { planes: counted.filter(may_count).collect(), tangent, lower, ..*self }
    }

    /// Number of planes that are evaluated for each ray.
    pub fn len(&self) -> usize {
        self.planes.len()
    }

    /// A lower bound of g(p), by the bounding ball.
    pub fn least(&self, p: &Vector3<f64>) -> f64 {
        self.least * p.norm()
    }

    pub fn plane_weight(&self) -> f64 {
        self.plane_weight
    }

    /// The surface on the ray through a point of the piece. `near` is ∇g at a point of the piece nearby, or 0.
    pub fn at(&self, p: &Vector3<f64>, near: &Vector3<f64>) -> OnRay {
        let [on_ray] = self.along_row(&[*p], &[*near]);
        on_ray
    }

    /// The same for a row of points, for which each plane is evaluated at once: Newton's method from outside, which
    /// does not overshoot, since S is convex.
    pub fn along_row<const N: usize>(&self, points: &[Vector3<f64>; N], near: &[Vector3<f64>; N]) -> [OnRay; N] {
        let mut tau: [f64; N] = std::array::from_fn(|i| {
            let p = &points[i];
            1.0 / self.tangent.dot(p).max(near[i].dot(p)).max(self.least * p.norm())
        });
        // The last points that were not found to be inside.
        let mut outside = tau;
        let mut is_open = [true; N];
        let coordinates = [0, 1, 2].map(|axis| points.map(|p| p[axis]));
        for is_first in (0..Limits::GAUGE_STEPS).map(|step| step == 0) {
            let sums = self.sums(&coordinates, &tau);
            for i in 0..N {
                if !is_open[i] {
                    continue;
                }
                let sphere = self.sphere_weight * points[i].norm_squared();
                let value = sphere * tau[i] * tau[i] - 1.0 + self.plane_weight * sums.squares[i];
                let half_slope = sphere * tau[i] + self.plane_weight * sums.mixed[i];
                let half_curvature = sphere + self.plane_weight * sums.steep[i];
                let step = 0.5 * value / half_slope;
                if half_slope > 0.0 && value > -0.5 {
                    outside[i] = tau[i];
                }
                // The rounding of a tangent may have put the start inside, where no plane may be active.
                if is_first && !(step >= -LEAST_STEP * tau[i]) {
                    tau[i] = self.beyond_a_plane(&points[i]);
                    outside[i] = tau[i];
                    continue;
                }
                // Also where a step is not a number.
                let moves = step > LEAST_STEP * tau[i];
                if moves {
                    tau[i] -= step;
                }
                let left = 0.5 * half_curvature * step * step;
                is_open[i] = moves && left > 0.25 * LEAST_STEP * tau[i] * half_slope;
            }
            if !is_open.contains(&true) {
                break;
            }
        }
        let pulls = self.pulls(&coordinates, &outside);
        std::array::from_fn(|i| self.on_ray(&points[i], tau[i], outside[i], &pulls[i]))
    }

    /// What the planes add to S, its slope and its curvature along rays.
    #[inline(always)]
    fn sums<const N: usize>(&self, [x, y, z]: &[[f64; N]; 3], tau: &[f64; N]) -> Sums<N> {
        let mut sums = Sums { squares: [0.0; N], mixed: [0.0; N], steep: [0.0; N] };
        for Counted { n, d, .. } in &self.planes {
            for i in 0..N {
                let rate = n.x * x[i] + n.y * y[i] + n.z * z[i];
                let excess = tau[i] * rate - d;
                let excess = if excess > 0.0 { excess } else { 0.0 };
                sums.squares[i] += excess * excess;
                sums.mixed[i] += excess * rate;
                sums.steep[i] += if excess > 0.0 { rate * rate } else { 0.0 };
            }
        }
        sums
    }

    /// Σ e_i n_i, and what rounding makes of the excess of each plane, at points of rays.
    #[inline(always)]
    fn pulls<const N: usize>(&self, [x, y, z]: &[[f64; N]; 3], tau: &[f64; N]) -> [(Vector3<f64>, f64); N] {
        let mut sums = [[0.0; N]; 4];
        let far: [f64; N] = std::array::from_fn(|i| tau[i] * (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt());
        for Counted { n, d, length, .. } in &self.planes {
            for i in 0..N {
                let excess = tau[i] * (n.x * x[i] + n.y * y[i] + n.z * z[i]) - d;
                let excess = if excess > 0.0 { excess } else { 0.0 };
                sums[0][i] += excess * n.x;
                sums[1][i] += excess * n.y;
                sums[2][i] += excess * n.z;
                sums[3][i] += excess * (length * far[i] + d.abs());
            }
        }
        std::array::from_fn(|i| (Vector3::new(sums[0][i], sums[1][i], sums[2][i]), sums[3][i]))
    }

    /// The surface at τ p, with the tangent from a point on the ray that is not inside.
    fn on_ray(&self, p: &Vector3<f64>, tau: f64, outside: f64, (sum, rounding): &(Vector3<f64>, f64)) -> OnRay {
        let x = outside * p;
        let half = self.plane_weight * sum + self.sphere_weight * x;
        let half_slope = half.dot(&x);
        let gauge = 1.0 / tau;
        let usable = half_slope > 0.0;
        OnRay {
            gauge,
            tangent: if usable { half / (half_slope * tau / outside) } else { p * (gauge / p.norm_squared()) },
            slope: 2.0 * half_slope,
            rounding: gauge
                * (LEAST_STEP + if usable { LEAST_STEP * self.plane_weight * rounding / half_slope } else { 0.0 }),
        }
    }

    /// 1/g is at most this: where one plane alone gives S = 1, or the ray leaves the bounding ball.
    fn beyond_a_plane(&self, p: &Vector3<f64>) -> f64 {
        let depth = 1.0 / self.plane_weight.sqrt();
        let crossings = self.planes.iter().map(|plane| (plane.d + depth) / plane.n.dot(p)).filter(|tau| *tau > 0.0);
        crossings.fold(1.0 / (self.least * p.norm()), f64::min)
    }

    /// What the planes do over the piece, by g at its corners.
    pub fn activity(&self, corners: &[Vector3<f64>], gauges: &[f64]) -> Activity {
        let longest = corners.iter().map(|p| p.norm()).fold(0.0, f64::max);
        let highest = gauges.iter().copied().fold(0.0, f64::max);
        let of_lower = self.lower.iter().copied().fold(f64::INFINITY, f64::min);
        let (mut undecided, mut active, mut nearest, mut behind) = (Vec::new(), 0.0, f64::INFINITY, 0.0);
        for Counted { n, d, length, most } in &self.planes {
            let over = |bounds: &[f64]| {
                let h = corners.iter().zip(bounds).map(|(p, bound)| n.dot(p) - d * bound);
                h.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (h.min(low), h.max(high)))
            };
            let (low, high) = if *d >= 0.0 { (over(gauges).0, *most) } else { (over(&self.lower).0, over(gauges).1) };
            let rounding = UNDECIDED_SLOPE * length * longest;
            if high > rounding && low < -rounding {
                undecided.push(Undecided { n: *n, d: *d, excess: high.min(-low) / of_lower });
            }
            active += d.max(0.0) * low.max(0.0) / highest;
            nearest = d.min(nearest);
            behind += d.min(0.0).powi(2);
        }
        let of_planes = (1.0 - self.sphere_weight / self.least.powi(2)).max(0.0);
        let least_slope = if nearest >= 0.0 {
            2.0 + 2.0 * f64::max(nearest * (self.plane_weight * of_planes).sqrt(), self.plane_weight * active)
        } else {
            1.0 - self.plane_weight * behind
        };
        Activity { undecided, least_slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;

    /// Pieces of the plane x = 1 from far wider than the particle to far smaller than its rounding.
    fn pieces() -> impl Iterator<Item = [Vector3<f64>; 4]> {
        [(0.0, 0.0, 2.0), (0.7, 0.6, 0.3), (0.72, 0.1, 0.1), (0.9, 0.9, 1e-3)].into_iter().map(|(y, z, half)| {
            [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
                .map(|(u, v)| Vector3::new(1.0, y + u * half, z + v * half))
        })
    }

    fn inside(corners: &[Vector3<f64>; 4], i: u32, j: u32) -> Vector3<f64> {
        let (u, v) = (f64::from(i) / 8.0, f64::from(j) / 8.0);
        let [a, b, c, d] = corners;
        (1.0 - u) * ((1.0 - v) * a + v * b) + u * ((1.0 - v) * c + v * d)
    }

    #[test]
    fn rays_end_on_the_surface_and_tangents_lie_outside() {
        for particle in
            [Particle::cube(0.7, 0.3, 0.0, 1.0), Particle::cube(0.7, 1e-6, 0.1, 2.0), Particle::sphere(1.0).unwrap()]
        {
            let gauge = Gauge::of(&particle);
            for corners in pieces() {
                let piece = gauge.on(&corners, 1.0);
                let tangent = piece.at(&corners[0], &Vector3::zeros()).tangent;
                for (i, j) in (0..=8).flat_map(|i| (0..=8).map(move |j| (i, j))) {
                    let p = inside(&corners, i, j);
                    let on_ray = piece.at(&p, &tangent);
                    let distance = particle.surface_distance(&Vector3::zeros(), &p.normalize()).unwrap();
                    assert!((distance * on_ray.gauge / p.norm() - 1.0).abs() < 1e-13);
                    assert!(tangent.dot(&p) <= on_ray.gauge * (1.0 + 1e-12));
                    assert!((on_ray.tangent.dot(&p) / on_ray.gauge - 1.0).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn planes_that_are_decided_are_active_everywhere_or_nowhere() {
        let particle = Particle::cube(0.7, 0.3, 0.0, 1.0);
        let (gauge, mut counts) = (Gauge::of(&particle), Vec::new());
        for corners in pieces() {
            let piece = gauge.on(&corners, 1.0);
            let gauges = corners.map(|corner| piece.at(&corner, &Vector3::zeros()).gauge);
            let undecided = piece.activity(&corners, &gauges).undecided;
            for plane in particle.planes() {
                let excess = |i, j| {
                    let p = inside(&corners, i, j);
                    plane.normal.dot(&p) / piece.at(&p, &Vector3::zeros()).gauge - plane.offset
                };
                let all = (0..=8).flat_map(|i| (0..=8).map(move |j| (i, j))).map(|(i, j)| excess(i, j));
                let active = all.filter(|excess| *excess > 1e-14).count();
                let is_undecided = undecided.iter().any(|other| other.n == plane.normal);
                assert!(is_undecided || active == 0 || active == 81, "{active} of 81");
            }
            counts.push(undecided.len());
        }
        assert!(counts[0] > 0 && counts[3] == 0, "{counts:?}");
    }
}
