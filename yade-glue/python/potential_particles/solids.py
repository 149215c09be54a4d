# SPDX-License-Identifier: GPL-3.0-or-later
"""What the builders of shapes share: fractions of the size as lengths, and the rounded hull of points."""
from . import rounding
from .arguments import number, positive, within
from .polyhedron import Polyhedron


def sizes(ball_radius, r, k, R):
    """r and R as lengths, from fractions of the diameter of the largest ball inside, and k; R=None stays so."""
    size = 2.0 * ball_radius
    k = within(k, 0.0, 1.0, "k")
    r = number(r, "r")
    if not 0.0 < r < 0.5:
        raise ValueError(f"r={r:g} is a fraction of the size and must lie between 0 and 0.5 (for a sphere use sphere(radius))")
    return size * r, k, None if R is None else size * positive(R, "R")


def rounded_hull(points, r, k, R, name):
    """The Shape of the convex hull of points (n, 3)."""
    polyhedron = Polyhedron.of_points(points)
    return rounding.rounded(polyhedron, *sizes(polyhedron.ball_radius, r, k, R), name)
