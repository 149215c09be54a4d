//! The points of a contact at which its forces act: a rule that integrates quadratic functions over its polygon.
//!
//! The convex hull of the corners is cut into triangles from its centroid. A triangle of area A takes A/12 at each of
//! its corners and 3 A/4 at its centroid, which is exact to the second degree: stiffness against shifts and turns is
//! that of an elastic layer, so that splitting a polygon does not change it. The corners are points, since a block
//! turns over about them.

use super::scene::Contact;
use nalgebra::Vector3;

/// A point of a contact.
#[derive(Clone, Debug)]
pub(super) struct ContactPoint {
    pub at: Vector3<f64>,
    /// Its part of the area.
    pub share: f64,
    /// Corners and parts of a force here that, moved to these corners, have its resultant and its moment.
    pub onto: Vec<(usize, f64)>,
    /// Whether it is a corner. Without cohesion forces at corners have all resultants that the contact can have.
    pub is_corner: bool,
}

/// The points of a contact: shares add up to 1.
pub(super) fn points_of(contact: &Contact) -> Vec<ContactPoint> {
    let corners = &contact.corners;
    let normal = contact.normal.normalize();
    let order = contact.outline();
    let count = order.len();
    let place = |i: usize| corners[order[i % count]];
    let middle = order.iter().map(|i| corners[*i]).sum::<Vector3<f64>>() / count as f64;
    // Twice the area of the triangle from a point over each edge.
    let fan = |from: Vector3<f64>| -> Vec<f64> {
        (0..count).map(|i| (place(i) - from).cross(&(place(i + 1) - from)).dot(&normal).max(0.0)).collect()
    };
    if count < 3 {
        return on_a_line(corners, middle);
    }
    let areas = fan(middle);
    let total: f64 = areas.iter().sum();
    // The centroid as a mean of corners.
    let mut mean = vec![1.0 / (3.0 * count as f64); count];
    for (i, area) in areas.iter().enumerate() {
        mean[i] += area / (3.0 * total);
        mean[(i + 1) % count] += area / (3.0 * total);
    }
    let centroid: Vector3<f64> = mean.iter().enumerate().map(|(i, part)| *part * place(i)).sum();
    let areas = fan(centroid);
    let total: f64 = areas.iter().sum();
    let onto_all = |part: f64| -> Vec<_> { order.iter().zip(&mean).map(|(corner, of)| (*corner, part * of)).collect() };
    let mut found = vec![ContactPoint { at: centroid, share: 1.0 / 12.0, onto: onto_all(1.0), is_corner: false }];
    for (i, area) in areas.iter().enumerate() {
        let (share, before, next) = (area / total, areas[(i + count - 1) % count] / total, (i + 1) % count);
        let corner = order[i];
        found.push(ContactPoint {
            at: place(i),
            share: (before + share) / 12.0,
            onto: vec![(corner, 1.0)],
            is_corner: true,
        });
        let onto = [onto_all(1.0 / 3.0), vec![(corner, 1.0 / 3.0), (order[next], 1.0 / 3.0)]].concat();
        let at = (centroid + place(i) + place(next)) / 3.0;
        found.push(ContactPoint { at, share: 0.75 * share, onto, is_corner: false });
    }
    found.retain(|point| point.share > 0.0);
    found
}

/// Simpson's rule between the two corners farthest from each other; one point of corners in one place.
fn on_a_line(corners: &[Vector3<f64>], middle: Vector3<f64>) -> Vec<ContactPoint> {
    let farthest = |from: Vector3<f64>| {
        let far = |i: &usize, j: &usize| (corners[*i] - from).norm().total_cmp(&(corners[*j] - from).norm());
        (0..corners.len()).max_by(far).unwrap_or(0)
    };
    let first = farthest(middle);
    let last = farthest(corners[first]);
    let end =
        |corner: usize, share| ContactPoint { at: corners[corner], share, onto: vec![(corner, 1.0)], is_corner: true };
    if corners[first] == corners[last] {
        return vec![end(first, 1.0)];
    }
    let at = (corners[first] + corners[last]) / 2.0;
    let between = ContactPoint { at, share: 2.0 / 3.0, onto: vec![(first, 0.5), (last, 0.5)], is_corner: false };
    vec![end(first, 1.0 / 6.0), between, end(last, 1.0 / 6.0)]
}
