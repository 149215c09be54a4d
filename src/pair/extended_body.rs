//! A body in numbers of 32 digits, about a point of reference.
//!
//! Everything is taken from the data as the caller gave it: the rotations from quaternion or angle, the centre from
//! both positions, the weights from r, k and R. The depth of a plane at x₀ + δ is e + n·δ, where e = n·x₀ − d is found
//! once: whatever e has lost to rounding is a shift of the plane, the same for every δ.

use crate::linalg::double_double::DoubleDouble;
use crate::linalg::line::Line;
use crate::linalg::number::{Number, gamma, larger, smaller};
use crate::linalg::sine_and_cosine::sine_and_cosine;
use crate::linalg::symmetric::Symmetric;
use crate::linalg::wide::{Wide, difference, rounded, wide};
use crate::pair::body::Body;
use crate::pair::boundary_part::WideFrame;
use crate::pair::pair::{Given, Pair};
use crate::particle::potential::{Sums, Weights};
use crate::pose::{Pose, Turn};
use nalgebra::{Matrix3, Vector3};

/// Bound on the rounding of e and of a rotated normal, in units of [`DoubleDouble::UNIT`] and of the lengths that enter
/// (docs/theory.md, "Rounding"). Derived: 50 + N with sums over N planes, for which 64 + N is taken.
const ROUNDING: f64 = 64.0;

/// Bound on the rounding of a depth in doubles, relative to its terms: 3ε are derived.
const OF_DEPTH: f64 = gamma(16);

/// Bound on the rounding of e + n·δ, or of a depth after a step, in the same units. Derived: 5, of the product 3, of
/// the sum 1, of δ + v 1.
pub(crate) const DEPTH_AFTER: f64 = 8.0;

/// Bound on the relative rounding of a sum over so many planes.
fn rounding_of_sums(count: u32) -> f64 {
    (ROUNDING + f64::from(count)) * DoubleDouble::UNIT
}

/// Which side a plane is on at a point where its depth cannot be told from 0.
///
/// At zero depth S and its gradient are the same either way, and both curvatures are one-sided second derivatives: a
/// step with the plane off has length 0 if it leads to the other side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Undecided {
    /// As the sign of its depth says.
    BySign,
    /// On, unless it was dropped.
    On,
}

/// A plane near the point of reference.
#[derive(Clone, Copy)]
struct Plane {
    /// Solver frame.
    normal: Wide,
    /// e = n·x₀ − d.
    excess: DoubleDouble,
    /// |n|.
    length: f64,
    /// Whether it was on with a negative multiplier where its depth cannot be told from 0.
    dropped: bool,
}

impl Plane {
    /// Whether it counts as on, with this depth at x₀ + δ, |δ| = `length`.
    fn is_on(&self, depth: DoubleDouble, undecided: Undecided, length: f64) -> bool {
        match undecided {
            Undecided::BySign => depth.is_positive(),
            Undecided::On => depth.rounded() > if self.dropped { self.doubt(length) } else { -self.doubt(length) },
        }
    }

    /// The depth after a step, in the arithmetic of the model: the rounding of the depth before it is a shift of the
    /// plane.
    fn after(&self, depth: DoubleDouble, v: &Wide) -> (f64, f64) {
        let change = self.normal.dot(v);
        let doubt = DEPTH_AFTER * DoubleDouble::UNIT * (depth.rounded().abs() + self.length * rounded(v).norm());
        ((depth + change).rounded(), doubt)
    }

    fn depth(&self, delta: &Wide) -> DoubleDouble {
        self.excess + self.normal.dot(delta)
    }

    /// Bound on the rounding of a depth at x₀ + δ, |δ| = `length`, beyond that of e, which is that of the data.
    fn doubt(&self, length: f64) -> f64 {
        DEPTH_AFTER * DoubleDouble::UNIT * (self.excess.rounded().abs() + self.length * length)
    }

    /// The depth at x₀ + δ in doubles, and a bound on its rounding: a depth beyond that bound needs no more digits.
    fn quick_depth(&self, delta: &Vector3<f64>, length: f64) -> (f64, f64) {
        let excess = self.excess.rounded();
        let depth = excess + rounded(&self.normal).dot(delta);
        (depth, OF_DEPTH * (excess.abs() + self.length * length))
    }
}

/// A particle with its pose in the solver's frame.
pub(crate) struct ExtendedBody<'a> {
    body: &'a Body<'a>,
    /// Columns: the axes of the particle in the solver's frame.
    axes: [Wide; 3],
    /// Centre to x₀, solver frame and local frame.
    from_centre: Wide,
    local: Wide,
    planes: Vec<Plane>,
    /// No other plane is on within this distance of x₀.
    reach: f64,
    weights: Weights<DoubleDouble>,
    /// |x₀| + 2|centre|, the lengths that ROUNDING multiplies (docs/theory.md, 4.9).
    lengths: f64,
}

/// S and its derivatives at a point, in some axes.
#[derive(Clone, Copy)]
pub(crate) struct WideQuadratic {
    pub value: DoubleDouble,
    pub gradient: Wide,
    pub hessian: Symmetric<DoubleDouble>,
}

/// What enters the bounds of a solution: S, ∇S in the solver's frame, 2w Σ depth, the number of planes on, and the
/// bounds on the rounding of the depths and on the turn of ∇S.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideValue {
    pub value: DoubleDouble,
    pub gradient: Wide,
    pub pull: f64,
    pub count: u32,
    pub blur: f64,
    pub turn: f64,
    /// Number of planes kept times their weight: one that is off may be on by rounding.
    weight_of_planes: f64,
    /// Rounding of the centre of the sphere, in S.
    of_centre: f64,
    /// Least |depth| of any plane.
    pub clear: f64,
}

impl WideValue {
    /// Bound on the rounding of S.
    pub fn rounding(&self) -> f64 {
        let planes = self.pull * self.blur + self.weight_of_planes * self.blur * self.blur;
        planes + rounding_of_sums(self.count) * self.value.rounded() + self.of_centre
    }
}

fn of(value: f64) -> DoubleDouble {
    DoubleDouble::from(value)
}

impl<'a> ExtendedBody<'a> {
    /// Both bodies of a pair about x₀, solver frame.
    pub fn both(pair: &Pair, bodies: [&'a Body<'a>; 2], x: &Vector3<f64>) -> [Self; 2] {
        let (pose_a, of_b, centre, lengths) = match pair.given {
            Given::Poses([pose_a, pose_b]) => {
                let (of_b, to_a) = (axes(pose_b), difference(pose_a.position(), pose_b.position()));
                (pose_a, of_b, Vector3::from(of_b.map(|axis| axis.dot(&to_a))), pair.lengths())
            }
            Given::Boundary(placed) => {
                let WideFrame { axes, centre } = *placed.wide_frame();
                (placed.pose, axes, centre, pair.lengths() * placed.part.wide_condition())
            }
        };
        let identity = [0, 1, 2].map(|i| wide(&Vector3::ith(i, 1.0)));
        let of_a = axes(pose_a).map(|axis| Vector3::from(of_b.map(|b| b.dot(&axis))));
        let at_origin = wide(&Vector3::zeros());
        [Self::new(bodies[0], of_a, (centre, lengths), x), Self::new(bodies[1], identity, (at_origin, 0.0), x)]
    }

    fn new(body: &'a Body<'a>, axes: [Wide; 3], (centre, lengths): (Wide, f64), x: &Vector3<f64>) -> Self {
        let particle = body.particle;
        let own = Weights::precise(particle);
        let from_centre = wide(x) - centre;
        let local = Vector3::from([0, 1, 2].map(|i| axes[i].dot(&from_centre)));
        Self {
            body,
            axes,
            from_centre,
            local,
            planes: Vec::new(),
            reach: 0.0,
            weights: if body.is_plain() { own } else { Weights { sphere: of(body.weights().sphere), ..own } },
            lengths: x.norm() + 2.0 * larger(rounded(&centre).norm(), lengths),
        }
    }

    /// Whether every plane that is on within a distance of x₀ is kept.
    pub fn covers(&self, distance: f64) -> bool {
        distance <= self.reach
    }

    /// Makes sure of that.
    pub fn cover(&mut self, distance: f64) {
        if self.covers(distance) {
            return;
        }
        let (particle, axes) = (self.body.particle, &self.axes);
        self.reach = GATHERED_AHEAD * distance;
        let from = rounded(&self.local).norm();
        // The excess is compared in doubles.
        let blur = OF_DEPTH * (particle.bounds.longest_normal * from + particle.bounds.offset_within(from));
        let early = particle.bounds.longest_normal * self.reach + blur;
        let (planes, local) = (&mut self.planes, &self.local);
        planes.clear();
        particle.visit_near(&rounded(local), early, |place, n, excess| {
            if excess > -early {
                let normal = axes[0] * of(n.x) + axes[1] * of(n.y) + axes[2] * of(n.z);
                let excess = local.x * n.x + local.y * n.y + local.z * n.z - of(particle.offset(place));
                planes.push(Plane { normal, excess, length: n.norm(), dropped: false });
            }
        });
    }

    /// Calls `visit` with the normal and the depth of each plane that is on at x₀ + δ; the depth is 0 where it is so by
    /// `undecided` alone. Gives a lower bound of |depth| over the others.
    fn visit_active(&self, delta: &Wide, undecided: Undecided, mut visit: impl FnMut(&Wide, DoubleDouble)) -> f64 {
        let (quick, mut clear) = (rounded(delta), f64::INFINITY);
        let length = quick.norm();
        for plane in &self.planes {
            let (depth, rounding) = plane.quick_depth(&quick, length);
            if depth < -rounding {
                clear = smaller(-depth - rounding, clear);
                continue;
            }
            let depth = plane.depth(delta);
            if plane.is_on(depth, undecided, length) {
                visit(&plane.normal, depth.larger(of(0.0)));
            } else {
                clear = smaller(depth.rounded().abs(), clear);
            }
        }
        clear
    }

    /// Calls `visit` with the normal of each plane that is on at x₀ + δ.
    pub fn active_normals(&self, delta: &Wide, undecided: Undecided, mut visit: impl FnMut(Vector3<f64>)) {
        self.visit_active(delta, undecided, |n, _| visit(rounded(n)));
    }

    /// S at x₀ + δ with derivatives in `axes` (columns, solver frame; `metric` is the product of their transpose with
    /// them).
    pub fn quadratic(
        &self,
        delta: &Wide,
        undecided: Undecided,
        axes: &Matrix3<f64>,
        metric: &Symmetric<DoubleDouble>,
    ) -> WideQuadratic {
        let turned = |v: &Wide| {
            let along = |i: usize| v.x * axes[(0, i)] + v.y * axes[(1, i)] + v.z * axes[(2, i)];
            Vector3::new(along(0), along(1), along(2))
        };
        let (mut sums, mut squares) = (Sums::default(), Symmetric::default());
        self.visit_active(delta, undecided, |n, depth| {
            let n = turned(n);
            sums.add(&n, depth);
            squares.add_square(&n);
        });
        let (y, twice) = (self.from_centre + delta, self.weights.twice());
        WideQuadratic {
            value: self.weights.value(&sums, &y),
            gradient: self.weights.gradient(&sums.linear, &turned(&y)),
            hessian: squares.weighted(twice.plane, metric, twice.sphere),
        }
    }

    /// Whether each plane is on at x₀ + δ + v if it is at x₀ + δ, and off if it is off, but for rounding.
    pub fn keeps_active_set(&self, delta: &Wide, undecided: Undecided, v: &Wide) -> bool {
        let (quick, end) = (rounded(delta), rounded(&(delta + v)));
        let (length, length_of_end) = (quick.norm(), end.norm());
        self.planes.iter().all(|plane| {
            let (before, doubt) = plane.quick_depth(&quick, length);
            let (after, doubt_after) = plane.quick_depth(&end, length_of_end);
            if before < -doubt && after < -doubt_after {
                return true;
            }
            let before = plane.depth(delta);
            let (after, rounding) = plane.after(before, v);
            if plane.is_on(before, undecided, length) {
                after >= -rounding
            } else {
                after <= plane.doubt(length + length_of_end)
            }
        })
    }

    /// Of the active planes whose depth cannot be distinguished from 0, the one with the most negative depth, hence
    /// multiplier, after a step; and |depth|·|n|.
    pub fn most_negative(&self, delta: &Wide, v: &Wide) -> Option<(usize, f64)> {
        let length = rounded(delta).norm();
        let mut most = None;
        for (place, plane) in self.planes.iter().enumerate() {
            let before = plane.depth(delta);
            let undecided = !plane.dropped && before.rounded().abs() <= plane.doubt(length);
            let (after, rounding) = plane.after(before, v);
            if undecided && after < -rounding && most.is_none_or(|(_, pull)| -after * plane.length > pull) {
                most = Some((place, -after * plane.length));
            }
        }
        most
    }

    /// Leaves a plane out where its depth cannot be told from 0.
    pub fn drop(&mut self, place: usize) {
        self.planes[place].dropped = true;
    }

    /// Takes all planes that were dropped in again.
    pub fn restore(&mut self) {
        self.planes.iter_mut().for_each(|plane| plane.dropped = false);
    }

    /// Adds S at x₀ + δ + α·v, times a weight.
    pub fn add_to_line(&self, line: &mut Line, delta: &Wide, v: &Wide, weight: DoubleDouble) {
        let (quick, length) = (rounded(delta), rounded(delta).norm());
        let twice = self.weights.twice();
        let w2 = weight * twice.plane;
        line.add_curvature(weight * twice.sphere * v.dot(v));
        for plane in &self.planes {
            let (depth, rounding) = plane.quick_depth(&quick, length);
            let depth = if depth < -rounding { of(depth) } else { plane.depth(delta) };
            line.add_plane(depth, plane.normal.dot(v), w2);
        }
    }

    /// S and what enters the bounds, at x₀ + δ.
    pub fn value(&self, delta: &Wide) -> WideValue {
        let particle = self.body.particle;
        let (mut sums, mut least) = (Sums::default(), f64::INFINITY);
        let clear = self.visit_active(delta, Undecided::BySign, |n, depth| {
            least = smaller(depth.rounded(), least);
            sums.add(n, depth);
        });
        let clear = smaller(least, clear);
        let y = self.from_centre + delta;
        let lengths = self.lengths + rounded(delta).norm();
        let unit = ROUNDING * DoubleDouble::UNIT;
        let normals = particle.bounds.longest_normal;
        let (plane_weight, sphere_weight, count) = (self.plane_weight(), self.weights.sphere.rounded(), sums.count);
        let pull = 2.0 * plane_weight * sums.depth.rounded();
        WideValue {
            value: self.weights.value(&sums, &y),
            gradient: self.weights.gradient(&sums.linear, &y),
            pull,
            count,
            blur: unit * (normals * lengths + particle.bounds.offset_within(lengths)),
            weight_of_planes: self.planes.len() as f64 * plane_weight,
            of_centre: sphere_weight * unit * lengths * (2.0 * rounded(&y).norm() + unit * lengths),
            turn: rounding_of_sums(count) * normals * pull + unit * 2.0 * sphere_weight * lengths,
            clear,
        }
    }

    /// Whether S, k = 0, may be 0 where its regularised value is this.
    pub fn may_be_all_regularisation(&self, value: f64) -> bool {
        self.body.particle.sphericity() == 0.0 && value <= self.body.most_surplus(1.0)
    }

    /// From x₀ + δ to the centre.
    pub fn to_centre(&self, delta: &Wide) -> Wide {
        -(self.from_centre + delta)
    }

    /// x₀, local frame.
    #[cfg(test)]
    pub fn local(&self) -> &Wide {
        &self.local
    }

    /// S at the centre, where only planes behind it count.
    pub fn value_at_centre(&self) -> f64 {
        self.body.value(&self.body.centre())
    }

    /// Bound on the curvature of S in any direction, anywhere.
    pub fn stiffest(&self) -> f64 {
        let normals = self.longest_normal();
        self.body.plane_curvature() * self.body.particle.len() as f64 * normals * normals + self.soft()
    }

    /// Longest normal of a plane.
    pub fn longest_normal(&self) -> f64 {
        self.body.particle.bounds.longest_normal
    }

    /// Planes' weight, 1/length².
    pub fn plane_weight(&self) -> f64 {
        self.weights.plane.rounded()
    }

    /// Least curvature of S in any direction.
    pub fn soft(&self) -> f64 {
        2.0 * self.weights.sphere.rounded()
    }

    /// Bound on the rounding of the centre of the sphere, length.
    pub fn shift(&self, delta: &Wide) -> f64 {
        ROUNDING * DoubleDouble::UNIT * (self.lengths + rounded(delta).norm())
    }
}

/// How much farther planes are gathered than they are needed (chosen; each gathering at least doubles it).
const GATHERED_AHEAD: f64 = 2.0;

/// The axes of a body in the world, from its rotation as given.
pub(crate) fn axes(pose: &Pose) -> [Wide; 3] {
    match pose.turn() {
        Turn::Quaternion(quaternion) => axes_of(quaternion),
        Turn::Angle(angle) => {
            let (sine, cosine) = sine_and_cosine(angle);
            let (zero, one) = (of(0.0), of(1.0));
            [Vector3::new(cosine, sine, zero), Vector3::new(-sine, cosine, zero), Vector3::new(zero, zero, one)]
        }
    }
}

/// The axes that a quaternion of any length turns those of the world to.
fn axes_of([w, x, y, z]: [f64; 4]) -> [Wide; 3] {
    let p = DoubleDouble::product;
    let (ww, xx, yy, zz) = (p(w, w), p(x, x), p(y, y), p(z, z));
    let square = ww + xx + yy + zz;
    let twice = |v: DoubleDouble| (v + v) / square;
    let (xy, xz, yz, wx, wy, wz) = (p(x, y), p(x, z), p(y, z), p(w, x), p(w, y), p(w, z));
    [
        Vector3::new((ww + xx - yy - zz) / square, twice(xy + wz), twice(xz - wy)),
        Vector3::new(twice(xy - wz), (ww - xx + yy - zz) / square, twice(yz + wx)),
        Vector3::new(twice(xz + wy), twice(yz - wx), (ww - xx - yy + zz) / square),
    ]
}
