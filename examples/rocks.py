# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks of a size distribution fall into a box and come to rest.

    yade -x -n -j2 examples/rocks.py

Environment: BODIES (500), STEPS (30000), OUTPUT (out/rocks), LAW (point, or joint: contact patches). Writes rocks.png,
rocks.bodies.pvd and rocks.contacts.pvd with their frames for ParaView, and summary.json. SI units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import colormaps
from potential_particles import boundaries, files, packing, shapes
from yade import *
from yade import utils

COUNT, STEPS = int(os.environ.get("BODIES", 500)), int(os.environ.get("STEPS", 30_000))
OUT = os.environ.get("OUTPUT", "out/rocks")
# Of the mass, the part in rocks below each diameter: a grading curve.
GRADING = [(0.04, 0.0), (0.06, 0.3), (0.09, 0.7), (0.13, 1.0)]  # m
WIDTH, HEIGHT = 0.8, max(0.25, 0.0014 * COUNT)  # of the box, m: many rocks fill a tenth of it before they fall

os.makedirs(OUT, exist_ok=True)
O.materials.append(FrictMat(young=1e7, poisson=0.3, frictionAngle=np.radians(35), density=2650))
kinds = [shapes.random_rock(seed, elongation=0.75, flatness=0.7) for seed in range(12)]
inside = packing.Box((0, 0, 0), (WIDTH, WIDTH, HEIGHT))
rocks = potential_particles.pack(inside, kinds, sizes=GRADING, shares="passing", number=COUNT)
diameters = np.array([rock.shape.equivalent_diameter * rock.scale for rock in rocks])
colours = colormaps["cividis"]((diameters - GRADING[0][0]) / (GRADING[-1][0] - GRADING[0][0]))[:, :3]
ids = [potential_particles.add_packing([rock], color=tuple(colour))[0] for rock, colour in zip(rocks, colours)]
O.bodies.append(boundaries.box_walls(inside.lower, inside.upper))

contacts = [Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()]
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Facet_Aabb()], verletDist=0),
    InteractionLoop(contacts, [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True),
]
if potential_particles.joints.chosen():
    potential_particles.use_joints(restitution=0.5)
O.dt = potential_particles.critical_time_step()
record = potential_particles.Recorder(os.path.join(OUT, "rocks"))
for _ in range(5):
    record()
    O.run(STEPS // 5, wait=True)
record()
potential_particles.plot(os.path.join(OUT, "rocks.png"))

positions = np.array([O.bodies[i].state.pos for i in ids])
inside_walls = ((positions > 0) & (positions < inside.upper)).all(1)
touching = [i for i in O.interactions if i.isReal]
summary = {
    "bodies": len(ids),
    "lost": int((~inside_walls).sum()),
    "steps": O.iter,
    "time_step_s": O.dt,
    "failures": sum(functor.failures for functor in contacts),
    "contacts": len(touching),
    "largest_overlap_over_smallest_diameter": max(
        (i.geom.penetrationDepth for i in touching), default=0.0) / GRADING[0][0],
    "kinetic_energy_J": utils.kineticEnergy(),
    "mean_height_m": float(positions[:, 2].mean()),
}
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(f"{summary}\nResults in {OUT}")
