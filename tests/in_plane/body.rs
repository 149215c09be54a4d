//! A polygon by its numbers, and contacts found by searches that know nothing of the solver.

use nalgebra::Vector3;
use potential_particles::{BackEnd, Contact, Formulation, Particle, Pose, Settings, detect};
use std::f64::consts::TAU;

/// A particle by its numbers, where it is, and S as eq. (1) has it.
#[derive(Clone, Debug)]
pub struct Body {
    pub lines: Vec<[f64; 3]>,
    pub r: f64,
    pub k: f64,
    pub shadow_radius: f64,
    pub position: [f64; 2],
    pub angle: f64,
}

impl Body {
    /// A square with sides near `half`, at the origin.
    pub fn square(half: f64, r: f64, k: f64) -> Self {
        let d = half - r;
        let lines = vec![[1.0, 0.0, d], [0.0, 1.0, d], [-1.0, 0.0, d], [0.0, -1.0, d]];
        Self { lines, r, k, shadow_radius: 1.6 * half, position: [0.0; 2], angle: 0.0 }
    }

    pub fn at(self, position: [f64; 2], angle: f64) -> Self {
        Self { position, angle, ..self }
    }

    pub fn centre(&self) -> Vector3<f64> {
        Vector3::new(self.position[0], self.position[1], 0.0)
    }

    pub fn moved(&self, by: Vector3<f64>) -> Self {
        self.clone().at([self.position[0] + by.x, self.position[1] + by.y], self.angle)
    }

    pub fn particle(&self) -> Particle {
        Particle::in_plane(&self.lines, self.r, self.k, self.shadow_radius).expect("a valid polygon")
    }

    pub fn pose(&self) -> Pose {
        Pose::in_plane(self.position, self.angle).expect("a valid pose")
    }

    pub fn s(&self, point: &Vector3<f64>) -> f64 {
        let (sin, cos) = self.angle.sin_cos();
        let (dx, dy) = (point.x - self.position[0], point.y - self.position[1]);
        let (x, y) = (cos * dx + sin * dy, cos * dy - sin * dx);
        let squares: f64 = self.lines.iter().map(|[a, b, d]| (a * x + b * y - d).max(0.0).powi(2)).sum();
        let lines = if self.k < 1.0 { (1.0 - self.k) / self.r.powi(2) * squares } else { 0.0 };
        let circle = if self.k > 0.0 { self.k / self.shadow_radius.powi(2) * (x * x + y * y) } else { 0.0 };
        (lines + circle).sqrt()
    }

    /// How much rounding of a point moves s: a few units in its last place times the steepness.
    pub fn noise(&self) -> f64 {
        let size = self.position.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        16.0 * f64::EPSILON * size * (1.0 / self.r + 1.0 / self.shadow_radius)
    }
}

pub fn circle(radius: f64) -> Particle {
    Particle::in_plane(&[], 0.0, 1.0, radius).expect("a circle")
}

/// A rectangle about the origin, of these half edges.
pub fn rectangle(x: f64, y: f64, r: f64, k: f64) -> Particle {
    Particle::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]], r, k).expect("a rectangle")
}

/// Solves to the end, whatever the kind.
pub fn solve(a: &Body, b: &Body, formulation: Formulation, back_end: BackEnd) -> Contact {
    let settings = Settings::default().with_formulation(formulation).with_back_end(back_end).with_solve_separated(true);
    detect(&a.particle(), &a.pose(), &b.particle(), &b.pose(), &settings, None).expect("an answer")
}

pub fn midway(a: &Body, b: &Body) -> Contact {
    solve(a, b, Formulation::Midway, BackEnd::Fast)
}

/// Minimum of a convex function on an interval, to the last digit that its values tell.
pub fn least(mut low: f64, mut high: f64, f: &dyn Fn(f64) -> f64) -> (f64, f64) {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let at = |x: f64| (x, f(x));
    let (mut left, mut right) = (at(high - golden * (high - low)), at(low + golden * (high - low)));
    for _ in 0..80 {
        if left.1 <= right.1 {
            (high, right) = (right.0, left);
            left = at(high - golden * (high - low));
        } else {
            (low, left) = (left.0, right);
            right = at(low + golden * (high - low));
        }
    }
    if left.1 <= right.1 { left } else { right }
}

/// Least common scale of a pair, by nested search.
pub fn searched_midway(a: &Body, b: &Body) -> f64 {
    let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let scale = |x: f64, y: f64| a.s(&at(x, y)).max(b.s(&at(x, y)));
    let ends =
        |axis: usize| (a.position[axis].min(b.position[axis]) - 1.0, a.position[axis].max(b.position[axis]) + 1.0);
    let ((west, east), (south, north)) = (ends(0), ends(1));
    least(west, east, &|x| least(south, north, &|y| scale(x, y)).1).1
}

/// Least s of `free` on the boundary of `held`, by a search along that boundary.
pub fn searched_closest(free: &Body, held: &Body) -> f64 {
    let on_boundary = |angle: f64| {
        let direction = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let (mut inside, mut outside) = (0.0, 4.0);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if held.s(&(held.centre() + middle * direction)) < 1.0 { inside = middle } else { outside = middle }
        }
        free.s(&(held.centre() + inside * direction))
    };
    let step = TAU / 2000.0;
    let best =
        (0..2000).map(|i| f64::from(i) * step).min_by(|x, y| on_boundary(*x).total_cmp(&on_boundary(*y))).unwrap();
    least(best - step, best + step, &on_boundary).1
}
