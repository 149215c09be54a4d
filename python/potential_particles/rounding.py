# SPDX-License-Identifier: MIT OR Apache-2.0
"""How edges and corners are rounded, as a script says it: r as a length or as a share of the size.

The size is the diameter of the largest ball that fits inside the sharp body. How the planes of the particle follow
from its faces: src/shapes/rounding.rs.
"""
import functools
import math
import typing
import warnings

from .arguments import number, positive, warn, within

# What docs/shapes.md advises.
ROUNDING, SPHERICITY = 0.05, 0.02


class Rounding(typing.NamedTuple):
    """r (length) or else `share`, both None where a builder chooses it; k; R (length), None: to the farthest corner."""

    share: typing.Optional[float]
    k: float
    r: typing.Optional[float] = None
    R: typing.Optional[float] = None

    @property
    def is_chosen(self):
        """Whether a script says how large r is."""
        return self.share is not None or self.r is not None

    def lengths(self, size, share=ROUNDING):
        """r, k and R, lengths, R=None as it is; `share`: where the script gives neither r nor a share.

        ValueError for numbers out of range.
        """
        if self.r is not None and self.share is not None:
            raise ValueError(f"rounding={self.share!r} and r={self.r!r} both give the rounding radius: leave out one")
        size, k = positive(size, "size, the diameter of the largest ball inside"), within(self.k, 0.0, 1.0, "k")
        if k == 1.0:
            raise ValueError("k=1 leaves no face: take sphere(R), which has that shape")
        R = None if self.R is None else positive(self.R, "R")
        if self.r is not None or R is not None:
            _warn_of_lengths()
        if self.r is not None:
            r = number(self.r, "r")
            if not 0.0 < r < 0.5 * size:
                raise ValueError(
                    f"r={r:g} is a length and must lie between 0 and {0.5 * size:.6g}, half the diameter of the largest "
                    "ball that fits inside: rounding= gives it as a share of that diameter")
            return r, k, R
        share = number(share if self.share is None else self.share, "rounding")
        if not 0.0 < share < 0.5:
            raise ValueError(f"rounding={share:g} is a share of the size and must lie between 0 and 0.5 "
                             "(for a sphere use sphere(radius))")
        return size * share, k, R

    def told_of(self, shape):
        """The shape, with a SceneWarning if the shadow sphere of a given R cuts off a part of it."""
        if self.R is not None and shape.k > 0.0 and shape.bounding_radius >= (1.0 - 1e-9) * shape.R / math.sqrt(shape.k):
            warn(f"{shape.name}: R={self.R:g}: a sphere of radius R/sqrt(k)={shape.R / math.sqrt(shape.k):.6g} cuts off "
                 "what lies beyond; leave R out, or take a larger one")
        return shape


@functools.lru_cache(maxsize=1)
def _warn_of_lengths():
    """Once a process, until December 2027, for scripts written for version 0.1."""
    warnings.warn_explicit(
        "r and R of shapes are lengths; until version 0.1 they were shares of the size: r=0.05 of then is "
        "rounding=0.05 (docs/shapes.md)", FutureWarning, "potential_particles", 0)
