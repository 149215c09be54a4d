# SPDX-License-Identifier: GPL-3.0-or-later
"""Principal axes of inertia, as near to the axes of a given frame as they can be."""
import numpy as np
from scipy.spatial.transform import Rotation

# Moments of inertia that differ by less than this share belong to one axis of symmetry, about which any axis is principal:
# some times the error to which they are known.
EQUAL = 2e-5


def principal_axes(inertia):
    """Rotation (3, 3) whose columns are principal axes of a symmetric matrix, and the moments about them (3,).

    Column i is the axis nearest to the i-th axis of the frame. Where moments are equal, and any axes of a plane or of space are
    principal, those nearest to the frame's own are taken: a cube or a sphere keeps its frame.
    """
    moments, vectors = np.linalg.eigh(inertia)
    groups = np.cumsum(np.diff(moments, prepend=moments[0]) > EQUAL * moments[2])
    rotation = np.empty((3, 3))
    left = [0, 1, 2]
    # Single axes first: what is left for a group of equal moments is then the plane across.
    for group in sorted(set(groups), key=lambda one: np.count_nonzero(groups == one)):
        basis = vectors[:, groups == group]
        nearness = np.linalg.norm(basis[left], axis=1)
        chosen = sorted(np.array(left)[np.argsort(-nearness, kind="stable")[:basis.shape[1]]])
        left = [axis for axis in left if axis not in chosen]
        # The orthonormal axes of the subspace nearest to the chosen axes of the frame.
        u, _, v = np.linalg.svd(basis.T[:, chosen])
        rotation[:, chosen] = basis @ (u @ v)
    if np.linalg.det(rotation) < 0.0:
        turned = int(np.argmin(np.diag(rotation)))
        rotation[:, turned] *= -1.0
    # Axes that are those of the frame up to the error of the moments are those of the frame.
    if np.abs(rotation - np.eye(3)).max() < EQUAL:
        rotation = np.eye(3)
    return rotation, np.diag(rotation.T @ inertia @ rotation)


def quaternion(rotation):
    """(w, x, y, z), w >= 0, of a rotation matrix."""
    x, y, z, w = Rotation.from_matrix(rotation).as_quat()
    return np.array([w, x, y, z]) if w >= 0.0 else -np.array([w, x, y, z])
