//! The planes of a particle as lines of the section, loaded as the boundary comes near them.

use super::numbers::{FIRST_LOADED, ROUNDING};
use super::plane_section::{Failure, PlaneSection};
use nalgebra::Vector2;

/// A plane of the particle in the section: at_origin + rate·y = 0, y from the contact point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    /// n·x − d at the contact point.
    pub at_origin: f64,
    /// Its gradient in the section.
    pub rate: Vector2<f64>,
    /// n·x − d at the current point, and its change since the contact point.
    pub excess: f64,
    pub change: f64,
    /// The length whose rounding both carry.
    pub length: f64,
    /// Whether it is active on the edge curve from the current point on.
    pub active: bool,
    /// The next of those that may be active at the current point.
    pub next: Option<u32>,
}

impl Line {
    /// The excess at the current point; 0 if it is nothing but rounding.
    #[inline]
    pub fn significant_excess(&self) -> f64 {
        if self.excess.abs() <= ROUNDING * self.rounding() { 0.0 } else { self.excess }
    }

    /// Whether the excess at the current point is positive or nothing but rounding.
    #[inline]
    pub fn may_be_active(&self) -> bool {
        self.excess >= -ROUNDING * self.rounding()
    }

    /// Rounding of the excess, in units of ε.
    #[inline]
    pub fn rounding(&self) -> f64 {
        self.length * (self.rate.x.abs() + self.rate.y.abs())
    }

    /// Moves to a point at this distance from the contact point.
    #[inline]
    pub fn move_to(&mut self, y: &Vector2<f64>, distance: f64) {
        self.length = distance;
        self.change = self.rate.dot(y);
        self.excess = self.at_origin + self.change;
    }

    /// Moves to the point y by a step from the current point.
    ///
    /// The excess of a line that passed close to the current point is more precise as a sum with the step than from y:
    /// a corner may be sharper than the rounding of y.
    #[inline]
    pub fn move_by(&mut self, y: &Vector2<f64>, distance: f64, step: &Vector2<f64>, step_length: f64) {
        let length = self.length + step_length;
        if length < distance {
            let change = self.rate.dot(step);
            self.length = length;
            self.change += change;
            self.excess += change;
        } else {
            self.move_to(y, distance);
        }
    }
}

/// The lines within a distance of the contact point, in a buffer of the caller.
#[derive(Debug)]
pub(super) struct Lines<'s> {
    section: &'s PlaneSection<'s>,
    buffer: &'s mut [Line],
    used: usize,
    /// First of the lines that may be active at the current point: usually a few of many.
    first_near: Option<u32>,
    /// Distance from the contact point within which all lines are loaded.
    loaded: f64,
    /// The disc in which the bounding ball meets the plane: centre and squared radius.
    centre: Vector2<f64>,
    square: f64,
    /// Radius about the contact point of a disc that holds the cross-section.
    radius: f64,
}

impl<'s> Lines<'s> {
    /// The lines that pass closest; all of them if the planes form a single cluster.
    pub fn new(section: &'s PlaneSection, buffer: &'s mut [Line]) -> Result<Self, Failure> {
        let PlaneSection { shape, point, axes, .. } = section;
        let centre = -Vector2::new(point.dot(&axes[0]), point.dot(&axes[1]));
        let ball = shape.bounds.radius;
        let square = ball * ball - point.norm_squared() + centre.norm_squared();
        let radius = square.max(0.0).sqrt() + centre.norm();
        let mut lines = Self { section, buffer, used: 0, first_near: None, loaded: -1.0, centre, square, radius };
        if !shape.is_sphere() {
            lines.load(if shape.clusters.is_single() { radius } else { FIRST_LOADED * radius })?;
        }
        Ok(lines)
    }

    pub fn as_slice(&self) -> &[Line] {
        &self.buffer[..self.used]
    }

    pub fn at(&mut self, i: u32) -> &mut Line {
        &mut self.buffer[i as usize]
    }

    /// First of the linked list of lines that may be active at the current point.
    pub fn first_near(&self) -> Option<u32> {
        self.first_near
    }

    /// Adds a line to that list.
    pub fn add_near(&mut self, i: u32) {
        self.buffer[i as usize].next = self.first_near.replace(i);
    }

    /// Moves every line to a new point by `to_point`, lists those that may be active there, and calls `each`.
    #[inline(always)]
    pub fn move_all(&mut self, to_point: impl Fn(&mut Line), mut each: impl FnMut(&Line)) {
        self.first_near = None;
        for (i, line) in self.buffer[..self.used].iter_mut().enumerate() {
            to_point(line);
            line.active = line.excess > 0.0;
            if line.may_be_active() {
                line.next = self.first_near.replace(i as u32);
            }
            each(line);
        }
    }

    /// Distance from the contact point within which no line is missing.
    pub fn loaded(&self) -> f64 {
        if self.is_complete() { f64::INFINITY } else { self.loaded }
    }

    fn is_complete(&self) -> bool {
        self.loaded >= self.radius || self.section.shape.is_sphere()
    }

    /// Radius about the contact point of a disc that holds the cross-section.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Loads the lines up to a distance, but at most twice as far as before. The new lines move to y, a point within
    /// the distance loaded before.
    pub fn load_towards(&mut self, distance: f64, y: &Vector2<f64>) -> Result<(), Failure> {
        let known = self.used;
        self.load(distance.min(2.0 * self.loaded).min(self.radius))?;
        let from_origin = y.norm();
        for line in &mut self.buffer[known..self.used] {
            line.move_to(y, from_origin);
        }
        Ok(())
    }

    fn load(&mut self, distance: f64) -> Result<(), Failure> {
        let PlaneSection { shape, point, axes, .. } = self.section;
        let (old, new) = (self.loaded * self.loaded, distance * distance);
        let is_first = self.loaded < 0.0;
        // No excess changes by more over the distance.
        let early = distance * shape.bounds.longest_normal * (1.0 + ROUNDING);
        let mut used = self.used;
        shape.visit_near(point, early, |_, normal, excess| {
            if excess < -early {
                return;
            }
            let rate = Vector2::new(normal.dot(&axes[0]), normal.dot(&axes[1]));
            let steep = rate.norm_squared();
            let within = |square: f64| excess >= 0.0 || steep * square >= excess * excess;
            if !within(new) || !is_first && within(old) {
                return;
            }
            // Lines that do not meet the disc are never active.
            let central = excess + rate.dot(&self.centre);
            if excess > 0.0 || central > 0.0 || steep * self.square >= central * central {
                if let Some(free) = self.buffer.get_mut(used) {
                    *free = Line { at_origin: excess, rate, ..Line::default() };
                }
                used += 1;
            }
        });
        if used > self.buffer.len() {
            return Err(Failure::BufferFull);
        }
        (self.used, self.loaded) = (used, distance);
        Ok(())
    }
}
