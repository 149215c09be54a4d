# SPDX-License-Identifier: GPL-3.0-or-later
"""The pile of studies/pyramids.py with another number of bodies, and how its states are compared."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "studies"))

import numpy as np
from yade import O

import pyramids
from bodies import reach
from box import Box
from contact_functor import ContactFunctor
from loose_grid import loose_grid
from pyramid import pyramid

SLABS = 5  # the first bodies: floor and walls
SIZE = pyramids.SIZE


def build(count, functor):
    """Pyramids above a floor between four walls; returns the box."""
    shape = pyramid(SIZE)
    grid = loose_grid(count, reach(shape), pyramids.JITTER, pyramids.SEED)
    # So near that a shaken heap comes to lean on the walls.
    half_width = grid.half_width + 0.3 * grid.height
    box = Box(half_width, half_width, grid.height + SIZE, thickness=SIZE)
    pyramids.build_scene(ContactFunctor(functor), shape, grid, box)
    return box


def state():
    """Of the pyramids, as plain lists: what must agree when a run is repeated."""
    bodies = [body.state for body in O.bodies][SLABS:]
    return {
        "positions": [tuple(one.pos) for one in bodies],
        "orientations": [tuple(one.ori) for one in bodies],
        "velocities": [tuple(one.vel) for one in bodies],
    }
