# SPDX-License-Identifier: GPL-3.0-or-later
"""The pile of studies/pile.py with another number of bodies, and how its states are compared."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "studies"))

import numpy as np
from yade import O

from pile import SIZE, Pile

SLABS = 5  # the first bodies: floor and walls
ROOM = 0.3  # so near that a shaken heap comes to lean on the walls


def build(count, functor):
    """Pyramids above a floor between four walls; returns the box."""
    pile = Pile(count, functor, room=ROOM)
    pile.build()
    return pile.box


def state():
    """Of the pyramids, as plain lists: what must agree when a run is repeated."""
    bodies = [body.state for body in O.bodies][SLABS:]
    return {
        "positions": [tuple(one.pos) for one in bodies],
        "orientations": [tuple(one.ori) for one in bodies],
        "velocities": [tuple(one.vel) for one in bodies],
    }
