//! Whether the active set of a local model is still right after a step: the KKT check.

use crate::linalg::number::{gamma, smaller};
use crate::pair::body::Body;
use crate::pair::local_point::LocalPoint;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Bound on the rounding of a depth n·x − d + n·v after a step, relative to the terms of its sum (docs/theory.md,
/// "Rounding"). Derived: 13.7ε.
pub(crate) const DEPTH_ROUNDING: f64 = gamma(28);

/// Factor on a distance to a plane: so far below 1 that the rounding of the distance does not hide that the plane
/// switches (derived).
pub(crate) const CLEAR: f64 = 1.0 - 4.0 * DEPTH_ROUNDING;

/// What a step does to the active set of one body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KktCheck {
    pub change: Change,
    /// The plane to be dropped before the model is solved again.
    pub drop: Option<usize>,
    /// Σ |n|·(doubt + ⟨−depth⟩) over planes of doubtful sign: bound on their negative multipliers, per curvature.
    pub doubtful: f64,
    /// A lower bound of |n|·depth over the active planes, after the step.
    pub least_push: f64,
    /// Bound on 2w Σ depth after the step.
    pub pull: f64,
    /// Number of planes that are active after the step, or may be by rounding.
    pub near: f64,
    /// A lower bound of −depth of every other plane after the step.
    pub clear: f64,
    /// Whether an inactive plane may be on by rounding.
    pub near_inactive: bool,
}

/// What a step does to an active set, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Change {
    /// Every active plane has a multiplier ≥ 0 and no other has become active: the model is S there, and a lower bound
    /// of S everywhere.
    None,
    /// Every active plane has a multiplier ≥ 0, but another has become active: the model is a lower bound only.
    Entering,
    /// A plane that was active by no more than its rounding has a negative multiplier: the model is solved again
    /// without it.
    Leaving,
    /// A plane active by more than rounding has a negative multiplier after the step: the point moves before any plane
    /// is dropped.
    Pulling,
}

impl KktCheck {
    /// Checks the planes of a body after the step v, of the given length.
    ///
    /// A quadratic whose planes all have a depth n·x − d + n·v ≥ 0 is a lower bound of S everywhere: the depths are
    /// admissible multipliers, by ⟨t⟩² ≥ 2pt − p² for every p ≥ 0. The sign is judged in the model's own arithmetic, to
    /// which the rounding of n·x − d is but a shift of the plane.
    #[inline(always)]
    pub fn after(body: &Body, point: &LocalPoint, q: &Quadratic, v: &Vector3<f64>, length: f64) -> Self {
        let moved = body.particle.bounds.longest_normal * length;
        if moved + point.blur <= CLEAR * q.clear {
            Self::of_short_step(body, point, q, moved)
        } else {
            Self::plane_by_plane(body, point, *v)
        }
    }

    /// Of a step so short that no plane switches.
    #[inline(always)]
    fn of_short_step(body: &Body, point: &LocalPoint, q: &Quadratic, moved: f64) -> Self {
        let near = f64::from(q.count);
        Self {
            change: Change::None,
            drop: None,
            doubtful: 0.0,
            least_push: (q.clear - moved) * body.particle.bounds.shortest_normal_at(&point.y),
            pull: q.pull + near * body.plane_curvature() * moved,
            near,
            clear: q.clear - moved,
            near_inactive: false,
        }
    }

    #[inline(never)]
    fn plane_by_plane(body: &Body, point: &LocalPoint, v: Vector3<f64>) -> Self {
        let (e, particle) = (body.turn(&v), body.particle);
        // Active planes are near y, entering ones near y + e: no other plane is within reach of either.
        let moved = particle.bounds.longest_normal * e.norm() * (1.0 + DEPTH_ROUNDING);
        let far = if particle.clusters.is_single() { 0.0 } else { point.blur + moved };
        let mut planes = Planes::after(body, point, &e);
        let most_left_out = particle.visit_near(&point.y, far, |place, n, excess| {
            let depth = excess + n.dot(&e);
            if point.is_active(place, excess) {
                planes.add_active(place, &n, excess, depth);
            } else {
                planes.add_inactive(depth);
            }
        });
        planes.clear = smaller(planes.clear, -most_left_out - moved);
        planes.check()
    }

    /// Whether every active plane pushes with more than a force, for a body of this weight.
    #[inline(always)]
    pub fn pushes_more(&self, body: &Body, weight: f64, force: f64) -> bool {
        // Without planes, ∞ times 0 is NaN, and the answer is true.
        !(weight * body.plane_curvature() * self.least_push < force)
    }

    /// Bound on the slope that planes of doubtful sign may leave, for a body of this weight whose slope is rounded by
    /// `rounding`: a force that is known to rounding only may be a pull.
    #[inline(always)]
    pub fn doubtful_slope(&self, body: &Body, weight: f64, rounding: f64) -> f64 {
        let lost = if self.pushes_more(body, weight, rounding) { 0.0 } else { self.near * rounding };
        // Weights that overflow times no doubt at all would not be a number.
        if self.doubtful > 0.0 { lost + weight * body.plane_curvature() * self.doubtful } else { lost }
    }
}

/// What a step does to the planes of one body, one by one.
struct Planes<'a> {
    body: &'a Body<'a>,
    point: &'a LocalPoint,
    /// Bound on the rounding of the step in the body's axes, and of a depth by it.
    step_rounding: f64,
    doubt_of_all: f64,
    /// Of the planes that were on by no more than their rounding, the one with the most negative multiplier, and its
    /// depth.
    worst: Option<(usize, f64)>,
    /// Whether a plane that was on by more than rounding has a negative multiplier.
    pulling: bool,
    entering: bool,
    near_inactive: bool,
    doubtful: f64,
    depths: f64,
    near: f64,
    clear: f64,
    least_push: f64,
}

impl<'a> Planes<'a> {
    /// None yet, after the step e of the particle's own frame.
    #[inline(always)]
    fn after(body: &'a Body<'a>, point: &'a LocalPoint, e: &Vector3<f64>) -> Self {
        // In the body's axes, what is left of a long step across a plane may be rounding alone.
        let step_rounding = DEPTH_ROUNDING * (e.x.abs() + e.y.abs() + e.z.abs());
        Self {
            body,
            point,
            step_rounding,
            doubt_of_all: step_rounding * body.particle.bounds.longest_normal,
            worst: None,
            pulling: false,
            entering: false,
            near_inactive: false,
            doubtful: 0.0,
            depths: 0.0,
            near: 0.0,
            clear: f64::INFINITY,
            least_push: f64::INFINITY,
        }
    }

    #[inline(always)]
    fn add_inactive(&mut self, depth: f64) {
        let blur = self.point.blur;
        if depth > -blur {
            self.near += 1.0;
            self.near_inactive = true;
            self.entering |= depth > blur;
        } else {
            self.clear = smaller(self.clear, -depth);
        }
    }

    #[inline(always)]
    fn add_active(&mut self, place: usize, n: &Vector3<f64>, excess: f64, depth: f64) {
        self.depths += depth.max(0.0);
        self.near += 1.0;
        if depth * self.body.particle.bounds.shortest_normal < self.least_push {
            self.least_push = self.least_push.min(depth * n.norm());
        }
        if depth >= self.doubt_of_all + DEPTH_ROUNDING * excess.abs() {
            return;
        }
        // The longest normal may be that of another plane.
        let length = n.norm();
        let doubt = self.step_rounding * length + DEPTH_ROUNDING * excess.abs();
        if depth >= -doubt {
            if depth < doubt {
                self.doubtful += length * (doubt + (-depth).max(0.0));
            }
        } else if excess > self.point.blur {
            self.pulling = true;
        } else if self.worst.is_none_or(|(_, most)| depth < most) {
            self.worst = Some((place, depth));
        }
    }

    #[inline(always)]
    fn check(self) -> KktCheck {
        // One at a time: without it, the multipliers of the others may be positive again.
        let drop = self.worst.map(|(place, _)| place).filter(|_| !self.pulling);
        let change = match drop {
            _ if self.pulling => Change::Pulling,
            None if self.entering => Change::Entering,
            None => Change::None,
            Some(_) if self.point.is_full() => Change::Pulling,
            Some(_) => Change::Leaving,
        };
        KktCheck {
            change,
            drop,
            doubtful: self.doubtful,
            least_push: self.least_push,
            pull: self.body.plane_curvature() * self.depths,
            near: self.near,
            clear: self.clear,
            near_inactive: self.near_inactive,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// The check after steps from a point of a cube with faces at 0.4, and the place of the plane x ≤ 0.4.
    fn after(y: [f64; 3], v: [f64; 3]) -> (KktCheck, usize, LocalPoint) {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let pose = Pose::at([0.0; 3]).unwrap();
        let pair = Pair::new(&cube, &pose, &cube, &pose);
        let (_, body) = Body::both(&pair, 0.0);
        let (point, v) = (body.locate(&y.into()), Vector3::from(v));
        let q = body.at(&point, None);
        let (_, face) = body.particle.farthest_excess(&Vector3::new(1.0, 0.0, 0.0));
        (KktCheck::after(&body, &point, &q, &v, v.norm()), face, point)
    }

    #[test]
    fn a_step_changes_the_active_set_as_the_depths_say() {
        // The plane x ≤ 0.4 is on by 0.1.
        for (v, change, clear) in [
            ([-0.05, 0.0, 0.0], Change::None, 0.4),
            ([0.3, 0.2, 0.0], Change::None, 0.2),
            ([0.0, 0.5, 0.0], Change::Entering, 0.4),
            ([-0.2, 0.0, 0.0], Change::Pulling, 0.4),
            ([-0.2, 0.5, 0.0], Change::Pulling, 0.4),
        ] {
            let (check, ..) = after([0.5, 0.0, 0.0], v);
            assert_eq!(check.change, change, "{v:?}");
            // No more than the distance of the planes that are off; where the step is short, than that of the plane
            // that is on as well.
            assert!(check.clear > 0.0 && check.clear <= clear + 1e-12, "{v:?}: {}", check.clear);
            assert!(check.drop.is_none());
        }
    }

    #[test]
    fn a_plane_that_is_on_by_rounding_is_dropped_where_it_pulls() {
        let (check, face, mut point) = after([0.4, 0.0, 0.0], [-1e-3, 0.0, 0.0]);
        assert_eq!((check.change, check.drop), (Change::Leaving, Some(face)));
        assert!(point.is_active(face, 0.0));
        point.drop(face);
        assert!(!point.is_active(face, 0.0) && point.is_active(face, 2.0 * point.blur));
    }
}
