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
    /// Weight of the shadow sphere that the solver uses: the particle's own, or the regularised one.
    sphere_weight: f64,
}

/// Units in the last place per length that a distance to a plane may lose; measured against 40-digit
/// solutions, whose worst error stays ten times below.
const ROUNDING: f64 = 4.0;

/// Most planes that one model may drop at a point.
const MOST_DROPPED: usize = 8;

/// Which planes a quadratic counts, beyond those that are clearly on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counted {
    /// Planes count from this distance before they switch on: where a step was stopped by a plane, the
    /// next model must know it.
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
        let body = |particle: &'a Particle, rotation, centre| Self {
            particle,
            rotation,
            centre,
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

    /// (Regularised) S at x with derivatives in the axes of `frame` (columns: axes in the solver frame).
    ///
    /// A plane counts wherever rounding could hide that it is on: a stiff plane carries its share with a
    /// depth below rounding.
    pub fn at(&self, x: &Vector3<f64>, frame: Option<&Matrix3<f64>>, counted: &Counted) -> Quadratic {
        let rotation = match frame {
            Some(axes) => axes.tr_mul(&self.rotation),
            None => self.rotation,
        };
        let blur = self.blur(x);
        let early = counted.early.max(blur);
        potential::in_frame(self.particle, self.sphere_weight, &rotation, &self.local(x), early, |i, excess| {
            counted.includes(i, excess, blur)
        })
    }

    /// (Regularised) S at x along the direction e.
    pub fn on_line(&self, x: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
        potential::on_line(self.particle, self.sphere_weight, &self.local(x), &self.rotation.tr_mul(e))
    }

    /// Checks the planes of the quadratic at x after the step v.
    ///
    /// The quadratic with depth n·x − d + n·v ≥ 0 for each of its planes is a lower bound of S everywhere:
    /// ⟨t⟩² ≥ 2λt − λ² for every λ ≥ 0. The sign is judged in the model's own arithmetic, to which the rounding
    /// of n·x − d is but a shift of the plane.
    pub fn check(&self, x: &Vector3<f64>, v: &Vector3<f64>, counted: &mut Counted) -> Planes {
        let (y, e) = (self.local(x), self.rotation.tr_mul(v));
        let blur = self.blur(x);
        let p = self.particle;
        let mut worst: Option<(usize, f64)> = None;
        let mut met = false;
        // Planes of the quadratic are near y, planes that are met near y + e: no other is near either.
        let far = counted.early.max(blur).max(p.bounds.longest_normal * e.norm());
        for run in p.leaves.near(&y, far) {
            for (i, [a, b, c], d) in p.run(run) {
                let excess = a * y.x + b * y.y + c * y.z - d;
                let terms = [a * e.x, b * e.y, c * e.z];
                let depth = excess + (terms[0] + terms[1] + terms[2]);
                if !counted.includes(i, excess, blur) {
                    met |= depth > blur;
                    continue;
                }
                let size = excess.abs() + terms[0].abs() + terms[1].abs() + terms[2].abs();
                if depth >= -8.0 * f64::EPSILON * size {
                    continue;
                }
                if excess > blur {
                    return Planes::Pulling;
                }
                if worst.is_none_or(|(_, most)| depth < most) {
                    worst = Some((i, depth));
                }
            }
        }
        // One at a time: without the worst, the others may push again.
        match worst {
            None if met => Planes::Met,
            None => Planes::Exact,
            Some((i, _)) if counted.drop(i) => Planes::Dropped,
            Some(_) => Planes::Pulling,
        }
    }

    /// Calls `visit` with the (solver frame) normal, the weight and n·x − d of each plane of the quadratic at x.
    pub fn rows(&self, x: &Vector3<f64>, counted: &Counted, mut visit: impl FnMut(Vector3<f64>, f64, f64)) {
        let y = self.local(x);
        let blur = self.blur(x);
        for run in self.particle.leaves.near(&y, counted.early.max(blur)) {
            for (i, [a, b, c], d) in self.particle.run(run) {
                let excess = a * y.x + b * y.y + c * y.z - d;
                if counted.includes(i, excess, blur) {
                    visit(self.rotation * Vector3::new(a, b, c), self.particle.plane_weight, excess);
                }
            }
        }
    }

    /// Bound on the rounding of a distance to a plane at x: a sum of terms as long as the point, the centre
    /// and the offsets, each known to a few units in the last place.
    pub fn blur(&self, x: &Vector3<f64>) -> f64 {
        ROUNDING * f64::EPSILON * (x.norm() + 2.0 * self.centre.norm() + self.particle.bounds.longest_offset)
    }

    /// Bound on the rounding of S at x, given the quadratic there.
    pub fn rounding(&self, x: &Vector3<f64>, q: &Quadratic) -> f64 {
        let blur = self.blur(x);
        let planes = (q.pull + q.gradient.norm()) * blur + self.particle.plane_weight * blur * blur;
        planes + ROUNDING * f64::EPSILON * q.value
    }

    /// Lower bound of [`Self::rounding`] where S has the given gradient.
    pub fn least_rounding(&self, x: &Vector3<f64>, gradient: &Vector3<f64>) -> f64 {
        self.blur(x) * gradient.norm()
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

impl Counted {
    /// Counts planes from the distance `early` before they switch on.
    pub fn from(early: f64) -> Self {
        Self { early, ..Self::default() }
    }

    fn includes(&self, i: usize, excess: f64, blur: f64) -> bool {
        excess > blur || (excess > -self.early.max(blur) && !self.dropped[..self.count].contains(&(i as u32)))
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
