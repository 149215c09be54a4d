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

/// Rounding of a depth, relative to the terms of its sum.
const DOUBT: f64 = 8.0 * f64::EPSILON;

/// Share of the regularisation below which a plane's pull changes nothing that counts about where it puts the point.
const WEAK: f64 = 1e-3;

/// Less than 1 by more than the rounding of a distance to a plane, relative to the terms of its sum.
const CLEAR: f64 = 1.0 - 4.0 * DOUBT;

/// Most planes that one model may drop at a point.
const MOST_DROPPED: usize = 8;

/// A point as a body sees it, and which planes its quadratic there counts beyond those that are clearly on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    /// The point in the particle's own frame.
    y: Vector3<f64>,
    /// Bound on the rounding of this point: a sum of terms as long as the point and the centre, each known to a few
    /// units in the last place.
    pub shift: f64,
    /// Bound on the rounding of n·y − d of every plane that can be on here, from that of the point and of the offset.
    pub blur: f64,
    /// Planes count from this distance before they switch on: at least the blur, since a stiff plane carries
    /// its share with a depth below rounding; more where a step was stopped by a plane, so that the next
    /// model knows it.
    early: f64,
    /// Planes within that distance that were found to pull instead of push: they do not count.
    dropped: [u16; MOST_DROPPED],
    count: u8,
}

/// A point of the particle's own frame, and which planes count there.
pub(crate) trait Place {
    fn point(&self) -> &Vector3<f64>;

    /// No plane counts whose excess at the point is below −`early`.
    fn early(&self) -> f64;

    /// Whether plane `i`, with this excess at the point, counts.
    fn counts(&self, particle: &Particle, i: usize, excess: f64) -> bool;
}

impl Place for Local {
    #[inline]
    fn point(&self) -> &Vector3<f64> {
        &self.y
    }

    #[inline]
    fn early(&self) -> f64 {
        self.early
    }

    #[inline]
    fn counts(&self, _: &Particle, i: usize, excess: f64) -> bool {
        excess > self.blur || (excess > -self.early && !self.dropped().contains(&(i as u16)))
    }
}

/// What a step does to the planes of a quadratic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Verdict {
    pub planes: Planes,
    /// The plane to be dropped before the model is solved again.
    pub drop: Option<usize>,
    /// Sum of the depths by which planes of doubtful sign may pull after all.
    pub doubtful: f64,
    /// The least depth of a plane of the quadratic after the step.
    pub least: f64,
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
            sphere_weight: particle.sphere_weight.max(least_sphericity / particle.bounding_radius().powi(2)),
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
        let n = self.particle.normal(place);
        if self.turned { self.rotation * n } else { n }
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// The point x as this body sees it, with planes counting from `early` before they switch on.
    pub fn locate(&self, x: &Vector3<f64>, early: f64) -> Local {
        let bounds = &self.particle.bounds;
        let lengths = x.norm() + self.twice_centre;
        let shift = ROUNDING * f64::EPSILON * lengths;
        let blur = bounds.longest_normal * shift + ROUNDING * f64::EPSILON * bounds.offset_within(lengths + early);
        Local { y: self.local(x), shift, blur, early: early.max(blur), dropped: [0; MOST_DROPPED], count: 0 }
    }

    /// (Regularised) S with derivatives in the axes of `frame` (columns: axes in the solver frame), or of the solver
    /// frame itself.
    #[inline]
    pub fn at(&self, place: &impl Place, frame: Option<&Matrix3<f64>>) -> Quadratic {
        let turned = |rotation: Matrix3<f64>| self.quadratic(place, |n| rotation * n);
        match frame {
            Some(axes) if self.turned => turned(axes.tr_mul(&self.rotation)),
            Some(axes) => turned(axes.transpose()),
            None if self.turned => turned(self.rotation),
            None => self.quadratic(place, |n| n),
        }
    }

    #[inline]
    fn quadratic(&self, place: &impl Place, turn: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Quadratic {
        let weights = (self.plane_weight, self.sphere_weight);
        let counts = |i, excess| place.counts(self.particle, i, excess);
        potential::turned(self.particle, weights, turn, place.point(), place.early(), counts)
    }

    /// (Regularised) S at x along the direction e.
    pub fn on_line(&self, x: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
        potential::on_line(self.particle, self.sphere_weight, &self.local(x), &self.turn(e))
    }

    /// Checks the planes of the quadratic after the step v.
    ///
    /// The quadratic with depth n·x − d + n·v ≥ 0 for each of its planes is a lower bound of S everywhere:
    /// ⟨t⟩² ≥ 2λt − λ² for every λ ≥ 0. The sign is judged in the model's own arithmetic, to which the rounding
    /// of n·x − d is but a shift of the plane.
    #[inline]
    pub fn check(&self, local: &Local, q: &Quadratic, v: &Vector3<f64>, length: f64) -> Verdict {
        if self.stays(q, length) { Verdict::clear(self, local, q, length) } else { self.check_each(local, q, v) }
    }

    /// Whether no plane of the quadratic switches within a distance.
    #[inline]
    fn stays(&self, q: &Quadratic, distance: f64) -> bool {
        self.particle.bounds.longest_normal * distance <= CLEAR * q.clear
    }

    /// The distance within which no plane of the quadratic switches.
    #[inline]
    pub fn stays_for(&self, q: &Quadratic) -> f64 {
        CLEAR * q.clear / self.particle.bounds.longest_normal
    }

    /// Whether S is the particle's own, not regularised.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.sphere_weight == self.particle.sphere_weight
    }

    /// The depth at which a plane pushes as much as a share of the regularisation at the surface, or as the rounding of the
    /// forces.
    fn weakest(&self, q: &Quadratic) -> f64 {
        let force = WEAK * self.sphere_curvature() * self.particle.bounding_radius() + DOUBT * q.pull;
        force / (self.plane_curvature() * self.particle.bounds.longest_normal)
    }

    #[inline(never)]
    fn check_each(&self, local: &Local, q: &Quadratic, v: &Vector3<f64>) -> Verdict {
        let (y, blur, e) = (local.y, local.blur, self.turn(v));
        let p = self.particle;
        let mut worst: Option<(usize, f64)> = None;
        let (mut pulling, mut doubtful, mut depths, mut near) = (false, 0.0, 0.0, 0.0);
        let (mut nearest, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
        // Planes of the quadratic are near y, planes that are met near y + e: no other is near either.
        let far = if p.leaves.single() { 0.0 } else { local.early.max(p.bounds.longest_normal * e.norm()) };
        // The step was turned: what is left of a long one across a plane is but rounding.
        let doubt = DOUBT * p.bounds.longest_normal * (e.x.abs() + e.y.abs() + e.z.abs());
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
            let doubt = doubt + DOUBT * excess.abs();
            if depth >= doubt {
                return;
            }
            if depth >= -doubt.max(weak) {
                doubtful += doubt.max(-depth);
            } else if excess > blur {
                pulling = true;
            } else if worst.is_none_or(|(_, most)| depth < most) {
                worst = Some((i, depth));
            }
        });
        near += if nearest > -blur { 1.0 } else { 0.0 };
        let met = nearest > blur;
        let pull = self.plane_curvature() * depths;
        if pulling {
            return Verdict { planes: Planes::Pulling, drop: None, doubtful: f64::INFINITY, least, pull, near };
        }
        // One at a time: without the worst, the others may push again.
        let drop = worst.map(|(i, _)| i);
        let planes = match drop {
            None if met => Planes::Met,
            None => Planes::Exact,
            Some(_) if usize::from(local.count) < MOST_DROPPED => Planes::Dropped,
            Some(_) => Planes::Pulling,
        };
        Verdict { planes, drop, doubtful, least, pull, near }
    }

    /// Carries over which planes were dropped, from a point whose step was stopped at once, to the same point again:
    /// all but those that stopped it. Without it the planes that rightly went would come back each time.
    pub fn carry_dropped(&self, from: &Local, step: &Vector3<f64>, to: &mut Local) {
        let reached = from.y + self.turn(step);
        for &i in &from.dropped[..usize::from(from.count)] {
            let place = usize::from(i);
            if self.particle.normal(place).dot(&reached) - self.particle.offset(place) <= from.blur {
                to.drop(place);
            }
        }
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
    /// the gradient is this long; with it the rounding of the sums at the point of expansion, carried along.
    pub fn rounding_after(&self, local: &Local, q: &Quadratic, verdict: &Verdict, step: f64, gradient: f64) -> f64 {
        let (shift, blur) = self.after(local, step);
        let planes = (verdict.pull + verdict.near * self.plane_weight * blur) * blur;
        planes + gradient * shift + q.pull * (blur - local.blur)
    }

    /// The shift and the blur at the end of a step of this length.
    #[inline]
    fn after(&self, local: &Local, step: f64) -> (f64, f64) {
        let further = ROUNDING * f64::EPSILON * step;
        (local.shift + further, local.blur + self.particle.bounds.longest_normal * further)
    }

    /// Rounding of a value of S that is summed up.
    #[inline]
    pub fn rounding_of_value(&self, value: f64) -> f64 {
        ROUNDING * f64::EPSILON * value
    }

    /// The share of the way to the centre on which every plane falls by more than its rounding at the end of a step; more
    /// than 1 where some plane does not.
    pub fn share_of_way(&self, local: &Local, step: f64) -> f64 {
        let (_, blur) = self.after(local, step);
        let least = self.particle.bounds.least_offset;
        if least > blur { blur / least + ROUNDING * f64::EPSILON } else { f64::INFINITY }
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

impl Verdict {
    /// Of a step so short that no plane switches.
    #[inline]
    fn clear(body: &Body, local: &Local, q: &Quadratic, length: f64) -> Self {
        let (moved, count) = (body.particle.bounds.longest_normal * length, f64::from(q.count));
        let least = q.clear - moved;
        let pull = q.pull + count * body.plane_curvature() * moved;
        let near = if least < local.blur { count + 1.0 } else { count };
        Self { planes: Planes::Exact, drop: None, doubtful: 0.0, least, pull, near }
    }

    /// Slope that planes of doubtful sign may leave, for a body of this weight: a force that is found to rounding only may
    /// be a pull.
    pub fn doubtful_slope(&self, body: &Body, weight: f64, rounding: f64) -> f64 {
        let per_depth = weight * body.plane_curvature() * body.particle.bounds.longest_normal;
        let lost = if per_depth * self.least < rounding { self.near * rounding } else { 0.0 };
        // No plane may be doubtful, of weights that overflow.
        if self.doubtful > 0.0 { lost + per_depth * self.doubtful } else { lost }
    }
}

impl Local {
    pub const BLANK: Self = Self {
        y: Vector3::new(0.0, 0.0, 0.0),
        shift: 0.0,
        blur: 0.0,
        early: 0.0,
        dropped: [0; MOST_DROPPED],
        count: 0,
    };

    /// Lower bound of [`Body::rounding`] where S has the given gradient.
    pub fn least_rounding(&self, gradient: &Vector3<f64>) -> f64 {
        self.blur * gradient.norm()
    }

    fn dropped(&self) -> &[u16] {
        &self.dropped[..usize::from(self.count)]
    }

    /// From now on plane i does not count until it is clearly on; without effect when too many are dropped already.
    pub fn drop(&mut self, i: usize) {
        if let Some(place) = self.dropped.get_mut(usize::from(self.count)) {
            // Places fit: a particle has no more planes (`MAX_PLANES`).
            *place = i as u16;
            self.count += 1;
        }
    }
}
