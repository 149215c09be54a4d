//! Two arcs over the same angle: which of them bounds the intersection, and where they cross.

use super::arc::{Arc, Parameter};
use super::conic::Conic;
use nalgebra::Vector2;

/// Halvings of an arc after which a touch of both arcs is closer than rounding.
const DEEPEST: u32 = 30;

/// Most steps towards a crossing; a handful are usual.
const MOST_STEPS: usize = 100;

/// Relative Newton step towards a crossing that is the last one: what it misses counts with its square in the
/// parameter, and with its square again in the area, since both arcs are as far from the contact point there.
const LAST_STEP: f64 = 1e-7;

/// Distances below this part of the size mean nothing.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Area between the origin and the inner of two arcs over the same angle.
pub(super) fn sector(a: &Arc, b: &Arc, conic_b: &Conic) -> f64 {
    // An arc lies between its chord and its tangents; mostly one such triangle lies behind the other one's chord.
    let beyond = [&a.from, &a.pole, &a.to].map(|point| -b.behind_chord(point));
    if beyond.iter().all(|&beyond| beyond <= 0.0) {
        return a.sector();
    }
    if [&b.from, &b.pole, &b.to].iter().all(|point| a.behind_chord(point) >= 0.0) {
        return b.sector();
    }
    let mut contest = Contest { a: *a, b: *b, a_is_inner: None, area: 0.0 };
    // Behind the chord of B, A is inside. Beyond it, which it is in one interval since it is convex, the conic of
    // B is nothing but the arc, and decides.
    let Some((start, end)) = positive([beyond[0], a.weight * beyond[1], beyond[2]]) else {
        return a.sector();
    };
    let (mut middle, tail) = end.map_or((*a, None), |end| {
        let (middle, tail) = a.split_at(end);
        (middle, Some(tail))
    });
    if let Some(start) = start {
        contest.own(true, &a.from);
        middle = middle.split(&a.split_at(start).0.to).1;
    }
    contest.decide(&middle, conic_b);
    if let Some(tail) = tail {
        contest.own(true, &tail.from);
    }
    contest.area + if contest.a_is_inner == Some(false) { contest.b.sector() } else { contest.a.sector() }
}

/// The interval in which c₀(1−λ)² + 2c₁λ(1−λ) + c₂λ² is positive if it is one; ends of the arc are `None`.
fn positive([c0, c1, c2]: [f64; 3]) -> Option<(Option<Parameter>, Option<Parameter>)> {
    let discriminant = c1 * c1 - c0 * c2;
    if c0 <= 0.0 && c2 <= 0.0 && (c1 <= 0.0 || discriminant <= 0.0) {
        return None;
    }
    let root = discriminant.max(0.0).sqrt();
    let start = (c0 < 0.0).then(|| if c1 >= 0.0 { [c1 + root, -c0] } else { [c2, root - c1] });
    let end = (c2 < 0.0).then(|| if c1 >= 0.0 { [-c2, c1 + root] } else { [root - c1, c0] });
    let whole = |[a, b]: Parameter| [a / (a + b), b / (a + b)];
    Some((start.map(whole), end.map(whole)))
}

/// What is left of both arcs, who is inner at its beginning, and the area before it.
struct Contest {
    a: Arc,
    b: Arc,
    a_is_inner: Option<bool>,
    area: f64,
}

impl Contest {
    /// From the ray through a point on, one arc is inner.
    fn own(&mut self, a_is_inner: bool, from: &Vector2<f64>) {
        if self.a_is_inner.is_some_and(|before| before != a_is_inner) {
            let (done_a, a) = self.a.split(from);
            let (done_b, b) = self.b.split(from);
            self.area += if a_is_inner { done_b.sector() } else { done_a.sector() };
            (self.a, self.b) = (a, b);
        }
        self.a_is_inner = Some(a_is_inner);
    }

    /// Who is inner where, over a part of A beyond the chord of B: the sign of S of B along A, a quartic in
    /// Bernstein form.
    fn decide(&mut self, part: &Arc, conic_b: &Conic) {
        let Arc { from, pole, to, weight } = part;
        let polar = |p, p2| conic_b.polar(p, p2);
        let quartic = [
            polar(from, from),
            weight * polar(from, pole),
            (polar(from, to) + 2.0 * weight * weight * polar(pole, pole)) / 3.0,
            weight * polar(pole, to),
            polar(to, to),
        ];
        let nothing = ROUNDING * (from.norm() + to.norm()) * conic_b.half_gradient.norm();
        self.search(part, quartic, [[1.0, 0.0], [0.0, 1.0]], nothing, DEEPEST);
    }

    /// Of the quartic over a range of the parameter of `part`. Values below `nothing` have no sign.
    fn search(&mut self, part: &Arc, c: [f64; 5], [low, high]: [Parameter; 2], nothing: f64, deeper: u32) {
        let at = |parameter: Parameter| part.split_at(parameter).0.to;
        let between = |[u, t]: Parameter| [u * low[0] + t * high[0], u * low[1] + t * high[1]];
        let inside = c.iter().all(|&c| c <= nothing);
        let outside = c.iter().all(|&c| c >= -nothing);
        // Arcs that coincide change nothing.
        if inside && outside && self.a_is_inner.is_some() {
            return;
        }
        if inside || outside {
            return self.own(inside, &at(low));
        }
        let changes = c.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
        if changes == 1 {
            // Descartes: exactly one crossing.
            self.own(c[0] <= 0.0, &at(low));
            return self.own(c[0] > 0.0, &at(between(crossing(c))));
        }
        // Halves of what is no number are none either: the caller sees that in the area.
        if !c.iter().all(|c| c.is_finite()) {
            self.area = f64::NAN;
            return;
        }
        if deeper == 0 {
            return self.own(c[2] <= 0.0, &at(low));
        }
        let (left, right) = halves(c);
        let middle = between([0.5, 0.5]);
        self.search(part, left, [low, middle], nothing, deeper - 1);
        self.search(part, right, [middle, high], nothing, deeper - 1);
    }
}

/// Both halves of a quartic in Bernstein form.
fn halves(mut c: [f64; 5]) -> ([f64; 5], [f64; 5]) {
    let (mut left, mut right) = (c, c);
    for round in 1..5 {
        for i in 0..5 - round {
            c[i] = 0.5 * (c[i] + c[i + 1]);
        }
        left[round] = c[0];
        right[4 - round] = c[4 - round];
    }
    (left, right)
}

/// Where a quartic in Bernstein form changes its sign, which it does once, as precise close to both ends.
fn crossing(mut c: [f64; 5]) -> Parameter {
    let (middle, _) = bernstein(&c, 0.5);
    if (middle > 0.0) == (c[4] > 0.0) {
        let t = root(&c);
        [1.0 - t, t]
    } else {
        c.reverse();
        let t = root(&c);
        [t, 1.0 - t]
    }
}

/// The root in (0, ½] of a quartic in Bernstein form that changes its sign there, once: Newton, or halving where that
/// leaves the bracket.
fn root(c: &[f64; 5]) -> f64 {
    let rising = c[0] <= 0.0;
    let (mut low, mut high) = (0.0, 0.5);
    let mut t = 0.0;
    for _ in 0..MOST_STEPS {
        let (value, slope) = bernstein(c, t);
        if (value > 0.0) == rising {
            high = t
        } else {
            low = t
        }
        let newton = t - value / slope;
        let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= LAST_STEP * next {
            return next;
        }
        t = next;
    }
    t
}

/// Value and slope of a quartic in Bernstein form.
fn bernstein(c: &[f64; 5], t: f64) -> (f64, f64) {
    let u = 1.0 - t;
    let cubic = |c: [f64; 4]| u * u * (u * c[0] + 3.0 * t * c[1]) + t * t * (3.0 * u * c[2] + t * c[3]);
    let left = cubic([c[0], c[1], c[2], c[3]]);
    let right = cubic([c[1], c[2], c[3], c[4]]);
    (u * left + t * right, 4.0 * (right - left))
}
