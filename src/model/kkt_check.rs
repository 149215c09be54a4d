//! Whether the active set of a local model is still right after a step: the KKT check.

use crate::pair::active_set::LocalPoint;
use crate::pair::placed_particle::Body;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Bound on the rounding of a depth n·x − d + n·v after a step, relative to the terms of its sum (docs/theory.md, "Rounding").
pub(crate) const DEPTH_ROUNDING: f64 = 14.0 * f64::EPSILON;

/// Less than 1 by more than the rounding of a distance to a plane, relative to the terms of its sum.
const CLEAR: f64 = 1.0 - 4.0 * DEPTH_ROUNDING;

/// What a step does to the active set of one body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KktCheck {
    pub change: Change,
    /// The plane to be dropped before the model is solved again.
    pub drop: Option<usize>,
    /// Σ |n|·depth over planes of doubtful sign: the depth by which each may pull after all.
    pub doubtful: f64,
    /// A lower bound of |n|·depth over the active planes, after the step.
    pub least_push: f64,
    /// Bound on 2w Σ depth after the step.
    pub pull: f64,
    /// Number of planes that are active after the step, or may be by rounding.
    pub near: f64,
    /// Whether an inactive plane may be on by rounding.
    pub near_inactive: bool,
}

/// What a step does to an active set, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Change {
    /// Every active plane still pushes and no other has become active: the model is S there, and a lower bound of S
    /// everywhere.
    None,
    /// Every active plane still pushes, but another has become active: the model is a lower bound only.
    Entering,
    /// A plane that was active by no more than its rounding pulls; without it, the model should be solved again.
    Leaving,
    /// Planes that are clearly on at the point pull after the step: the point has to move first.
    Pulling,
}

impl KktCheck {
    /// Checks the planes of a body after the step v, of the given length.
    ///
    /// A quadratic whose planes all have a depth n·x − d + n·v ≥ 0 is a lower bound of S everywhere: the depths are
    /// admissible multipliers, by ⟨t⟩² ≥ 2pt − p² for every p ≥ 0. The sign is judged in the model's own arithmetic, to which the
    /// rounding of n·x − d is but a shift of the plane.
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
            near_inactive: false,
        }
    }

    #[inline(never)]
    fn plane_by_plane(body: &Body, point: &LocalPoint, v: Vector3<f64>) -> Self {
        let (y, blur, e) = (point.y, point.blur, body.turn(&v));
        let particle = body.particle;
        let mut worst: Option<(usize, f64)> = None;
        let (mut pulling, mut doubtful, mut depths, mut near) = (false, 0.0, 0.0, 0.0);
        let (mut entering, mut near_inactive, mut least_push) = (false, false, f64::INFINITY);
        // Active planes are near y, entering ones near y + e: no other plane is within reach of either.
        let far = if particle.clusters.is_single() {
            0.0
        } else {
            blur + particle.bounds.longest_normal * e.norm() * (1.0 + DEPTH_ROUNDING)
        };
        // The step was turned: what is left of a long one across a plane is but rounding.
        let turned = DEPTH_ROUNDING * (e.x.abs() + e.y.abs() + e.z.abs());
        let doubt_of_all = turned * particle.bounds.longest_normal;
        particle.visit_near(&y, far, |place, n, excess| {
            let depth = excess + n.dot(&e);
            if !point.is_active(place, excess) {
                if depth > -blur {
                    near += 1.0;
                    near_inactive = true;
                    entering |= depth > blur;
                }
                return;
            }
            depths += depth.max(0.0);
            near += 1.0;
            if depth * particle.bounds.shortest_normal < least_push {
                least_push = least_push.min(depth * n.norm());
            }
            if depth >= doubt_of_all + DEPTH_ROUNDING * excess.abs() {
                return;
            }
            // The longest normal may be that of another plane.
            let length = n.norm();
            let doubt = turned * length + DEPTH_ROUNDING * excess.abs();
            if depth >= -doubt {
                if depth < doubt {
                    doubtful += length * (doubt + (-depth).max(0.0));
                }
            } else if excess > blur {
                pulling = true;
            } else if worst.is_none_or(|(_, most)| depth < most) {
                worst = Some((place, depth));
            }
        });
        // One at a time: without the worst, the others may push again.
        let drop = worst.map(|(place, _)| place).filter(|_| !pulling);
        let change = match drop {
            _ if pulling => Change::Pulling,
            None if entering => Change::Entering,
            None => Change::None,
            Some(_) if point.is_full() => Change::Pulling,
            Some(_) => Change::Leaving,
        };
        let pull = body.plane_curvature() * depths;
        Self { change, drop, doubtful, least_push, pull, near, near_inactive }
    }

    /// Whether every active plane pushes with more than a force, for a body of this weight.
    #[inline(always)]
    pub fn pushes_more(&self, body: &Body, weight: f64, force: f64) -> bool {
        // Without planes ∞ times 0 is not a number: then none fails to.
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
