# SPDX-License-Identifier: MIT OR Apache-2.0
"""A tunnel is driven through some 2,000 blocks: key blocks by block theory, and what falls. Run it inside YADE: yade -x
-n -j2 examples/rock_tunnel.py

Environment: SPACING (1.75 m), SECONDS (0.4), OUTPUT (out/rock_tunnel). Writes a picture of the key blocks, red for
    those that fall, one after they fell, and summary.json. SI units.
"""
import os

import numpy as np
import potential_particles
from potential_particles import files, rock
from yade import *

SPACING, SECONDS, OUT = (float(os.environ.get("SPACING", 1.75)), float(os.environ.get("SECONDS", 0.4)),
                         os.environ.get("OUTPUT", "out/rock_tunnel"))
RADIUS, FRICTION = 4.0, 25.0  # m, degrees
os.makedirs(OUT, exist_ok=True)

domain = rock.Domain.box((0, 0, 0), (24, 16, 24))
tunnel = rock.Domain.cylinder((12, -1, 11), (12, 17, 11), RADIUS, sides=10)
sets = [
    rock.JointSet(20, 100, SPACING, fisher=300, seed=1),
    rock.JointSet(70, 200, SPACING, fisher=300, seed=2),
    rock.JointSet(75, 310, SPACING, fisher=300, seed=3)
]
mass = rock.slice(domain, sets, regions=[tunnel], least_volume=0.3, least_thickness=0.2)
inside = mass.inside(0)
keys = rock.key_blocks(mass, free=(), degrees=FRICTION, removed=inside)
print(mass)
print(rock.summary(keys))

# Blocks that are not at the tunnel stay where they are.
away = np.ones(len(mass), bool)
away[[block for one in keys if one.mode != "inner" for block in one.blocks]] = False
colours = {block: one.color for one in keys for block in one.blocks}
O.materials.append(
    ConicJointMat(normalStiffness=1e8, shearStiffness=5e7, frictionAngle=np.radians(FRICTION), restitution=0.3,
                  density=2600))
ids = rock.bodies(mass, rounding=0.05, fixed=away | mass.on_domain([rock.Domain.SOUTH, rock.Domain.NORTH]),
                  color=lambda block: colours.get(block, rock.COLOURS["inner"]))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                         [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                         [Law2_ScGeomConicPP_ConicJointPhys()]),
    NewtonIntegrator(damping=0.2, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
rock.excavate(ids[inside])
roof = [
    int(ids[block]) for one in keys if one.mode != "inner" for block in one.blocks
    if mass.blocks["centroid"][block, 2] > 11
]


def picture(name):
    """The blocks at the upper half of the tunnel, from below."""
    potential_particles.plot(os.path.join(OUT, name), towards=(0.2, -0.75, -0.62), size=(900, 640), bodies=roof)


picture("key_blocks.png")
O.dt = potential_particles.critical_time_step(safety=0.9)
O.run(int(SECONDS / O.dt), True)
picture("fallen.png")
way = {block: O.bodies[int(ids[block])].state.displ().norm() for block in np.flatnonzero(~inside)}
still = [one for one in keys if one.mode != "inner" and not mass.on_domain(rock.Domain.SIDES)[list(one.blocks)].any()]
numbers = {
    "blocks": len(mass), "pieces_that_block_theory_frees": sum(one.moves for one in still),
    "of_these_moved": sum(way[one.blocks[0]] > 0.01 for one in still
                          if one.moves), "others_at_the_tunnel": sum(not one.moves for one in still),
    "of_these_moved_behind_them": sum(way[one.blocks[0]] > 0.01 for one in still if not one.moves), "steps": O.iter,
    "overlap_over_r": potential_particles.overlap_ratio()
}
numbers = {name: float(value) if isinstance(value, float) else int(value) for name, value in numbers.items()}
files.write_summary(os.path.join(OUT, "summary.json"), numbers)
print(numbers)
