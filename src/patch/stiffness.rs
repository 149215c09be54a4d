//! How force and torque change with the pose of A relative to B.
//!
//! With B held, the region of space that B governs changes at the patch alone, whose points move along G = ∇s_A − ∇s_B
//! by (∇s_A·δ)/|G| where A moves by δ. With the screws g = (∇s, x × ∇s), the change of force and torque on B is
//! therefore −ℓ ∫ g_B (g_A·δ)/|G| dΣ. For a rigid boundary the pressure alone changes, and −g_B/|G| is the screw of its
//! normal.

use super::field::{Field, Owner, dot};
use super::ray::Node;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// The integral over ℓ, as the sum over points of the patch, about the origin of the frame and in its axes: rows are
/// force and torque on B, columns shift and turn of A.
pub(super) fn stiffness(field: &Field, points: &[Node]) -> Matrix6<f64> {
    let mut sum = Matrix6::zeros();
    for node in points {
        let [of_a, of_b] = gradients(field, &node.x);
        let pushed = match field.b {
            Some(_) => -node.weight / (of_a.z - of_b.z) * of_b,
            None => node.weight * Vector3::new(node.normal[0], node.normal[1], 1.0),
        };
        let x = Vector3::from(node.x);
        let screw = |v: &Vector3<f64>| {
            let turn = x.cross(v);
            Vector6::new(v.x, v.y, v.z, turn.x, turn.y, turn.z)
        };
        sum.ger(1.0, &screw(&pushed), &screw(&of_a), 1.0);
    }
    sum
}

/// A stiffness, turned to the frame in which its axes are these columns.
pub(super) fn turned(stiffness: &Matrix6<f64>, axes: &Matrix3<f64>) -> Matrix6<f64> {
    let mut turned = Matrix6::zeros();
    for (row, column) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
        let block = axes * stiffness.fixed_view::<3, 3>(row, column) * axes.transpose();
        turned.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    }
    turned
}

/// ∇s_A and ∇s_B (0 where there is none) at a point of the frame.
fn gradients(field: &Field, x: &[f64; 3]) -> [Vector3<f64>; 2] {
    let mut sums = [(0.0, Vector3::zeros()); 2];
    for plane in field.planes.iter().filter(|plane| plane.owner != Owner::Edge) {
        let excess = plane.excess + dot(&plane.normal, x);
        if excess > 0.0 {
            let sum = &mut sums[usize::from(plane.owner == Owner::B)];
            sum.0 += excess * excess;
            sum.1 += excess * Vector3::from(plane.normal);
        }
    }
    let mut gradients = [Vector3::zeros(); 2];
    for (i, body) in [Some(&field.a), field.b.as_ref()].into_iter().enumerate() {
        let Some(body) = body else { continue };
        let y: Vector3<f64> = Vector3::from(body.from_centre) + Vector3::from(*x);
        let (w, m) = (body.plane_weight, body.sphere_weight);
        let s = (w * sums[i].0 + m * y.norm_squared()).sqrt();
        gradients[i] = (w * sums[i].1 + m * y) / s;
    }
    gradients
}
