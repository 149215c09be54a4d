//! A ray over the patch: an exact walk through the cells, with Gauss points in each.

use super::cell::{Cell, Quadratic, RayPlane};
use super::energy;
use super::field::{Field, Owner, dot};
use super::half_plane::{HalfPlane, Tilt};
use super::rules::gauss;

/// Events of a ray that are kept; of a longer one the last place holds the end.
pub(super) const EVENTS: usize = 12;

/// The end of a ray where s = 1, in place of the number of a plane.
pub(super) const RIM: u32 = u32::MAX;

/// Most cells on a ray.
const MOST_CELLS: usize = 400;

/// Shortest part of a cell that gets a rule of its own.
const SHORTEST: f64 = 1.0 / 256.0;

/// Incline beyond which a walk goes on with its axes turned, as it does where the patch turns back: over upright axes rules converge slowly there.
const STEEP: f64 = 3.0;

/// Incline at the start of a cell from which on they are turned at once; else after half of the bend.
const GENTLE: f64 = 0.1;

/// Part of the way to where the patch turns back from which on a rim counts as beyond: rounding places it on either side.
const NEAR_TURN: f64 = 0.999;

/// Least part of a normal along z that is told from 0.
const UPRIGHT: f64 = 1e-12;

/// A step back of this part of the size of the bodies is rounding.
const TINY: f64 = 1e-13;

/// Half of a straight line over the plane of the frame, from a point of the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub origin: [f64; 3],
    /// Unit vector.
    pub direction: [f64; 2],
    /// Whether lengths are weighted by the distance, as for an integral over an area in polar coordinates.
    pub is_polar: bool,
}

/// Where the way through a cell ends.
pub(super) struct CellEnd {
    pub h: f64,
    pub k: f64,
    /// Place of the plane that goes on or off, or of the edge that is met; `None` on the rim.
    pub next: Option<usize>,
    /// Whether the patch turns back there.
    pub is_folded: bool,
}

/// A point of quadrature on the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub x: [f64; 3],
    /// Of the area in the plane of the frame, per angle; below 0 where the patch has turned back under itself, so that sums of weight · normal are right there, too.
    pub weight: f64,
    /// 1 − s.
    pub pressure: f64,
    /// u and v of the normal whose z is 1: the normal times the area of the patch over that in the plane.
    pub normal: [f64; 2],
}

impl Node {
    /// Its share of the area of the patch, per angle.
    #[inline(always)]
    pub fn area(&self) -> f64 {
        let [n_u, n_v] = self.normal;
        self.weight.abs() * (1.0 + (n_u * n_u + n_v * n_v)).sqrt()
    }
}

/// Where a plane goes on or off, or the ray ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    /// Number of the plane, or [`RIM`].
    pub id: u32,
    /// Distance from the origin of the ray, and height above it; beyond a turn of the patch the way, and nothing of use.
    pub rho: f64,
    pub zeta: f64,
    /// Integral of the pressure up to here.
    pub before: f64,
}

/// Number of integrals of a ray.
pub(super) const SUMS: usize = 8;

/// What a ray found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub direction: [f64; 2],
    /// Its nodes.
    pub nodes: (u32, u32),
    /// ∫ p n, ∫ x × p n about the origin of the ray, ∫ |n|: force, torque and area per angle; and the energy, if asked for.
    pub sums: [f64; SUMS],
    /// ∫ p n over the cells that are not flat.
    pub curved: [f64; 3],
    /// Estimated error of ∫ p along the ray.
    pub error: f64,
    pub events: [Event; EVENTS],
    pub count: usize,
    /// Whether it was walked over with its axes turned: the patch turns back under itself, or is steep.
    pub is_tilted: bool,
    /// Whether it ended before the patch does.
    pub is_folded: bool,
}

impl Ray {
    pub fn event(&self, i: usize) -> Option<&Event> {
        self.events[..self.count].get(i)
    }

    /// Whether the same planes go on and off in the same order.
    pub fn is_like(&self, other: &Self) -> bool {
        self.count == other.count && self.first_difference(other) == self.count
    }

    /// Index of the first event that differs.
    pub fn first_difference(&self, other: &Self) -> usize {
        let both = self.count.min(other.count);
        (0..both).find(|i| self.events[*i].id != other.events[*i].id).unwrap_or(both)
    }

    /// From the origin to the end.
    pub fn length(&self) -> f64 {
        self.events[self.count.max(1) - 1].rho
    }

    /// ∫ p beyond event `i` − 1.
    pub fn tail(&self, i: usize) -> f64 {
        self.sums[2] - if i == 0 { 0.0 } else { self.event(i - 1).map_or(0.0, |event| event.before) }
    }

    fn push(&mut self, event: Event) {
        let place = self.count.min(EVENTS - 1);
        self.events[place] = event;
        self.count = place + 1;
    }
}

/// Walks over rays with the scratch that it needs.
pub(super) struct Walker<'f, 'a, 's> {
    pub field: &'f mut Field<'a, 's>,
    pub planes: &'f mut Vec<RayPlane>,
    pub nodes: &'f mut Vec<Node>,
    /// Gauss points in a cell that is not flat.
    pub order: usize,
    /// Whether the energy is integrated, too.
    pub with_energy: bool,
    /// Error of ∫ p n that one of its rules may make.
    pub budget: f64,
}

impl<'f, 'a, 's> Walker<'f, 'a, 's> {
    /// With one rule for each cell, and without the energy.
    pub fn new(
        field: &'f mut Field<'a, 's>,
        planes: &'f mut Vec<RayPlane>,
        nodes: &'f mut Vec<Node>,
        order: usize,
    ) -> Self {
        Self { field, planes, nodes, order, with_energy: false, budget: f64::INFINITY }
    }

    /// Walks over a ray to its end.
    pub fn walk(&mut self, line: &Line) -> Ray {
        let known = self.nodes.len();
        loop {
            match self.attempt(line) {
                Ok(ray) => return ray,
                Err(distance) => {
                    self.nodes.truncate(known);
                    self.field.load((2.0 * self.field.loaded()).max(distance));
                }
            }
        }
    }

    /// The same, unless it leaves the distance within which all planes are loaded: that distance.
    fn attempt(&mut self, line: &Line) -> Result<Ray, f64> {
        let start = self.nodes.len() as u32;
        let nowhere = Event { id: RIM, rho: 0.0, zeta: 0.0, before: 0.0 };
        let mut ray = Ray {
            direction: line.direction,
            nodes: (start, start),
            sums: [0.0; SUMS],
            curved: [0.0; 3],
            error: 0.0,
            events: [nowhere; EVENTS],
            count: 0,
            is_tilted: false,
            is_folded: false,
        };
        let mut half_plane = HalfPlane::upright(line.origin, line.direction);
        let mut tilt = Tilt::UPRIGHT;
        self.set_out(&half_plane);
        let (mut rho, mut zeta, mut way) = (0.0, 0.0, 0.0);
        for _ in 0..MOST_CELLS {
            let cell = self.cell(&half_plane, rho, zeta);
            if !(cell.s.v < 1.0) {
                ray.push(Event { id: RIM, rho: way, zeta, before: ray.sums[2] });
                break;
            }
            let CellEnd { mut h, mut k, mut next, is_folded: mut turns } = self.end_of(&cell);
            turns |= !cell.is_flat && self.field.b.is_some() && cell.incline(h, k).abs() > STEEP;
            if turns {
                ray.is_tilted = true;
                let incline = cell.incline(0.0, 0.0);
                if incline.abs() > GENTLE {
                    // With axes along the patch it goes on.
                    let (onwards, by) = tilt.onwards(incline);
                    (tilt, half_plane) = (onwards, half_plane.turned(by));
                    [rho, zeta] = [by[0] * rho + by[1] * zeta, by[0] * zeta - by[1] * rho];
                    self.turn(by);
                    continue;
                }
                (h, k) = cell.half_turned(h);
            }
            let axis = |h: f64, k: f64| tilt.upright(rho + h, zeta + k)[0];
            if !tilt.is_upright() && axis(h, k) < 0.0 {
                // The patch closes around a body.
                (h, k) = cell.zero_of(h, axis);
                (next, turns) = (None, false);
            }
            let end = half_plane.at(rho + h, zeta + k);
            let away = end[0].hypot(end[1]).hypot(end[2]);
            if away > self.field.loaded() {
                return Err(away);
            }
            if h > 0.0 {
                self.integrate(line, &tilt, &cell, (rho, zeta), h, &mut ray)?;
            }
            (rho, zeta, way) = (rho + h, zeta + k, way + h);
            if turns {
                if !(h > 0.0) {
                    break;
                }
                continue;
            }
            let id = next.map_or(RIM, |place| place as u32);
            ray.push(Event { id, rho: way, zeta, before: ray.sums[2] });
            match next {
                Some(place) if self.planes[place].owner != Owner::Edge => {
                    self.planes[place].active = !self.planes[place].active;
                }
                _ => break,
            }
        }
        if ray.event(ray.count.wrapping_sub(1)).is_none_or(|last| !self.ends_at(last)) {
            // Lost on the way.
            ray.is_folded = true;
            ray.push(Event { id: RIM, rho: way, zeta, before: ray.sums[2] });
        }
        ray.nodes.1 = self.nodes.len() as u32;
        Ok(ray)
    }

    /// Whether a ray may end with an event: on the rim or at an edge.
    fn ends_at(&self, event: &Event) -> bool {
        self.planes.get(event.id as usize).is_none_or(|plane| plane.owner == Owner::Edge)
    }

    /// Turns the axes of a walk in its half-plane.
    fn turn(&mut self, [c, s]: [f64; 2]) {
        for plane in self.planes.iter_mut() {
            [plane.along, plane.up] = [c * plane.along + s * plane.up, c * plane.up - s * plane.along];
        }
    }

    /// Where the way through a cell ends: at the nearest plane or edge, or on the rim.
    pub fn end_of(&self, cell: &Cell) -> CellEnd {
        let ((h, k), next) = self.next_crossing(cell, TINY * self.field.radius());
        // Beyond its turn the patch is no graph, and what is met there lies on another branch.
        let turn = cell.turn();
        if next.is_some() && h <= turn && cell.s.value(h, k) < 1.0 {
            return CellEnd { h, k, next, is_folded: false };
        }
        let (h, is_folded) = match cell.rim(h.min(turn), 0.1 * self.field.radius()) {
            Ok(rim) => (rim, rim >= NEAR_TURN * turn),
            Err(turn) => (turn, true),
        };
        CellEnd { h, k: cell.height(h).map_or(0.0, |(k, _)| k), next: None, is_folded }
    }

    /// The planes at the origin of a half-plane.
    pub fn set_out(&mut self, half_plane: &HalfPlane) {
        let HalfPlane { origin, along, across, up } = half_plane;
        self.planes.clear();
        self.planes.extend(self.field.planes.iter().map(|plane| {
            let excess = plane.excess + dot(&plane.normal, origin);
            let [along, across, up] = [along, across, up].map(|axis| dot(&plane.normal, axis));
            let active = excess > 0.0 && plane.owner != Owner::Edge;
            RayPlane { at_origin: excess, excess, along, up, across, active, owner: plane.owner }
        }));
    }

    /// The quadratics from a point of the half-plane on.
    pub fn cell(&mut self, half_plane: &HalfPlane, rho: f64, zeta: f64) -> Cell {
        let field = &self.field;
        let weights = [field.a.plane_weight, field.b.map_or(0.0, |b| b.plane_weight)];
        let mut sums = [Quadratic::default(); 2];
        let mut active = [0; 2];
        for plane in self.planes.iter_mut() {
            plane.excess = plane.at_origin + plane.along * rho + plane.up * zeta;
            if plane.active && plane.owner != Owner::Edge {
                let body = usize::from(plane.owner == Owner::B);
                sums[body].add(weights[body], plane);
                active[body] += 1;
            }
        }
        let is_flat = active[0] == 1 && field.a.sphere_weight == 0.0;
        if field.a.sphere_weight > 0.0 {
            sums[0].add_sphere(field.a.sphere_weight, &half_plane.from_centre(&field.a, rho, zeta));
        }
        let mut cell = Cell { s: sums[0], d: half_plane.height(rho, zeta), is_flat, flat_incline: 0.0 };
        if let Some(b) = &field.b {
            cell.is_flat &= active[1] == 1 && b.sphere_weight == 0.0;
            if b.sphere_weight > 0.0 {
                sums[1].add_sphere(b.sphere_weight, &half_plane.from_centre(b, rho, zeta));
            }
            cell.d = sums[0].minus(&sums[1]);
            if cell.is_flat {
                cell.flat_incline = cell.incline(0.0, 0.0);
            }
        }
        cell
    }

    /// The nearest place where a plane goes on or off, or an edge is met, and its plane.
    fn next_crossing(&self, cell: &Cell, tiny: f64) -> ((f64, f64), Option<usize>) {
        let mut next = ((f64::INFINITY, 0.0), None);
        for (place, plane) in self.planes.iter().enumerate() {
            if let Some((h, k)) = cell.crossing(plane, tiny) {
                if h < next.0.0 {
                    next = ((h, k), Some(place));
                }
            }
        }
        if next.0.0 < 0.0 {
            next.0 = (0.0, 0.0);
        }
        next
    }

    /// Adds the cell to the integrals, in pieces where one rule does not do.
    fn integrate(
        &mut self,
        line: &Line,
        tilt: &Tilt,
        cell: &Cell,
        start: (f64, f64),
        h: f64,
        ray: &mut Ray,
    ) -> Result<(), f64> {
        let (mut from, mut step) = (0.0, h);
        while from < h {
            let to = if from + step < h * (1.0 - 1e-6) { from + step } else { h };
            let known = self.nodes.len();
            let Some((sums, error)) = self.piece(line, tilt, cell, start, (from, to))? else {
                self.nodes.truncate(known);
                ray.is_folded = true;
                return Ok(());
            };
            if error > self.budget && to - from > SHORTEST * h {
                self.nodes.truncate(known);
                step = 0.5 * (to - from);
                continue;
            }
            for (sum, term) in ray.sums.iter_mut().zip(sums) {
                *sum += term;
            }
            if !cell.is_flat {
                (0..3).for_each(|i| ray.curved[i] += sums[i]);
            }
            ray.error += error;
            (from, step) = (to, 2.0 * step);
        }
        Ok(())
    }

    /// One rule on a part of a cell: its integrals and the estimated error of ∫ p n; `None` where the patch has turned back. As an error,
    /// a distance beyond that within which all planes are loaded.
    #[inline(always)]
    fn piece(
        &mut self,
        line: &Line,
        tilt: &Tilt,
        cell: &Cell,
        (rho, zeta): (f64, f64),
        (from, to): (f64, f64),
    ) -> Result<Option<([f64; SUMS], f64)>, f64> {
        let is_flat = cell.is_flat && !self.with_energy;
        let points = if is_flat { 2 } else { self.order };
        let rule = gauss(points);
        let [e, f] = line.direction;
        let by_distance = |distance: f64| if line.is_polar { distance } else { 1.0 };
        // The gradient of D, along the ray, across and upwards, over its slope in the direction in which the height was found.
        let gradient = |along: f64, up: f64, rise: f64| {
            let run = 1.0 / rise;
            let (of_along, of_across) = (cell.d.by_h(along, up) * run, cell.d.across(along, up) * run);
            [tilt.cos * of_along - tilt.sin, of_across, tilt.sin * of_along + tilt.cos]
        };
        let turned = |n_along: f64, n_across: f64| [n_along * e - n_across * f, n_along * f + n_across * e];
        let mut sums = [0.0; SUMS];
        // Pressure and its product with the slope of the patch: at the ends by the polynomial through the points, and the largest.
        let (mut ends, mut largest) = ([[0.0; 4]; 2], [0.0_f64; 2]);
        for (i, (place, weight)) in rule.nodes[..points].iter().enumerate() {
            let along = from + place * (to - from);
            let Some((up, rise)) = cell.height(along) else { return Ok(None) };
            let [distance, height] = tilt.upright(rho + along, zeta + up);
            let pressure = 1.0 - cell.s.value(along, up).max(0.0).sqrt();
            let density = by_distance(distance);
            let [n_along, n_across, n_up] = gradient(along, up, rise);
            let n_up = if n_up.abs() < UPRIGHT { UPRIGHT } else { n_up };
            let weight = weight * (to - from) * density * n_up;
            let normal = turned(n_along / n_up, n_across / n_up);
            let arm = [distance * e, distance * f, height];
            let load = weight * pressure;
            let x = [line.origin[0] + arm[0], line.origin[1] + arm[1], line.origin[2] + arm[2]];
            let node = Node { x, weight, pressure, normal };
            let energy = if self.with_energy { energy::density(self.field, &node)? } else { 0.0 };
            self.nodes.push(node);
            let [n_u, n_v] = normal;
            let torque = [arm[1] - arm[2] * n_v, arm[2] * n_u - arm[0], arm[0] * n_v - arm[1] * n_u];
            let [of_u, of_v, of_w] = torque.map(|c| load * c);
            let terms = [load * n_u, load * n_v, load, of_u, of_v, of_w, node.area(), weight * energy];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term;
            }
            if !is_flat {
                let values = [n_up * pressure, n_along * pressure, n_across * pressure, n_up * energy];
                let values = values.map(|c| c * density);
                for (j, value) in values.into_iter().enumerate() {
                    ends[0][j] += rule.at_end[i] * value;
                    ends[1][j] += rule.at_end[points - 1 - i] * value;
                    largest[j / 3] = largest[j / 3].max(value.abs());
                }
            }
        }
        if !sums.iter().all(|sum| sum.is_finite()) {
            return Ok(None);
        }
        if is_flat {
            return Ok(Some((sums, 0.0)));
        }
        // That polynomial misses the ends by a term whose square, relative, is that of degree 2n.
        let mut off = [0.0_f64; 2];
        for (end, at) in ends.iter().zip([from, to]) {
            let Some((up, rise)) = cell.height(at) else { return Ok(None) };
            let pressure = 1.0 - cell.s.value(at, up).max(0.0).sqrt();
            let [n_along, n_across, n_up] = gradient(at, up, rise);
            let [distance, height] = tilt.upright(rho + at, zeta + up);
            let energy = if self.with_energy {
                let x = [line.origin[0] + distance * e, line.origin[1] + distance * f, line.origin[2] + height];
                let n_up = if n_up.abs() < UPRIGHT { UPRIGHT } else { n_up };
                let normal = turned(n_along / n_up, n_across / n_up);
                n_up * energy::density(self.field, &Node { x, weight: 0.0, pressure, normal })?
            } else {
                0.0
            };
            let values = [n_up * pressure, n_along * pressure, n_across * pressure, energy];
            let values = values.map(|c| c * by_distance(distance));
            (0..4).for_each(|j| off[j / 3] = off[j / 3].max((values[j] - end[j]).abs()));
        }
        let error = |i: usize| if off[i] > 0.0 { (to - from) * off[i] * off[i] / (largest[i] + off[i]) } else { 0.0 };
        // Neither has one sign where the patch turns back.
        let of_energy = if largest[1] > 0.0 { error(1) * largest[0] / largest[1] } else { 0.0 };
        Ok(Some((sums, error(0).max(of_energy))))
    }

    /// The integral of a plane or of the rim (as an inverse distance from the origin) in the cell that follows the first `m` events of a
    /// ray: where it would be met if nothing else were before.
    pub fn inverse_distance(&mut self, line: &Line, ray: &Ray, m: usize, id: u32) -> Option<f64> {
        if ray.is_tilted {
            return None;
        }
        let half_plane = HalfPlane::upright(line.origin, line.direction);
        self.set_out(&half_plane);
        for event in &ray.events[..m] {
            if let Some(plane) = self.planes.get_mut(event.id as usize) {
                plane.active = !plane.active;
            }
        }
        let (rho, zeta) = if m == 0 { (0.0, 0.0) } else { (ray.events[m - 1].rho, ray.events[m - 1].zeta) };
        let cell = self.cell(&half_plane, rho, zeta);
        let radius = self.field.radius();
        if id == RIM {
            return cell.rim(f64::INFINITY, 0.1 * radius).ok().map(|h| 1.0 / (rho + h));
        }
        let plane = self.planes.get(id as usize)?;
        if let Some((h, _)) = cell.crossing(plane, TINY * radius) {
            return Some(1.0 / (rho + h));
        }
        (m == 0).then(|| cell.linear_inverse(plane)).filter(|inverse| inverse.is_finite())
    }
}
