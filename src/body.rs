//! A particle placed in the frame in which a pair is solved.

use crate::pair::Pair;
use crate::particle::Particle;
use crate::potential::{self, OnLine, Quadratic};
use nalgebra::{Matrix3, Vector3};

/// A particle with its pose in the solver's frame (local axes of B, origin at the centre of B).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<'a> {
    pub particle: &'a Particle,
    /// Local to solver frame.
    rotation: Matrix3<f64>,
    /// Centre in the solver frame.
    centre: Vector3<f64>,
    /// Sum of the lengths, other than the point's own, that a distance to a plane is made from.
    lengths: f64,
    /// Weight of the shadow sphere that the solver uses: the particle's own, or the regularised one.
    sphere_weight: f64,
}

/// Units in the last place per length that a distance to a plane may lose; measured against 40-digit
/// solutions, whose worst error stays ten times below.
const ROUNDING: f64 = 4.0;

/// Most planes that one model may drop at a point.
const MOST_DROPPED: usize = 8;

/// A point as a body sees it, and which planes its quadratic there counts beyond those that are clearly on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    /// The point in the particle's own frame.
    y: Vector3<f64>,
    /// Bound on the rounding of a distance to a plane here: a sum of terms as long as the point, the centre
    /// and the offsets, each known to a few units in the last place.
    pub blur: f64,
    /// Planes count from this distance before they switch on: at least the blur, since a stiff plane carries
    /// its share with a depth below rounding; more where a step was stopped by a plane, so that the next
    /// model knows it.
    early: f64,
    /// Planes within that distance that were found to pull instead of push: they do not count.
    dropped: [u32; MOST_DROPPED],
    count: usize,
}

/// What a step does to the planes of a model, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Planes {
    /// All still push and no other has switched on: the quadratic is S there, and a lower bound of it
    /// everywhere.
    Exact,
    /// All still push, but another is met on the way: the quadratic is a lower bound only.
    Met,
    /// Some that had hardly switched on pull; they were dropped, and the model should be solved again.
    Dropped,
    /// Some that are clearly on at the point pull after the step: the point has to move first.
    Pulling,
}

impl<'a> Body<'a> {
    /// Both bodies of a pair; k below `least_sphericity` is raised to it (see `Settings`).
    pub fn both(pair: &Pair<'a>, least_sphericity: f64) -> (Self, Self) {
        let body = |particle: &'a Particle, rotation, centre: Vector3<f64>| Self {
            particle,
            rotation,
            centre,
            lengths: 2.0 * centre.norm() + particle.bounds.longest_offset,
            sphere_weight: particle.sphere_weight.max(least_sphericity / particle.bounding_radius().powi(2)),
        };
        (body(pair.a, pair.rotation, pair.centre), body(pair.b, Matrix3::identity(), Vector3::zeros()))
    }

    /// Solver frame to local frame.
    pub fn local(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.centre))
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// The point x as this body sees it, with planes counting from `early` before they switch on.
    pub fn locate(&self, x: &Vector3<f64>, early: f64) -> Local {
        let blur = ROUNDING * f64::EPSILON * (x.norm() + self.lengths);
        Local { y: self.local(x), blur, early: early.max(blur), dropped: [0; MOST_DROPPED], count: 0 }
    }

    /// (Regularised) S with derivatives in the axes of `frame` (columns: axes in the solver frame).
    pub fn at(&self, local: &Local, frame: Option<&Matrix3<f64>>) -> Quadratic {
        let rotation = match frame {
            Some(axes) => axes.tr_mul(&self.rotation),
            None => self.rotation,
        };
        potential::in_frame(self.particle, self.sphere_weight, &rotation, &local.y, local.early, |i, excess| {
            local.counts(i, excess)
        })
    }

    /// (Regularised) S at x along the direction e.
    pub fn on_line(&self, x: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
        potential::on_line(self.particle, self.sphere_weight, &self.local(x), &self.rotation.tr_mul(e))
    }

    /// Checks the planes of the quadratic after the step v.
    ///
    /// The quadratic with depth n·x − d + n·v ≥ 0 for each of its planes is a lower bound of S everywhere:
    /// ⟨t⟩² ≥ 2λt − λ² for every λ ≥ 0. The sign is judged in the model's own arithmetic, to which the rounding
    /// of n·x − d is but a shift of the plane.
    ///
    /// Also returned: the slope, 1/length, by which planes of doubtful sign may pull after all.
    pub fn check(&self, local: &mut Local, v: &Vector3<f64>) -> (Planes, f64) {
        let (y, blur, e) = (local.y, local.blur, self.rotation.tr_mul(v));
        let p = self.particle;
        let mut worst: Option<(usize, f64)> = None;
        let (mut met, mut doubtful) = (false, 0.0);
        // Planes of the quadratic are near y, planes that are met near y + e: no other is near either.
        let far = local.early.max(p.bounds.longest_normal * e.norm());
        for run in p.leaves.near(&y, far) {
            for (i, [a, b, c], d) in p.run(run) {
                let excess = a * y.x + b * y.y + c * y.z - d;
                let terms = [a * e.x, b * e.y, c * e.z];
                let depth = excess + (terms[0] + terms[1] + terms[2]);
                if !local.counts(i, excess) {
                    met |= depth > blur;
                    continue;
                }
                let size = excess.abs() + terms[0].abs() + terms[1].abs() + terms[2].abs();
                let doubt = 8.0 * f64::EPSILON * size;
                if depth >= -doubt {
                    doubtful += if depth < doubt { doubt } else { 0.0 };
                    continue;
                }
                if excess > blur {
                    return (Planes::Pulling, f64::INFINITY);
                }
                if worst.is_none_or(|(_, most)| depth < most) {
                    worst = Some((i, depth));
                }
            }
        }
        // One at a time: without the worst, the others may push again.
        let planes = match worst {
            None if met => Planes::Met,
            None => Planes::Exact,
            Some((i, _)) if local.drop(i) => Planes::Dropped,
            Some(_) => Planes::Pulling,
        };
        (planes, self.plane_curvature() * p.bounds.longest_normal * doubtful)
    }

    /// Carries over which planes were dropped, from a point whose step was stopped at once, to the same point again:
    /// all but those that stopped it. Without it the planes that rightly went would come back each time.
    pub fn carry_dropped(&self, from: &Local, step: &Vector3<f64>, to: &mut Local) {
        let reached = from.y + self.rotation.tr_mul(step);
        for &i in &from.dropped[..from.count] {
            let place = i as usize;
            if self.particle.normal(place).dot(&reached) - self.particle.d[place] <= from.blur {
                to.drop(place);
            }
        }
    }

    /// Calls `visit` with the (solver frame) normal, the weight and n·x − d of each plane of the quadratic.
    pub fn rows(&self, local: &Local, mut visit: impl FnMut(Vector3<f64>, f64, f64)) {
        let y = &local.y;
        for run in self.particle.leaves.near(y, local.early) {
            for (i, [a, b, c], d) in self.particle.run(run) {
                let excess = a * y.x + b * y.y + c * y.z - d;
                if local.counts(i, excess) {
                    visit(self.rotation * Vector3::new(a, b, c), self.particle.plane_weight, excess);
                }
            }
        }
    }

    /// Bound on the rounding of S, given the quadratic.
    pub fn rounding(&self, local: &Local, q: &Quadratic) -> f64 {
        let blur = local.blur;
        let planes = (q.pull + q.gradient.norm()) * blur + self.particle.plane_weight * blur * blur;
        planes + ROUNDING * f64::EPSILON * q.value
    }

    /// Largest curvature that one plane can give S.
    pub fn plane_curvature(&self) -> f64 {
        2.0 * self.particle.plane_weight
    }

    /// Curvature of the shadow sphere's share of S, the least in any direction.
    pub fn sphere_curvature(&self) -> f64 {
        2.0 * self.sphere_weight
    }

    /// How much the regularisation adds to S at x.
    pub fn surplus(&self, x: &Vector3<f64>) -> f64 {
        (self.sphere_weight - self.particle.sphere_weight) * (x - self.centre).norm_squared()
    }

    /// Upper bound of what the regularisation adds anywhere in {S ≤ `level`}.
    pub fn most_surplus(&self, level: f64) -> f64 {
        let reach = self.particle.reach(level);
        (self.sphere_weight - self.particle.sphere_weight) * reach * reach
    }
}

impl Local {
    /// Lower bound of [`Body::rounding`] where S has the given gradient.
    pub fn least_rounding(&self, gradient: &Vector3<f64>) -> f64 {
        self.blur * gradient.norm()
    }

    fn counts(&self, i: usize, excess: f64) -> bool {
        excess > self.blur || (excess > -self.early && !self.dropped[..self.count].contains(&(i as u32)))
    }

    /// Whether there was room to drop one more.
    fn drop(&mut self, i: usize) -> bool {
        let room = self.count < MOST_DROPPED;
        if room {
            self.dropped[self.count] = i as u32;
            self.count += 1;
        }
        room
    }
}
