//! The planes of a particle as lines of the section, brought in as the walk gets near them.

use super::Side;
use nalgebra::Vector2;

/// A plane of the particle in the section: excess + rate·y = 0.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    /// n·x − d at the contact point.
    pub excess: f64,
    /// Change of it with y.
    pub rate: Vector2<f64>,
    /// n·x − d at the point looked at last, and its change since the contact point.
    pub here: f64,
    pub change: f64,
    /// The length whose rounding both carry.
    pub doubt: f64,
    /// Whether it counts on the conic from there on.
    pub on: bool,
    /// The next of those that reach the point looked at last.
    pub next: Option<u32>,
}

/// Multiple of the rounding of a sum below which its sign means nothing.
pub(super) const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Line {
    /// The excess at the point looked at last; 0 if it is nothing but rounding.
    #[inline]
    pub fn offset(&self) -> f64 {
        if self.here.abs() <= ROUNDING * self.noise() { 0.0 } else { self.here }
    }

    /// Whether the excess at the point looked at last is positive, or nothing but rounding.
    #[inline]
    pub fn reaches(&self) -> bool {
        self.here >= -ROUNDING * self.noise()
    }

    /// Rounding of the excess, in units of ε.
    #[inline]
    pub fn noise(&self) -> f64 {
        self.doubt * (self.rate.x.abs() + self.rate.y.abs())
    }

    /// A look at a point, by the way from the contact point.
    #[inline]
    pub fn look(&mut self, y: &Vector2<f64>, far: f64) {
        self.doubt = far;
        self.change = self.rate.dot(y);
        self.here = self.excess + self.change;
    }

    /// A look at a point y that lies a step behind the one before it.
    ///
    /// A line that passed close to that one is known better by going on from there than from y: a corner may be
    /// sharper than the rounding of y.
    #[inline]
    pub fn follow(&mut self, y: &Vector2<f64>, far: f64, step: &Vector2<f64>, near: f64) {
        let doubt = self.doubt + near;
        if doubt < far {
            let change = self.rate.dot(step);
            self.doubt = doubt;
            self.change += change;
            self.here += change;
        } else {
            self.look(y, far);
        }
    }
}

/// The lines that pass the contact point within a distance, the horizon.
#[derive(Debug)]
pub(super) struct Lines<'s> {
    side: &'s Side<'s>,
    room: &'s mut [Line],
    used: usize,
    /// First of the lines that reach the point looked at last, up to rounding: mostly a few of many.
    reaching: Option<u32>,
    horizon: f64,
    /// The disc around the particle's centre in which its ball cuts the plane: centre and squared radius.
    centre: Vector2<f64>,
    square: f64,
    /// Horizon that holds the whole cut.
    reach: f64,
}

/// There are more lines than there is room for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crowded;

/// First horizon, as a part of the last one.
const FIRST: f64 = 0.125;

impl<'s> Lines<'s> {
    /// The lines that pass closest; all of few planes.
    pub fn new(side: &'s Side, room: &'s mut [Line]) -> Result<Self, Crowded> {
        let Side { particle, point, axes, .. } = side;
        let centre = -Vector2::new(point.dot(&axes[0]), point.dot(&axes[1]));
        let radius = particle.bounding_radius();
        let square = radius * radius - point.norm_squared() + centre.norm_squared();
        let reach = square.max(0.0).sqrt() + centre.norm();
        let mut lines = Self { side, room, used: 0, reaching: None, horizon: -1.0, centre, square, reach };
        if !particle.is_sphere() {
            // To judge few planes costs more than to keep them.
            lines.widen(if particle.clusters.is_single() { reach } else { FIRST * reach })?;
        }
        Ok(lines)
    }

    pub fn as_slice(&self) -> &[Line] {
        &self.room[..self.used]
    }

    pub fn at(&mut self, i: u32) -> &mut Line {
        &mut self.room[i as usize]
    }

    /// First of the lines that reach the point looked at last; each knows the next one.
    pub fn reaching(&self) -> Option<u32> {
        self.reaching
    }

    /// Adds a line to those.
    pub fn reach_by(&mut self, i: u32) {
        self.room[i as usize].next = self.reaching.replace(i);
    }

    /// Calls `each` with every line after `look` has looked at the new point, and keeps in mind those that reach it.
    #[inline(always)]
    pub fn look(&mut self, look: impl Fn(&mut Line), mut each: impl FnMut(&Line)) {
        self.reaching = None;
        for (i, line) in self.room[..self.used].iter_mut().enumerate() {
            look(line);
            line.on = line.here > 0.0;
            if line.reaches() {
                line.next = self.reaching.replace(i as u32);
            }
            each(line);
        }
    }

    /// Distance within which no line is missing.
    pub fn horizon(&self) -> f64 {
        if self.is_whole() { f64::INFINITY } else { self.horizon }
    }

    fn is_whole(&self) -> bool {
        self.horizon >= self.reach || self.side.particle.is_sphere()
    }

    /// Radius about the contact point of a disc that holds the cut.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Widens the horizon towards a distance, twofold at most; the lines that it brings in are looked at from a point
    /// inside the old one.
    pub fn widen_towards(&mut self, distance: f64, y: &Vector2<f64>) -> Result<(), Crowded> {
        let known = self.used;
        self.widen(distance.min(2.0 * self.horizon).min(self.reach))?;
        let far = y.norm();
        for line in &mut self.room[known..self.used] {
            line.look(y, far);
        }
        Ok(())
    }

    fn widen(&mut self, horizon: f64) -> Result<(), Crowded> {
        let Side { particle, point, axes, .. } = self.side;
        let (old, new) = (self.horizon * self.horizon, horizon * horizon);
        let is_first = self.horizon < 0.0;
        // No excess grows by more on the way there; most planes end here.
        let early = horizon * particle.bounds.longest_normal * (1.0 + ROUNDING);
        let mut used = self.used;
        particle.visit_near(point, early, |_, normal, excess| {
            if excess < -early {
                return;
            }
            let rate = Vector2::new(normal.dot(&axes[0]), normal.dot(&axes[1]));
            let steep = rate.norm_squared();
            let within = |square: f64| excess >= 0.0 || steep * square >= excess * excess;
            if !within(new) || !is_first && within(old) {
                return;
            }
            let central = excess + rate.dot(&self.centre);
            if excess > 0.0 || central > 0.0 || steep * self.square >= central * central {
                if let Some(free) = self.room.get_mut(used) {
                    *free = Line { excess, rate, ..Line::default() };
                }
                used += 1;
            }
        });
        if used > self.room.len() {
            return Err(Crowded);
        }
        (self.used, self.horizon) = (used, horizon);
        Ok(())
    }
}
