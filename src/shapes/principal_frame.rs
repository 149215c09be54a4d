//! Principal axes of inertia, as near to the axes of the given frame as they can be.

use super::numbers::EQUAL_MOMENTS;
use nalgebra::{Matrix2, Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Rotation whose columns are principal axes, column i the one nearest to axis i of the frame. Where moments are equal,
/// and any axes of a plane or of space are principal, those nearest to the frame's own are taken: a cube or a sphere
/// keeps its frame.
fn axes(inertia: &Matrix3<f64>) -> Matrix3<f64> {
    let eigen = inertia.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let moment = |i: usize| eigen.eigenvalues[order[i]];
    let is_equal = |i: usize| moment(i + 1) - moment(i) <= EQUAL_MOMENTS * moment(2);
    let vector = |i: usize| eigen.eigenvectors.column(order[i]).into_owned();
    let rotation = match [is_equal(0), is_equal(1)] {
        [true, true] => Matrix3::identity(),
        [false, false] => assigned(&[vector(0), vector(1), vector(2)]),
        [first, _] => about(&vector(if first { 2 } else { 0 })),
    };
    let mut rotation = rotation;
    if rotation.determinant() < 0.0 {
        let turned = (0..3).min_by(|&i, &j| rotation[(i, i)].total_cmp(&rotation[(j, j)])).unwrap_or(0);
        rotation.column_mut(turned).neg_mut();
    }
    // Axes that are those of the frame up to the error of the moments are those of the frame.
    if (rotation - Matrix3::identity()).amax() < EQUAL_MOMENTS { Matrix3::identity() } else { rotation }
}

/// The same, and the quaternion (w, x, y, z), w ≥ 0, from them to the frame.
pub fn principal_orientation(inertia: &Matrix3<f64>) -> (Matrix3<f64>, [f64; 4]) {
    let axes = axes(inertia);
    let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    let sign = if quaternion.w < 0.0 { -1.0 } else { 1.0 };
    (axes, [quaternion.w, quaternion.i, quaternion.j, quaternion.k].map(|c| sign * c))
}

/// Three axes in the order and with the signs in which they are nearest to the frame's.
fn assigned(vectors: &[Vector3<f64>; 3]) -> Matrix3<f64> {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let nearness = |order: &[usize; 3]| (0..3).map(|axis| vectors[order[axis]][axis].abs()).sum::<f64>();
    let best = orders.into_iter().max_by(|a, b| nearness(a).total_cmp(&nearness(b))).unwrap_or([0, 1, 2]);
    let columns = [0, 1, 2].map(|axis| {
        let vector = vectors[best[axis]];
        if vector[axis] < 0.0 { -vector } else { vector }
    });
    Matrix3::from_columns(&columns)
}

/// One axis of symmetry, and across it the axes nearest to those of the frame that are left.
fn about(axis: &Vector3<f64>) -> Matrix3<f64> {
    let along = axis.iamax();
    let axis = if axis[along] < 0.0 { -axis } else { *axis };
    let left = [(along + 1) % 3, (along + 2) % 3];
    let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let basis = [first, axis.cross(&first)];
    // The orthonormal axes of the plane nearest to the chosen axes of the frame (Procrustes).
    let nearest = Matrix2::from_fn(|i, j| basis[i][left[j]]).svd(true, true);
    let turn = match (nearest.u, nearest.v_t) {
        (Some(u), Some(v_t)) => u * v_t,
        _ => Matrix2::identity(),
    };
    let mut rotation = Matrix3::zeros();
    rotation.set_column(along, &axis);
    for j in 0..2 {
        rotation.set_column(left[j], &(basis[0] * turn[(0, j)] + basis[1] * turn[(1, j)]));
    }
    rotation
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_principal_and_nearest() {
        let tilt = Rotation3::from_euler_angles(0.2, -0.3, 0.1).into_inner();
        for moments in [[1.0, 2.0, 3.0], [3.0, 1.0, 2.0], [2.0, 2.0, 1.0], [1.0, 2.0, 2.0]] {
            let inertia = tilt * Matrix3::from_diagonal(&Vector3::from(moments)) * tilt.transpose();
            let axes = axes(&inertia);
            let about = axes.tr_mul(&(inertia * axes));
            assert!((about - Matrix3::from_diagonal(&about.diagonal())).amax() < 1e-12, "{about}");
            assert!((axes.determinant() - 1.0).abs() < 1e-12 && axes.diagonal().min() > 0.9, "{axes}");
        }
        assert_eq!(axes(&Matrix3::from_diagonal(&Vector3::repeat(2.0))), Matrix3::identity());
    }
}
