# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks in a box under a plate that keeps a stress, in three stages: what it bears against time.

    yade -x -n examples/servo.py

Environment: BODIES (100), OUTPUT (out/servo). Writes servo.png and summary.json. SI units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, shapes
from yade import *

COUNT, OUT = int(os.environ.get("BODIES", 100)), os.environ.get("OUTPUT", "out/servo")
SIDE = 0.1 * (0.8 * COUNT) ** (1 / 3)  # m
O.materials.append(FrictMat(young=5e7, poisson=0.3, frictionAngle=0.3, density=2650))
O.bodies.append(boundaries.box_walls((0, 0, 0), (SIDE, SIDE, 4 * SIDE), mask=3))
rocks = [shapes.random_rock(seed, size=0.08) for seed in range(8)]
box = packing.Box((0, 0, 0), (SIDE, SIDE, 4 * SIDE))
ids = potential_particles.add_packing(
    potential_particles.pack(box, rocks, number=COUNT, dense=True, obstacles=O.bodies))
top = potential_particles.extrema(ids)[1][2]
plate = O.bodies.append(boundaries.plate((0, 0, top), (SIDE, 0, 0), (0, SIDE, 0), mask=3))
press = MovingMesh(ids=plate, mass=2 * COUNT, free="z", damping=0.5, area=SIDE**2)
O.engines = [
    ForceResetter(),
    BoundWatch(),
    InsertionSortCollider([Bo1_ConicPP_Aabb(), Bo1_Facet_Aabb()], verletDist=0.004, avoidSelfInteractionMask=2),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                         [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    press,
    NewtonIntegrator(damping=0.3, exactAsphericalRot=True),
]
O.dt = potential_particles.critical_time_step(safety=0.4)
rows, reached = [], {}
for stress, steps in (1e5, 4000), (3e5, 3000), (5e4, 3000):
    press.stress = Vector3(0, 0, -stress)
    for _ in range(steps // 50):
        O.run(50, True)
        rows.append((O.time, press.contactForce[2] / SIDE**2, stress, -press.displacement[2] / top))
    reached[f"{stress:g}"] = rows[-1][1] / stress
time, borne, wanted, strain = np.array(rows).T
figure, axis = pyplot.subplots(figsize=(7, 3.6), dpi=110)
axis.plot(time, borne / 1e3, label="stress on the plate, kPa")
axis.step(time, wanted / 1e3, "k--", lw=1, where="pre", label="prescribed, kPa")
axis.plot(time, 1e3 * strain, label="strain, 1e-3")
axis.set(xlabel="time, s", ylim=(0, 2.2 * wanted.max() / 1e3))
axis.legend()
figure.tight_layout()
os.makedirs(OUT, exist_ok=True)
figure.savefig(os.path.join(OUT, "servo.png"))
files.write_summary(os.path.join(OUT, "summary.json"), {"borne_over_prescribed": reached, "bodies": len(ids)})
print(f"borne over prescribed: {reached}\nResults in {OUT}")
