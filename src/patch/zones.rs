//! Where the zones of a patch lie: strips and caps around a flat part, or about an edge, or one disc.

use super::cap::{Cap, Third};
use super::disc::Disc;
use super::field::{Field, Owner};
use super::local_coordinates::{Flat, LocalCoordinates, Vector, Wave, normal, radius};
use super::numbers::{BULGE, FINE};
use super::piece::{Kind, Piece};
use super::polygon::{Corner, Level, OPEN, cut};
use super::ray::RIM;
use super::strip::{End, Strip};

/// The plane of A and that of B whose faces meet.
type Faces = (usize, Option<usize>);

/// The parts of a patch in the making.
pub(super) struct Zones<'b, 'f, 's> {
    pub field: &'b mut Field<'f, 's>,
    pub pieces: &'b mut Vec<Piece>,
}

impl Zones<'_, '_, '_> {
    fn flat(&self, plane: Option<usize>) -> Flat {
        plane.map_or(Flat::BOUNDARY, |k| {
            let plane = &self.field.planes[k];
            Flat { normal: normal(plane), excess: plane.excess, radius: radius(self.field, plane.owner) }
        })
    }

    /// The polygon of the two planes that face each other most, left in `corners[0]`; the inner option is `None` if it
    /// is empty.
    pub fn face(&mut self, active: [&[usize]; 2], corners: &mut [Vec<Corner>; 2]) -> Option<Option<(Level, Faces)>> {
        let unit = |k: usize| normal(&self.field.planes[k]).normalize();
        let others: &[usize] = if active[1].is_empty() { &[usize::MAX] } else { active[1] };
        let (mut best, mut pair) = (f64::INFINITY, (0, 0));
        for &i in active[0] {
            for &j in others {
                let facing = unit(i).dot(&if j == usize::MAX { -Vector::z() } else { unit(j) });
                if facing < best {
                    (best, pair) = (facing, (i, j));
                }
            }
        }
        let (i, j) = (pair.0, Some(pair.1).filter(|j| *j != usize::MAX));
        let other = self.flat(j);
        let Some(level) = Level::new(self.field, i, &other) else { return Some(None) };
        // Planes are loaded as far as the polygon goes.
        for _ in 0..8 {
            let reach = self.field.loaded().min(self.field.radius());
            if !cut(self.field, &level, [i, pair.1], reach, corners) {
                return Some(None);
            }
            let is_open = corners[0].iter().any(|corner| corner.side == OPEN);
            let farthest = corners[0].iter().map(|c| level.point(&c.at).norm()).fold(0.0, f64::max);
            let rim = 2.0 * (radius(self.field, Owner::A) + other.radius);
            let needed = if is_open { 16.0 * reach } else { farthest + rim.min(farthest) };
            if needed <= self.field.loaded() {
                return (!is_open).then_some(Some((level, (i, j))));
            }
            self.field.load(needed);
        }
        None
    }

    /// Strips along the sides of a polygon that are planes, and caps at their ends.
    pub fn around(&mut self, level: &Level, polygon: &[Corner], (i, j): Faces) -> Option<()> {
        let other = &self.flat(j);
        let a = self.flat(Some(i));
        let count = polygon.len();
        for k in 0..count {
            let side = polygon[k].side;
            let Some(of) = self.owner(side) else { continue };
            // The body with two planes, and the flat one.
            let (two, one, flat) = if of == Owner::A { (i, &a, other) } else { (j?, other, &a) };
            let planes = &self.field.planes;
            let edge = [&planes[two], &planes[side as usize]];
            let coordinates = LocalCoordinates::edge(edge, flat)?;
            let neighbours = [polygon[(k + count - 1) % count].side, polygon[(k + 1) % count].side];
            let at = [polygon[k].at, polygon[(k + 1) % count].at].map(|at| level.point(&at));
            let mut ends = [0, 1].map(|e| {
                let along = coordinates.arms[2].dot(&(at[e] - coordinates.origin));
                (self.end(&coordinates, neighbours[e], along), neighbours[e], along)
            });
            if ends[0].2 > ends[1].2 {
                ends.swap(0, 1);
            }
            let radii = [one.radius, flat.radius];
            let strip = Strip::new(coordinates, radii, Some(0.0), 1.0, [ends[0].0, ends[1].0])?;
            let active = [i as u32, j.map_or(RIM, |j| j as u32), side, RIM];
            self.strip(strip, &active, neighbours);
            // A cap belongs to the strip before it.
            let next = neighbours[1];
            if let Some(of_next) = self.owner(next) {
                let planes = &self.field.planes;
                let coordinates =
                    LocalCoordinates::corner([&planes[two], &planes[side as usize], &planes[next as usize]], flat);
                let third = if of_next == of { Third::Same } else { Third::Other };
                match coordinates.and_then(|coordinates| Cap::new(coordinates, &strip, third)) {
                    Some(cap) => self.cap(cap, &[active[0], active[1], side, next]),
                    None => return None,
                }
            }
        }
        Some(())
    }

    /// The body that a side of the polygon belongs to.
    fn owner(&self, side: u32) -> Option<Owner> {
        self.field.planes.get(side as usize).map(|plane| plane.owner).filter(|owner| *owner != Owner::Edge)
    }

    /// The end of a strip at a plane, the edge of a triangle or, at a place, where s = 1.
    fn end(&self, coordinates: &LocalCoordinates, side: u32, along: f64) -> End {
        self.field.planes.get(side as usize).map_or(End::At(along), |plane| {
            let n = normal(plane);
            End::Line {
                value: plane.excess + n.dot(&coordinates.origin),
                slopes: coordinates.arms.map(|arm| n.dot(&arm)),
            }
        })
    }

    /// `ends`: the planes or edges of a triangle at which it ends.
    fn strip(&mut self, strip: Strip, active: &[u32], ends: [u32; 2]) {
        let [first, last] = strip.lengths();
        let outline = strip.outline().map(|at| strip.place(at));
        let width = (outline[4] - 0.5 * (outline[0] + outline[1])).norm();
        let mut neglected = self.neglected(&outline[2..], width * first.max(last).max(0.0), active);
        let sides = [(outline[2] - outline[0]).norm(), (outline[3] - outline[1]).norm()];
        neglected += sides[0].max(sides[1]) * strip.overhang();
        if first < 0.0 || last < 0.0 {
            // The ends cross before the rim.
            neglected += width * (first.abs() + last.abs()) * strip.depth().max(0.0);
        }
        self.push(Kind::Strip(strip), &outline, &ends, neglected);
    }

    fn cap(&mut self, cap: Cap, active: &[u32]) {
        let outline = cap.outline();
        let corner = cap.corner();
        let size = (outline[0] - corner).norm() * (outline[1] - corner).norm();
        let neglected = self.neglected(&outline, size, active) + size * cap.rise();
        self.push(Kind::Cap(cap), &[outline[0], outline[1], outline[2], corner], &[], neglected);
    }

    /// Largest change of ∫ p over an area by planes that are active at one of these places but not counted as such, or
    /// the reverse.
    fn neglected(&self, places: &[Vector], area: f64, active: &[u32]) -> f64 {
        let mut squares = [0.0_f64; 2];
        // A ball about the first place has them all: most planes pass it by.
        let Some((first, others)) = places.split_first() else { return 0.0 };
        let square = |x: &Vector| x.norm_squared();
        let reach = others.iter().map(|x| square(&(x - first))).fold(0.0, larger).sqrt();
        for (k, plane) in self.field.planes.iter().enumerate().filter(|(_, plane)| plane.owner != Owner::Edge) {
            let n = normal(plane);
            let at_first = plane.excess + n.dot(first);
            let around = reach * (n.x.abs() + n.y.abs() + n.z.abs());
            let sign = if active.contains(&(k as u32)) { -1.0 } else { 1.0 };
            if sign * at_first + around > 0.0 {
                let excess = others.iter().map(|x| sign * (plane.excess + n.dot(x))).fold(sign * at_first, larger);
                let most = &mut squares[usize::from(plane.owner == Owner::B)];
                *most = larger(*most, if excess > 0.0 { excess * excess } else { 0.0 });
            }
        }
        let weights = [self.field.a.plane_weight, self.field.b.map_or(0.0, |b| b.plane_weight)];
        let most = 0.5 * larger(weights[0] * squares[0], weights[1] * squares[1]);
        let farthest = places.iter().map(square).fold(0.0, larger).sqrt();
        if farthest > self.field.loaded() { f64::INFINITY } else { area * most }
    }

    /// Adds a zone with these places on its border, which ends at `ends`; what else of it lies outside a triangle is
    /// neglected, too.
    fn push(&mut self, kind: Kind, border: &[Vector], ends: &[u32], neglected: f64) {
        let neglected = neglected + self.beyond_edges(border, ends);
        self.pieces.push(Piece::new(kind, neglected));
    }

    /// Bound on ∫ p over the part of a zone that lies outside the triangle, since p ≤ 1; the edges in `ends` cut
    /// nothing off.
    fn beyond_edges(&self, border: &[Vector], ends: &[u32]) -> f64 {
        let middle = border.iter().sum::<Vector>() / border.len() as f64;
        let reach = border.iter().map(|x| (x - middle).norm()).fold(0.0, f64::max) * BULGE;
        let edges = self.field.planes.iter().enumerate().filter(|(_, plane)| plane.owner == Owner::Edge);
        let others = edges.filter(|(k, _)| !ends.contains(&(*k as u32)));
        others
            .map(|(_, edge)| {
                let n = normal(edge);
                let outwards = border.iter().map(|x| n.dot(&(x - middle))).fold(0.0, f64::max);
                let beyond = edge.excess + n.dot(&middle) + BULGE * outwards;
                2.0 * reach * beyond.clamp(0.0, 2.0 * reach)
            })
            .sum()
    }

    /// The patch about an edge, or one zone.
    pub fn edge_or_disc(&mut self, active: [&[usize]; 2], start: &Vector, tolerance: f64) -> Option<()> {
        for body in 0..2 {
            let (of, others) = (active[body], active[1 - body]);
            for (p, &i) in of.iter().enumerate() {
                for &a in &of[p + 1..] {
                    let flats: &[usize] = if others.is_empty() { &[usize::MAX] } else { others };
                    for &j in flats {
                        if self.edge(i, a, Some(j).filter(|j| *j != usize::MAX), start)? {
                            return (tolerance >= FINE).then_some(());
                        }
                    }
                }
            }
        }
        self.disc(active)
    }

    fn disc(&mut self, active: [&[usize]; 2]) -> Option<()> {
        let planes = &self.field.planes;
        let (three, last, third) = match active {
            [&[i, a, b], rest] if rest.len() <= 1 => ([i, a, b], rest.first().copied(), Third::Same),
            [rest, &[i, a, b]] if rest.len() == 1 => ([i, a, b], Some(rest[0]), Third::Same),
            [&[i, a], &[j, b]] => ([i, a, b], Some(j), Third::Other),
            _ => return None,
        };
        let last_flat = self.flat(last);
        let coordinates = LocalCoordinates::corner(three.map(|k| &planes[k]), &last_flat)?;
        let disc = Disc::new(coordinates, [radius(self.field, planes[three[0]].owner), last_flat.radius], third)?;
        // Between places on the rim it reaches out a little farther.
        let outline = disc.outline();
        let middle = outline.iter().sum::<Vector>() / outline.len() as f64;
        let wider = outline.map(|x| middle + 1.035 * (x - middle));
        let across = (wider[0] - wider[6]).norm() * (wider[3] - wider[9]).norm();
        let farthest = wider.iter().map(|x| x.norm()).fold(0.0, f64::max);
        if farthest > self.field.loaded() {
            self.field.load(farthest);
        }
        let active = [three[0], three[1], three[2], last.unwrap_or(usize::MAX)].map(|k| k as u32);
        let neglected = self.neglected(&wider, across, &active);
        self.push(Kind::Disc(disc), &outline, &[], neglected);
        Some(())
    }

    /// The edge of planes `i` and `a` against a flat body: whether there is such a part of the patch.
    fn edge(&mut self, i: usize, a: usize, j: Option<usize>, start: &Vector) -> Option<bool> {
        let flat = self.flat(j);
        let radii = [radius(self.field, self.field.planes[i].owner), flat.radius];
        let Some(coordinates) = LocalCoordinates::edge([&self.field.planes[i], &self.field.planes[a]], &flat) else {
            return Some(false);
        };
        let wave = Wave::new(-coordinates.slopes[0] * radii[0], -coordinates.slopes[1] * radii[0]);
        let [cos, sin] = [wave.a / wave.size, wave.b / wave.size];
        if !(cos > 0.0 && sin > 0.0) {
            return Some(false);
        }
        let known = [i as u32, a as u32, j.map_or(RIM, |j| j as u32)];
        for _ in 0..8 {
            // Along the ridge, where s is least at each place along the edge: up to where s = 1 or a plane comes on.
            let slope = coordinates.slopes[2];
            let f = wave.size + flat.radius;
            let top = (f - coordinates.c) / slope;
            let mut ends = [(f64::NEG_INFINITY, RIM), (f64::INFINITY, RIM)];
            ends[usize::from(slope > 0.0)].0 = top;
            if slope == 0.0 {
                ends = [(f64::NEG_INFINITY, RIM), (f64::INFINITY, RIM)];
                if coordinates.c > f {
                    return Some(false);
                }
            }
            let k = radii[0] / f;
            for (number, plane) in self.field.planes.iter().enumerate().filter(|(k, _)| !known.contains(&(*k as u32))) {
                let n = normal(plane);
                let [h1, h2, h3] = coordinates.arms.map(|arm| n.dot(&arm));
                let ridge = k * (cos * h1 + sin * h2);
                let (value, rate) =
                    (plane.excess + n.dot(&coordinates.origin) + coordinates.c * ridge, h3 + slope * ridge);
                let at = -value / rate;
                if rate > 0.0 && at < ends[1].0 {
                    ends[1] = (at, number as u32);
                } else if rate < 0.0 && at > ends[0].0 {
                    ends[0] = (at, number as u32);
                } else if rate == 0.0 && value > 0.0 {
                    return Some(false);
                }
            }
            if !(ends[1].0 > ends[0].0) {
                return Some(false);
            }
            let places = ends.map(|(t, _)| coordinates.origin + t * coordinates.arms[2]);
            let farthest = places.iter().map(|x| x.norm()).fold(start.norm(), f64::max);
            let needed = 1.2 * farthest + 2.0 * (radii[0] + radii[1]).min(farthest);
            if needed > self.field.loaded() {
                let loaded = self.field.loaded();
                self.field.load(needed.min(8.0 * loaded).max(2.0 * loaded));
                continue;
            }
            return self.ridge(&coordinates, radii, [i, a], j, ends);
        }
        None
    }

    /// Two strips from the ridge to both sides, and caps at their ends.
    fn ridge(
        &mut self,
        coordinates: &LocalCoordinates,
        radii: [f64; 2],
        [i, a]: [usize; 2],
        j: Option<usize>,
        ends: [(f64, u32); 2],
    ) -> Option<bool> {
        let flat = self.flat(j);
        let active = [i as u32, a as u32, j.map_or(RIM, |j| j as u32), RIM];
        for sign in [1.0, -1.0] {
            let limits = ends.map(|(along, side)| self.end(coordinates, side, along));
            let strip = Strip::new(*coordinates, radii, None, sign, limits)?;
            self.strip(strip, &active, ends.map(|(_, side)| side));
            for (_, side) in ends {
                let Some(plane) = self.field.planes.get(side as usize).filter(|plane| plane.owner != Owner::Edge)
                else {
                    continue;
                };
                let planes = &self.field.planes;
                let third = if plane.owner == planes[i].owner { Third::Same } else { Third::Other };
                let coordinates = LocalCoordinates::corner([&planes[i], &planes[a], plane], &flat)?;
                let cap = Cap::new(coordinates, &strip, third)?;
                self.cap(cap, &[active[0], active[1], active[2], side]);
            }
        }
        Some(true)
    }
}

/// The larger one; the first where the second is no number.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
