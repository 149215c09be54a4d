# SPDX-License-Identifier: MIT OR Apache-2.0
"""A slope of 591 blocks, cut by two joint sets: it slides or topples as friction says. Run it inside YADE: yade -x -n
-j2 examples/rock_slope.py

Environment: SECONDS (1.2), OUTPUT (out/rock_slope). Joints that dip out of the slope by 30 degrees cut columns; columns
whose width over height is below tan(30) topple where they cannot slide (Goodman & Bray 1976). Writes a picture for each
friction angle, and summary.json. SI units.
"""
import os

import numpy as np
import potential_particles
from potential_particles import files, rock
from yade import *

SECONDS, OUT = float(os.environ.get("SECONDS", 1.2)), os.environ.get("OUTPUT", "out/rock_slope")
FRICTION = (15, 45)  # degrees: less than the dip of the base, and more
os.makedirs(OUT, exist_ok=True)

domain = rock.Domain.box((0, 0, 0), (34, 1, 17)).below((32, 0, 1), dip=62, dip_direction=90)
sets = [rock.JointSet(30, 90, 1.7, name="base"), rock.JointSet(60, 270, 0.5, name="columns")]
mass = rock.slice(domain, sets, least_volume=0.3, least_thickness=0.15)
print(mass, f"{mass.too_small} cuts left out")


def slope(friction):
    """The slope after some time: how many blocks turned (brown in the picture) and slid (blue)."""
    O.reset()
    O.materials.append(
        ConicJointMat(normalStiffness=1e8, shearStiffness=2e7, frictionAngle=np.radians(friction), restitution=0.5,
                      density=2600))
    ids = rock.bodies(mass, rounding=0.1, fixed=mass.on_domain([rock.Domain.WEST, rock.Domain.BOTTOM]))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                             [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                             [Law2_ScGeomConicPP_ConicJointPhys()]),
        NewtonIntegrator(damping=0.1, gravity=(0, 0, -9.81), exactAsphericalRot=True),
    ]
    O.dt = potential_particles.critical_time_step(safety=0.9)
    O.run(int(SECONDS / O.dt), True)
    way = np.array([O.bodies[int(i)].state.displ().norm() for i in ids])
    turn = np.degrees([O.bodies[int(i)].state.rot().norm() for i in ids])
    turned, slid = turn > 5.0, (way > 0.2) & (turn <= 5.0)
    for i, leans, goes in zip(ids, turned, slid):
        O.bodies[int(i)].shape.color = Vector3(
            0.82, 0.45, 0.25) if leans else Vector3(0.4, 0.55, 0.72) if goes else Vector3(0.72, 0.69, 0.62)
    potential_particles.plot(os.path.join(OUT, f"friction_{friction}.png"), towards=(0.12, -1.0, 0.12),
                             size=(1100, 620))
    numbers = {
        "blocks": len(ids), "turned_by_5_degrees": int(turned.sum()), "slid_by_20_cm": int(slid.sum()),
        "largest_way_m": float(way.max()), "steps": O.iter, "overlap_over_r": potential_particles.overlap_ratio()
    }
    print(f"friction {friction} degrees: {numbers}")
    return numbers


files.write_summary(os.path.join(OUT, "summary.json"), {f"friction_{one}": slope(one) for one in FRICTION})
