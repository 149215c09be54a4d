//! The elastic energy of a patch as an integral over the patch.
//!
//! The vector field F(x) = −ŷ/|y|² ∫ (1 − s) τ² dτ, y from the centre of a body to x and τ along ŷ from |y| to the
//! surface, has the divergence 1 − s and vanishes on the surface (in the plane, with τ and |y| in place of their
//! squares). What lies between the patch and the surface of A therefore holds ∫ −F·n dΣ, and likewise for B. So the
//! energies of the pieces of a boundary add up, in whatever pieces it is given.

use super::field::{Field, Owner, Placed, dot};
use super::numbers::{ENERGY_POINTS, Limits};
use super::ray::Node;
use super::rules::gauss;

/// −F·n of A, and of B where there is one, at a node, for the normal whose z is 1. As an error, the distance of a point
/// beyond that within which all planes are loaded.
pub(super) fn density(field: &Field, node: &Node) -> Result<f64, f64> {
    let normal = [node.normal[0], node.normal[1], 1.0];
    let of_a = outwards(field, &field.a, Owner::A, &node.x, &normal)?;
    match &field.b {
        Some(b) => Ok(of_a + outwards(field, b, Owner::B, &node.x, &normal.map(|c| -c))?),
        None => Ok(of_a),
    }
}

fn outwards(field: &Field, body: &Placed, owner: Owner, x: &[f64; 3], normal: &[f64; 3]) -> Result<f64, f64> {
    let y: [f64; 3] = std::array::from_fn(|i| body.from_centre[i] + x[i]);
    let length = dot(&y, &y).sqrt();
    if !(length > 0.0) {
        return Ok(0.0);
    }
    let direction = y.map(|c| c / length);
    let planes = field.planes.iter().filter(|plane| plane.owner == owner).map(|plane| {
        let [excess, rate] = [plane.excess + dot(&plane.normal, x), dot(&plane.normal, &direction)];
        (excess, rate)
    });
    let power = if field.is_in_plane() { 1 } else { 2 };
    let (w, m) = (body.plane_weight, body.sphere_weight);
    let (mut from, mut sum) = (0.0, 0.0);
    let rule = &gauss(ENERGY_POINTS).nodes[..ENERGY_POINTS];
    for _ in 0..Limits::ENERGY_CELLS {
        // The quadratic from here on, and the next place where a plane goes on or off.
        let (mut value, mut slope, mut square) = (m * (length + from).powi(2), 2.0 * m * (length + from), m);
        let mut next = f64::INFINITY;
        for (excess, rate) in planes.clone() {
            let place = -excess / rate;
            let is_active = match rate {
                _ if rate > 0.0 => place <= from,
                _ if rate < 0.0 => place > from,
                _ => excess > 0.0,
            };
            if is_active {
                let here = (excess + rate * from).max(0.0);
                value += w * here * here;
                slope += 2.0 * w * here * rate;
                square += w * rate * rate;
            }
            if place > from {
                next = next.min(place);
            }
        }
        let root = (slope * slope - 4.0 * square * (value - 1.0)).sqrt();
        let end = -2.0 * (value - 1.0) / (slope + root);
        let is_last = !(from + end > next);
        let step = if is_last { end.max(0.0) } else { next - from };
        let away: [f64; 3] = std::array::from_fn(|i| x[i] + (from + step) * direction[i]);
        let distance = dot(&away, &away).sqrt();
        if distance > field.loaded() {
            return Err(distance);
        }
        for (place, weight) in rule {
            let t = place * step;
            let scale = (value + t * (slope + square * t)).max(0.0).sqrt();
            sum += weight * step * (1.0 - scale) * (1.0 + (from + t) / length).powi(power);
        }
        if is_last {
            break;
        }
        from = next;
    }
    Ok(sum * dot(&direction, normal))
}
