//! The least S on a plane or a triangle in 32 digits, by a method of its own: the judge of contacts with walls.
//!
//! In coordinates y of the boundary's plane, with the foot of the particle's centre as their origin,
//!
//! ```text
//! F(y) = w Σ ⟨e_i + a_i·y⟩² + m (h² + |y|²)
//! ```
//!
//! with a_i the part of a normal in the plane and e_i its excess at the foot. Newton's method with an exact line search
//! finds the minimum on the plane; on a triangle it is that or the least of the three edges. Whatever is reached is a
//! proof: with a slope g into the boundary at a feasible point, F is nowhere on it below F − |g|²/4m, nor below F −
//! |g|·D within a distance D.

use crate::pair_line::Place;
use crate::stress::placed_boundary::{Boundary, Edge, Part, Plane, Wide2, along, cross, dot, edges, length};
use crate::wide::{Wide, Wide3};
use potential_particles::Particle;

/// The least S as far as it is known.
#[derive(Clone, Copy, Debug)]
pub struct Least {
    /// Relative to the centre of the particle, world axes.
    pub x: Wide3,
    pub part: Part,
    /// s lies between these two.
    pub least: f64,
    pub most: f64,
    /// How far x can be from the minimiser, length; infinite where nothing says.
    pub doubt: f64,
    /// ∇S, world axes.
    pub gradient: Wide3,
    /// How fast the direction of ∇S can turn, radians a length.
    pub bend: f64,
}

/// F: the planes as the boundary sees them.
struct Reduced {
    /// a_i, e_i.
    rows: Vec<(Wide2, Wide)>,
    /// The same in doubles, and what those may be off, relative to 1 + |y|.
    plain: Vec<([f64; 2], f64, f64)>,
    w: Wide,
    m: Wide,
    height: Wide,
}

/// F, half its gradient, and the places of the active planes.
#[derive(Clone)]
struct Local {
    value: Wide,
    slope: Wide2,
    /// Place and excess.
    active: Vec<(usize, Wide)>,
}

impl Local {
    fn has_planes_of(&self, other: &Self) -> bool {
        self.active.len() == other.active.len() && self.active.iter().zip(&other.active).all(|(a, b)| a.0 == b.0)
    }
}

/// Most steps of one search.
const MOST_STEPS: usize = 120;

impl Reduced {
    fn new(particle: &Particle, plane: &Plane, m: Wide) -> Self {
        let (r, k) = (particle.rounding_radius(), particle.sphericity());
        let round = k == 1.0;
        let planes = particle.planes().filter(|_| !round);
        let rows: Vec<(Wide2, Wide)> = planes
            .map(|p| {
                let n = Wide3::from(p.normal);
                let a = [plane.axes[0].dot(&n), plane.axes[1].dot(&n)];
                (a, n.dot(&plane.normal) * plane.height - Wide::from(p.offset))
            })
            .collect();
        let loss = |(a, e): &(Wide2, Wide)| ([a[0].f64(), a[1].f64()], e.f64(), 1e-14 * length(a));
        let plain = rows.iter().map(loss).collect();
        let w = if round { Wide::ZERO } else { Wide::difference(1.0, k) / Wide::product(r, r) };
        Self { rows, plain, w, m, height: plane.height }
    }

    fn at(&self, y: &Wide2) -> Local {
        let near = [y[0].f64(), y[1].f64()];
        let size = near[0].abs() + near[1].abs();
        let (mut square, mut slope, mut active) = (Wide::ZERO, [self.m * y[0], self.m * y[1]], Vec::new());
        for (i, (a, e, loss)) in self.plain.iter().enumerate() {
            if e + a[0] * near[0] + a[1] * near[1] < -(loss * size + 1e-14 * e.abs()) {
                continue;
            }
            let (a, e) = &self.rows[i];
            let excess = *e + dot(a, y);
            if excess.f64() <= 0.0 {
                continue;
            }
            square += excess * excess;
            let push = self.w * excess;
            slope = along(&slope, push, a);
            active.push((i, excess));
        }
        let value = self.w * square + self.m * (self.height * self.height + dot(y, y));
        Local { value, slope, active }
    }

    /// Newton's step in the plane: −K⁻¹q with K = wΣaaᵀ + m, by its adjugate. Determinant and adjugate are made from
    /// the cross products of pairs of normals, so that nearly parallel ones lose no digits.
    fn newton(&self, y: &Wide2, at: &Local) -> Wide2 {
        let rows = || at.active.iter().map(|(i, excess)| (&self.rows[*i].0, *excess));
        let (mut both, mut each) = (Wide::ZERO, Wide::ZERO);
        let (mut adjugate, mut pull) = ([Wide::ZERO; 2], [self.m * y[0], self.m * y[1]]);
        for (a, excess) in rows() {
            each += dot(a, a);
            pull = along(&pull, self.w * excess, a);
            let across = [-a[1], a[0]];
            let mut turned = self.m * dot(&across, y);
            for (b, other) in rows() {
                let product = cross(a, b);
                both += product * product;
                turned += self.w * (other * product);
            }
            adjugate = along(&adjugate, self.w * turned, &across);
        }
        let determinant = self.w * self.w * (both * Wide::from(0.5)) + self.w * self.m * each + self.m * self.m;
        let step = along(&adjugate, self.m, &pull);
        let factor = -Wide::ONE / determinant;
        [step[0] * factor, step[1] * factor]
    }

    /// Half the slope and half the curvature of F along a step.
    fn on_line(&self, y: &Wide2, step: &Wide2) -> (Wide, Wide, Local) {
        let at = self.at(y);
        let mut curvature = self.m * dot(step, step);
        for (i, _) in &at.active {
            let rate = dot(&self.rows[*i].0, step);
            curvature += self.w * (rate * rate);
        }
        (dot(&at.slope, step), curvature, at)
    }

    /// The least F on y + t·step for t in [0, most]: the place, and whether it is at an end.
    fn on_segment(&self, y: &Wide2, step: &Wide2, most: Wide) -> (Wide, Option<bool>) {
        let (start, curvature, mut at) = self.on_line(y, step);
        if start.f64() >= 0.0 {
            return (Wide::ZERO, Some(false));
        }
        let (end, ..) = self.on_line(&along(y, most, step), step);
        if end.f64() <= 0.0 {
            return (most, Some(true));
        }
        let (mut low, mut high) = (Wide::ZERO, most);
        let mut t = -start / curvature;
        for _ in 0..2 * MOST_STEPS {
            let inside = (t - low).f64() > 0.0 && (high - t).f64() > 0.0;
            if !inside {
                t = (low + high) * Wide::from(0.5);
            }
            let (slope, curvature, next) = self.on_line(&along(y, t, step), step);
            if slope.f64() == 0.0 || (inside && next.has_planes_of(&at)) {
                return (t, None);
            }
            at = next;
            if slope.f64() > 0.0 {
                high = t
            } else {
                low = t
            }
            if (high - low).f64() <= 1e-31 * high.f64() {
                break;
            }
            t = t - slope / curvature;
        }
        (t, None)
    }

    /// The minimiser on the whole plane.
    fn on_plane(&self, start: Wide2) -> Wide2 {
        let (mut y, mut at) = (start, self.at(&start));
        for _ in 0..MOST_STEPS {
            let step = self.newton(&y, &at);
            if !step[0].is_finite() || !step[1].is_finite() {
                break;
            }
            let whole = along(&y, Wide::ONE, &step);
            let next = self.at(&whole);
            if next.has_planes_of(&at) {
                // Once more, against the rounding of a long step.
                let last = along(&whole, Wide::ONE, &self.newton(&whole, &next));
                return if (self.at(&last).value - next.value).f64() < 0.0 { last } else { whole };
            }
            let fall = dot(&at.slope, &step).f64();
            let (y_next, next) = if (next.value - at.value).f64() <= 0.2 * fall {
                (whole, next)
            } else {
                let (t, _) = self.on_segment(&y, &step, Wide::ONE);
                let y = along(&y, t, &step);
                (y, self.at(&y))
            };
            if (at.value - next.value).f64() <= 1e-31 * at.value.f64() {
                return if (at.value - next.value).f64() > 0.0 { y_next } else { y };
            }
            (y, at) = (y_next, next);
        }
        y
    }

    /// How far from the minimum on the plane (no direction) or along a unit direction a point may be, and it is no
    /// farther than that if no plane is switched within that way: to the next Newton point, else by the least
    /// curvature.
    fn doubt(&self, y: &Wide2, direction: Option<&Wide2>, slope: f64) -> f64 {
        let at = self.at(y);
        let step = match direction {
            None => self.newton(y, &at),
            Some(direction) => {
                let (slope, curvature, _) = self.on_line(y, direction);
                let by = -slope / curvature;
                [by * direction[0], by * direction[1]]
            }
        };
        let way = 4.0 * length(&step);
        let clear = |(a, e): &(Wide2, Wide)| (*e + dot(a, y)).f64().abs() > length(a) * way;
        let by_curvature = slope / self.m.f64();
        if self.rows.iter().all(clear) { way.min(by_curvature) } else { by_curvature }
    }
}

/// A candidate: where, on which part, in a plane with F as seen from there.
struct Candidate {
    y: Wide2,
    part: Part,
    plane: Plane,
    reduced: Reduced,
}

/// How steeply F/2 falls at most from a candidate into the boundary.
fn descent(slope: &Wide2, part: Part, edges: Option<&[Edge; 3]>) -> f64 {
    let (Some(edges), part) = (edges, part) else { return length(slope) };
    match part {
        Part::Inside => length(slope),
        Part::Edge(i) => dot(slope, &edges[i].along).f64().hypot(dot(slope, &edges[i].inwards).f64().min(0.0)),
        Part::Vertex(i) => {
            let (next, last) = (&edges[i], &edges[(i + 2) % 3]);
            let back = last.along.map(|c| -c);
            let inside = dot(slope, &next.inwards).f64() <= 0.0 && dot(slope, &last.inwards).f64() <= 0.0;
            // The negative slope points into the corner, or the steepest way is along a side.
            let along_sides = dot(slope, &next.along).f64().min(dot(slope, &back).f64()).min(0.0).abs();
            if inside { length(slope) } else { along_sides }
        }
    }
}

/// Weight of the shadow sphere with k raised to a least one, about a sphere of the bounding radius.
fn sphere_weight(particle: &Particle, least_sphericity: f64) -> Wide {
    let (k, shadow, radius) = (particle.sphericity(), particle.shadow_radius(), particle.bounding_radius());
    let own = if k == 0.0 { Wide::ZERO } else { Wide::from(k) / Wide::product(shadow, shadow) };
    own.max(Wide::from(least_sphericity) / Wide::product(radius, radius))
}

/// The least S of a particle whose sphericity is raised to `least_sphericity` (above 0, or k is) on a boundary.
pub fn least(particle: &Particle, at: &Place, boundary: &Boundary, least_sphericity: f64) -> Least {
    let plane = Plane::new(boundary, at);
    let m = sphere_weight(particle, least_sphericity);
    let reduced = Reduced::new(particle, &plane, m);
    // From a rounder particle to the given one, so that each search starts near its end.
    let mut y = [Wide::ZERO; 2];
    let (mut rounder, last) =
        (Reduced { m: reduced.w.max(m), rows: reduced.rows.clone(), plain: reduced.plain.clone(), ..reduced }, m.f64());
    while rounder.m.f64() > 1e4 * last {
        rounder.m = rounder.m * Wide::from(1e-3);
        y = rounder.on_plane(y);
    }
    y = reduced.on_plane(y);
    let mut candidates = Vec::new();
    let beyond = plane.corners.as_ref().is_some_and(|corners| {
        let from = |i: usize| [y[0] - corners[i][0], y[1] - corners[i][1]];
        edges(corners).iter().enumerate().any(|(i, edge)| dot(&edge.inwards, &from(i)).f64() < 0.0)
    });
    let sides = if plane.corners.is_some() { 3 } else { 0 };
    if !beyond {
        candidates.push(Candidate { y, part: Part::Inside, plane, reduced });
    }
    for i in 0..sides {
        let plane = Plane::along_edge(boundary, at, i);
        let reduced = Reduced::new(particle, &plane, m);
        let corners = plane.corners.as_ref().expect("a triangle has corners");
        let Edge { along: unit, length, .. } = &edges(corners)[i];
        let (t, end) = reduced.on_segment(&corners[i], unit, *length);
        let (y, part) = match end {
            None => (along(&corners[i], t, unit), Part::Edge(i)),
            Some(false) => (corners[i], Part::Vertex(i)),
            Some(true) => (corners[(i + 1) % 3], Part::Vertex((i + 1) % 3)),
        };
        candidates.push(Candidate { y, part, plane, reduced });
    }
    let value = |candidate: &Candidate| candidate.reduced.at(&candidate.y).value;
    let best = candidates
        .into_iter()
        .reduce(|best, other| if (value(&other) - value(&best)).f64() < 0.0 { other } else { best });
    finish(particle, &best.expect("a boundary has a part"))
}

fn finish(particle: &Particle, best: &Candidate) -> Least {
    let Candidate { plane, reduced, .. } = best;
    let edges = plane.corners.as_ref().map(edges);
    let at = reduced.at(&best.y);
    let slope = 2.0 * descent(&at.slope, best.part, edges.as_ref());
    let m = reduced.m.f64();
    let local = plane.local(&best.y);
    let s = at.value.f64().max(1.0).sqrt();
    let extent = plane.corners.as_ref().map_or(f64::INFINITY, |corners| {
        corners.iter().map(|c| length(&[c[0] - best.y[0], c[1] - best.y[1]])).fold(0.0, f64::max)
    });
    let within = extent.min(local.norm().f64() + particle.bounding_radius() * s * 4.0);
    let below = (slope * slope / (4.0 * m)).min(slope * within);
    let (mut gradient, mut pull, mut stiffness) = (local.times(reduced.m), 0.0, 3.0 * m);
    let planes: Vec<_> = particle.planes().collect();
    for (i, excess) in &at.active {
        let n = planes[*i].normal;
        gradient = gradient.plus(&Wide3::from(n).times(reduced.w * *excess));
        pull += 2.0 * reduced.w.f64() * excess.f64() * n.norm();
        stiffness += reduced.w.f64() * n.norm_squared();
    }
    let gradient = gradient.times(Wide::from(2.0));
    // What 32 digits of a place may do to S, to second order: near its least value S is flat.
    let place = 1e-30 * (plane.farthest + within);
    let rounding = (pull + gradient.norm().f64()) * place + stiffness * place * place;
    let doubt = match best.part {
        Part::Vertex(_) if slope == 0.0 => 0.0,
        Part::Vertex(_) => slope / m,
        Part::Inside => reduced.doubt(&best.y, None, slope),
        Part::Edge(i) => {
            let edge = &edges.as_ref().expect("an edge is one of a triangle")[i];
            let held = dot(&at.slope, &edge.inwards).f64() > 0.0;
            if held { reduced.doubt(&best.y, Some(&edge.along), slope) } else { slope / m }
        }
    };
    let root = |v: Wide| v.max(Wide::ZERO).sqrt().f64();
    Least {
        x: plane.world(&local),
        part: best.part,
        // As a double `below` is rounded, and so is its difference to a value that it nearly is.
        least: root(at.value - Wide::from(below * (1.0 + 1e-12) + rounding)),
        most: root(at.value + Wide::from(rounding)),
        doubt: if doubt.is_finite() { doubt } else { f64::INFINITY },
        gradient: plane.world(&gradient),
        bend: 2.0 * stiffness / gradient.norm().f64(),
    }
}
