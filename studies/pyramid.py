# SPDX-License-Identifier: MIT OR Apache-2.0
"""The square pyramid of the falling-pyramids example: five planes, slightly rounded.

Local frame: z along the axis, towards the apex; origin at the centroid of the true, rounded
shape, which YADE wants there; x, y, z are principal axes of inertia by symmetry.
"""

import numpy as np
from potential_particles import ConicPotentialParticle

from bodies import MASS_TOLERANCE, shape_of_planes

# All relative to the base edge, which is the size of the particle.
HEIGHT = 1.0
ROUNDING = 0.05
SPHERICITY = 0.02


def pyramid(size, rounding=ROUNDING, sphericity=SPHERICITY):
    """The Shape of a pyramid of base edge `size` (m); rounding relative to it."""
    below = 0.25 * HEIGHT  # centroid of the sharp pyramid above its base
    while True:
        normals, offsets, r, k, R = unit = _unit(below, rounding, sphericity)
        planes = np.column_stack([normals, offsets]).tolist()
        shift = ConicPotentialParticle(planes=planes, r=r, k=k, R=R).massProperties(MASS_TOLERANCE)[1][2]
        if abs(shift) < 1e-8:
            return shape_of_planes(*unit, name="pyramid").scaled(size)
        below += shift


def _unit(below, r, k):
    """Normals, offsets, r, k and R of a pyramid of base edge 1 whose base plane lies `below` under the origin."""
    slope = np.hypot(HEIGHT, 0.5)
    across, up = HEIGHT / slope, 0.5 / slope
    normals = [(across, 0, up), (-across, 0, up), (0, across, up), (0, -across, up), (0, 0, -1)]
    side = 0.5 * across - below * up
    # Offsets reduced by r, as YADE has them: the rounding brings the faces back out.
    offsets = np.array([side] * 4 + [below]) - r
    # The shadow sphere passes near the corners, so that its share of S there is about k.
    return normals, offsets, r, k, np.sqrt(0.5 + below**2)
