# SPDX-License-Identifier: MIT OR Apache-2.0
"""An open box for YADE scenes: a floor and four walls, each a fixed slab that is a particle too.

A slab is a potential particle of six planes. Its rounding radius equals half its thickness, so
that its core is a thin plate in its middle and the potential rises all the way from there to the
surface: the contact normal stays right for overlaps up to that half thickness, many times what
occurs. Slabs reach beyond the inside of the box by more than their rounding, so that bodies only
ever meet flat parts.
"""

from dataclasses import dataclass

import numpy as np

from bodies import potential_body, shape_of_planes

# Functors that need k > 0 get just enough: the faces bulge by less than k/2 of the half
# thickness, and their normals turn by less than k radians.
SLAB_SPHERICITY = 1e-6
SLAB_NORMALS = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)

# Collision masks: slabs share a bit that bodies lack, by which the collider skips slab pairs.
BODY_MASK, SLAB_MASK, SLAB_ONLY = 0b01, 0b11, 0b10


@dataclass
class Box:
    """Inside dimensions in m: x in [-half_x, half_x], y alike, z from 0 to `height`."""

    half_x: float
    half_y: float
    height: float
    thickness: float  # of the slabs

    def slabs(self, shape_class, material):
        """Five bodies: the floor, then the walls at -x, +x, -y, +y."""
        half = 0.5 * self.thickness
        wide_x, wide_y = self.half_x + 2.0 * self.thickness, self.half_y + 2.0 * self.thickness
        tall = 0.5 * self.height + self.thickness
        middle = 0.5 * self.height - half
        blocks = [((0.0, 0.0, -half), (wide_x, wide_y, half))]
        blocks += [((side * (self.half_x + half), 0.0, middle), (half, wide_y, tall)) for side in (-1, 1)]
        blocks += [((0.0, side * (self.half_y + half), middle), (wide_x, half, tall)) for side in (-1, 1)]
        return [_slab(shape_class, material, centre, half_size, half) for centre, half_size in blocks]

    def lost(self, positions):
        """Masks of the positions (n, 3) below the floor, and of those outside the walls."""
        x, y, z = positions.T
        inside = (np.abs(x) <= self.half_x) & (np.abs(y) <= self.half_y)
        # Written so that a position that is not a number counts as lost.
        return ~(z >= 0.0), ~inside


def _slab(shape_class, material, centre, half_size, rounding):
    """A fixed slab; half_size along x, y, z, m."""
    half_size = np.asarray(half_size)
    offsets = np.repeat(half_size - rounding, 2)
    shape = shape_of_planes(SLAB_NORMALS, offsets, rounding, SLAB_SPHERICITY, np.linalg.norm(half_size), "slab")
    return potential_body(shape_class, shape, material, centre, isBoundary=True, fixed=True, mask=SLAB_MASK)
