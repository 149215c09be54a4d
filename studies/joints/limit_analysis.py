# SPDX-License-Identifier: GPL-3.0-or-later
"""The largest load that rigid blocks on joints without tension can carry: the static theorem of limit analysis, a
linear program.

Each corner of a joint carries a force in a cone of friction, here a pyramid of DIRECTIONS sides inside it. A joint with
its force at the corners resists twist
more than one with a pressure over its area, and sliding is taken as if it opened the joint: both make the limit an
upper bound where twist or sliding decides. Where blocks rock it is exact.
"""
import numpy as np
from scipy.optimize import linprog

DIRECTIONS = 32


class Joint:
    """Between two stones: the corners of the face on which they meet, its normal from the first to the second."""

    def __init__(self, first, second, corners, normal):
        self.stones, self.corners = (first, second), np.asarray(corners, float)
        self.normal = np.asarray(normal, float) / np.linalg.norm(normal)

    def forces(self, friction):
        """The edges of the pyramid of friction: forces on the second stone."""
        across = np.cross(self.normal, np.eye(3)[np.argmin(abs(self.normal))])
        across /= np.linalg.norm(across)
        angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        return self.normal + friction * (np.outer(np.cos(angles), across)
                                         + np.outer(np.sin(angles), np.cross(self.normal, across)))


def largest_load(centroids, weights, joints, friction, load):
    """The largest a for which stones of these weights, with forces a * load besides, are in equilibrium. Stones: rows
    of `centroids`; others are fixed.
    """
    columns = []
    for joint in joints:
        forces = joint.forces(friction)
        for corner in joint.corners:
            block = np.zeros((6 * len(centroids), len(forces)))
            for stone, sign in zip(joint.stones, (-1, 1)):
                if stone < len(centroids):
                    block[6 * stone:6 * stone + 3] = sign * forces.T
                    block[6 * stone + 3:6 * stone + 6] = sign * np.cross(corner - centroids[stone], forces).T
            columns.append(block)
    of_load, of_weight = np.zeros((len(centroids), 6)), np.zeros((len(centroids), 6))
    of_load[:, :3], of_weight[:, 2] = load, -np.asarray(weights)
    equilibrium = np.column_stack(columns + [of_load.ravel()])
    scale = max(weights)
    cost = np.zeros(equilibrium.shape[1])
    cost[-1] = -1
    found = linprog(cost, A_eq=equilibrium / scale, b_eq=-of_weight.ravel() / scale, bounds=(0, None), method="highs")
    if found.status == 2:
        return 0.0
    if found.status:
        raise RuntimeError(f"the limit was not found: {found.message}")
    return -found.fun
