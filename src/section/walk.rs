//! The walk around the edge of one cut: arc by arc, counter-clockwise, once around.

use super::Trouble;
use super::arc::Arc;
use super::conic::{Conic, quarter_turn};
use super::cut::{Cut, Look};
use nalgebra::Vector2;
use std::f64::consts::FRAC_1_SQRT_2;

/// Rays at which every arc ends, so that none spans half a turn. The walk starts at the last one. Points of one of them
/// are multiples of each other without rounding.
const STOPS: [Vector2<f64>; 3] =
    [Vector2::new(0.0, 1.0), Vector2::new(-FRAC_1_SQRT_2, -FRAC_1_SQRT_2), Vector2::new(1.0, 0.0)];

/// Tangent of half the widest angle of an arc on its circle: √3, 120°.
const WIDEST: f64 = 1.7320508075688772;

/// Multiple of rounding by which S may miss 1 at the end of an arc before the walk counts as spoilt. In 99.9 % of random
/// arcs it misses by less than once the rounding; a wrong conic misses by more than any multiple.
const MISS: f64 = 100.0;

/// Most moves of an end to where it should be; none or one are usual.
const MOST_MOVES: usize = 4;

/// Sine below which a line counts as a tangent of the edge.
const TANGENT: f64 = 1e-8;

/// A walk around the edge of a cut.
#[derive(Debug)]
pub(super) struct Walk<'s> {
    cut: Cut<'s>,
    /// Conic of the last arc.
    pub conic: Conic,
    start: Vector2<f64>,
    here: Vector2<f64>,
    look: Look,
    /// The line that switches here.
    switching: Option<u32>,
    /// Rounding of S here, with that of the last arc.
    rounding: f64,
    /// Stops passed.
    stops: usize,
    /// Arcs so far.
    arcs: usize,
}

/// What ends an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// A plane switches.
    Line(u32),
    /// A stop, by its direction.
    Stop(Vector2<f64>),
    /// The widest angle.
    Width,
}

impl<'s> Walk<'s> {
    /// Fails when the edge is not found along the first ray.
    pub fn new(mut cut: Cut<'s>) -> Result<Self, Trouble> {
        let first = STOPS[STOPS.len() - 1];
        let here = cut.ray(&first)? * first;
        let look = cut.look(&here);
        let conic = cut.conic(&here, &look, None);
        let mut walk =
            Self { cut, conic, start: here, here, look, switching: None, rounding: look.rounding, stops: 0, arcs: 0 };
        walk.settle(Event::Stop(first));
        walk.start = walk.here;
        Ok(walk)
    }

    /// Whether the walk is once around.
    pub fn is_round(&self) -> bool {
        self.stops == STOPS.len()
    }

    /// Whether it came back to where it began.
    pub fn is_closed(&self) -> bool {
        let gap = 2.0 * self.look.half_gradient.dot(&(self.here - self.start));
        self.is_round() && gap.abs() <= MISS * f64::EPSILON * self.rounding
    }

    /// The next arc. Fails when the walk is once around, and when rounding has spoilt it: an arc is proven by its end,
    /// where S = 1, while no plane switches on the way there.
    pub fn step(&mut self) -> Result<Arc, Trouble> {
        let stop = STOPS.get(self.stops).ok_or(Trouble::Spoilt)?;
        self.arcs += 1;
        // A line meets a convex curve at most twice; as many arcs again may be split off by rounding.
        if self.arcs > 4 * self.cut.lines.as_slice().len() + 8 * STOPS.len() {
            return Err(Trouble::Spoilt);
        }
        self.conic = self.cut.conic(&self.here, &self.look, self.switching);
        let (tau, event, mut arc, mut step) = self.first_event(stop)?;
        if let Event::Stop(stop) = event {
            let on_ray = arc.to.dot(&stop) * stop;
            step += on_ray - arc.to;
            arc.to = on_ray;
            self.stops += 1;
        }
        self.switching = if let Event::Line(i) = event { Some(i) } else { None };
        self.here = arc.to;
        let before = self.look.far;
        self.look = self.cut.follow(&self.here, &step);
        let length = before + self.look.far;
        self.rounding = self.look.rounding + self.conic.rounding(tau, &arc, &self.look.half_gradient, length);
        if !(self.look.value.abs() <= MISS * f64::EPSILON * self.rounding) {
            return Err(Trouble::Spoilt);
        }
        self.settle(event);
        // A tilt of the chord takes the pole along half the way.
        arc.pole += 0.5 * (self.here - arc.to);
        arc.to = self.here;
        Ok(arc)
    }

    /// Parameter and kind of the first event on the conic, and the arc that leads there.
    fn first_event(&mut self, stop: &Vector2<f64>) -> Result<(f64, Event, Arc, Vector2<f64>), Trouble> {
        let conic = &self.conic;
        let (determinant, twice_inwards) = (conic.determinant(), 2.0 * conic.inwards());
        // Where below `limit` an excess, not negative at the base, first turns negative. On the conic it is
        // (excess + 2bτ + aτ²)/(1 + τ²·det M).
        let crossing = |excess: f64, rate: &Vector2<f64>, limit: f64| {
            let b = conic.half_gradient.perp(rate);
            let a = excess * determinant + rate.dot(&twice_inwards);
            let control = excess + b * limit;
            if control >= 0.0 && control + limit * (b + a * limit) >= 0.0 {
                return None;
            }
            let root = (b * b - a * excess).sqrt();
            let tau = if b <= 0.0 { excess / (root - b) } else { -(b + root) / a };
            (tau >= 0.0 && tau < limit).then_some(tau)
        };
        let mut tau = if determinant > 0.0 { WIDEST / determinant.sqrt() } else { f64::MAX };
        let mut event = Event::Width;
        // A stop is a line through the origin with the walk on its positive side.
        if let Some(earlier) = crossing(self.here.perp(stop).max(0.0), &-quarter_turn(stop), tau) {
            (tau, event) = (earlier, Event::Stop(*stop));
        }
        let mut known = 0;
        loop {
            for (i, line) in self.cut.lines.as_slice()[known..].iter().enumerate() {
                let sign = if line.on { 1.0 } else { -1.0 };
                if let Some(earlier) = crossing((sign * line.here).max(0.0), &(sign * line.rate), tau) {
                    (tau, event) = (earlier, Event::Line((known + i) as u32));
                }
            }
            let horizon = self.cut.lines.horizon();
            let (arc, step) = conic.arc(tau);
            if horizon == f64::INFINITY {
                return Ok((tau, event, arc, step));
            }
            let farthest = arc.pole.norm_squared().max(arc.to.norm_squared()).sqrt();
            if !(farthest > horizon) {
                return Ok((tau, event, arc, step));
            }
            known = self.cut.lines.as_slice().len();
            self.cut.lines.widen_towards(farthest, &self.here)?;
        }
    }

    /// Moves here to where S = 1 and the line of the event is met, to the rounding of both: what an arc misses, the next
    /// one would inherit.
    fn settle(&mut self, event: Event) {
        for _ in 0..MOST_MOVES {
            let Look { value, half_gradient, .. } = self.look;
            let on_edge = self.look.on_edge();
            let to_edge = -0.5 * value / half_gradient.norm_squared() * half_gradient;
            let shift = match event {
                Event::Line(i) => {
                    let line = self.cut.lines.at(i);
                    let (excess, rate) = (line.offset(), line.rate);
                    if on_edge && excess == 0.0 {
                        return;
                    }
                    let turn = half_gradient.perp(&rate);
                    if turn.abs() > TANGENT * half_gradient.norm() * rate.norm() {
                        (0.5 * value * quarter_turn(&rate) - excess * quarter_turn(&half_gradient)) / turn
                    } else {
                        to_edge
                    }
                }
                _ if on_edge => return,
                Event::Stop(stop) => -0.5 * value / half_gradient.dot(&stop) * stop,
                Event::Width => to_edge,
            };
            self.here += shift;
            self.look = self.cut.follow(&self.here, &shift);
        }
    }
}
