# SPDX-License-Identifier: MIT OR Apache-2.0
"""From joint sets to a rock mass: blocks cut by joints, their bodies, key blocks, excavations and water.

    from potential_particles import rock
    domain = rock.Domain.box((0, 0, 0), (20, 10, 12)).below((12, 0, 12), dip=60, dip_direction=90)
    mass = rock.slice(domain, [rock.JointSet(35, 90, 1.5), rock.JointSet(80, 265, 2.0, fisher=150)])
    ids = rock.bodies(mass, fixed=mass.on_domain(rock.Domain.SIDES))          # in YADE

Axes: x east, y north, z up. Dips and dip directions are in degrees, a dip direction is clockwise from north; lengths
are in the script's unit. What is wrong with an argument is a ValueError of one sentence, and nothing is made.
docs/rock.md leads from a scanline to a result.
"""
import importlib.util
import pkgutil

from .. import IN_YADE
from ..limit_state import Equilibrium
from .block_theory import COLOURS, KeyBlock, key_blocks, summary
from .domain import Domain
from .files import read_blockgen, read_dfn
from .joints import Joint, JointSet, joint, polygon, rectangle
from .loads import face_pressure, water_pressure
from .mass import Block, RockMass, slice
from .picture import plot
from .stability import limit_analysis, limit_scene

# Parts for YADE may be installed elsewhere than a wheel.
__path__ = pkgutil.extend_path(__path__, __name__)

__all__ = [
    "COLOURS", "Block", "Domain", "Equilibrium", "Joint", "JointSet", "KeyBlock", "RockMass", "face_pressure", "joint",
    "key_blocks", "limit_analysis", "limit_scene", "plot", "polygon", "read_blockgen", "read_dfn", "rectangle",
    "slice", "summary", "water_pressure"
]
_OF_YADE = ["JointRecorder", "apply_loads", "bodies", "excavate", "joint_engine", "joint_table"]

if IN_YADE and importlib.util.find_spec(".scene", __name__):
    from .scene import apply_loads, bodies, excavate, joint_engine
    from .surfaces import JointRecorder, joint_table

    __all__ += _OF_YADE


def __getattr__(name):
    if name in _OF_YADE:
        raise AttributeError(f"rock.{name} is for bodies of YADE: it needs YADE and its plugin")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
