# SPDX-License-Identifier: MIT OR Apache-2.0
"""Simple shear of rocks in a periodic cell at constant normal stress: yade -x -n -j2 examples/shear.py

Environment: BODIES (1000), STRAIN (0.3), OUTPUT (out/shear). The cell is pressed together without friction, then
sheared along x in planes across y; y follows the stress, x and z stay. Writes shear.png and summary.json. SI units.
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
                                                                     0.3)), os.environ.get("OUTPUT", "out/shear")
PRESSURE, RATE, FRICTION, SIDE = 1e5, 0.3, np.radians(30), 0.1 * (1.5 * COUNT) ** (1 / 3)  # Pa, 1/s, between rocks, m
O.periodic = True
O.cell.setBox(SIDE, SIDE, SIDE)
O.materials.append(FrictMat(young=5e7, poisson=0.3, frictionAngle=0.0, density=2650))
kinds = [shapes.random_rock(seed, elongation=0.75, flatness=0.7) for seed in range(12)]
rocks = potential_particles.pack(packing.Box((0, 0, 0), (SIDE, ) * 3), kinds, sizes=[(0.06, 0.0), (0.12, 1.0)],
                                 shares="passing", number=COUNT)
potential_particles.add_packing(rocks, color=(0.72, 0.58, 0.42))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB()], verletDist=0, allowBiggerThanPeriod=True),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(safety=0.8),
    PyRunner(command="follow()", iterPeriod=10),
    NewtonIntegrator(damping=0.3, exactAsphericalRot=True)
]
shearing, rows = False, []


def follow():
    """Lets the cell shrink or grow towards the pressure: in all three directions, or across the planes of shear."""
    rates = np.clip(2 * (-np.array(utils.getStress().diagonal()) / PRESSURE - 1), -0.5, 0.5)
    O.cell.velGrad = Matrix3(0, RATE, 0, 0, rates[1], 0, 0, 0, 0) if shearing else Matrix3(
        rates[0], 0, 0, 0, rates[1], 0, 0, 0, rates[2])


while O.time < 0.5 or abs(potential_particles.stress().trace() / 3 / -PRESSURE - 1) > 0.02 and O.time < 1.5:
    O.run(250, True)
utils.setContactFriction(FRICTION)
shearing, begin, height = True, O.time, O.cell.hSize[1, 1]
while RATE * (O.time - begin) < STRAIN:
    O.run(100, True)
    stress, fabric = potential_particles.stress(), potential_particles.fabric_tensor()
    rows.append((RATE * (O.time - begin), stress[0, 1] / stress[1, 1], O.cell.hSize[1, 1] / height - 1,
                 potential_particles.porosity(), fabric[0, 1]))
strain, ratio, growth, porosity, fabric = np.array(rows).T
angles, end = np.degrees(np.arctan(np.abs(ratio))), strain > 0.6 * STRAIN
summary = {
    "bodies": len(rocks), "steps": O.iter, "porosity": [porosity[0], porosity[-1]], "friction_angle_peak": angles.max(),
    "friction_angle_end": angles[end].mean(), "growth_end_percent": 100 * growth[-1], "fabric_end": fabric[end].mean(),
    "normal_stress_end": -stress[1, 1]
}
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "rocks.png"), size=(600, 600), towards=(0.2, 0.35, 0.9))
picture, axes = pyplot.subplots(1, 4, figsize=(13, 3.2), layout="constrained")
axes[0].imshow(pyplot.imread(os.path.join(OUT, "rocks.png")))
axes[0].axis("off")
for place, line, label in zip(axes[1:], (np.abs(ratio), 100 * growth, fabric),
                              ("shear stress / normal stress", "growth across, %", "fabric, xy")):
    place.plot(100 * strain, line)
    place.set(xlabel="shear strain, %", ylabel=label)
picture.savefig(os.path.join(OUT, "shear.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
