//! A ray over the patch: an exact walk through the cells.

use super::cell::{Cell, Quadratic, RayPlane};
use super::field::{Field, Owner, dot};
use super::half_plane::{HalfPlane, Tilt};
use super::numbers::{GENTLE, Limits, NEAR_TURN, STEEP};

/// Events of a ray that are kept; of a longer one the last place holds the end.
pub(super) const EVENTS: usize = 12;

/// The end of a ray where s = 1, in place of the number of a plane.
pub(super) const RIM: u32 = u32::MAX;

/// Half of a straight line over the plane of the frame, from a point of the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub origin: [f64; 3],
    /// Unit vector.
    pub direction: [f64; 2],
    /// Whether lengths are weighted by the distance, as for an integral over an area in polar coordinates.
    pub is_polar: bool,
}

/// The end of the way through a cell.
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
    /// Weight of its area in the plane of the frame, per angle; below 0 where the patch has turned back under itself,
    /// so that sums of weight · normal are right there, too.
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

/// A place at which a plane goes on or off, or the ray ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    /// Number of the plane, or [`RIM`].
    pub id: u32,
    /// Distance from the origin of the ray, and height above it; with turned axes the length walked, `zeta` unused.
    pub rho: f64,
    pub zeta: f64,
    /// Integral of the pressure up to here.
    pub before: f64,
}

/// Number of integrals of a ray.
pub(super) const SUMS: usize = 8;

/// A ray that was walked, and its integrals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub direction: [f64; 2],
    /// Its nodes.
    pub nodes: (u32, u32),
    /// ∫ p n, ∫ x × p n about the origin of the ray, ∫ |n|: force, torque and area per angle; and the energy, if asked
    /// for.
    pub sums: [f64; SUMS],
    /// ∫ p n over the cells that are not flat.
    pub curved: [f64; 3],
    /// Estimated error of ∫ p along the ray.
    pub error: f64,
    pub events: [Event; EVENTS],
    pub count: usize,
    /// Whether it was walked over with its axes turned: the patch turns back under itself, or is steep.
    pub is_tilted: bool,
    /// Whether it went on where the patch turns back under itself.
    pub turns_back: bool,
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
    /// Number of planes looked at so far, once for each cell.
    pub work: usize,
}

impl<'f, 'a, 's> Walker<'f, 'a, 's> {
    /// With one rule for each cell, and without the energy.
    pub fn new(
        field: &'f mut Field<'a, 's>,
        planes: &'f mut Vec<RayPlane>,
        nodes: &'f mut Vec<Node>,
        order: usize,
    ) -> Self {
        Self { field, planes, nodes, order, with_energy: false, budget: f64::INFINITY, work: 0 }
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

    /// Walks once. An error is the distance up to which planes must be loaded, where the ray leaves those that are.
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
            turns_back: false,
            is_folded: false,
        };
        let mut half_plane = HalfPlane::upright(line.origin, line.direction);
        let mut tilt = Tilt::UPRIGHT;
        self.set_out(&half_plane);
        let (mut rho, mut zeta, mut way) = (0.0, 0.0, 0.0);
        for _ in 0..Limits::RAY_CELLS {
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
    pub fn turn(&mut self, [c, s]: [f64; 2]) {
        for plane in self.planes.iter_mut() {
            [plane.along, plane.up] = [c * plane.along + s * plane.up, c * plane.up - s * plane.along];
        }
    }

    /// The end of the way through a cell: at the nearest plane or edge, or on the rim.
    pub fn end_of(&self, cell: &Cell) -> CellEnd {
        // Beyond its turn the patch is no graph, and what is met there lies on another branch.
        let turn = cell.turn();
        let ((h, k), next) = self.next_crossing(cell, turn);
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
        self.work += self.planes.len();
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
    fn next_crossing(&self, cell: &Cell, turn: f64) -> ((f64, f64), Option<usize>) {
        let mut next = ((f64::INFINITY, 0.0), None);
        let radius = self.field.radius();
        let mut bounds = cell.bounding_triangle(turn);
        for (place, plane) in self.planes.iter().enumerate() {
            if bounds.is_some_and(|triangle| !triangle.may_cross(plane)) {
                continue;
            }
            if let Some((h, k)) = cell.crossing(plane, radius) {
                if h < next.0.0 {
                    next = ((h, k), Some(place));
                    bounds = bounds.map(|triangle| triangle.cut_at(h, k));
                }
            }
        }
        if next.0.0 < 0.0 {
            next.0 = (0.0, 0.0);
        }
        next
    }

    /// Inverse distance from the origin to a plane or the rim in the cell that follows the first `m` events of a ray,
    /// as if nothing else were met before.
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
        if let Some((h, _)) = cell.crossing(plane, radius) {
            return Some(1.0 / (rho + h));
        }
        (m == 0).then(|| cell.linear_inverse(plane)).filter(|inverse| inverse.is_finite())
    }
}
