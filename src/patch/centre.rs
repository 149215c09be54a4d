//! Where the rays of a patch start, and in which directions the first ones go.

use super::field::{Field, Owner};
use super::ray::{Line, Walker};

/// The axis of the frame's plane along which S_A and S_B, weighted so that their gradients cancel, curve least at the
/// origin: along an edge, or the major axis of a small ellipse. The u axis if no axis is flattest.
pub(super) fn flattest_axis(field: &Field) -> [f64; 2] {
    let [(_, rise), (_, fall)] = field.values(&[0.0; 3]);
    let (of_a, of_b) = if field.b.is_some() { (fall.abs(), rise.abs()) } else { (1.0, 0.0) };
    let weight = |owner: Owner| field.plane_weight(owner) * if owner == Owner::A { of_a } else { of_b };
    let (mut difference, mut mixed) = (0.0, 0.0);
    for plane in field.planes.iter().filter(|plane| plane.owner != Owner::Edge && plane.excess > 0.0) {
        let [u, v, _] = plane.normal;
        difference += weight(plane.owner) * (u * u - v * v);
        mixed += weight(plane.owner) * u * v;
    }
    if difference == 0.0 && mixed == 0.0 {
        return [1.0, 0.0];
    }
    let steepest = 0.5 * (2.0 * mixed).atan2(difference);
    [-steepest.sin(), steepest.cos()]
}

/// A point in the middle of the patch: from a point of it to the centre of the load on the line along an axis, then on
/// the line across it. And a rough ∫ p ρ dρ over the four rays from there along both.
pub(super) fn middle(walker: &mut Walker, start: [f64; 3], axis: [f64; 2]) -> ([f64; 3], f64) {
    let (mut at, mut rough) = (start, 0.0);
    for direction in [axis, [-axis[1], axis[0]]] {
        let (mut load, mut moment, mut length) = (0.0, 0.0, 0.0);
        walker.nodes.clear();
        for sign in [1.0, -1.0] {
            let line = Line { origin: at, direction: direction.map(|c| sign * c), is_polar: false };
            let ray = walker.walk(&line);
            length += ray.length();
            for node in &walker.nodes[ray.nodes.0 as usize..ray.nodes.1 as usize] {
                let along = direction[0] * (node.x[0] - at[0]) + direction[1] * (node.x[1] - at[1]);
                load += node.weight * node.pressure;
                moment += node.weight * node.pressure * along;
            }
        }
        rough += 0.25 * load * length;
        if load > 0.0 {
            let nearest = walker.nodes.iter().min_by(|a, b| {
                let off = |x: &[f64; 3]| {
                    let along = direction[0] * (x[0] - at[0]) + direction[1] * (x[1] - at[1]);
                    (along - moment / load).abs()
                };
                off(&a.x).total_cmp(&off(&b.x))
            });
            let [u, v] = [at[0] + direction[0] * moment / load, at[1] + direction[1] * moment / load];
            at = on_patch(walker.field, u, v, nearest.map_or(at[2], |node| node.x[2])).unwrap_or(at);
        }
    }
    (at, rough)
}

/// The point of the patch above a point of the plane of the frame.
pub(super) fn on_patch(field: &mut Field, u: f64, v: f64, from: f64) -> Option<[f64; 3]> {
    if field.b.is_none() {
        return Some([u, v, 0.0]);
    }
    let distance = u.hypot(v).hypot(from);
    if distance > field.loaded() {
        field.load(2.0 * distance);
    }
    field.height(u, v, from).map(|z| [u, v, z])
}
