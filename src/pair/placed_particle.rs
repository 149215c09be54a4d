//! A particle placed in the frame in which a pair is solved.

use crate::linalg::number::larger;
use crate::linalg::symmetric::Symmetric;
use crate::model::kkt_check::Verdict;
use crate::pair::active_set::{Local, Place};
use crate::pair::relative_pose::Pair;
use crate::particle::particle::Particle;
use crate::particle::potential::{self, OnLine, Quadratic};
use nalgebra::{Matrix3, Vector3};

/// A particle with its pose in the solver's frame (local axes of B, origin at the centre of B).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<'a> {
    pub particle: &'a Particle,
    /// Local to solver frame.
    rotation: Matrix3<f64>,
    /// Whether that is more than the identity: the axes of B are the solver's own.
    turned: bool,
    /// Centre in the solver frame.
    centre: Vector3<f64>,
    /// Twice the distance of the centre from the origin: it enters the point as seen from here, rounded twice.
    twice_centre: f64,
    /// Weight of the planes that the solver uses: the particle's own, or a lower one ([`Body::softened`]).
    plane_weight: f64,
    /// Weight of the shadow sphere that the solver uses: the particle's own, or the regularised one.
    sphere_weight: f64,
}

/// Units in the last place per length that a distance to a plane may lose; measured against 40-digit
/// solutions, whose worst error stays ten times below.
const ROUNDING: f64 = 4.0;

/// Bound on the rounding of a point that is made from these lengths.
pub(crate) fn shift(lengths: f64) -> f64 {
    ROUNDING * f64::EPSILON * lengths
}

impl<'a> Body<'a> {
    /// Both bodies of a pair; k below `least_sphericity` is raised to it (see `Settings`).
    pub fn both(pair: &Pair<'a>, least_sphericity: f64) -> (Self, Self) {
        let body = |particle: &'a Particle, rotation, turned, centre: Vector3<f64>| Self {
            particle,
            rotation,
            turned,
            centre,
            twice_centre: 2.0 * centre.norm(),
            plane_weight: particle.plane_weight,
            sphere_weight: larger(particle.sphere_weight, least_sphericity / particle.bounding_radius().powi(2)),
        };
        (body(pair.a, pair.rotation, true, pair.centre), body(pair.b, Matrix3::identity(), false, Vector3::zeros()))
    }

    /// The same body with planes that weigh at most this much: S nowhere larger.
    pub fn softened(&self, plane_weight: f64) -> Self {
        Self { plane_weight: self.plane_weight.min(plane_weight), ..*self }
    }

    /// Solver frame to local frame.
    #[inline]
    pub fn local(&self, x: &Vector3<f64>) -> Vector3<f64> {
        if self.turned { self.rotation.tr_mul(&(x - self.centre)) } else { *x }
    }

    /// A direction of the solver frame in the local frame.
    #[inline]
    pub fn turn(&self, v: &Vector3<f64>) -> Vector3<f64> {
        if self.turned { self.rotation.tr_mul(v) } else { *v }
    }

    /// The largest n·x − d, and the place of its plane.
    #[inline]
    pub fn farthest_excess(&self, x: &Vector3<f64>) -> (f64, usize) {
        self.particle.farthest_excess(&self.local(x))
    }

    /// The normal of a plane, solver frame.
    #[inline]
    pub fn normal(&self, place: usize) -> Vector3<f64> {
        self.to_solver(self.particle.normal(place))
    }

    /// A direction of the local frame in the solver frame.
    #[inline]
    pub fn to_solver(&self, n: Vector3<f64>) -> Vector3<f64> {
        if self.turned { self.rotation * n } else { n }
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// The point x as this body sees it, with planes counting from `early` before they switch on.
    pub fn locate(&self, x: &Vector3<f64>, early: f64) -> Local {
        let bounds = &self.particle.bounds;
        let lengths = x.norm() + self.twice_centre;
        let shift = shift(lengths);
        let blur = bounds.longest_normal * shift + ROUNDING * f64::EPSILON * bounds.offset_within(lengths + early);
        Local::new(self.local(x), shift, blur, larger(early, blur))
    }

    /// (Regularised) S with derivatives in the axes of `frame` (columns: axes in the solver frame), or of the solver
    /// frame itself.
    #[inline(always)]
    pub fn at(&self, place: &impl Place, frame: Option<&Matrix3<f64>>) -> Quadratic {
        match frame {
            Some(axes) if self.turned => self.in_axes(place, &axes.tr_mul(&self.rotation)),
            Some(axes) => self.in_axes(place, &axes.transpose()),
            None if self.turned => self.in_axes(place, &self.rotation),
            None => self.in_its_own(place),
        }
    }

    /// Out of line, each once: they are long.
    #[inline(never)]
    fn in_axes(&self, place: &impl Place, rotation: &Matrix3<f64>) -> Quadratic {
        self.quadratic(place, |n| rotation * n)
    }

    #[inline(never)]
    fn in_its_own(&self, place: &impl Place) -> Quadratic {
        self.quadratic(place, |n| n)
    }

    #[inline(always)]
    fn quadratic(&self, place: &impl Place, turn: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Quadratic {
        let weights = (self.plane_weight, self.sphere_weight);
        let counts = |i, excess| place.counts(self.particle, i, excess);
        potential::turned(self.particle, weights, turn, place.point(), place.early(), counts)
    }

    /// (Regularised) S at x along the direction e.
    pub fn on_line(&self, x: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
        potential::on_line(self.particle, self.sphere_weight, &self.local(x), &self.turn(e))
    }

    /// Whether S is the particle's own, not regularised.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.sphere_weight == self.particle.sphere_weight
    }

    /// Calls `visit` with the (solver frame) normal of each plane of the quadratic.
    #[inline]
    pub fn normals(&self, place: &impl Place, mut visit: impl FnMut(Vector3<f64>)) {
        self.particle.visit_near(place.point(), place.early(), |i, n, excess| {
            if place.counts(self.particle, i, excess) {
                visit(if self.turned { self.rotation * n } else { n });
            }
        });
    }

    /// Bound on the rounding of S, given the quadratic.
    pub fn rounding(&self, local: &Local, q: &Quadratic) -> f64 {
        let blur = local.blur;
        let planes = q.pull * blur + q.gradient.norm() * local.shift + self.plane_weight * blur * blur;
        planes + ROUNDING * f64::EPSILON * q.value
    }

    /// What the rounding of where the planes lie does to S at the end of a step of this length with its verdict, where
    /// the gradient is this long; with it the rounding of the sums at the point of expansion, carried along. Apart from it
    /// what is of second order, and makes S larger only.
    pub fn rounding_after(
        &self,
        local: &Local,
        q: &Quadratic,
        verdict: &Verdict,
        step: f64,
        gradient: f64,
    ) -> (f64, f64) {
        let (shift, blur) = self.after(local, step);
        let first = verdict.pull * blur + gradient * shift + q.pull * (blur - local.blur);
        (first, verdict.near * self.plane_weight * blur * blur)
    }

    /// The shift and the blur at the end of a step of this length.
    #[inline]
    pub fn after(&self, local: &Local, step: f64) -> (f64, f64) {
        let further = shift(step);
        (local.shift + further, local.blur + self.particle.bounds.longest_normal * further)
    }

    /// Rounding of a value of S that is summed up.
    #[inline]
    pub fn rounding_of_value(&self, value: f64) -> f64 {
        ROUNDING * f64::EPSILON * value
    }

    /// The same point with the shift and the blur that it has at the end of a step of this length.
    pub fn blurred(&self, local: &Local, step: f64) -> Local {
        let (shift, blur) = self.after(local, step);
        local.blurred(shift, blur)
    }

    /// The blur of one plane. That of the point is what the longest normal makes of its shift; n·x − d of a shorter one changes
    /// by less. Of two planes in one place, one of them written 40 times as long, a point follows both only if each has its own.
    pub fn blur_of(&self, n: &Vector3<f64>, local: &Local) -> f64 {
        local.blur - larger(self.particle.bounds.longest_normal - n.norm(), 0.0) * local.shift
    }

    /// (Regularised) S after a step v from a point, with all planes moved in by their blur and the centre moved away by its
    /// shift; derivatives in the axes of `frame` or of the solver. Planes count from `early` before they switch on.
    pub fn inset(&self, local: &Local, v: &Vector3<f64>, early: f64, frame: Option<&Matrix3<f64>>) -> Quadratic {
        let (e, blur) = (self.turn(v), local.blur);
        let rotation = frame.map_or(self.rotation, |axes| axes.tr_mul(&self.rotation));
        let far = self.particle.bounds.longest_normal * e.norm() * (1.0 + 1e-14) + blur + early;
        let (mut square, mut all, mut linear, mut count) = (0.0, 0.0, 0.0, 0);
        let (mut g, mut squares) = (Vector3::zeros(), Symmetric::default());
        self.particle.visit_near(&local.y, far, |_, n, excess| {
            let depth = excess + n.dot(&e) + self.blur_of(&n, local);
            if depth > -early {
                let n = rotation * n;
                square += larger(depth, 0.0) * depth;
                all += depth * depth;
                linear += larger(depth, 0.0);
                count += 1;
                g += depth * n;
                squares.add_square(&n);
            }
        });
        let (w2, m2, y) = (2.0 * self.plane_weight, 2.0 * self.sphere_weight, local.y + e);
        let of_sphere = self.sphere_weight * (y.norm() + local.shift).powi(2);
        Quadratic {
            value: self.plane_weight * square + of_sphere,
            expansion: self.plane_weight * all + of_sphere,
            gradient: w2 * g + m2 * (rotation * y),
            hessian: squares.scaled(w2, m2),
            pull: w2 * linear,
            count,
            clear: 0.0,
        }
    }

    /// (Regularised) S at x.
    pub fn value(&self, x: &Vector3<f64>) -> f64 {
        let surplus = self.surplus(x);
        potential::value(self.particle, &self.local(x)) + surplus
    }

    /// Weight of the planes in S.
    pub fn plane_weight(&self) -> f64 {
        self.plane_weight
    }

    /// Weight of the shadow sphere in (regularised) S.
    pub fn sphere_weight(&self) -> f64 {
        self.sphere_weight
    }

    /// Largest curvature that one plane can give S.
    pub fn plane_curvature(&self) -> f64 {
        2.0 * self.plane_weight
    }

    /// Curvature of the shadow sphere's share of S, the least in any direction.
    pub fn sphere_curvature(&self) -> f64 {
        2.0 * self.sphere_weight
    }

    /// Bound on how fast the shadow sphere's share of S changes with its centre where S is `value`: 2m|y| with m|y|² ≤ S.
    #[inline]
    pub fn sphere_slope(&self, value: f64) -> f64 {
        2.0 * (self.sphere_weight * larger(value, 0.0)).sqrt()
    }

    /// How much the regularisation adds to S at x.
    pub fn surplus(&self, x: &Vector3<f64>) -> f64 {
        (self.sphere_weight - self.particle.sphere_weight) * (x - self.centre).norm_squared()
    }

    /// Upper bound of what the regularisation adds anywhere in {S ≤ `level`}.
    pub fn most_surplus(&self, level: f64) -> f64 {
        let added = self.sphere_weight - self.particle.sphere_weight;
        if added == 0.0 {
            return 0.0;
        }
        let reach = self.particle.reach(level);
        added * reach * reach
    }
}
