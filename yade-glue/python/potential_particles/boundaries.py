# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundaries as meshes of YADE's Facets: a box, a funnel, a plate. Each function returns bodies for O.bodies.append.

Facets are fixed, and their normals point to where the bodies are. `facets` is the least number of them: a surface is
cut into quadrilaterals of about equal edges, in the same way on both sides of an edge, and each of these into two
triangles. Facets meet potential particles where the scene has a functor for the two.
"""
import math
import typing

import numpy as np

from .arguments import MANY, positive, rows, vector, whole


def box_walls(lower, upper, material=None, lid=False, facets=10, **more):
    """Floor and four walls of a box between two corners, and its lid if asked for.

    more: further arguments of yade.utils.facet (color, wire, mask, ...). ValueError for a box without volume.
    """
    (x, y, z), (a, b, c) = vector(lower, "lower"), vector(upper, "upper")
    if not (x < a and y < b and z < c):
        raise ValueError(f"lower={(x, y, z)} must lie below upper={(a, b, c)} along each axis")
    quads = [
        [(x, y, z), (a, y, z), (a, b, z), (x, b, z)],
        [(x, y, z), (x, b, z), (x, b, c), (x, y, c)],
        [(a, y, z), (a, y, c), (a, b, c), (a, b, z)],
        [(x, y, z), (x, y, c), (a, y, c), (a, y, z)],
        [(x, b, z), (a, b, z), (a, b, c), (x, b, c)],
    ]
    if lid:
        quads.append([(x, y, c), (x, b, c), (a, b, c), (a, y, c)])
    return _meshed(quads, facets, material, more)


def plate(corner, along, across, material=None, facets=2, **more):
    """A parallelogram from a corner along two edges; its normal points along `along` x `across`."""
    corner, along, across = vector(corner, "corner"), vector(along, "along"), vector(across, "across")
    if not np.linalg.norm(np.cross(along, across)) > 1e-12 * np.linalg.norm(along) * np.linalg.norm(across):
        raise ValueError(
            f"along={tuple(along)} and across={tuple(across)} span no plate: give two edges that are not parallel")
    return _meshed([[corner, corner + along, corner + along + across, corner + across]], facets, material, more)


def funnel(outlet, mouth, height, position=(0.0, 0.0, 0.0), material=None, sides=32, facets=2, **more):
    """The wall of a funnel whose outlet lies about `position`, and its mouth `height` above.

    outlet, mouth: the radii of a cone, made of `sides` plane pieces whose edges lie on it; or the widths (x, y) of a
    wedge. An outlet of 0, or one of its widths, closes it. For an open cylinder or shaft give both alike.
    """
    position, height = vector(position, "position"), positive(height, "height")
    lower, upper = _outline(outlet, sides, "outlet", closed=True), _outline(mouth, sides, "mouth")
    if len(lower) != len(upper):
        raise ValueError(f"outlet={outlet!r} and mouth={mouth!r} must both be a radius or both be two widths")
    lower = [position + (x, y, 0.0) for x, y in lower]
    upper = [position + (x, y, height) for x, y in upper]
    turn = range(len(lower))
    return _meshed([[lower[i - 1], upper[i - 1], upper[i], lower[i]] for i in turn], facets, material, more)


def _outline(opening, sides, name, closed=False):
    """Corners of an opening, counterclockwise seen from above."""
    allowed = _not_negative if closed else positive
    if hasattr(opening, "__len__"):
        x, y = (0.5 * allowed(width, name) for width in rows([opening], 2, name, "the two widths along x and y")[0])
        return [(x, -y), (x, y), (-x, y), (-x, -y)]
    radius = allowed(opening, name)
    angles = 2.0 * math.pi * np.arange(whole(sides, 3, MANY, "sides")) / sides
    return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]


def _not_negative(value, name):
    return 0.0 if value == 0 else positive(value, name)


def _meshed(quads, facets, material, more) -> typing.List:
    from yade import utils
    quads = [[np.asarray(corner, float) for corner in quad] for quad in quads]
    wanted = whole(facets, 1, MANY, "facets")
    triangles = _triangles(quads, math.inf)
    # Edges of the length at which squares of the same area would be as many, and shorter until they are.
    length = math.sqrt(2.0 * sum(map(_area, triangles)) / wanted)
    while len(triangles) < wanted:
        triangles = _triangles(quads, length)
        length *= 0.98
    if material is not None:
        more = dict(more, material=material)
    return [utils.facet([tuple(map(float, corner)) for corner in one], fixed=True, **more) for one in triangles]


def _triangles(quads, length):
    """Triangles of quadrilaterals (p, q, r, s) whose edges are cut into pieces of at most this length; none without
    area.
    """
    found = []
    pieces = [(_pieces(length, q - p, r - s), _pieces(length, s - p, r - q)) for p, q, r, s in quads]
    needed = sum(2 * n * m for n, m in pieces)
    if needed > 4 * MANY:
        raise ValueError(
            f"the surface is so long and narrow that {needed:.3g} facets of equal edges are needed, and no more than {4 * MANY} are made: give fewer facets, or cut it up"
        )
    for (p, q, r, s), (n, m) in zip(quads, pieces):
        grid = [[(1 - v) * ((1 - u) * p + u * q) + v * ((1 - u) * s + u * r) for v in np.linspace(0, 1, m + 1)]
                for u in np.linspace(0, 1, n + 1)]
        for i in range(n):
            for j in range(m):
                a, b, c, d = grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]
                found += [(a, b, c), (a, c, d)]
    largest = max(map(_area, found))
    return [one for one in found if _area(one) > 1e-12 * largest]


def _pieces(length, *edges):
    """Of opposite edges the longer one counts."""
    return max(1, math.ceil(max(map(np.linalg.norm, edges)) / length * (1.0 - 1e-12)))


def _area(triangle):
    a, b, c = triangle
    return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a)))
