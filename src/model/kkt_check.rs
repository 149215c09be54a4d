//! What a step does to the planes of a quadratic: whether its model was that of S, and a lower bound.

use crate::pair::active_set::{Local, Place};
use crate::pair::placed_particle::Body;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Rounding of a depth, relative to the terms of its sum.
pub(crate) const DOUBT: f64 = 8.0 * f64::EPSILON;

/// Share of the regularisation below which a plane's pull changes nothing that counts about where it puts the point.
const WEAK: f64 = 1e-9;

/// Less than 1 by more than the rounding of a distance to a plane, relative to the terms of its sum.
const CLEAR: f64 = 1.0 - 4.0 * DOUBT;

/// What a step does to the planes of a quadratic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Verdict {
    pub planes: Planes,
    /// The plane to be dropped before the model is solved again.
    pub drop: Option<usize>,
    /// Sum of the depths by which planes of doubtful sign may pull after all, each times the length of its normal.
    pub doubtful: f64,
    /// The least depth of a plane of the quadratic after the step.
    pub least: f64,
    /// A lower bound of the depth of any of them times the length of its normal; mostly the least.
    pub push: f64,
    /// Bound on the pull after the step.
    pub pull: f64,
    /// How many planes there are, or may be by rounding.
    pub near: f64,
}

/// What a step does to the planes of a model, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Planes {
    /// All still push and no other has switched on: the quadratic is S there, and a lower bound of it
    /// everywhere.
    Exact,
    /// All still push, but another is met on the way: the quadratic is a lower bound only.
    Met,
    /// One that had hardly switched on pulls; without it, the model should be solved again.
    Dropped,
    /// Some that are clearly on at the point pull after the step: the point has to move first.
    Pulling,
}

impl Body<'_> {
    /// Checks the planes of the quadratic after the step v.
    ///
    /// The quadratic with depth n·x − d + n·v ≥ 0 for each of its planes is a lower bound of S everywhere:
    /// ⟨t⟩² ≥ 2λt − λ² for every λ ≥ 0. The sign is judged in the model's own arithmetic, to which the rounding
    /// of n·x − d is but a shift of the plane.
    #[inline(always)]
    pub fn check(&self, local: &Local, q: &Quadratic, v: &Vector3<f64>, length: f64) -> Verdict {
        if self.stays(q, length) { Verdict::clear(self, local, q, length) } else { self.check_each(local, q, *v) }
    }

    /// Whether no plane of the quadratic switches within a distance.
    #[inline(always)]
    fn stays(&self, q: &Quadratic, distance: f64) -> bool {
        self.particle.bounds.longest_normal * distance <= CLEAR * q.clear
    }

    /// The distance within which no plane of the quadratic switches.
    #[inline]
    pub fn stays_for(&self, q: &Quadratic) -> f64 {
        CLEAR * q.clear / self.particle.bounds.longest_normal
    }

    /// The depth at which a plane pushes as much as a share of the regularisation at the surface, or as the rounding of the
    /// forces.
    fn weakest(&self, q: &Quadratic) -> f64 {
        let force = WEAK * self.sphere_curvature() * self.particle.bounding_radius() + DOUBT * q.pull;
        force / (self.plane_curvature() * self.particle.bounds.longest_normal)
    }

    /// The plane of the quadratic that is least deep after a step.
    pub fn shallowest(&self, local: &Local, v: &Vector3<f64>) -> Option<usize> {
        let e = self.turn(v);
        let (mut weakest, mut least) = (None, f64::INFINITY);
        self.particle.visit_near(&local.y, local.early, |i, n, excess| {
            let depth = excess + n.dot(&e);
            if local.counts(self.particle, i, excess) && depth < least {
                (weakest, least) = (Some(i), depth);
            }
        });
        weakest
    }

    /// Visits the planes that do not count at a place and may be on after the step v for all that rounding tells, with their
    /// normals in the frame of the particle, their depths and their own blurs.
    pub fn beside(
        &self,
        place: &impl Place,
        local: &Local,
        v: &Vector3<f64>,
        mut visit: impl FnMut(Vector3<f64>, f64, f64),
    ) {
        let (p, e) = (self.particle, self.turn(v));
        let far = place.early().max(p.bounds.longest_normal * e.norm() * (1.0 + 1e-14) + local.blur);
        p.visit_near(&local.y, far, |i, n, excess| {
            let (depth, blur) = (excess + n.dot(&e), self.blur_of(&n, local));
            if depth > -blur && !place.counts(p, i, excess) {
                visit(n, depth, blur);
            }
        });
    }

    /// Whether a plane that does not count is on after the step v, beyond what rounding does to this very plane.
    #[cold]
    #[inline(never)]
    fn meets(&self, local: &Local, v: &Vector3<f64>) -> bool {
        let mut met = false;
        self.beside(local, local, v, |_, depth, blur| met |= depth > blur);
        met
    }

    #[inline(never)]
    fn check_each(&self, local: &Local, q: &Quadratic, v: Vector3<f64>) -> Verdict {
        let (y, blur, e) = (local.y, local.blur, self.turn(&v));
        let p = self.particle;
        let mut worst: Option<(usize, f64)> = None;
        let (mut pulling, mut doubtful, mut depths, mut near) = (false, 0.0, 0.0, 0.0);
        let (mut nearest, mut least, mut push) = (f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY);
        // Planes of the quadratic are near y, planes that are met near y + e: no other is near either.
        let far = if p.clusters.is_single() { 0.0 } else { local.early.max(p.bounds.longest_normal * e.norm()) };
        // The step was turned: what is left of a long one across a plane is but rounding.
        let turned = DOUBT * (e.x.abs() + e.y.abs() + e.z.abs());
        let doubt = turned * p.bounds.longest_normal;
        // Where only the regularisation tells one point of a face from another, pulls far weaker than itself or as the rounding of
        // the forces would let planes take turns without end.
        let weak = if self.is_plain() { 0.0 } else { self.weakest(q) };
        p.visit_near(&y, far, |i, n, excess| {
            let depth = excess + n.dot(&e);
            if !local.counts(p, i, excess) {
                nearest = nearest.max(depth);
                return;
            }
            depths += depth.max(0.0);
            near += 1.0;
            least = least.min(depth);
            if depth * p.bounds.shortest_normal < push {
                push = push.min(depth * n.norm());
            }
            if depth >= doubt + DOUBT * excess.abs() {
                return;
            }
            // The longest normal may be that of another plane.
            let length = n.norm();
            let doubt = turned * length + DOUBT * excess.abs();
            if depth >= doubt {
                return;
            }
            if depth >= -doubt.max(weak) {
                // The depth itself is known to the doubt only.
                doubtful += length * (doubt + (-depth).max(0.0));
            } else if excess > blur {
                pulling = true;
            } else if worst.is_none_or(|(_, most)| depth < most) {
                worst = Some((i, depth));
            }
        });
        near += if nearest > -blur { 1.0 } else { 0.0 };
        // The blur is that of the longest normal: a plane with a short one may be on for sure.
        let met = nearest > blur || (nearest > 0.0 && self.meets(local, &v));
        let pull = self.plane_curvature() * depths;
        if pulling {
            return Verdict { planes: Planes::Pulling, drop: None, doubtful: f64::INFINITY, least, push, pull, near };
        }
        // One at a time: without the worst, the others may push again.
        let drop = worst.map(|(i, _)| i);
        let planes = match drop {
            None if met => Planes::Met,
            None => Planes::Exact,
            Some(_) if !local.is_full() => Planes::Dropped,
            Some(_) => Planes::Pulling,
        };
        Verdict { planes, drop, doubtful, least, push, pull, near }
    }
}

impl Verdict {
    /// Of a step so short that no plane switches.
    #[inline(always)]
    fn clear(body: &Body, local: &Local, q: &Quadratic, length: f64) -> Self {
        let (moved, count) = (body.particle.bounds.longest_normal * length, f64::from(q.count));
        let least = q.clear - moved;
        let pull = q.pull + count * body.plane_curvature() * moved;
        let near = if least < local.blur { count + 1.0 } else { count };
        let push = least * body.particle.bounds.shortest_normal;
        Self { planes: Planes::Exact, drop: None, doubtful: 0.0, least, push, pull, near }
    }

    /// Whether a plane that does not count may be on by rounding.
    #[inline(always)]
    pub fn has_beside(&self, q: &Quadratic) -> bool {
        self.near > f64::from(q.count)
    }

    /// Whether some plane may push less than a force, for a body of this weight. Without planes none does: ∞ times 0 is no
    /// number.
    #[inline(always)]
    pub fn pushes_less(&self, body: &Body, local: &Local, weight: f64, force: f64) -> bool {
        let stiffness = weight * body.plane_curvature();
        // The shortest normal may be that of a plane which is not on.
        let of_nearby = || body.particle.bounds.shortest_normal_at(&local.y) * self.least;
        stiffness * self.push < force && stiffness * of_nearby() < force
    }

    /// Slope that planes of doubtful sign may leave, for a body of this weight: a force that is found to rounding only may
    /// be a pull.
    pub fn doubtful_slope(&self, body: &Body, local: &Local, weight: f64, rounding: f64) -> f64 {
        let lost = if self.pushes_less(body, local, weight, rounding) { self.near * rounding } else { 0.0 };
        // No plane may be doubtful, of weights that overflow.
        if self.doubtful > 0.0 { lost + weight * body.plane_curvature() * self.doubtful } else { lost }
    }
}
