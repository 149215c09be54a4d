//! How force and torque change with the pose of A relative to B.
//!
//! With B held, the region of space that B governs changes at the patch alone, whose points move along G = ∇s_A − ∇s_B
//! by (∇s_A·δ)/|G| where A moves by δ. With the screws g = (∇s, x × ∇s), the change of force and torque on B is
//! therefore −ℓ ∫ g_B (g_A·δ)/|G| dΣ. For a rigid boundary the pressure alone changes, and −g_B/|G| is the screw of its
//! normal.

use super::field::Field;
use super::ray::Node;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// The integral over ℓ, as the sum over points of the patch, about the origin of the frame and in its axes: rows are
/// force and torque on B, columns shift and turn of A.
pub(super) fn stiffness(field: &Field, points: &[Node]) -> Matrix6<f64> {
    let mut sum = Matrix6::zeros();
    for node in points {
        let look = field.look(&node.x);
        // ∇s = ∇S/2s.
        let [of_a, of_b] = [0, 1].map(|i| Vector3::from(look.gradients[i]) / (2.0 * look.s[i].sqrt()));
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
