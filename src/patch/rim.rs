//! Points and arcs of the rim of the patch, on which both potentials are 1, and of the curves inside.

use super::field::{Field, Look, Owner, dot};
use super::numbers::{COINCIDENT, Limits, MOST_HALF_TURN, ON_RIM, POINT_BESIDE_CURVE};
use crate::linalg::root::MOST_STEPS;

/// A point of the rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimPoint {
    pub x: [f64; 3],
    /// Along the rim, counter-clockwise: a unit vector of the frame's plane.
    pub tangent: [f64; 2],
    pub active: u128,
}

impl RimPoint {
    /// The direction and the slopes of the field at a point of the rim; `None` where the patch is no graph.
    pub fn new(field: &Field, x: [f64; 3]) -> Option<Self> {
        Self::of(field, x, &field.look(&x))
    }

    /// As `new`, from a look at the point, or at one so near that the direction of the rim is known.
    fn of(field: &Field, x: [f64; 3], look: &Look) -> Option<Self> {
        let (_, rises) = look.difference(field.b.is_some());
        // The slope of S points outwards.
        let slope = look.slope(field.b.is_some());
        let length = length_of(slope);
        let tangent = [-slope[1] / length, slope[0] / length];
        (rises[2] > 0.0 && tangent[0].is_finite() && tangent[1].is_finite()).then_some(Self {
            x,
            tangent,
            active: look.active,
        })
    }

    /// tan ½θ of the angle θ by which the rim turns from here to another point.
    pub fn half_turn_to(&self, other: &Self) -> f64 {
        let ([a, b], [c, d]) = (self.tangent, other.tangent);
        (a * d - b * c) / (1.0 + (a * c + b * d))
    }

    /// Crossing of the tangents here and at another point, from the middle of the chord.
    fn crossing(&self, other: &Self) -> Option<[f64; 2]> {
        let ([a, b], [c, d]) = (self.tangent, other.tangent);
        let [u, v] = [other.x[0] - self.x[0], other.x[1] - self.x[1]];
        let turn = a * d - b * c;
        let along = (u * d - v * c) / turn;
        (turn > COINCIDENT).then_some([along * a - 0.5 * u, along * b - 0.5 * v])
    }

    /// The area between the chord to another point and the tangents, within which the rim lies; infinite after half a
    /// turn.
    pub fn tip(&self, other: &Self) -> f64 {
        let [u, v] = [other.x[0] - self.x[0], other.x[1] - self.x[1]];
        self.crossing(other).map_or(f64::INFINITY, |[x, y]| 0.5 * (x * v - y * u).abs())
    }

    /// The point of the rim between here and another one, outwards from the middle of the chord: towards where the
    /// tangents cross, which of a conic is the point whose tangent is along the chord.
    pub fn middle(&self, other: &Self, field: &Field) -> Option<Self> {
        let (mut out, length) = across(&self.x, &other.x);
        let half = self.half_turn_to(other);
        let chord: [f64; 3] = std::array::from_fn(|i| 0.5 * (self.x[i] + other.x[i]));
        // The sagitta of a circle: half the chord times tan ¼θ.
        let part = 1.0 / (1.0 + (1.0 + half * half).sqrt());
        let mut sagitta = 0.5 * length * half.clamp(-MOST_HALF_TURN, MOST_HALF_TURN) * part;
        let towards = self.crossing(other).or_else(|| {
            // After half a turn the tangents are parallel.
            let ([a, b], [c, d]) = (self.tangent, other.tangent);
            (a * c + b * d < 0.0).then_some([length * (a - c), length * (b - d)])
        });
        if let Some([u, v]) = towards.filter(|[u, v]| u * out[0] + v * out[1] > 0.0) {
            let far = length_of([u, v]);
            out = [u / far, v / far];
            sagitta = (far * part).min(length);
        }
        let at = |t: f64| [chord[0] + t * out[0], chord[1] + t * out[1], chord[2]];
        let x = on_line(field, at(sagitta), (out, length), |look, _| (look.s[0] - 1.0, look.gradients[0]));
        // Inwards is the other side of the rim, which in a sliver is near.
        let is_outwards =
            |(x, _): &([f64; 3], Look)| (x[0] - chord[0]) * out[0] + (x[1] - chord[1]) * out[1] >= -ON_RIM * length;
        let (x, look) = x.filter(is_outwards).or_else(|| outwards(field, at, (out, length), sagitta))?;
        Self::of(field, x, &look)
    }
}

/// The point of the rim on a line outwards from a point of the patch: S is convex along it, so that Newton's method
/// converges from outside, and what it says inside leads out.
fn outwards(
    field: &Field,
    at: impl Fn(f64) -> [f64; 3],
    (out, length): ([f64; 2], f64),
    from: f64,
) -> Option<([f64; 3], Look)> {
    let (mut inside, mut outside, mut t) = (0.0, f64::INFINITY, from.max(0.0));
    let mut z = at(0.0)[2];
    for _ in 0..MOST_STEPS {
        let [u, v, _] = at(t);
        if field.b.is_some() {
            z = field.height(u, v, z)?;
        }
        let look = field.look(&[u, v, if field.b.is_some() { z } else { 0.0 }]);
        let slope = look.slope(field.b.is_some());
        let off = look.s[0] - 1.0;
        if off < 0.0 {
            inside = t
        } else {
            outside = t
        }
        let mut next = t - off / (slope[0] * out[0] + slope[1] * out[1]);
        if !(next > inside && next < outside) {
            next = if outside.is_finite() { 0.5 * (inside + outside) } else { 2.0 * t + length };
        }
        if (next - t).abs() <= ON_RIM * length {
            return Some(([u, v, z], look));
        }
        t = next;
    }
    None
}

/// The point of the patch near x, off it in one direction of the frame's plane only, where a function is 0; and the
/// field beside it. `function` gives value and gradient. `None` where it is farther than `length`.
fn on_line(
    field: &Field,
    mut x: [f64; 3],
    (out, length): ([f64; 2], f64),
    function: impl Fn(&Look, &[f64; 3]) -> (f64, [f64; 3]),
) -> Option<([f64; 3], Look)> {
    for _ in 0..Limits::ITERATIONS {
        let look = field.look(&x);
        let (d, rises) = look.difference(field.b.is_some());
        let (off, slopes) = function(&look, &x);
        let across = |g: &[f64; 3]| g[0] * out[0] + g[1] * out[1];
        let determinant = across(&slopes) * rises[2] - slopes[2] * across(&rises);
        let step = (off * rises[2] - slopes[2] * d) / determinant;
        let up = (across(&slopes) * d - across(&rises) * off) / determinant;
        (0..2).for_each(|i| x[i] -= step * out[i]);
        x[2] -= up;
        if !(step.abs() < length) {
            return None;
        }
        if step.abs().max(up.abs()) <= ON_RIM * length {
            return Some((x, look));
        }
    }
    None
}

/// A part of the curve on which plane `id` goes on.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvePart {
    pub id: u32,
    pub from: [f64; 3],
    pub middle: [f64; 3],
    pub to: [f64; 3],
}

impl CurvePart {
    fn quarters(&self) -> [[f64; 3]; 2] {
        [0.25, 0.75].map(|t| parabola([&self.from, &self.middle, &self.to], t))
    }

    /// Estimated error of ∫ p where the parabola through the three points departs from the curve: a point of quadrature
    /// between the two wrongly counts, or omits, the square of the excess.
    pub fn straying(&self, field: &Field) -> f64 {
        let plane = &field.planes[self.id as usize];
        let (_, length) = across(&self.from, &self.to);
        let excess = self.quarters().map(|mut x| {
            let (d, rises) = field.look(&x).difference(field.b.is_some());
            x[2] -= d / rises[2];
            plane.excess + dot(&plane.normal, &x)
        });
        POINT_BESIDE_CURVE
            * 0.5
            * field.plane_weight(plane.owner)
            * length
            * length
            * excess[0].powi(2).max(excess[1].powi(2))
    }

    /// Its halves, each with its middle on the curve.
    pub fn halves(&self, field: &Field) -> Option<[Self; 2]> {
        let plane = &field.planes[self.id as usize];
        let (out, length) = across(&self.from, &self.to);
        let excess = |_: &Look, x: &[f64; 3]| (plane.excess + dot(&plane.normal, x), plane.normal);
        let [a, b] = self.quarters().map(|x| on_line(field, x, (out, length), excess));
        let Self { id, from, middle, to } = *self;
        Some([Self { id, from, middle: a?.0, to: middle }, Self { id, from: middle, middle: b?.0, to }])
    }
}

/// How far the parabola through an arc's ends and middle is off the rim.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Misfit {
    /// The area between both.
    pub area: f64,
    /// ∫ p on it.
    pub load: f64,
    /// By which the middle is to be moved, so that the parabola encloses the area of the arc.
    pub correction: [f64; 2],
}

impl Misfit {
    /// From the distances at a quarter and three quarters: in between the parabola meets the rim.
    pub fn new(field: &Field, [from, middle, to]: [&RimPoint; 3]) -> Option<Self> {
        let (out, length) = across(&from.x, &to.x);
        let mut misfit = Self::default();
        let mut signed = 0.0;
        for t in [0.25, 0.75] {
            let look = field.look(&parabola([&from.x, &middle.x, &to.x], t));
            let (d, rises) = look.difference(field.b.is_some());
            let steepness = length_of(look.slope(field.b.is_some()));
            let distance = (look.s[0] - 1.0 - look.gradients[0][2] * d / rises[2]) / steepness;
            if !distance.is_finite() {
                return None;
            }
            signed += 32.0 / 90.0 * length * distance;
            // s changes half as fast as S.
            misfit.load += 0.25 * 32.0 / 90.0 * length * steepness * distance * distance;
        }
        misfit.area = signed.abs();
        // A shift of the middle by d adds 2/3 of d times the chord.
        misfit.correction = out.map(|c| -1.5 * signed / length * c);
        Some(misfit)
    }
}

/// The planes whose state is known where the rim is drawn, one bit each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// Planes whose curves are drawn.
    pub drawn: u128,
    /// Planes that are active at the origin.
    pub at_origin: u128,
    /// Change of S by a plane up to which its curve is left out.
    pub least: f64,
    /// Distance beyond the edge of a triangle, over that from the origin, up to which the edge is left out.
    pub least_beyond: f64,
}

/// A plane whose state on an arc is not the known one: that at the origin if its curve is not drawn, else that in the
/// middle of the arc. Its number, and a point where the state differs.
///
/// `own`: the planes whose curves end at the ends of the arc. Along a parabola through the three points the excess of a
/// plane is a quadratic; where the arc turns too much (not `is_arc`), only its middle is checked.
pub(super) fn unmet_plane(
    field: &Field,
    [from, middle, to]: [&RimPoint; 3],
    (own, is_arc): ([u32; 2], bool),
    known: &Known,
) -> Option<(usize, [f64; 3])> {
    for (i, plane) in field.planes.iter().enumerate() {
        let [a, m, b] = [from, middle, to].map(|point| plane.excess + dot(&plane.normal, &point.x));
        let is_drawn = known.drawn >> i & 1 == 1;
        let is_on = if is_drawn { m > 0.0 } else { known.at_origin >> i & 1 == 1 };
        let sign = if is_on { -1.0 } else { 1.0 };
        // The parabola is ≤ the largest plus its bend.
        if (sign * a).max(sign * m).max(sign * b) + (a - 2.0 * m + b).abs() <= 0.0 {
            continue;
        }
        let extreme = (3.0 * a + b - 4.0 * m) / (4.0 * (a + b) - 8.0 * m);
        let mut farthest = (f64::NAN, 0.0);
        for (t, own) in [(0.0, own[0]), (1.0, own[1]), (0.5, u32::MAX), (extreme, u32::MAX)] {
            let [excess] = parabola([&[a], &[m], &[b]], t);
            let beyond = sign * excess;
            if own != i as u32 && (0.0..=1.0).contains(&t) && (is_arc || t == 0.5) && beyond > farthest.1 {
                farthest = (t, beyond);
            }
        }
        let (t, beyond) = farthest;
        let counts = match plane.owner {
            Owner::Edge => beyond * beyond > known.least_beyond * known.least_beyond * dot(&middle.x, &middle.x),
            owner => field.plane_weight(owner) * beyond * beyond > known.least,
        };
        if counts {
            return Some((i, parabola([&from.x, &middle.x, &to.x], t)));
        }
    }
    None
}

/// The parabola through three points at t = 0, ½, 1.
pub(super) fn parabola<const N: usize>([from, middle, to]: [&[f64; N]; 3], t: f64) -> [f64; N] {
    let [p, q, r] = [(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)];
    std::array::from_fn(|i| p * from[i] + q * middle[i] + r * to[i])
}

/// The unit vector of the frame's plane across a chord, outwards where the rim runs counter-clockwise, and the length
/// of the chord.
fn across(from: &[f64; 3], to: &[f64; 3]) -> ([f64; 2], f64) {
    let [u, v] = [to[0] - from[0], to[1] - from[1]];
    let length = length_of([u, v]);
    ([v / length, -u / length], length)
}

/// Length of a vector of the frame's plane. A patch is as large as its bodies: squares neither overflow nor vanish.
fn length_of([u, v]: [f64; 2]) -> f64 {
    (u * u + v * v).sqrt()
}
