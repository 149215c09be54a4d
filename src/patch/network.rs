//! The patch as a network: the curves on which planes go on, the rim around them, and the places where they meet.

use super::curve::{ONWARDS, Stretch, Trouble};
use super::field::{Field, dot};
use super::half_plane::HalfPlane;
use super::numbers::{BULGE, ErrorBudget, Fitted, HALF_TURN, Limits, ON_CURVE, SAME_VERTEX};
use super::ray::{RIM, Walker};
use super::rim::{CurvePart, Known, Misfit, RimPoint, parabola, unmet_plane};

/// Where two curves meet, or one meets the rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub x: [f64; 3],
    /// The planes of both curves; [`RIM`] for the rim, twice where a ray met it.
    planes: [u32; 2],
    /// Number of curves that lead through it.
    uses: u32,
}

/// A side of cells: the part of a curve or of the rim between two vertices.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub ends: [u32; 2],
    /// u, v of its middle.
    pub middle: [f64; 2],
    /// The plane of the curve, or [`RIM`].
    pub plane: u32,
}

/// Buffers, and what they hold at last.
#[derive(Debug, Default)]
pub(super) struct Network {
    pub vertices: Vec<Vertex>,
    pub sides: Vec<Side>,
    /// Planes whose curves are to be followed, each from a place on it.
    queue: Vec<(u32, [f64; 3])>,
    /// Planes one curve of which is drawn, each from a place on another one: a plane that crosses the patch twice has
    /// two.
    again: Vec<(u32, [f64; 3])>,
    /// Directions in which planes are sought, and the one that counts even if its curve is drawn.
    towards: Vec<([f64; 2], u32)>,
    /// The planes whose curves are drawn, and those that are active at the origin, a bit each.
    pub drawn: u128,
    pub at_origin: u128,
    /// The edges of the triangle, beyond which nothing counts.
    pub edges: u128,
    ring: Vec<(f64, u32)>,
    /// Misfit that an arc may have, and that of all arcs.
    allowed: Misfit,
    pub misfit: Misfit,
    /// Misfit of ∫ p along the curves.
    pub curved_load: f64,
    /// ∫ p over the patch, roughly.
    pub rough_load: f64,
    stretches: [Vec<Stretch>; 2],
}

/// The settings by which a network is drawn.
#[derive(Clone, Copy)]
pub(super) struct Drawing {
    /// The axis of the frame's plane along which the first rays go, and across it.
    pub axis: [f64; 2],
    /// 1 − S at the origin.
    pub depth: f64,
    pub tolerance: f64,
}

impl Network {
    /// Draws the network; of a walk that left the rim or the loaded planes, the trouble.
    pub fn draw(&mut self, walker: &mut Walker, drawing: &Drawing) -> Result<(), Trouble> {
        self.vertices.clear();
        self.sides.clear();
        self.queue.clear();
        self.again.clear();
        self.towards.clear();
        self.curved_load = 0.0;
        (self.drawn, self.at_origin) = (0, walker.field.look(&[0.0; 3]).active);
        self.edges = walker.field.edges();
        let [e, f] = drawing.axis;
        let mut lengths = [0.0; 2];
        for (i, direction) in [[e, f], [-f, e], [-e, -f], [f, -e]].into_iter().enumerate() {
            let end = self.look_out(walker, direction, RIM)?;
            self.vertices.push(Vertex { x: end, planes: [RIM; 2], uses: 1 });
            lengths[i % 2] += (end[0] * end[0] + end[1] * end[1]).sqrt();
        }
        // Area of an ellipse with these axes, and load of a paraboloid of s over it.
        let area = 0.25 * std::f64::consts::PI * lengths[0] * lengths[1];
        self.rough_load = 0.25 * drawing.depth * area;
        let [of_area, of_load] = [drawing.tolerance, ErrorBudget::MINOR * drawing.tolerance];
        self.allowed = Misfit { area: of_area * area, load: of_load * self.rough_load, ..Misfit::default() };
        for _ in 0..Limits::ITERATIONS {
            loop {
                if let Some((id, through)) = self.queue.pop() {
                    if !self.is_drawn(id) {
                        self.follow(walker, id, through)?;
                    }
                } else if let Some((id, through)) = self.again.pop() {
                    self.follow(walker, id, through)?;
                } else {
                    break;
                }
            }
            if !self.meet() {
                continue;
            }
            if self.close(walker.field, drawing)? {
                return Ok(());
            }
            while let Some(([u, v], id)) = self.towards.pop() {
                let length = (u * u + v * v).sqrt();
                self.look_out(walker, [u / length, v / length], id)?;
            }
        }
        Err(Trouble::Lost)
    }

    /// Walks over a ray from the origin, for the planes that it meets whose curves are not drawn, or are plane `again`;
    /// its end.
    fn look_out(&mut self, walker: &mut Walker, direction: [f64; 2], again: u32) -> Result<[f64; 3], Trouble> {
        let [_, ray] = &mut self.stretches;
        ray.clear();
        walker.walk_to_rim(HalfPlane::upright([0.0; 3], direction), None, ray)?;
        for stretch in ray.iter().filter(|stretch| stretch.id == again && again != RIM) {
            self.again.push((stretch.id, stretch.end));
        }
        let met = ray.iter().filter(|stretch| stretch.id != RIM);
        self.queue.extend(met.map(|stretch| (stretch.id, stretch.end)));
        ray.last().map(|stretch| stretch.end).ok_or(Trouble::Lost)
    }

    fn is_drawn(&self, id: u32) -> bool {
        self.drawn.checked_shr(id).unwrap_or(0) & 1 == 1
    }

    /// Adds the curve of a plane.
    fn follow(&mut self, walker: &mut Walker, id: u32, through: [f64; 3]) -> Result<(), Trouble> {
        if id as usize >= Limits::PLANES || self.vertices.len() > Limits::VERTICES {
            return Err(Trouble::Lost);
        }
        let is_drawn = self.is_drawn(id);
        self.drawn |= 1 << id;
        let [backwards, forwards] = &mut self.stretches;
        walker.curve(id as usize, through, backwards, forwards)?;
        let count = self.stretches[1].len();
        let first = &self.stretches[1][0].end;
        if is_drawn && self.vertices.iter().any(|vertex| vertex.planes == [id, RIM] && are_same(&vertex.x, first)) {
            return Ok(());
        }
        let mut last = u32::MAX;
        for i in 0..count {
            let Stretch { id: met, end, middle, is_exact } = self.stretches[1][i];
            let vertex = self.vertex([id, met], &end)?;
            if i > 0 {
                let from = self.vertices[last as usize].x;
                let part = CurvePart { id, from, middle, to: end };
                self.add(walker.field, &part, [last, vertex], is_exact, 0)?;
            }
            last = vertex;
            if met != RIM && met != ONWARDS && !self.is_drawn(met) {
                self.queue.push((met, end));
            }
        }
        Ok(())
    }

    /// Adds a part of a curve, in halves where it is no parabola.
    fn add(
        &mut self,
        field: &Field,
        part: &CurvePart,
        ends: [u32; 2],
        is_exact: bool,
        halvings: usize,
    ) -> Result<(), Trouble> {
        let straying = if is_exact { 0.0 } else { part.straying(field) };
        let is_off = straying > self.allowed.load && halvings < Limits::HALVINGS;
        if let Some([first, second]) = is_off.then(|| part.halves(field)).flatten() {
            self.vertices.push(Vertex { x: part.middle, planes: [part.id; 2], uses: 2 });
            let between = self.vertices.len() as u32 - 1;
            self.add(field, &first, [ends[0], between], is_exact, halvings + 1)?;
            return self.add(field, &second, [between, ends[1]], is_exact, halvings + 1);
        }
        self.curved_load += straying;
        self.sides.push(Side { ends, middle: [part.middle[0], part.middle[1]], plane: part.id });
        Ok(())
    }

    /// The vertex of two curves at a place: as it is known, or a new one.
    fn vertex(&mut self, [own, met]: [u32; 2], x: &[f64; 3]) -> Result<u32, Trouble> {
        if met == ONWARDS {
            self.vertices.push(Vertex { x: *x, planes: [own; 2], uses: 2 });
            return Ok(self.vertices.len() as u32 - 1);
        }
        if met != RIM {
            let crossed = self.vertices.iter_mut().enumerate().filter(|(_, vertex)| vertex.planes == [met, own]);
            if let Some((i, vertex)) = crossed.into_iter().find(|(_, vertex)| are_same(&vertex.x, x)) {
                vertex.uses += 1;
                return Ok(i as u32);
            }
        }
        self.vertices.push(Vertex { x: *x, planes: [own, met], uses: 1 });
        Ok(self.vertices.len() as u32 - 1)
    }

    /// Adds a vertex to every curve that another one met without being met by it; returns whether all such vertices are
    /// on drawn curves.
    fn meet(&mut self) -> bool {
        for i in 0..self.vertices.len() {
            let Vertex { x, planes: [own, met], uses } = self.vertices[i];
            if uses != 1 || met == RIM || own == met {
                continue;
            }
            self.vertices[i].uses = 2;
            let near = self.sides.iter().enumerate().filter(|(_, side)| side.plane == met);
            let near = near.map(|(place, side)| (self.off(side, &x), place));
            let nearest = near.min_by(|a, b| a.0.0.total_cmp(&b.0.0));
            match nearest {
                Some(((off, t), place)) if off < ON_CURVE * self.length(&self.sides[place]) => {
                    let [first, second] = self.halves(&self.sides[place], t, i as u32);
                    self.sides[place] = first;
                    self.sides.push(second);
                }
                _ => self.again.push((met, x)),
            }
        }
        self.again.is_empty()
    }

    pub fn length(&self, side: &Side) -> f64 {
        let [p, q] = side.ends.map(|end| self.vertices[end as usize].x);
        ((q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2)).sqrt()
    }

    /// How far a point is off a side, and the place on it that is nearest.
    pub fn off(&self, side: &Side, x: &[f64; 3]) -> (f64, f64) {
        let [from, to] = side.ends.map(|end| self.vertices[end as usize].x);
        let [p, q] = [&from, &to].map(|x| [x[0], x[1]]);
        let way = [q[0] - p[0], q[1] - p[1]];
        let square = way[0] * way[0] + way[1] * way[1];
        let mut t = 0.5;
        let mut off = f64::INFINITY;
        for _ in 0..3 {
            let at = parabola([&p, &side.middle, &q], t);
            let [u, v] = [x[0] - at[0], x[1] - at[1]];
            off = (u * u + v * v).sqrt();
            t = (t + (u * way[0] + v * way[1]) / square).clamp(0.0, 1.0);
        }
        (off, t)
    }

    /// Both parts of a side that gets a vertex at t.
    pub fn halves(&self, side: &Side, t: f64, vertex: u32) -> [Side; 2] {
        let [from, to] = side.ends.map(|end| self.vertices[end as usize].x);
        let at = |t: f64| parabola([&[from[0], from[1]], &side.middle, &[to[0], to[1]]], t);
        [
            Side { ends: [side.ends[0], vertex], middle: at(0.5 * t), ..*side },
            Side { ends: [vertex, side.ends[1]], middle: at(0.5 + 0.5 * t), ..*side },
        ]
    }

    /// Adds the arcs of the rim; whether no plane was found on them whose curve was not known.
    fn close(&mut self, field: &Field, drawing: &Drawing) -> Result<bool, Trouble> {
        let known = (self.sides.len(), self.vertices.len());
        self.misfit = Misfit { load: self.curved_load, ..Misfit::default() };
        self.ring.clear();
        for (i, vertex) in self.vertices.iter().enumerate().filter(|(_, vertex)| vertex.planes[1] == RIM) {
            self.ring.push((around(&vertex.x), i as u32));
        }
        self.ring.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut is_complete = true;
        let at = |vertex: &Vertex| RimPoint::new(field, vertex.x).ok_or(Trouble::Lost);
        let count = self.ring.len();
        let first = self.ring.first().ok_or(Trouble::Lost)?.1;
        let first = at(&self.vertices[first as usize])?;
        let mut from = first;
        for i in 0..count {
            let ends = [self.ring[i].1, self.ring[(i + 1) % count].1];
            let to = if i + 1 < count { at(&self.vertices[ends[1] as usize])? } else { first };
            is_complete &= self.arc(field, drawing, (ends, [&from, &to]), 0)?;
            from = to;
        }
        if !is_complete {
            self.sides.truncate(known.0);
            self.vertices.truncate(known.1);
        }
        Ok(is_complete)
    }

    /// Adds an arc of the rim, in parts where it turns much; whether no unknown plane was found on it.
    fn arc(
        &mut self,
        field: &Field,
        drawing: &Drawing,
        (ends, [from, to]): ([u32; 2], [&RimPoint; 2]),
        halvings: usize,
    ) -> Result<bool, Trouble> {
        if are_same(&from.x, &to.x) {
            // One vertex.
            return Ok(true);
        }
        let middle = from.middle(to, field).ok_or(Trouble::Lost)?;
        let away = BULGE * dot(&middle.x, &middle.x).sqrt();
        if away > field.loaded() {
            return Err(Trouble::Far(away));
        }
        let turns = from.half_turn_to(&middle).abs().max(middle.half_turn_to(to).abs()) > HALF_TURN;
        let own = ends.map(|end| self.vertices[end as usize].planes[0]);
        let least_beyond = ErrorBudget::MINOR * drawing.tolerance;
        let least = least_beyond * drawing.depth;
        let known = Known { drawn: self.drawn, at_origin: self.at_origin, least, least_beyond };
        let is_arc = !turns || halvings == Limits::HALVINGS;
        if let Some((id, [u, v, _])) = unmet_plane(field, [from, &middle, to], (own, is_arc), &known) {
            self.towards.push(([u, v], id as u32));
            if self.is_drawn(id as u32) {
                // Its curve passes between there and the middle once more.
                self.towards.push(([middle.x[0], middle.x[1]], id as u32));
            }
            return Ok(false);
        }
        let misfit = if middle.active & self.edges == 0 {
            Misfit::new(field, [from, &middle, to]).ok_or(Trouble::Lost)?
        } else {
            Misfit::default()
        };
        let is_off = turns || misfit.area > self.allowed.area || misfit.load > self.allowed.load;
        if is_off && halvings < Limits::HALVINGS {
            self.vertices.push(Vertex { x: middle.x, planes: [RIM; 2], uses: 1 });
            let between = self.vertices.len() as u32 - 1;
            let first = self.arc(field, drawing, ([ends[0], between], [from, &middle]), halvings + 1)?;
            let second = self.arc(field, drawing, ([between, ends[1]], [&middle, to]), halvings + 1)?;
            return Ok(first && second);
        }
        if turns {
            // Area and load of the tip are not known any better.
            let tip = from.tip(to);
            self.misfit.area += tip;
            self.misfit.load += drawing.depth * tip;
        }
        self.misfit.area += Fitted::CORRECTED * misfit.area;
        self.misfit.load += misfit.load;
        let [u, v] = [0, 1].map(|i| middle.x[i] + misfit.correction[i]);
        self.sides.push(Side { ends, middle: [u, v], plane: RIM });
        Ok(true)
    }
}

/// Whether two walks found the same place.
fn are_same(a: &[f64; 3], b: &[f64; 3]) -> bool {
    let size = b.iter().map(|c| c.abs()).fold(0.0, f64::max);
    (0..3).all(|c| (a[c] - b[c]).abs() <= SAME_VERTEX * size)
}

/// Rises with the angle of a point about the origin, from −2 to 2.
fn around([u, v, _]: &[f64; 3]) -> f64 {
    let along = u / (u.abs() + v.abs());
    if *v < 0.0 { along - 1.0 } else { 1.0 - along }
}
