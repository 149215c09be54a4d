# SPDX-License-Identifier: MIT OR Apache-2.0
"""A potential particle that waits to become bodies: its definition, its mass properties, and how it stands in its
builder's frame.
"""
import dataclasses
import functools
import math
import typing

import numpy as np

from ._core import Particle, Pose


class Fit(typing.NamedTuple):
    """How near a particle comes to the surface that it was made from."""

    #: Distance of a sample of the surface from that of the particle, to first order, over the diameter of the ball of
    #: the surface's volume.
    largest: float
    mean: float  #: the root of the mean of its square
    volume: float  #: of the surface, length^3


@dataclasses.dataclass(frozen=True, repr=False)
class Shape:
    """One particle, validated by the library. Immutable; one shape serves any number of bodies.

    With <t> = max(t, 0) its surface is (1-k)/r^2 sum <a x + b y + c z - d>^2 + k/R^2 |x|^2 = 1 in its principal frame:
    the origin is the centroid and the axes are principal axes of inertia, as YADE wants the frame of a body. `centroid`
    and `orientation` say where this frame lies in that of the builder (the planes, points or file that a script gave):
    x_builder = centroid + orientation x. Lengths are in the script's unit.
    """

    planes: typing.Tuple[typing.Tuple[float, float, float, float], ...]  #: a, b, c, d of each plane, principal frame
    r: float  #: rounding radius, length
    k: float  #: sphericity, 0 to 1
    R: float  #: radius of the shadow sphere, length
    volume: float  #: length^3
    inertia: typing.Tuple[float, float, float]  #: about the centroid along the principal axes for density 1, length^5
    error: float  #: estimated bound on the relative error of volume and inertia
    centroid: typing.Tuple[float, float, float]  #: in the builder's frame
    orientation: typing.Tuple[float, float, float, float]  #: w, x, y, z, from the principal to the builder's frame
    bounding_radius: float  #: of a ball about the centroid that holds the particle, length
    name: str = "particle"
    fit: typing.Optional[Fit] = None  #: of a shape from a surface
    #: of what it was made of, the sharp body or the round one that was asked for, length^3
    sharp_volume: typing.Optional[float] = None

    def __repr__(self):
        """One line; the planes and the rest are attributes."""
        off = "" if self.fit is None else f", off its surface by {self.fit.largest:.2g} of its diameter at most, {self.fit.mean:.2g} in the mean"
        return (
            f"<Shape {self.name}: {len(self.planes)} planes, r={self.r:.3g}, k={self.k:.3g}, R={self.R:.3g}, volume {self.volume:.4g}, "
            f"bounding radius {self.bounding_radius:.3g}{off}>")

    @functools.cached_property
    def particle(self):
        """The Particle, in its principal frame. In YADE, body() makes a body of a shape."""
        return Particle(np.array(self.planes).reshape(-1, 4), self.r, self.k, self.R)

    @property
    def pose(self):
        """The Pose of the principal frame in the builder's: the particle stands there as it was built."""
        return Pose(self.centroid, self.orientation)

    @property
    def equivalent_diameter(self):
        """Diameter of the ball of the same volume, length."""
        return (6.0 * self.volume / math.pi) ** (1.0 / 3.0)

    def scaled(self, factor):
        """The same shape with all lengths multiplied by `factor`."""
        from .arguments import positive
        factor = positive(factor, "factor")
        positive(factor * self.bounding_radius, f"factor={factor:g} times the bounding radius")
        return dataclasses.replace(
            self,
            planes=tuple((a, b, c, d * factor) for a, b, c, d in self.planes),
            r=self.r * factor, R=self.R * factor,
            volume=self.volume * factor**3, inertia=tuple(one * factor**5 for one in self.inertia),
            centroid=tuple(one * factor for one in self.centroid), bounding_radius=self.bounding_radius * factor,
            sharp_volume=self.sharp_volume and self.sharp_volume * factor**3,
            fit=self.fit and self.fit._replace(volume=self.fit.volume * factor**3))
