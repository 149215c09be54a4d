# SPDX-License-Identifier: GPL-3.0-or-later
"""From joint sets to a rock mass: blocks cut by joints, their bodies, key blocks, excavations and water.

    from potential_particles import rock
    domain = rock.Domain.box((0, 0, 0), (20, 10, 12)).below((12, 0, 12), dip=60, dip_direction=90)
    mass = rock.slice(domain, [rock.JointSet(35, 90, 1.5), rock.JointSet(80, 265, 2.0, fisher=150)])
    ids = rock.bodies(mass, fixed=mass.on_domain(rock.Domain.SIDES))

Axes: x east, y north, z up. Dips and dip directions are in degrees, a dip direction is clockwise from north; lengths
are in the script's unit. What is wrong with an argument is a ValueError of one sentence, and nothing is made.
docs/rock.md leads from a scanline to a result.
"""
from .block_theory import COLOURS, KeyBlock, key_blocks, summary
from .domain import Domain
from .files import read_blockgen, read_dfn
from .joints import Joint, JointSet, joint, polygon, rectangle
from .loads import apply_loads, face_pressure, water_pressure
from .mass import Block, RockMass, slice
from .scene import bodies, excavate, joint_engine
from .stability import limit_analysis
from .surfaces import JointRecorder, joint_table

__all__ = [
    "COLOURS", "Block", "Domain", "Joint", "JointRecorder", "JointSet", "KeyBlock", "RockMass", "apply_loads", "bodies",
    "excavate", "face_pressure", "joint", "joint_engine", "joint_table", "key_blocks", "limit_analysis", "polygon", "read_blockgen",
    "read_dfn", "rectangle", "slice", "summary", "water_pressure"
]
