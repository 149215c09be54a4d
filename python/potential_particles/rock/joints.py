# SPDX-License-Identifier: MIT OR Apache-2.0
"""Joints one by one and in sets."""
import dataclasses
import math
import typing

import numpy as np

from .._core import _slicing
from ..arguments import LARGE, MANY, number, positive, rows, vector, whole, within


class Joint(typing.NamedTuple):
    """A plane in the rock, or a disc of it about `point`: unit normal, and radius (length, math.inf for a joint without
    end); of a polygon `outline`, its corners (n, 3).
    """

    point: tuple
    normal: tuple
    radius: float = math.inf
    outline: tuple = ()


def joint(point, dip, dip_direction, radius=math.inf):
    """The Joint through a point that descends most, by `dip` degrees, towards the azimuth `dip_direction`, degrees
    clockwise from north.

    Its normal is (sin d sin a, sin d cos a, cos d), d the dip and a the dip direction. radius: of a disc about the
    point, length.
    """
    dip, direction = math.radians(within(dip, 0.0, 90.0, "dip")), math.radians(number(dip_direction, "dip_direction"))
    normal = (math.sin(dip) * math.sin(direction), math.sin(dip) * math.cos(direction), math.cos(dip))
    return Joint(tuple(map(float, vector(point, "point"))), normal, _radius(radius))


def polygon(corners):
    """The Joint that is a convex polygon, by its corners (n, 3) in their order; ValueError where they lie off one plane
    or on one line, or are no convex polygon's.
    """
    outline = rows(corners, 3, "corners", "the three numbers x, y, z")
    return _of_core(_slicing.Joint.of_corners(outline), tuple(map(tuple, outline.tolist())))


def rectangle(point, dip, dip_direction, length, width):
    """The Joint that is a rectangle about `point`: `length` along its strike, `width` along its dip; angles as of
    joint().
    """
    middle, dip, direction = vector(point, "point"), math.radians(within(dip, 0.0, 90.0, "dip")), math.radians(
        number(dip_direction, "dip_direction"))
    along = 0.5 * positive(length, "length") * np.array([math.cos(direction), -math.sin(direction), 0.0])
    down = 0.5 * positive(width, "width") * np.array(
        [math.cos(dip) * math.sin(direction),
         math.cos(dip) * math.cos(direction), -math.sin(dip)])
    return polygon([middle + along + down, middle - along + down, middle - along - down, middle + along - down])


@dataclasses.dataclass(frozen=True)
class JointSet:
    """Joints of about one orientation at about one spacing.

    dip, dip_direction: of their mean, degrees. spacing: mean distance along the mean normal, length. exponential:
    distances are drawn from an exponential distribution instead of being all the same. fisher: Fisher's concentration
    of the normals, math.inf for none; half of them lie within about arccos(1 - 0.69/fisher) of the mean, 6.7 degrees
    for 100. radius: of joints that end, discs whose centres lie anywhere, length; a scanline along the mean normal
    crosses them at the spacing. (A trace length l on a face is that of discs of radius 2 l/pi, in the mean.) seed: the
    same one gives the same joints.
    """

    dip: float
    dip_direction: float
    spacing: float
    exponential: bool = False
    fisher: float = math.inf
    radius: float = math.inf
    seed: int = 0
    name: str = ""

    def __post_init__(self):
        within(self.dip, 0.0, 90.0, "dip")
        number(self.dip_direction, "dip_direction")
        positive(self.spacing, "spacing")
        whole(self.seed, 0, LARGE, "seed")
        if not self.fisher > 0.0:
            raise ValueError(f"fisher={self.fisher} must be above 0; math.inf is no scatter")
        _radius(self.radius)

    def joints(self, centre, reach):
        """A list of Joint: those that cross the line through `centre` along the mean normal within `reach`; discs that
        reach into that ball.
        """
        made = _slicing.joint_set(self.dip, self.dip_direction, self.spacing, centre=vector(centre, "centre"),
                                  reach=positive(reach, "reach"), exponential=bool(self.exponential),
                                  fisher=self.fisher, radius=self.radius, seed=int(self.seed))
        if len(made) > MANY:
            raise ValueError(
                f"spacing={self.spacing:g} makes {len(made)} joints, and no more than {MANY} are made: take a larger one, or a smaller domain"
            )
        return [_of_core(one) for one in made]


def _of_core(joint, outline=()):
    point, normal, radius = joint.parts
    return Joint(tuple(point), tuple(normal), radius, outline)


def _radius(radius):
    """A number above 0, or infinity."""
    return math.inf if radius == math.inf else positive(radius, "radius")
