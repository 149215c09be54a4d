//! The area of the intersection of both cross-sections.

use super::arc::Arc;
use super::bernstein::{Parameter, halves, positive_interval, sign_change};
use super::boundary::Boundary;
use super::cross_section::CrossSection;
use super::edge_curve::EdgeCurve;
use super::lines::Line;
use super::numbers::{Limits, ROUNDING};
use super::plane_section::{Failure, PlaneSection};
use nalgebra::Vector2;

/// The area, in the smallest buffers that hold all lines that come close.
pub(super) fn area(sections: &[PlaneSection; 2]) -> Result<f64, Failure> {
    let is_full = |found: &Result<f64, Failure>| *found == Err(Failure::BufferFull);
    let mut found = on_stack::<{ Limits::LINES[0] }>(sections);
    if is_full(&found) {
        found = on_stack::<{ Limits::LINES[1] }>(sections);
    }
    if is_full(&found) {
        let most = sections[0].shape.len().max(sections[1].shape.len());
        let (mut lines_a, mut lines_b) = (vec![Line::default(); most], vec![Line::default(); most]);
        found = in_buffers(sections, &mut lines_a, &mut lines_b);
    }
    found
}

/// A function of its own, so that only the buffers in use are on the stack.
#[inline(never)]
fn on_stack<const LINES: usize>(sections: &[PlaneSection; 2]) -> Result<f64, Failure> {
    let (mut lines_a, mut lines_b) = ([Line::default(); LINES], [Line::default(); LINES]);
    in_buffers(sections, &mut lines_a, &mut lines_b)
}

/// Traces both boundaries at once. Over every angle at which neither changes its arc, the inner of the two arcs counts.
fn in_buffers(sections: &[PlaneSection; 2], lines_a: &mut [Line], lines_b: &mut [Line]) -> Result<f64, Failure> {
    let mut boundary_a = Boundary::new(CrossSection::new(&sections[0], lines_a)?)?;
    let mut boundary_b = Boundary::new(CrossSection::new(&sections[1], lines_b)?)?;
    let (mut arc_a, mut arc_b) = (boundary_a.next_arc()?, boundary_b.next_arc()?);
    let mut area = 0.0;
    loop {
        // The arc that ends at the larger angle is divided where the other one ends.
        let turn = arc_a.to.perp(&arc_b.to);
        let (mut rest_a, mut rest_b) = (None, None);
        if turn > 0.0 {
            let (now, rest) = arc_b.split(&arc_a.to);
            (arc_b, rest_b) = (now, Some(rest));
        } else if turn < 0.0 {
            let (now, rest) = arc_a.split(&arc_b.to);
            (arc_a, rest_a) = (now, Some(rest));
        }
        area += inner_sector(&arc_a, &arc_b, &boundary_b.curve);
        // Once one boundary is complete, the remaining arcs of the other are rounding.
        if rest_a.is_none() && boundary_a.is_complete() || rest_b.is_none() && boundary_b.is_complete() {
            break;
        }
        arc_a = rest_a.map_or_else(|| boundary_a.next_arc(), Ok)?;
        arc_b = rest_b.map_or_else(|| boundary_b.next_arc(), Ok)?;
    }
    if boundary_a.is_closed() && boundary_b.is_closed() && area.is_finite() {
        Ok(area)
    } else {
        Err(Failure::Inaccurate)
    }
}

/// Area between the origin and the inner of two arcs over the same angle.
fn inner_sector(a: &Arc, b: &Arc, curve_b: &EdgeCurve) -> f64 {
    // An arc lies between its chord and its tangents; mostly one such triangle lies behind the other one's chord.
    let beyond = [&a.from, &a.pole, &a.to].map(|point| -b.behind_chord(point));
    if beyond.iter().all(|&beyond| beyond <= 0.0) {
        return a.sector();
    }
    if [&b.from, &b.pole, &b.to].iter().all(|point| a.behind_chord(point) >= 0.0) {
        return b.sector();
    }
    let mut comparison = Comparison { a: *a, b: *b, a_is_inner: None, area: 0.0 };
    // Behind the chord of B, A is the inner arc. The part of A beyond that chord is an interval, since A is convex;
    // there the sign of S of B decides, as its conic and its arc are the same.
    let Some((start, end)) = positive_interval([beyond[0], a.weight * beyond[1], beyond[2]]) else {
        return a.sector();
    };
    let (mut middle, tail) = end.map_or((*a, None), |end| {
        let (middle, tail) = a.split_at(end);
        (middle, Some(tail))
    });
    if let Some(start) = start {
        comparison.set_inner(true, &a.from);
        middle = middle.split(&a.split_at(start).0.to).1;
    }
    comparison.compare(&middle, curve_b);
    if let Some(tail) = tail {
        comparison.set_inner(true, &tail.from);
    }
    comparison.area + if comparison.a_is_inner == Some(false) { comparison.b.sector() } else { comparison.a.sector() }
}

/// The parts of both arcs not yet counted, which of them is inner where they begin, and the area before.
struct Comparison {
    a: Arc,
    b: Arc,
    a_is_inner: Option<bool>,
    area: f64,
}

impl Comparison {
    /// One arc is inner from the ray through a point on.
    fn set_inner(&mut self, a_is_inner: bool, from: &Vector2<f64>) {
        if self.a_is_inner.is_some_and(|before| before != a_is_inner) {
            let (done_a, a) = self.a.split(from);
            let (done_b, b) = self.b.split(from);
            self.area += if a_is_inner { done_b.sector() } else { done_a.sector() };
            (self.a, self.b) = (a, b);
        }
        self.a_is_inner = Some(a_is_inner);
    }

    /// Which arc is inner where, over a part of A beyond the chord of B: the sign of S of B along A, a quartic in
    /// Bernstein form.
    fn compare(&mut self, part: &Arc, curve_b: &EdgeCurve) {
        let Arc { from, pole, to, weight } = part;
        let polar = |p, p2| curve_b.polar(p, p2);
        let quartic = [
            polar(from, from),
            weight * polar(from, pole),
            (polar(from, to) + 2.0 * weight * weight * polar(pole, pole)) / 3.0,
            weight * polar(pole, to),
            polar(to, to),
        ];
        let negligible = ROUNDING * (from.norm() + to.norm()) * curve_b.half_gradient.norm();
        self.isolate(part, quartic, [[1.0, 0.0], [0.0, 1.0]], negligible, Limits::BISECTIONS);
    }

    /// The same for the quartic over a range of the parameter of `part`, by bisection until one sign change is left.
    /// Values below `negligible` have no sign.
    fn isolate(&mut self, part: &Arc, c: [f64; 5], [low, high]: [Parameter; 2], negligible: f64, deeper: u32) {
        let at = |parameter: Parameter| part.split_at(parameter).0.to;
        let between = |[u, t]: Parameter| [u * low[0] + t * high[0], u * low[1] + t * high[1]];
        let inside = c.iter().all(|&c| c <= negligible);
        let outside = c.iter().all(|&c| c >= -negligible);
        // Where the arcs coincide either may count.
        if inside && outside && self.a_is_inner.is_some() {
            return;
        }
        if inside || outside {
            return self.set_inner(inside, &at(low));
        }
        let changes = c.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
        if changes == 1 {
            // By Descartes' rule there is exactly one crossing.
            self.set_inner(c[0] <= 0.0, &at(low));
            return self.set_inner(c[0] > 0.0, &at(between(sign_change(c))));
        }
        // Bisection does not mend NaN: the caller sees it in the area.
        if !c.iter().all(|c| c.is_finite()) {
            self.area = f64::NAN;
            return;
        }
        if deeper == 0 {
            return self.set_inner(c[2] <= 0.0, &at(low));
        }
        let (left, right) = halves(c);
        let middle = between([0.5, 0.5]);
        self.isolate(part, left, [low, middle], negligible, deeper - 1);
        self.isolate(part, right, [middle, high], negligible, deeper - 1);
    }
}
