# SPDX-License-Identifier: MIT OR Apache-2.0
"""A slope from its joint sets to a factor of safety: on a laptop, python3 examples/slope.py, with the wheel and
matplotlib; in YADE,
yade -x -n examples/slope.py, which goes on to a run with the same friction and writes the scene for LAMMPS.

Environment: FRICTION (25, degrees), SECONDS (0.5), OUTPUT (out/slope). Writes keys.png, limit.png and summary.json, in
YADE run.png and the files lammps.*. SI units.
"""
import os
import sys

import numpy as np
import potential_particles
from potential_particles import files, rock

FRICTION, SECONDS = float(os.environ.get("FRICTION", 25)), float(os.environ.get("SECONDS", 0.5))
OUT = os.environ.get("OUTPUT", "out/slope")
os.makedirs(OUT, exist_ok=True)

domain = rock.Domain.box((0, 0, 0), (16, 10, 10)).below((13, 0, 0), dip=62, dip_direction=90)
sets = [rock.JointSet(35, 90, 2.2), rock.JointSet(80, 265, 2.4, fisher=150, seed=2), rock.JointSet(88, 355, 2.8)]
mass = rock.slice(domain, sets, least_volume=0.05, least_thickness=0.1)
held = mass.on_domain([rock.Domain.WEST, rock.Domain.NORTH, rock.Domain.SOUTH, rock.Domain.BOTTOM])
keys = rock.key_blocks(mass, [rock.Domain.TOP, rock.Domain.EAST, 6], degrees=FRICTION)
print(mass)
print(rock.summary(keys))

limit = rock.limit_analysis(mass, held, degrees=FRICTION)
print(limit)
rock.plot(mass, os.path.join(OUT, "keys.png"), keys=keys)
rock.plot(mass, os.path.join(OUT, "limit.png"), keys=keys, found=limit, held=held)
numbers = {"blocks": len(mass), "pieces_that_move": sum(one.moves for one in keys), "factor": limit.factor}


def run():
    """The slope after some time, in YADE: how many blocks have moved by more than 1 cm."""
    from yade import O
    import yade
    O.materials.append(
        yade.ConicJointMat(normalStiffness=5e8, shearStiffness=2e8, frictionAngle=np.radians(FRICTION),
                           restitution=0.5, density=2600))
    ids = rock.bodies(mass, rounding=0.02, fixed=held)
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        yade.ConicInteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                                  [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                                  [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=0.2, gravity=(0, 0, -9.81), exactAsphericalRot=True),
    ]
    O.dt = potential_particles.critical_time_step()
    O.step()
    potential_particles.to_lammps(os.path.join(OUT, "lammps"))
    O.run(int(SECONDS / O.dt), True)
    potential_particles.plot(os.path.join(OUT, "run.png"), towards=(0.8, -0.6, 0.4))
    return int(sum(O.bodies[int(one)].state.displ().norm() > 0.01 for one in ids))


if "yade" in sys.modules:
    numbers["blocks_that_moved"] = run()
files.write_summary(os.path.join(OUT, "summary.json"), numbers)
print(numbers)
