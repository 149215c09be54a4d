# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies of a scene as obstacles of a packing: particles at poses, triangles, planes."""
import functools

import numpy as np
import yade

from . import _glue
from ._core import Particle, Pose, Triangle, Wall


def of_body(body):
    """A list, empty for bodies that no potential particle touches."""
    shape, state = body.shape, body.state
    if isinstance(shape, yade.Facet):
        return [Triangle(*(tuple(state.pos + state.ori * vertex) for vertex in shape.vertices))]
    if isinstance(shape, yade.Wall):
        normal = [0.0, 0.0, 0.0]
        normal[shape.axis] = shape.sense or 1.0
        return [(Wall(tuple(state.pos), normal), shape.sense != 0)]
    definition = shape and _glue.definition_of(shape)
    if not definition:
        return []
    x, y, z, w = state.ori
    return [(_particle(*definition), Pose(tuple(state.pos), (w, x, y, z)))]


@functools.lru_cache(maxsize=100_000)
def _particle(planes, r, k, R):
    return Particle(np.array(planes).reshape(-1, 4), r, k, R)
