# SPDX-License-Identifier: MIT OR Apache-2.0
"""What is cut: a convex domain, less regions that are left out."""
import dataclasses
import math
import typing

import numpy as np

from .._core import _slicing
from ..arguments import MOST_PLANES, positive, rows, vector, whole
from .joints import joint


@dataclasses.dataclass(frozen=True, eq=False)
class Domain:
    """{x : a x + b y + c z <= d for all planes}, convex, without the convex regions that were left out.

    planes: rows (a, b, c, d), outward normals of any length. Regions for slice() are Domains, too.
    """

    planes: typing.Any
    left_out: tuple = ()

    #: Planes of box(): west and east (x), south and north (y), bottom and top (z).
    WEST: typing.ClassVar[int] = 1
    EAST: typing.ClassVar[int] = 0
    SOUTH: typing.ClassVar[int] = 3
    NORTH: typing.ClassVar[int] = 2
    BOTTOM: typing.ClassVar[int] = 5
    TOP: typing.ClassVar[int] = 4
    #: All but the top.
    SIDES: typing.ClassVar[tuple] = (0, 1, 2, 3, 5)

    def __post_init__(self):
        object.__setattr__(self, "planes", rows(self.planes, 4, "planes", "the four numbers a, b, c, d"))

    @classmethod
    def box(cls, lower, upper):
        """A box between two corners."""
        lower, upper = vector(lower, "lower"), vector(upper, "upper")
        if not np.all(lower < upper):
            raise ValueError(f"lower={tuple(lower)} must lie below upper={tuple(upper)} along each axis")
        return cls(
            [row for axis in range(3) for row in ((*np.eye(3)[axis], upper[axis]), (*-np.eye(3)[axis], -lower[axis]))])

    @classmethod
    def cylinder(cls, start, end, radius, sides=12):
        """A cylinder between two points as a prism, whose sides touch it from outside: a tunnel, a shaft."""
        start, end, radius = vector(start, "start"), vector(end, "end"), positive(radius, "radius")
        length = np.linalg.norm(end - start)
        if not length > 0.0:
            raise ValueError(f"start={tuple(start)} and end are the same point: a cylinder has a length")
        along = (end - start) / length
        # The first side faces upwards, or east for an upright one.
        up = np.eye(3)[2] if abs(along[2]) < 0.9 else np.eye(3)[0]
        u = up - (up @ along) * along
        u /= np.linalg.norm(u)
        angles = 2.0 * np.pi * np.arange(whole(sides, 3, MOST_PLANES - 2, "sides")) / sides
        normals = [math.cos(angle) * u + math.sin(angle) * np.cross(along, u) for angle in angles]
        return cls([(*n, n @ start + radius) for n in normals] + [(*along, along @ end), (*-along, -(along @ start))])

    def below(self, point, dip, dip_direction):
        """What of it lies below a plane through `point` (see joint()): a slope face, the ground. The plane is the last
        of `planes`.
        """
        face = joint(point, dip, dip_direction)
        return Domain(np.vstack([self.planes, [*face.normal, np.dot(face.normal, face.point)]]), self.left_out)

    def without(self, *regions):
        """The same without convex regions (Domains): a tunnel that is there, the rock that a bench or a valley lacks.

        Blocks are then cut by the planes of a region, too, as far as they meet it. The pieces of a block stay one piece
        of rock: bodies() glues them.
        """
        return Domain(self.planes, (*self.left_out, *convex(regions)))

    def ball(self):
        """Centre (3,) and radius of a ball that holds it, without regard to what is left out; ValueError if it is
        empty or open.
        """
        corners = _slicing.slice(self.planes, [], most_blocks=1).arrays()[3]
        centre = 0.5 * (corners.min(0) + corners.max(0))
        return centre, float(np.linalg.norm(corners - centre, axis=1).max())


def convex(regions):
    """These regions as a list; ValueError unless each is a Domain that leaves nothing out."""
    found = [regions] if isinstance(regions, Domain) else list(regions)
    for region in found:
        if not isinstance(region, Domain) or region.left_out:
            raise ValueError(
                f"a region is {type(region).__name__}: give convex Domains that leave nothing out themselves")
    return found
