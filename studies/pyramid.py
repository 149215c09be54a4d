# SPDX-License-Identifier: MIT OR Apache-2.0
"""The square pyramid of the falling-pyramids example: five planes, slightly rounded.

Local frame: z along the axis, towards the apex; origin at the centroid of the true, rounded
shape, which YADE wants there; x, y, z are principal axes of inertia by symmetry.
"""

import numpy as np

from potential_surface import PotentialSurface
from surface_mesh import surface_mesh

# All relative to the base edge, which is the size of the particle.
HEIGHT = 1.0
ROUNDING = 0.05
SPHERICITY = 0.02


class Pyramid:
    """A pyramid of base edge `size`: its surface, and mass properties for density 1."""

    def __init__(self, size, height=HEIGHT, rounding=ROUNDING, sphericity=SPHERICITY):
        self.size, self.height = size, height
        self.rounding, self.sphericity = rounding, sphericity
        below = 0.25 * height  # centroid of the sharp pyramid above its base
        while True:
            unit = _unit_surface(height, below, rounding, sphericity)
            volume, centroid, inertia = unit.mass_properties()
            if abs(centroid[2]) < 1e-8:
                break
            below += centroid[2]
        self.surface = PotentialSurface(
            unit.normals, unit.offsets * size, unit.r * size, unit.k, unit.R * size
        )
        self.volume = volume * size**3
        self.principal_inertia = np.diag(inertia) * size**5
        # Of a ball about the centre that holds it.
        self.ball_radius = float(np.linalg.norm(surface_mesh(self.surface)[0], axis=1).max())


def _unit_surface(height, below, r, k):
    """Pyramid of base edge 1 whose base plane lies `below` under the origin."""
    slope = np.hypot(height, 0.5)
    across, up = height / slope, 0.5 / slope
    normals = [(across, 0, up), (-across, 0, up), (0, across, up), (0, -across, up), (0, 0, -1)]
    side = 0.5 * across - below * up
    # Offsets reduced by r, as YADE has them: the rounding brings the faces back out.
    offsets = np.array([side] * 4 + [below]) - r
    # The shadow sphere passes near the corners, so that its share of S there is about k.
    shadow = np.sqrt(0.5 + below**2)
    return PotentialSurface(normals, offsets, r, k, shadow)
