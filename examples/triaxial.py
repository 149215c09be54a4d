# SPDX-License-Identifier: MIT OR Apache-2.0
"""Drained triaxial compression of rocks between six smooth walls: yade -x -n -j2 examples/triaxial.py

Environment: BODIES (1000), STRAIN (0.1), OUTPUT (out/triaxial). YADE's TriaxialStressController drives the walls;
porosity and the stress between rocks, which it cannot know, are measured by this package. Writes triaxial.png and
summary.json. SI units.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import files, packing, shapes
from yade import *
from yade import utils

COUNT, STRAIN, OUT = int(os.environ.get("BODIES",
                                        1000)), float(os.environ.get("STRAIN",
                                                                     0.1)), os.environ.get("OUTPUT", "out/triaxial")
PRESSURE, RATE, FRICTION, SIDE, THICK = 1e5, 0.1, np.radians(
    30), 0.1 * (1.5 * COUNT)**(1 / 3), 0.02  # Pa, 1/s, between rocks, m, m
for label in "walls", "rocks":
    O.materials.append(FrictMat(young=5e7, poisson=0.3, frictionAngle=0.0, density=2650, label=label))
walls = O.bodies.append(
    utils.aabbWalls([Vector3(0, 0, 0), Vector3(SIDE, SIDE, SIDE)], thickness=THICK, material="walls"))
kinds = [shapes.random_rock(seed, elongation=0.75, flatness=0.7) for seed in range(12)]
rocks = potential_particles.pack(packing.Box((0, 0, 0), (SIDE, ) * 3), kinds, sizes=[(0.06, 0.0), (0.12, 1.0)],
                                 shares="passing", number=COUNT)
potential_particles.add_packing(rocks)
press = TriaxialStressController(thickness=THICK, stressMask=7, goal1=-PRESSURE, goal2=-PRESSURE, goal3=-PRESSURE,
                                 internalCompaction=False, max_vel=0.4)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Box_Aabb()], verletDist=0),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Box_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(safety=0.8), press,
    NewtonIntegrator(damping=0.2, exactAsphericalRot=True)
]

while O.time < 0.9:  # smooth rocks are pressed together
    O.run(250, True)
utils.setContactFriction(FRICTION)
press.stressMask, press.goal2 = 5, -RATE
begin, rows = press.strain[1], []
while begin - press.strain[1] < STRAIN:
    O.run(250, True)
    sides = press.width, press.height, press.depth
    volume = np.prod(sides)
    # Forces on both walls of each pair; contacts (Love-Weber), and these with what accelerates rocks; fabric.
    outer = [
        0.5 * (O.forces.f(walls[2 * i])[i] - O.forces.f(walls[2 * i + 1])[i]) * sides[i] / volume for i in range(3)
    ]
    tensors = outer, *(potential_particles.stress(volume, moving).diagonal()
                       for moving in (False, True)), potential_particles.fabric_tensor().diagonal()
    q, inside, moved, directed = (tensor[1] - 0.5 * (tensor[0] + tensor[2]) for tensor in tensors)
    rows.append((-press.strain[1], -q, -inside, -moved, -sum(outer) / 3, -sum(press.strain),
                 1 - potential_particles.solid_volume() / volume, directed))

strain, wall, inner, moved, mean, compaction, porosity, fabric = np.array(rows).T
strain, compaction = 100 * (strain + begin), 100 * (compaction - compaction[0])
angle, end = np.degrees(np.arcsin(3 * wall / (6 * mean + wall))), strain > 60 * STRAIN
summary = {
    "bodies": len(rocks), "steps": O.iter, "porosity": [porosity[0], porosity[-1]], "friction_angle_peak": angle.max(),
    "friction_angle_end": angle[end].mean(), "contacts_against_walls": inner[end].mean() / wall[end].mean() - 1,
    "moving_against_walls": np.abs(moved / wall - 1).max(), "compaction_end_percent": compaction[-1],
    "fabric_end": fabric[end].mean()
}
os.makedirs(OUT, exist_ok=True)
picture, axes = pyplot.subplots(1, 3, figsize=(10, 3), layout="constrained")
for place, lines, label in zip(axes, ([wall / mean, inner / mean], [compaction], [fabric]),
                               ("q / p of walls and of contacts", "compaction, %", "deviator of the fabric")):
    place.plot(strain, np.transpose(lines))
    place.set(xlabel="axial strain, %", ylabel=label)
picture.savefig(os.path.join(OUT, "triaxial.png"), dpi=130)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
