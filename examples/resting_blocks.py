# SPDX-License-Identifier: MIT OR Apache-2.0
"""Blocks that have to rest, and do: two scenes that users of YADE asked about. Run it inside YADE: yade -x -n -j1
examples/resting_blocks.py

gitlab.com/yade-dev/answers 4142: a jointed wedge of 32 blocks on a plane of 26.5 degrees, which crept with a friction
angle of 89 degrees and a damping of 0.8. (Its geometry was in files of the asker; this is another wedge of 32 blocks.)
4102: cubes of 1 m on a plane of 20 degrees with a friction angle of 21, of which the second one made both slide.
Environment: OUTPUT (out/resting_blocks). Writes a picture and summary.json. SI units.
"""
import json
import os

import numpy as np
import potential_particles
from potential_particles import files, rock, shapes
from yade import *

OUT = os.environ.get("OUTPUT", "out/resting_blocks")
os.makedirs(OUT, exist_ok=True)


def start(friction, damping):
    """A scene with the law of joints and nothing in it."""
    O.reset()
    O.materials.append(
        ConicJointMat(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=np.radians(friction), restitution=0.2,
                      density=2600))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                             [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                             [Law2_ScGeomConicPP_ConicJointPhys()]),
        NewtonIntegrator(damping=damping, gravity=(0, 0, -9.81), exactAsphericalRot=True),
    ]


def run(seconds):
    """Runs; the largest way and speed of the bodies that are free since then."""
    free = [body for body in O.bodies if not body.state.blockedDOFs]
    begin = [body.state.pos for body in free]
    O.run(int(seconds / O.dt), True)
    return max((body.state.pos - place).norm() for body, place in zip(free, begin)), max(body.state.vel.norm()
                                                                                         for body in free)


def set_friction(angle):
    """Of all present and later contacts."""
    for material in O.materials:
        material.frictionAngle = np.radians(angle)
    for contact in O.interactions:
        if contact.isReal:
            contact.phys.tangensOfFrictionAngle = contact.phys.tangensOfResidualFrictionAngle = np.tan(
                np.radians(angle))


# 4142. Above the plane of 26.5 degrees, below the slope face and the top; what lies under the plane is fixed.
SLOPE = 26.5
domain = rock.Domain.box((-2, 0, -2), (10, 3, 4)).below((0, 0, 0), dip=60, dip_direction=270)
under = domain.below((0, 0, 0), dip=SLOPE, dip_direction=270)
above = rock.Domain(np.vstack([domain.planes, -under.planes[-1]]))
sets = [
    rock.JointSet(70, 80, 1.2),
    rock.joint((0, 1.5, 0), 90, 0),
    rock.joint((0, 0, 0.6), SLOPE, 270),
    rock.joint((0, 0, 1.2), SLOPE, 270)
]
start(friction=89, damping=0.8)
wedge, under = rock.slice(above, sets, least_volume=0.3, least_thickness=0.08), rock.slice(under, [])
ids = rock.bodies(wedge, rounding=0.02)
rock.bodies(under, rounding=0.02, fixed=[0], color=(0.55, 0.53, 0.5))
O.dt = potential_particles.critical_time_step()
print(f"{len(wedge)} blocks on a plane of {SLOPE} degrees")
way, _ = run(1.0)
found = {"blocks": len(wedge), "settled_mm": 1e3 * way}
creep, speed = run(1.0)
found.update(friction_89_creep_um=1e6 * creep, friction_89_unbalanced=unbalancedForce())
O.engines[-1].damping = 0.1
set_friction(30)
run(1.5)
creep, _ = run(1.0)
found["friction_30_creep_um"] = 1e6 * creep
picture = os.path.join(OUT, "wedge.png")
potential_particles.plot(picture, towards=(-0.6, -0.75, 0.35), size=(1000, 640))
set_friction(20)
slide, _ = run(0.5)
found["friction_20_slides_mm"] = 1e3 * slide

# 4102. One cube, and two: the plane is level, and gravity is inclined.
for cubes in (1, 2):
    start(friction=89, damping=0.8)
    O.engines[-1].gravity = 9.81 * Vector3(np.sin(np.radians(20)), 0, -np.cos(np.radians(20)))
    O.bodies.append(
        potential_particles.body(shapes.cuboid((10, 4, 1), rounding=0.02, k=0), position=(4, 0, -0.5), fixed=True))
    for x in (1.5, 3.5)[:cubes]:
        O.bodies.append(potential_particles.body(shapes.cuboid((1, 1, 1), rounding=0.02, k=0), position=(x, 0, 0.5)))
    O.dt = potential_particles.critical_time_step()
    run(0.5)
    O.engines[-1].damping = 0.0
    set_friction(21)
    rest, _ = run(1.0)
    set_friction(19)
    slide, speed = run(1.0)
    found[f"cubes_{cubes}"] = {
        "friction_21_way_um": 1e6 * rest, "friction_19_way_mm": 1e3 * slide,
        "friction_19_way_by_theory_mm": 1e3 * 0.5 * 9.81 *
                                        (np.sin(np.radians(20)) - np.tan(np.radians(19)) * np.cos(np.radians(20)))
    }
print(json.dumps(found, indent=2))
files.write_summary(os.path.join(OUT, "summary.json"), found)
