//! A particle placed in the frame in which a pair is solved.

use crate::linalg::number::larger;
use crate::linalg::symmetric::Symmetric;
use crate::pair::local_point::LocalPoint;
use crate::pair::pair::Pair;
use crate::particle::particle::Particle;
use crate::particle::potential::{self, OnLine, Quadratic, Weights};
use nalgebra::{Matrix3, Vector3};

/// A particle with its pose in the solver's frame (local axes of B, origin at the centre of B).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<'a> {
    pub particle: &'a Particle,
    /// Local to solver frame.
    rotation: Matrix3<f64>,
    /// Whether that is more than the identity: the axes of B are the solver's own.
    is_rotated: bool,
    /// Centre in the solver frame.
    centre: Vector3<f64>,
    /// Length added to |y| for the rounding of the centre, before `rounding` multiplies it.
    of_centre: f64,
    /// Bound on the rounding of a point, relative to its distance from the centre and that length.
    rounding: f64,
    /// The weights that the solver uses: the particle's own, or regularised ones.
    weights: Weights,
}

/// Bounds, in units of ε·length, on the rounding of a point as a body sees it and of n·y in n·y − d: in the axes of B,
/// and in those of A, whose rotation is rounded (docs/theory.md, "Rounding"). That of d is less than ε·|d| in either.
/// Derived: 28.9 in A, 2.5 in B.
const IN_B: f64 = 4.0;
const IN_A: f64 = 30.0;

/// The rounding of the centre of A, relative to its length, is at most this share of [`IN_A`] (derived: 24/50.4).
const OF_CENTRE: f64 = 0.5;

/// Bound on the rounding of a point as A sees it, at `length` from its centre, which is `centre` from that of B.
pub(crate) fn shift_in_a(length: f64, centre: f64) -> f64 {
    IN_A * f64::EPSILON * (length + OF_CENTRE * centre)
}

/// The same for B.
pub(crate) fn shift_in_b(length: f64) -> f64 {
    IN_B * f64::EPSILON * length
}

impl<'a> Body<'a> {
    /// Both bodies of a pair; k below `least_sphericity` is raised to it (see `Settings`).
    pub fn both(pair: &Pair<'a>, least_sphericity: f64) -> (Self, Self) {
        let body = |particle: &'a Particle, rotation, is_rotated, centre: Vector3<f64>, lengths: f64| Self {
            particle,
            rotation,
            is_rotated,
            centre,
            of_centre: OF_CENTRE * lengths,
            rounding: f64::EPSILON * if is_rotated { IN_A } else { IN_B },
            weights: Weights::of(particle, least_sphericity),
        };
        (
            body(pair.a, pair.rotation, true, pair.centre, pair.lengths()),
            body(pair.b, Matrix3::identity(), false, Vector3::zeros(), 0.0),
        )
    }

    /// One body alone, in its own frame as B is; k below `least_sphericity` is raised to it.
    pub fn alone(particle: &'a Particle, least_sphericity: f64) -> Self {
        Self {
            particle,
            rotation: Matrix3::identity(),
            is_rotated: false,
            centre: Vector3::zeros(),
            of_centre: 0.0,
            rounding: f64::EPSILON * IN_B,
            weights: Weights::of(particle, least_sphericity),
        }
    }

    /// Solver frame to local frame.
    #[inline]
    pub fn local(&self, x: &Vector3<f64>) -> Vector3<f64> {
        if self.is_rotated { self.rotation.tr_mul(&(x - self.centre)) } else { *x }
    }

    /// A direction of the solver frame in the local frame.
    #[inline]
    pub fn turn(&self, v: &Vector3<f64>) -> Vector3<f64> {
        if self.is_rotated { self.rotation.tr_mul(v) } else { *v }
    }

    /// A direction of the local frame in the solver frame.
    #[inline]
    pub fn to_solver(&self, n: Vector3<f64>) -> Vector3<f64> {
        if self.is_rotated { self.rotation * n } else { n }
    }

    /// A symmetric matrix of the solver frame in the local frame.
    pub fn turn_matrix(&self, h: &Symmetric) -> Symmetric {
        if self.is_rotated { h.turned(&self.rotation.transpose()) } else { *h }
    }

    /// Centre in the solver frame.
    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// A large n·x − d and the place of its plane (see [`crate::particle::solid::Solid::likely_excess`]).
    #[inline]
    pub fn likely_excess(&self, x: &Vector3<f64>) -> (f64, usize) {
        self.particle.likely_excess(&self.local(x))
    }

    /// The normal of a plane, solver frame.
    #[inline]
    pub fn normal(&self, place: usize) -> Vector3<f64> {
        self.to_solver(self.particle.normal(place))
    }

    /// The point x as this body sees it, with the bounds on its rounding.
    pub fn locate(&self, x: &Vector3<f64>) -> LocalPoint {
        let bounds = &self.particle.bounds;
        // |y|, without waiting for the rotation.
        let lengths = (x - self.centre).norm() + self.of_centre;
        let shift = self.rounding * lengths;
        let blur = bounds.longest_normal * shift + f64::EPSILON * bounds.offset_within(lengths);
        LocalPoint::new(self.local(x), shift, blur)
    }

    /// (Regularised) S with derivatives in the axes of `frame` (columns: axes in the solver frame), or of the solver
    /// frame itself.
    #[inline(always)]
    pub fn at(&self, point: &LocalPoint, frame: Option<&Matrix3<f64>>) -> Quadratic {
        match frame {
            Some(axes) if self.is_rotated => self.in_axes(point, &axes.tr_mul(&self.rotation)),
            Some(axes) => self.in_axes(point, &axes.transpose()),
            None if self.is_rotated => self.in_axes(point, &self.rotation),
            None => self.in_its_own(point),
        }
    }

    /// Out of line, each once: they are long.
    #[inline(never)]
    fn in_axes(&self, point: &LocalPoint, rotation: &Matrix3<f64>) -> Quadratic {
        self.quadratic(point, |n| rotation * n)
    }

    #[inline(never)]
    fn in_its_own(&self, point: &LocalPoint) -> Quadratic {
        self.quadratic(point, |n| n)
    }

    #[inline(always)]
    fn quadratic(&self, point: &LocalPoint, turn: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Quadratic {
        let active = |place, excess| point.is_active(place, excess);
        potential::turned(self.particle, &self.weights, turn, &point.y, point.blur, active)
    }

    /// (Regularised) S at x along the direction e.
    pub fn on_line(&self, x: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
        potential::on_line(self.particle, &self.weights, &self.local(x), &self.turn(e))
    }

    /// (Regularised) S at x.
    pub fn value(&self, x: &Vector3<f64>) -> f64 {
        potential::value(self.particle, &self.local(x)) + self.surplus(x)
    }

    /// Whether S is the particle's own, not regularised.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.weights.sphere == self.particle.sphere_weight
    }

    /// Calls `visit` with the (solver frame) normal of each active plane.
    #[inline]
    pub fn active_normals(&self, point: &LocalPoint, mut visit: impl FnMut(Vector3<f64>)) {
        self.particle.visit_near(&point.y, point.blur, |place, n, excess| {
            if point.is_active(place, excess) {
                visit(self.to_solver(n));
            }
        });
    }

    /// Bound on the rounding of S, given the quadratic.
    pub fn rounding(&self, point: &LocalPoint, q: &Quadratic) -> f64 {
        let LocalPoint { shift, blur, .. } = *point;
        let second = self.second_order(f64::from(q.count), shift, blur);
        q.pull * blur + q.gradient.norm() * point.shift + second + self.rounding_of_value(q.value, q.count)
    }

    /// Second-order change of S by a shift and the blur of these planes. One that is left out at a depth of one blur
    /// may be active by two.
    #[inline]
    pub fn second_order(&self, planes: f64, shift: f64, blur: f64) -> f64 {
        4.0 * planes * self.plane_weight() * blur * blur + self.weights.sphere * shift * shift
    }

    /// Bound on the rounding of a value of S that is summed up over so many planes: γ with n = count + 8.
    #[inline]
    pub fn rounding_of_value(&self, value: f64, count: u32) -> f64 {
        (4.0 + 0.5 * f64::from(count)) * f64::EPSILON * value
    }

    /// The shift and the blur at the end of a step of this length.
    #[inline]
    pub fn after(&self, point: &LocalPoint, step: f64) -> (f64, f64) {
        let further = self.rounding * step;
        (point.shift + further, point.blur + self.particle.bounds.longest_normal * further)
    }

    /// The weights of (regularised) S.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// Weight of the planes in S, 1/length².
    pub fn plane_weight(&self) -> f64 {
        self.weights.plane
    }

    /// 2w with the weight w of the planes, 1/length²: times |n|² it is the curvature that a plane gives S across
    /// itself.
    pub fn plane_curvature(&self) -> f64 {
        2.0 * self.plane_weight()
    }

    /// Largest curvature that one plane can give S, 1/length².
    pub fn stiffest_curvature(&self) -> f64 {
        let length = self.particle.bounds.longest_normal;
        self.plane_curvature() * length * length
    }

    /// Curvature of the shadow sphere's share of S, the least in any direction.
    pub fn sphere_curvature(&self) -> f64 {
        2.0 * self.weights.sphere
    }

    /// Bound on how fast the shadow sphere's share of S changes with its centre where S is `value`: 2m|y| with m|y|² ≤
    /// S.
    #[inline]
    pub fn sphere_slope(&self, value: f64) -> f64 {
        2.0 * (self.weights.sphere * larger(value, 0.0)).sqrt()
    }

    /// Weight of the sphere that the regularisation adds to S.
    fn added(&self) -> f64 {
        self.weights.sphere - self.particle.sphere_weight
    }

    /// How much the regularisation adds to S at x.
    pub fn surplus(&self, x: &Vector3<f64>) -> f64 {
        self.added() * (x - self.centre).norm_squared()
    }

    /// Square of the way from x to the centre; infinite where nothing is regularised.
    pub fn regularised_square(&self, x: &Vector3<f64>) -> f64 {
        if self.is_plain() { f64::INFINITY } else { (x - self.centre).norm_squared() }
    }

    /// Gradient of surplus.
    pub fn surplus_gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.surplus_curvature() * (x - self.centre)
    }

    /// Its curvature in each direction.
    pub fn surplus_curvature(&self) -> f64 {
        2.0 * self.added()
    }

    /// Upper bound of what the regularisation adds anywhere in {S ≤ `level`}.
    pub fn most_surplus(&self, level: f64) -> f64 {
        if self.added() == 0.0 {
            return 0.0;
        }
        let reach = self.particle.reach(level);
        self.added() * reach * reach
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::wide::{rounded, wide};
    use crate::pair::extended_body::ExtendedBody;
    use crate::pair::scattered;
    use crate::pose::Pose;

    #[test]
    fn a_point_is_rounded_by_no_more_than_its_shift() {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let mut most: f64 = 0.0;
        for seed in 0..2000 {
            let mut chance = scattered(100 * seed);
            let mut pose = |far: f64| {
                let position = [far * chance(), far * chance(), far * chance()];
                Pose::new(position, [chance(), chance(), chance(), chance()]).unwrap()
            };
            let far = [0.0, 1.0, 1e6][seed % 3];
            let (pose_a, pose_b) = (pose(far), pose(1.0));
            let pair = Pair::new(&cube, &pose_a, &cube, &pose_b);
            let (a, b) = Body::both(&pair, 0.0);
            let x = pair.centre + Vector3::new(0.3, -0.2, 0.5);
            let exact = ExtendedBody::both(&pair, [&a, &b], &x);
            for (body, exact) in [&a, &b].into_iter().zip(&exact) {
                let point = body.locate(&x);
                let off = rounded(&(wide(&point.y) - exact.local())).norm();
                assert!(off <= point.shift, "{off:e} of {:e}", point.shift);
                most = most.max(off / point.shift);
            }
        }
        assert!(most > 0.01, "{most}");
    }
}
