//! Convex polygons of a plane.

use crate::linalg::polygon;
use nalgebra::{Vector2, Vector3};

/// Two unit vectors across a unit normal, which make a right-handed frame with it.
pub(super) fn axes_across(normal: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let u = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    [u, normal.cross(&u)]
}

/// Takes from a convex polygon, corners in order, what lies where a linear function is below 0.
pub(super) fn clip(corners: &mut Vec<Vector2<f64>>, inside: impl Fn(&Vector2<f64>) -> f64) {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    polygon::clip(corners, &mut kept, |at| -inside(at), |from, to, part, _| from + part * (to - from));
    *corners = kept;
}

/// Signed area that the triangle of the origin, a and b shares with a circle about the origin: counter-clockwise counts
/// positive.
pub(super) fn within_circle(radius: f64, a: &Vector2<f64>, b: &Vector2<f64>) -> f64 {
    // By the difference, which keeps its digits far from the origin.
    let cross = |p: &Vector2<f64>, q: &Vector2<f64>| p.perp(&(q - p));
    let way = b - a;
    let (square, middle) = (way.norm_squared(), -a.dot(&way));
    if radius == f64::INFINITY || square == 0.0 {
        return 0.5 * cross(a, b);
    }
    let sector = |p: &Vector2<f64>, q: &Vector2<f64>| 0.5 * radius * radius * cross(p, q).atan2(p.dot(q));
    // Where the line from a to b enters the circle and leaves it, in parts of the way.
    let rest = middle * middle - square * (a.norm_squared() - radius * radius);
    let [enters, leaves] = [-1.0, 1.0].map(|sign| ((middle + sign * rest.max(0.0).sqrt()) / square).clamp(0.0, 1.0));
    if !(rest > 0.0) || leaves <= enters {
        return sector(a, b);
    }
    let [p, q] = [enters, leaves].map(|t| a + t * way);
    let before = if enters > 0.0 { sector(a, &p) } else { 0.0 };
    let after = if leaves < 1.0 { sector(&q, b) } else { 0.0 };
    before + 0.5 * cross(&p, &q) + after
}
