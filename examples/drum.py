# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks in a rotating drum: the slope of their surface against time. yade -x -n -j2 examples/drum.py

Environment: BODIES (500), TURNS (1), OUTPUT (out/drum). Writes drum.png and summary.json. SI units; z up, the drum
    turns about y.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, shapes
from yade import *
from yade import utils

COUNT, TURNS, OUT = int(os.environ.get("BODIES", 500)), float(os.environ.get("TURNS",
                                                                             1)), os.environ.get("OUTPUT", "out/drum")
DIAMETER, LENGTH = 0.03, 0.15  # of a ball of a rock's volume, of the drum, m
RADIUS = np.sqrt(COUNT * np.pi / 6 * DIAMETER**3 / 0.55 / LENGTH / (0.4 * np.pi))  # filled to 40 %
SPEED = 0.15 * np.sqrt(9.81 / RADIUS)  # rad/s: a Froude number of 0.02, at which the surface is flat
for label, angle in ("rough", 30), ("smooth", 0):
    O.materials.append(FrictMat(young=1e7, poisson=0.3, frictionAngle=np.radians(angle), density=2650, label=label))
kinds = [shapes.random_rock(seed, elongation=0.8, flatness=0.75) for seed in range(8)]
low, high = Vector3(-0.68 * RADIUS, 0, -0.68 * RADIUS), Vector3(0.68 * RADIUS, LENGTH, 0.68 * RADIUS)
rocks = potential_particles.pack(packing.Box(low, high), kinds, sizes=DIAMETER, number=COUNT, dense=True)
ids = [
    potential_particles.add_packing([one], "rough",
                                    color=((0.75, 0.6, 0.42), (0.35, 0.45, 0.55))[one.position[0] > 0])[0]
    for one in rocks
]
wall = boundaries.funnel(RADIUS, RADIUS, LENGTH, material="rough", sides=48,
                         mask=3)  # 2 is theirs alone: no pairs of two facets
lie_down = Quaternion(Vector3(1, 0, 0), -np.pi / 2)
for facet in wall:
    facet.state.pos, facet.state.ori = lie_down * facet.state.pos, lie_down * facet.state.ori
drum = O.bodies.append(wall)
O.bodies.append([utils.wall(place, axis=1, material="smooth", sense=sense) for place, sense in ((0, 1), (LENGTH, -1))])
O.engines = [
    ForceResetter(),
    InsertionSortCollider(
        [PotentialParticle2AABB(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0, avoidSelfInteractionMask=2),
    ConicInteractionLoop(
        [Ig2_ConicPP_ConicPP_ScGeom(),
         Ig2_Wall_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    RotationEngine(ids=drum, rotationAxis=(0, 1, 0), angularVelocity=SPEED, rotateAroundZero=True, zeroPoint=(0, 0, 0)),
    potential_particles.time_stepper(safety=0.8),
    NewtonIntegrator(damping=0.1, gravity=(0, 0, -9.81), exactAsphericalRot=True)
]
rows, strips = [], np.linspace(-0.6, 0.6, 9) * RADIUS
while SPEED * O.time < 2 * np.pi * TURNS:
    O.run(200, True)
    x, y, z = np.array([O.bodies[i].state.pos for i in ids]).T
    # The slope of the surface, by the highest rocks in each strip of its middle part.
    top = [(0.5 * (a + b), np.sort(z[(x >= a) & (x < b)])[-3:].mean()) for a, b in zip(strips, strips[1:])
           if ((x >= a) & (x < b)).any()]
    rows.append((SPEED * O.time / (2 * np.pi), np.degrees(np.arctan(np.polyfit(*np.transpose(top), 1)[0]))))
turns, angles = np.array(rows).T
late = turns > 0.4 * TURNS
summary = {
    "bodies": len(ids), "steps": O.iter, "slope": abs(angles[late].mean()), "slope_scatter": angles[late].std(),
    "radius": RADIUS, "out_of_drum": int(((np.hypot(x, z) > RADIUS) | (abs(y - 0.5 * LENGTH) > 0.5 * LENGTH)).sum())
}
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "rocks.png"), size=(600, 600), towards=(0, -1, 0.05))
picture, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
left.imshow(pyplot.imread(os.path.join(OUT, "rocks.png")))
left.axis("off")
right.plot(turns, np.abs(angles))
right.set(xlabel="turns of the drum", ylabel="slope of the surface, degrees", ylim=0)
picture.savefig(os.path.join(OUT, "drum.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
