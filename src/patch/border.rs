//! A flat part with whatever lies around it: rays from the border of the polygon outwards, across its sides and spread at its corners.
//!
//! What the zones do not cover, as where edges of both bodies coincide, is walked over here without the flat part.

use super::chart::{normal, radius};
use super::field::Owner;
use super::pieces::Estimate;
use super::polygon::{Corner, Level, integrate};
use super::ray::{Line, Node, RIM, Ray, Walker};
use super::rules::GAUSS_KRONROD;
use super::smoothness::norm;

/// Part of the load of a side or a corner by which one ray is wrong at most, about.
const SINGLE: f64 = 0.3;

/// Part of the tolerance that a rule on a ray may take.
const RADIAL: f64 = 0.2;

/// Part of the tolerance that all may take.
const SHARE: f64 = 0.9;

/// Cosine of the angle between sides from which on they count as one straight line.
const STRAIGHT: f64 = 0.98;

/// Part of the load next to a skew corner that the other side changes, about.
const CHANGED: f64 = 0.2;

/// A set of rays: across a side, or from a corner.
struct Spread {
    from: [f64; 2],
    to: [f64; 2],
    /// The directions at both ends.
    directions: [[f64; 2]; 2],
    /// Length of the side, or the angle.
    size: f64,
    is_polar: bool,
    /// |cos| of the angles of the polygon at both ends of a side: so far, over the length of a ray, the next side interferes.
    skew: f64,
}

/// Fills `points`; `None` where the error is above the tolerance.
pub(super) fn around(
    walker: &mut Walker,
    level: &Level,
    polygon: &[Corner],
    tolerance: f64,
    points: &mut Vec<Node>,
) -> Option<Estimate> {
    points.clear();
    walker.nodes.clear();
    integrate(level, polygon, points)?;
    let force: f64 = points.iter().map(|node| node.weight * node.pressure).sum();
    let perimeter: f64 = sides(polygon).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum();
    walker.budget = RADIAL * tolerance * force / perimeter;
    let share = SHARE * (1.0 - RADIAL) * tolerance * force / (2.0 * polygon.len() as f64);
    let mut estimate = Estimate::default();
    for k in 0..polygon.len() {
        estimate.force += overhang(walker, level, polygon, k);
        for spread in [side(walker, polygon, k), corner(walker, polygon, k)].into_iter().flatten() {
            let (force, area, rays) = spread.integrate(walker, level, share, points)?;
            estimate.rays += rays;
            estimate.force += force;
            estimate.area += area;
        }
    }
    (estimate.force <= tolerance * force).then_some(estimate)
}

fn sides(polygon: &[Corner]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    (0..polygon.len()).map(|k| (polygon[k].at, polygon[(k + 1) % polygon.len()].at))
}

/// The direction of a side; `None` of one without length.
fn direction(polygon: &[Corner], k: usize) -> Option<[f64; 2]> {
    let (a, b) = (polygon[k % polygon.len()].at, polygon[(k + 1) % polygon.len()].at);
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    (length > 0.0).then(|| [(b[0] - a[0]) / length, (b[1] - a[1]) / length])
}

fn outwards([u, v]: [f64; 2]) -> [f64; 2] {
    [v, -u]
}

fn owner(walker: &Walker, side: u32) -> Option<Owner> {
    walker.field.planes.get(side as usize).map(|plane| plane.owner)
}

fn side(walker: &Walker, polygon: &[Corner], k: usize) -> Option<Spread> {
    owner(walker, polygon[k].side).filter(|owner| *owner != Owner::Edge)?;
    let (from, to) = (polygon[k].at, polygon[(k + 1) % polygon.len()].at);
    let out = outwards(direction(polygon, k)?);
    let size = (to[0] - from[0]).hypot(to[1] - from[1]);
    let along = direction(polygon, k)?;
    let others = [k + polygon.len() - 1, k + 1].map(|k| direction(polygon, k));
    let cosines = others.map(|other| other.map_or(0.0, |d| (d[0] * along[0] + d[1] * along[1]).abs()));
    // Sides that go on nearly straight are one.
    let skew = cosines.iter().filter(|c| **c < STRAIGHT).sum();
    Some(Spread { from, to, directions: [out; 2], size, is_polar: false, skew })
}

/// Estimate of ∫ p beyond the ends of a side at which s = 1: no ray starts there, yet p may rise outwards from the line of the side.
///
/// Outwards p changes by rise·u − curvature·u²/2, and along the line it falls at a constant rate.
fn overhang(walker: &Walker, level: &Level, polygon: &[Corner], k: usize) -> f64 {
    let side = polygon[k].side;
    let owner = owner(walker, side).filter(|owner| *owner != Owner::Edge);
    let (Some(owner), Some(along)) = (owner, direction(polygon, k)) else { return 0.0 };
    let out = outwards(along);
    let [rise, along_side] = [out, along].map(|[u, v]| level.pressure[1] * u + level.pressure[2] * v);
    if !(rise > 0.0) {
        return 0.0;
    }
    let n = normal(&walker.field.planes[side as usize]);
    let curvature = ((n.x * out[0] + n.y * out[1]) / radius(walker.field, owner)).powi(2);
    let count = polygon.len();
    let ends = [(polygon[(k + count - 1) % count].side, along_side), (polygon[(k + 1) % count].side, -along_side)];
    let at_rim = ends.into_iter().filter(|(next, _)| *next == RIM);
    at_rim.map(|(_, fall)| 0.1 * rise.powi(5) / (curvature.powi(3) * fall.max(0.0))).sum()
}

/// What lies between the rays across two sides, or across a side and the edge of a triangle.
fn corner(walker: &Walker, polygon: &[Corner], k: usize) -> Option<Spread> {
    let next = (k + 1) % polygon.len();
    let numbers = [polygon[k].side, polygon[next].side];
    if numbers.contains(&RIM) {
        return None;
    }
    let [before, after] = [direction(polygon, k)?, direction(polygon, next)?];
    let is_edge = numbers.map(|side| owner(walker, side) == Some(Owner::Edge));
    let first = if is_edge[0] { before } else { outwards(before) };
    let last = if is_edge[1] { after.map(|c| -c) } else { outwards(after) };
    let size = (first[0] * last[1] - first[1] * last[0]).atan2(first[0] * last[0] + first[1] * last[1]);
    let at = polygon[next].at;
    (size > 0.0 && is_edge != [true; 2]).then_some(Spread {
        from: at,
        to: at,
        directions: [first, last],
        size,
        is_polar: true,
        skew: 0.0,
    })
}

impl Spread {
    fn line(&self, level: &Level, t: f64) -> Line {
        let at = [0, 1].map(|c| self.from[c] + t * (self.to[c] - self.from[c]));
        let [first, last] = self.directions;
        let direction = if self.is_polar {
            let (sin, cos) = (t * self.size).sin_cos();
            [first[0] * cos - first[1] * sin, first[1] * cos + first[0] * sin]
        } else {
            last
        };
        Line { origin: level.point(&at).into(), direction, is_polar: self.is_polar }
    }

    /// One, three or seven rays, until the error is within its share; the errors of force and area, and the number of rays.
    fn integrate(
        &self,
        walker: &mut Walker,
        level: &Level,
        share: f64,
        points: &mut Vec<Node>,
    ) -> Option<(f64, f64, usize)> {
        let mut rays: [Option<Ray>; 7] = [None; 7];
        let mut coarse = [0.0; 4];
        let mut error = (0.0, 0.0);
        let mut last = 1;
        for (round, count) in [1, 3, 7].into_iter().enumerate() {
            last = count;
            let mut fine = [0.0; 4];
            let mut radial = 0.0;
            for (i, ray) in rays[..count].iter_mut().enumerate() {
                let weight = self.size * weight(round, i);
                if ray.is_none() {
                    *ray = Some(walker.walk(&self.line(level, GAUSS_KRONROD[i].0)))
                        .filter(|ray| !(ray.is_tilted || ray.is_folded));
                }
                let ray = ray.as_ref()?;
                radial += weight * ray.error;
                let sums = [ray.sums[0], ray.sums[1], ray.sums[2], ray.sums[6]];
                fine.iter_mut().zip(sums).for_each(|(sum, value)| *sum += weight * value);
            }
            let (size, off) = (norm(&fine[..3]), norm(&[0, 1, 2].map(|j| fine[j] - coarse[j])));
            let first = rays[0].as_ref()?;
            let alike = rays[..count].iter().flatten().all(|ray| ray.is_like(first));
            let least = if alike { 0.02 } else { 1.0 };
            let of = |off: f64, size: f64| if off > 0.0 { off * (2.0 * off / size).clamp(least, 1.0) } else { 0.0 };
            let reach = first.length();
            let radial = radial + CHANGED * self.skew * reach * first.sums[2];
            error = if count == 1 {
                (radial + SINGLE * size, SINGLE * fine[3])
            } else {
                (radial + of(off, size), of((fine[3] - coarse[3]).abs(), fine[3]))
            };
            if error.0 <= share {
                break;
            }
            coarse = fine;
        }
        for (i, ray) in rays[..last].iter().flatten().enumerate() {
            let weight = self.size * weight(usize::from(last > 1) + usize::from(last > 3), i);
            let nodes = &walker.nodes[ray.nodes.0 as usize..ray.nodes.1 as usize];
            points.extend(nodes.iter().map(|node| Node { weight: weight * node.weight, ..*node }));
        }
        Some((error.0, error.1, last))
    }
}

/// The weight of a ray among one, three or seven.
fn weight(round: usize, i: usize) -> f64 {
    match round {
        0 => 1.0,
        1 => GAUSS_KRONROD[i].1,
        _ => GAUSS_KRONROD[i].2,
    }
}
