//! The integral over a patch: a fan of rays, cut into sectors on which the sequence of cells does not change, refined
//! where the estimated error is largest.

use super::numbers::{
    EVENTS_MEET, ErrorBudget, Fitted, JUMP, Limits, STEEPEST_LOAD, STRAIGHT_BORDER, TIP, WIDEST_SECTOR,
};
use super::ray::{EVENTS, Event, Line, RIM, Ray, SUMS, Walker};
use super::rules::GAUSS_KRONROD;
use super::smoothness::{error_of_rule, norm};

/// A sector between two rays of the same sequence of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sector {
    left: usize,
    right: usize,
    /// Its rays of quadrature, with the angle that each stands for.
    pub rays: [(usize, f64); 7],
    pub count: usize,
    pub value: [f64; SUMS],
    /// Estimated errors of force, torque about the centre of the fan, area and energy.
    error: [f64; 4],
    /// The ray whose sequence of cells the sector has, but for a negligible piece at one end; `None` where the whole is
    /// negligible.
    like: Option<usize>,
}

/// Integrals over the patch, with estimated errors of force, torque about the centre of the fan, area and energy.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Integral {
    pub sums: [f64; SUMS],
    pub error: [f64; 4],
    /// Part of the error of the force from the rules along the rays.
    pub radial: f64,
}

/// A fan of rays in the making.
pub(super) struct Fan<'w, 'f, 'a, 's> {
    pub walker: Walker<'f, 'a, 's>,
    pub rays: &'w mut Vec<Ray>,
    pub sectors: &'w mut Vec<Sector>,
    pub stack: &'w mut Vec<(usize, usize, u32)>,
    /// A point of the patch from which the rays start.
    pub centre: [f64; 3],
    pub tolerance: f64,
    /// ∫ p below which a piece of the patch does not count.
    negligible: f64,
    /// The longest ray.
    pub extent: f64,
    /// The ray at which a sector was halved: no sector is to grow over it.
    cut: usize,
    /// Whether the most rays, points or planes were used.
    pub is_capped: bool,
    /// Whether the loads of two neighbouring rays, one of them tilted, differ too much for the angle between them: a
    /// part of the patch lies between that no ray reaches, as the far side of a rod that goes through the other body.
    pub has_jump: bool,
}

impl<'w, 'f, 'a, 's> Fan<'w, 'f, 'a, 's> {
    pub fn new(
        walker: Walker<'f, 'a, 's>,
        rays: &'w mut Vec<Ray>,
        sectors: &'w mut Vec<Sector>,
        stack: &'w mut Vec<(usize, usize, u32)>,
        centre: [f64; 3],
        tolerance: f64,
    ) -> Self {
        Self {
            walker,
            rays,
            sectors,
            stack,
            centre,
            tolerance,
            negligible: 0.0,
            extent: 0.0,
            cut: usize::MAX,
            is_capped: false,
            has_jump: false,
        }
    }

    /// Integrates with first rays along an axis and across it; `rough`: ∫ p over the four of them, as far as that is
    /// known.
    pub fn integrate(&mut self, axis: [f64; 2], rough: f64) -> Integral {
        self.rays.clear();
        self.sectors.clear();
        self.walker.nodes.clear();
        (self.extent, self.is_capped, self.has_jump) = (0.0, false, false);
        let [e, f] = axis;
        let budget = ErrorBudget::MINOR * self.tolerance * 0.25 * rough;
        self.walker.budget = if budget > 0.0 { budget } else { f64::INFINITY };
        let first = [[e, f], [-f, e], [-e, -f], [f, -e]].map(|direction| self.cast(direction));
        self.negligible = ErrorBudget::NEGLIGIBLE * self.tolerance * rough * std::f64::consts::FRAC_PI_2;
        for i in 0..4 {
            self.resolve(first[i], first[(i + 1) % 4]);
        }
        let mut next = 0;
        loop {
            // Sectors that are cut again are appended.
            while let Some(sector) = self.sectors.get(next) {
                // One that is cut leaves its place to another.
                if sector.count > 0 || self.evaluate(next, self.first_count(next)) {
                    next += 1;
                }
            }
            next = 0;
            let integral = self.total();
            let (worst, error) = self.worst(&integral);
            if error <= ErrorBudget::MAIN * self.tolerance || self.is_capped {
                return integral;
            }
            if self.sectors[worst].count < 7 {
                let count = if self.sectors[worst].count == 1 { 3 } else { 7 };
                self.evaluate(worst, count);
            } else {
                let Sector { left, right, rays, .. } = self.sectors[worst];
                self.sectors.swap_remove(worst);
                let middle = rays[0].0;
                self.cut = middle;
                self.negligible = self.negligible.min(0.1 * error * norm(&integral.sums[..3]));
                self.resolve(left, middle);
                self.resolve(middle, right);
            }
        }
    }

    /// The sum over all sectors.
    fn total(&self) -> Integral {
        let mut integral = Integral::default();
        for sector in self.sectors.iter() {
            for (sum, value) in integral.sums.iter_mut().zip(&sector.value) {
                *sum += value;
            }
            for (sum, error) in integral.error.iter_mut().zip(&sector.error) {
                *sum += error;
            }
            integral.radial +=
                sector.rays[..sector.count].iter().map(|(ray, w)| w * self.rays[*ray].error).sum::<f64>();
        }
        integral
    }

    /// The sector with the largest error, and the relative error of the whole.
    fn worst(&self, integral: &Integral) -> (usize, f64) {
        let force = norm(&integral.sums[..3]);
        let torque = force * self.extent;
        let energy = if self.walker.with_energy { integral.sums[7] } else { f64::INFINITY };
        let relative = |error: &[f64; 4]| (error[0] / force).max(error[1] / torque).max(error[3] / energy);
        let mut worst = (0, -1.0);
        for (i, sector) in self.sectors.iter().enumerate() {
            let error = relative(&sector.error);
            if error > worst.1 {
                worst = (i, error);
            }
        }
        let error = relative(&integral.error);
        (worst.0, if error.is_finite() { error } else { 0.0 })
    }

    fn line(&self, direction: [f64; 2]) -> Line {
        Line { origin: self.centre, direction, is_polar: true }
    }

    /// Walks over a ray and keeps it.
    fn cast(&mut self, direction: [f64; 2]) -> usize {
        let ray = self.walker.walk(&self.line(direction));
        self.extent = self.extent.max(ray.length());
        self.rays.push(ray);
        let used_up = self.walker.nodes.len() >= Limits::NODES || self.walker.work >= Limits::WORK;
        if self.rays.len() >= Limits::RAYS || used_up {
            // The remaining rays are done as cheaply as possible.
            (self.is_capped, self.walker.budget) = (true, f64::INFINITY);
        }
        self.rays.len() - 1
    }

    fn push(&mut self, left: usize, right: usize, like: Option<usize>) {
        self.sectors.push(Sector {
            left,
            right,
            rays: [(0, 0.0); 7],
            count: 0,
            value: [0.0; SUMS],
            error: [0.0; 4],
            like,
        });
    }

    /// Adds a sector, to the last one if it goes on with the same cells.
    fn emit(&mut self, left: usize, right: usize, like: Option<usize>) {
        if let Some(before) =
            self.sectors.last().copied().filter(|before| before.count == 0 && before.right == left && left != self.cut)
        {
            let whole = angle(&self.rays[before.left].direction, &self.rays[right].direction);
            let alike = [left, right].iter().all(|ray| self.rays[before.left].is_like(&self.rays[*ray]));
            if alike && whole > 0.0 && whole < WIDEST_SECTOR {
                let end = self.sectors.len() - 1;
                self.sectors[end].right = right;
                return;
            }
        }
        self.push(left, right, like);
    }

    /// Cuts what lies between two rays where the sequence of cells changes.
    fn resolve(&mut self, left: usize, right: usize) {
        self.stack.clear();
        self.stack.push((left, right, 0));
        while let Some((left, right, depth)) = self.stack.pop() {
            let (a, b) = (&self.rays[left], &self.rays[right]);
            if a.is_like(b) {
                self.emit(left, right, Some(left));
                continue;
            }
            let m = a.first_difference(b);
            let (Some(&at_a), Some(&at_b)) = (a.event(m), b.event(m)) else {
                self.emit(left, right, None);
                continue;
            };
            let width = angle(&a.direction, &b.direction);
            let effect = width * a.tail(m).max(b.tail(m));
            let is_last = Fitted::OTHER_SEQUENCE * effect <= self.negligible
                || depth >= Limits::BORDER_HALVINGS
                || self.is_capped;
            self.has_jump |= is_last && jumps(a, b, width);
            if is_last {
                self.emit(left, right, None);
                continue;
            }
            let share = self.change(left, right, m, &at_a, &at_b);
            if let Some(t) = share.filter(|t| Fitted::OTHER_SEQUENCE * effect * t.min(1.0 - t) <= self.negligible) {
                self.emit(left, right, Some(if t > 0.5 { left } else { right }));
                continue;
            }
            let t = share.unwrap_or(0.5);
            let ([e, f], [g, h]) = (self.rays[left].direction, self.rays[right].direction);
            let middle = self.cast(unit([e + t * (g - e), f + t * (h - f)]));
            let (from, to) = if share.is_some() { self.sides(middle, m, at_a.id, at_b.id) } else { (middle, middle) };
            self.stack.push((to, right, depth + 1));
            self.stack.push((left, from, depth + 1));
        }
    }

    /// The place between two rays, as a part of the chord, at which their first differing events swap their order;
    /// `None` if it is unknown.
    ///
    /// Inverse distances to straight borders are linear on the chord.
    fn change(&mut self, left: usize, right: usize, m: usize, at_a: &Event, at_b: &Event) -> Option<f64> {
        let (a, b) = (self.rays[left], self.rays[right]);
        let other_a = self.walker.inverse_distance(&self.line(a.direction), &a, m, at_b.id)?;
        let other_b = self.walker.inverse_distance(&self.line(b.direction), &b, m, at_a.id)?;
        let (first, last) = (1.0 / at_a.rho - other_a, 1.0 / at_b.rho - other_b);
        let t = first / (first + last);
        (first > 0.0 && last > 0.0 && t > 0.0 && t < 1.0).then_some(t)
    }

    /// The ray as the end of the sectors on its left and right: two rays if it meets two events at one place, of which
    /// `i` comes first on the left and `j` on the right; else twice itself.
    fn sides(&mut self, middle: usize, m: usize, i: u32, j: u32) -> (usize, usize) {
        let ray = self.rays[middle];
        let Some(&first) = ray.event(m) else { return (middle, middle) };
        let other = match first.id {
            id if id == i => j,
            id if id == j => i,
            _ => return (middle, middle),
        };
        let near = EVENTS_MEET * self.tolerance.sqrt() * first.rho;
        let mut swapped = ray;
        match ray.event(m + 1) {
            Some(&second) if second.id == other && second.rho - first.rho <= near => {
                swapped.events[m].id = other;
                if other == RIM {
                    swapped.count = m + 1;
                } else {
                    swapped.events[m + 1].id = first.id;
                }
            }
            None if first.id == RIM && m + 1 < EVENTS => {
                let inverse = self.walker.inverse_distance(&self.line(ray.direction), &ray, m, other);
                if !inverse.is_some_and(|inverse| 1.0 - first.rho * inverse <= near / first.rho) {
                    return (middle, middle);
                }
                swapped.events[m] = Event { id: other, ..first };
                swapped.events[m + 1] = first;
                swapped.count = m + 2;
            }
            _ => return (middle, middle),
        }
        self.rays.push(swapped);
        let swapped = self.rays.len() - 1;
        if first.id == i { (middle, swapped) } else { (swapped, middle) }
    }

    /// One ray for a sector that hardly counts, three for any other.
    fn first_count(&self, index: usize) -> usize {
        let Sector { left, right, .. } = self.sectors[index];
        let (a, b) = (&self.rays[left], &self.rays[right]);
        let load = angle(&a.direction, &b.direction).abs() * a.sums[2].max(b.sums[2]);
        if Fitted::OTHER_SEQUENCE * load <= self.negligible { 1 } else { 3 }
    }

    /// Integrates over a sector with 1, 3 or 7 rays; resolves it where one of them has another sequence of cells.
    ///
    /// The rays end on a conic about the centre, through the places where the rays at both ends and in the middle leave
    /// a cell: a straight edge and an ellipse about the centre then cost nothing, as on both equal areas belong to
    /// equal steps.
    ///
    /// Whether it is still there.
    fn evaluate(&mut self, index: usize, count: usize) -> bool {
        let Sector { left, right, like, .. } = self.sectors[index];
        let place = self.reference(left, right);
        let (mut from, mut to) = (self.reach(left, place), self.reach(right, place));
        (from, to) = (from.max(1e-3 * to), to.max(1e-3 * from));
        let scaled = |ray: &Ray, length: f64| ray.direction.map(|c| c * length);
        let (start, end) = (scaled(&self.rays[left], from), scaled(&self.rays[right], to));
        let cross = start[0] * end[1] - start[1] * end[0];
        if !(cross > 0.0) {
            // A sector without area.
            self.sectors[index].count = 1;
            return true;
        }
        let known = self.sectors[index];
        let half = [0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])];
        let middle = if known.count > 0 { known.rays[0].0 } else { self.cast(unit(half)) };
        let bulge = half[0].hypot(half[1]) / self.reach(middle, place);
        let theta = if bulge < 1.0 { 2.0 * bulge.max(0.3).acos() } else { 0.0 };
        let part = |t: f64| if theta > 1e-6 { (t * theta).sin() / theta.sin() } else { t };
        let constant = if theta > 1e-6 { cross * theta / theta.sin() } else { cross };
        let mut sums = [[0.0; SUMS]; 2];
        let is_straight = (bulge - 1.0).abs() < STRAIGHT_BORDER;
        let (mut loads, mut energies) = ([[0.0; 3]; 7], [[0.0; 3]; 7]);
        let mut rays = known.rays;
        for (i, (t, few, many)) in GAUSS_KRONROD[..count].iter().enumerate() {
            let (p, q) = (part(1.0 - t), part(*t));
            let at = [p * start[0] + q * end[0], p * start[1] + q * end[1]];
            let ray = match i {
                0 => middle,
                _ if i < known.count => known.rays[i].0,
                _ => self.cast(unit(at)),
            };
            let density = constant / (at[0] * at[0] + at[1] * at[1]);
            let weight = match count {
                1 => &1.0,
                3 => few,
                _ => many,
            };
            rays[i] = (ray, weight * density);
            let low = if count == 7 {
                *few
            } else if i == 0 {
                1.0
            } else {
                0.0
            };
            let load = if is_straight { self.rays[ray].curved } else { [0, 1, 2].map(|j| self.rays[ray].sums[j]) };
            loads[i] = load.map(|c| density * c);
            energies[i][0] = density * self.rays[ray].sums[7];
            for (j, value) in self.rays[ray].sums.iter().enumerate() {
                sums[0][j] += weight * density * value;
                sums[1][j] += low * density * value;
            }
        }
        let alike = |ray: &usize| like.is_none_or(|like| self.rays[*ray].is_like(&self.rays[like]));
        let odd = rays[..count].iter().map(|(ray, _)| *ray).find(|ray| !alike(ray));
        let sector = &mut self.sectors[index];
        let [value, low] = sums;
        let off: [f64; SUMS] = std::array::from_fn(|i| value[i] - low[i]);
        let size = norm(&value[..3]);
        let at_end = |ray: &Ray, end: &[f64; 2]| {
            let load = if is_straight { ray.curved } else { [0, 1, 2].map(|j| ray.sums[j]) };
            load.map(|c| c * constant / (end[0] * end[0] + end[1] * end[1]))
        };
        let ends = [at_end(&self.rays[left], &start), at_end(&self.rays[right], &end)];
        let smoothness = error_of_rule(&loads[..count], &ends);
        let energy_at =
            |ray: &Ray, end: &[f64; 2]| [ray.sums[7] * constant / (end[0] * end[0] + end[1] * end[1]), 0.0, 0.0];
        let ends = [energy_at(&self.rays[left], &start), energy_at(&self.rays[right], &end)];
        let of_energy = if self.walker.with_energy { error_of_rule(&energies[..count], &ends) } else { 0.0 };
        let estimate = |off: f64, size: f64| match count {
            _ if like.is_none() || odd.is_some() => off,
            1 => 0.0,
            3 if TIP * bulge < 1.0 => Fitted::TIP_ERROR * size,
            3 => off * (2.0 * off / size).powi(2).min(1.0),
            _ => off * (10.0 * off / size).min(1.0),
        };
        let by_force = estimate(norm(&off[..3]), size).max(smoothness);
        let by_torque = estimate(norm(&off[3..6]), size * self.extent).max(smoothness * from.max(to));
        *sector = Sector {
            rays,
            count,
            value,
            error: [
                by_force,
                by_torque,
                estimate(off[6].abs(), value[6]).max(smoothness / size * value[6]),
                estimate(off[7].abs(), value[7].abs()).max(of_energy),
            ],
            ..*sector
        };
        if let (Some(odd), false) = (odd, self.is_capped) {
            self.sectors.swap_remove(index);
            self.resolve(left, odd);
            self.resolve(odd, right);
            return false;
        }
        true
    }

    /// The event before which half of a sector's load lies: the border to which its rays are fitted.
    fn reference(&self, left: usize, right: usize) -> usize {
        let (a, b) = (&self.rays[left], &self.rays[right]);
        let half = |ray: &Ray| {
            (0..ray.count).find(|i| ray.events[*i].before >= 0.5 * ray.sums[2]).unwrap_or(ray.count.saturating_sub(1))
        };
        let place = half(a).max(half(b));
        if place < a.first_difference(b) { place } else { usize::MAX }
    }

    /// Distance to an event, or to the end.
    fn reach(&self, ray: usize, place: usize) -> f64 {
        let ray = &self.rays[ray];
        ray.event(place).map_or_else(|| ray.length(), |event| event.rho)
    }
}

/// Whether the loads of two tilted rays differ by far more than the angle between them explains.
fn jumps(a: &Ray, b: &Ray, width: f64) -> bool {
    let change = norm(&[0, 1, 2].map(|i| a.sums[i] - b.sums[i]));
    (a.is_tilted || b.is_tilted)
        && change > JUMP.max(STEEPEST_LOAD * width) * norm(&a.sums[..3]).max(norm(&b.sums[..3]))
}

fn unit([e, f]: [f64; 2]) -> [f64; 2] {
    let length = e.hypot(f);
    [e / length, f / length]
}

/// From a to b, counter-clockwise positive.
fn angle(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}
