# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes by the library's builders: from the planes of faces, and from the hull of points; rounding.py says where faces are."""
import math

import numpy as np

from .arguments import number, positive, within
from .shape import Shape


def shares(r, k, R):
    """r and R as fractions of the size, and k, checked; R=None stays so."""
    k = within(k, 0.0, 1.0, "k")
    r = number(r, "r")
    if not 0.0 < r < 0.5:
        raise ValueError(f"r={r:g} is a fraction of the size and must lie between 0 and 0.5 (for a sphere use sphere(radius))")
    return r, k, None if R is None else positive(R, "R")


def sizes(ball_radius, r, k, R):
    """r and R as lengths, from fractions of the diameter of the largest ball inside, and k; R=None stays so."""
    r, k, R = shares(r, k, R)
    return 2.0 * ball_radius * r, k, None if R is None else 2.0 * ball_radius * R


def rounded_faces(planes, r, k, R, name):
    """The Shape whose faces are the planes (n, 4), a x + b y + c z <= h inside; those that make no face are left out."""
    from . import _glue
    return _built(_glue.shape_of_faces, planes, r, k, R, name)


def rounded_hull(points, r, k, R, name):
    """The Shape of the convex hull of points (n, 3)."""
    from . import _glue
    return _built(_glue.shape_of_points, points, r, k, R, name)


def ball(radius, name):
    """The Shape of a sphere: k = 1, no planes."""
    volume = 4.0 / 3.0 * math.pi * radius**3
    return Shape(planes=(), r=0.0, k=1.0, R=radius, volume=volume, inertia=(0.4 * volume * radius**2,) * 3, error=0.0,
                 centroid=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0), bounding_radius=radius, name=name)


def _built(builder, rows, r, k, R, name):
    r, k, R = shares(r, k, R)
    try:
        return Shape(name=name, **builder(np.ascontiguousarray(rows, float).tobytes(), r, k, R or 0.0))
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
