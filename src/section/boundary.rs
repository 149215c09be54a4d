//! The boundary of one cross-section: arc by arc, counter-clockwise, once around.
//!
//! A predictor–corrector method: an arc of the current conic leads to where the next line becomes active or inactive,
//! and Newton steps correct its end to S = 1.

use super::arc::Arc;
use super::cross_section::{CrossSection, Evaluation};
use super::edge_curve::{EdgeCurve, quarter_turn};
use super::numbers::{Limits, MISS, TANGENT};
use super::plane_section::Failure;
use nalgebra::Vector2;
use std::f64::consts::FRAC_1_SQRT_2;

/// Rays at which every arc is divided, so that none spans half a turn. The boundary begins at the last one. Points on
/// one of them are multiples of each other without rounding.
const RAYS: [Vector2<f64>; 3] =
    [Vector2::new(0.0, 1.0), Vector2::new(-FRAC_1_SQRT_2, -FRAC_1_SQRT_2), Vector2::new(1.0, 0.0)];

/// Tangent of half the widest angle of an arc on its circle: √3, 120°.
const WIDEST: f64 = 1.7320508075688772;

/// The boundary of a cross-section, traced as far as the current point.
#[derive(Debug)]
pub(super) struct Boundary<'s> {
    cross_section: CrossSection<'s>,
    /// The conic of the last arc.
    pub curve: EdgeCurve,
    start: Vector2<f64>,
    point: Vector2<f64>,
    here: Evaluation,
    /// The line that becomes active or inactive at the current point.
    switching: Option<u32>,
    /// Estimated rounding of S at the current point, with that of the last arc, in units of ε.
    rounding: f64,
    /// Rounding of S at the beginning of the last arc, and what S missed 1 by at its end before that was corrected.
    missed: [f64; 2],
    /// Number of rays passed.
    rays: usize,
    /// Number of arcs so far.
    arcs: usize,
}

/// What ends an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// A line becomes active or inactive.
    Line(u32),
    /// One of [`RAYS`], by its direction.
    Ray(Vector2<f64>),
    /// The widest angle.
    Width,
}

impl<'s> Boundary<'s> {
    /// Fails when the boundary is not found along the first ray.
    pub fn new(mut cross_section: CrossSection<'s>) -> Result<Self, Failure> {
        let first = RAYS[RAYS.len() - 1];
        let point = cross_section.ray(&first)? * first;
        let here = cross_section.at(&point);
        let curve = cross_section.edge_curve(&point, &here, None);
        let mut boundary = Self {
            cross_section,
            curve,
            start: point,
            point,
            here,
            switching: None,
            rounding: here.rounding,
            missed: [0.0; 2],
            rays: 0,
            arcs: 0,
        };
        boundary.correct(Event::Ray(first));
        boundary.start = boundary.point;
        Ok(boundary)
    }

    /// Whether the last arc was the last one.
    pub fn is_complete(&self) -> bool {
        self.rays == RAYS.len()
    }

    /// Whether it is complete and ends where it began, to rounding.
    pub fn is_closed(&self) -> bool {
        let gap = 2.0 * self.here.half_gradient.dot(&(self.point - self.start));
        self.is_complete() && gap.abs() <= MISS * f64::EPSILON * self.rounding
    }

    /// Estimated bound on the distance of the last arc from S = 1, length: that of its ends.
    pub fn deviation(&self) -> f64 {
        let [before, missed] = self.missed;
        let of_end = missed + f64::EPSILON * self.here.rounding;
        0.5 * (before / self.curve.half_gradient.norm()).max(of_end / self.here.half_gradient.norm())
    }

    /// The next arc. Fails when there is none, and when S ≠ 1 at its end by more than rounding, which is the check that
    /// the active set was right.
    pub fn next_arc(&mut self) -> Result<Arc, Failure> {
        let ray = RAYS.get(self.rays).ok_or(Failure::Inaccurate)?;
        self.arcs += 1;
        // A line meets a convex curve at most twice; rounding may divide as many arcs again.
        if self.arcs > 4 * self.cross_section.lines.as_slice().len() + 8 * RAYS.len() {
            return Err(Failure::Inaccurate);
        }
        self.curve = self.cross_section.edge_curve(&self.point, &self.here, self.switching);
        let (tau, event, mut arc, mut step) = self.first_event(ray)?;
        if let Event::Ray(ray) = event {
            let on_ray = arc.to.dot(&ray) * ray;
            step += on_ray - arc.to;
            arc.to = on_ray;
            self.rays += 1;
        }
        self.switching = if let Event::Line(i) = event { Some(i) } else { None };
        self.point = arc.to;
        let before = self.here.distance;
        let rounding_before = f64::EPSILON * self.here.rounding;
        self.here = self.cross_section.after_step(&self.point, &step);
        self.missed = [rounding_before, self.here.value.abs()];
        let length = before + self.here.distance;
        self.rounding = self.here.rounding + self.curve.rounding(tau, &arc, &self.here.half_gradient, length);
        if !(self.here.value.abs() <= MISS * f64::EPSILON * self.rounding) {
            return Err(Failure::Inaccurate);
        }
        self.correct(event);
        // The pole moves by half as much as the end.
        arc.pole += 0.5 * (self.point - arc.to);
        arc.to = self.point;
        Ok(arc)
    }

    /// Parameter and kind of the first event on the conic, the arc that leads there and the step from its beginning to
    /// its end.
    fn first_event(&mut self, ray: &Vector2<f64>) -> Result<(f64, Event, Arc, Vector2<f64>), Failure> {
        let curve = &self.curve;
        let (determinant, twice_inwards) = (curve.determinant(), 2.0 * curve.inwards());
        // The least parameter below `limit` at which an excess that is ≥ 0 at the base turns negative. On the conic it
        // is (excess + 2bτ + aτ²)/(1 + τ²·det M).
        let crossing = |excess: f64, rate: &Vector2<f64>, limit: f64| {
            let b = curve.half_gradient.perp(rate);
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
        // A ray lies on a line through the origin with the current point on its positive side.
        if let Some(earlier) = crossing(self.point.perp(ray).max(0.0), &-quarter_turn(ray), tau) {
            (tau, event) = (earlier, Event::Ray(*ray));
        }
        let mut known = 0;
        loop {
            for (i, line) in self.cross_section.lines.as_slice()[known..].iter().enumerate() {
                let sign = if line.active { 1.0 } else { -1.0 };
                if let Some(earlier) = crossing((sign * line.excess).max(0.0), &(sign * line.rate), tau) {
                    (tau, event) = (earlier, Event::Line((known + i) as u32));
                }
            }
            let loaded = self.cross_section.lines.loaded();
            let (arc, step) = curve.arc(tau);
            if loaded == f64::INFINITY {
                return Ok((tau, event, arc, step));
            }
            let farthest = arc.pole.norm_squared().max(arc.to.norm_squared()).sqrt();
            if !(farthest > loaded) {
                return Ok((tau, event, arc, step));
            }
            known = self.cross_section.lines.as_slice().len();
            self.cross_section.lines.load_towards(farthest, &self.point)?;
        }
    }

    /// Moves the current point to where S = 1 and the line of the event has no excess, both to rounding: the next arc
    /// would inherit the error.
    fn correct(&mut self, event: Event) {
        for _ in 0..Limits::CORRECTIONS {
            let Evaluation { value, half_gradient, .. } = self.here;
            let on_boundary = self.here.on_boundary();
            let to_boundary = -0.5 * value / half_gradient.norm_squared() * half_gradient;
            let shift = match event {
                Event::Line(i) => {
                    let line = self.cross_section.lines.at(i);
                    let (excess, rate) = (line.significant_excess(), line.rate);
                    if on_boundary && excess == 0.0 {
                        return;
                    }
                    let turn = half_gradient.perp(&rate);
                    if turn.abs() > TANGENT * half_gradient.norm() * rate.norm() {
                        (0.5 * value * quarter_turn(&rate) - excess * quarter_turn(&half_gradient)) / turn
                    } else {
                        to_boundary
                    }
                }
                _ if on_boundary => return,
                Event::Ray(ray) => -0.5 * value / half_gradient.dot(&ray) * ray,
                Event::Width => to_boundary,
            };
            self.point += shift;
            self.here = self.cross_section.after_step(&self.point, &shift);
        }
    }
}
