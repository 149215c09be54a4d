# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks in a box that a lid presses together and lets go: stress against strain, work against energy. yade -x -n -j2
examples/oedometer.py

Environment: BODIES (300), STRESS (2e5), LAW (point, or joint: contact patches), OUTPUT (out/oedometer). Writes
    oedometer.png and summary.json. SI units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import files, packing, shapes
from yade import *
from yade import utils

COUNT, STRESS, OUT = int(os.environ.get("BODIES",
                                        300)), float(os.environ.get("STRESS",
                                                                    2e5)), os.environ.get("OUTPUT", "out/oedometer")
SIDE, HEIGHT, SPEED = 0.1 * (0.8 * COUNT) ** (1 / 3), 0.3 * (0.8 * COUNT) ** (1 / 3), 0.05  # m, m, m/s
O.materials.append(FrictMat(young=5e7, poisson=0.3, frictionAngle=0.5, density=2650))
rocks = [shapes.random_rock(seed, size=0.08) for seed in range(12)]
potential_particles.add_packing(
    potential_particles.pack(packing.Box((0, 0, 0), (SIDE, SIDE, HEIGHT)), rocks, number=COUNT))
O.bodies.append([utils.wall(place, axis=axis) for axis, place in ((0, 0), (0, SIDE), (1, 0), (1, SIDE), (2, 0))])
lid = O.bodies[O.bodies.append(utils.wall(HEIGHT, axis=2))]
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Wall_Aabb()], verletDist=0),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(period=100, safety=0.25),
    PyRunner(command="press()", iterPeriod=1),
    NewtonIntegrator(damping=0.4, gravity=(0, 0, -9.81), exactAsphericalRot=True)
]
if os.environ.get("LAW") == "joint":
    potential_particles.use_joints(restitution=0.5)
work, last = 0.0, 0.0


def press():
    """Adds the work of the lid, by the mean of two steps' forces."""
    global work, last
    force = O.forces.f(lid.id)[2]
    work, last = work - 0.5 * (force + last) * lid.state.vel[2] * O.dt, force


while O.time < 1.0:
    O.run(250, True)
lid.state.pos, lid.state.vel = Vector3(0, 0, potential_particles.extrema()[1][2]), Vector3(0, 0, -SPEED)
while last < 0.01 * STRESS * SIDE**2:
    O.run(20, True)
# From here on springs, friction and the lid alone change the energy.
O.engines[-1].damping, O.engines[-1].gravity, O.trackEnergy = 0.0, Vector3.Zero, True
O.run(2, True)
work, start, rows, begin = 0.0, sum(dict(O.energy.items()).values()), [], lid.state.pos[2]
while lid.state.vel[2] < 0 or last > 0.02 * STRESS * SIDE**2:
    O.run(50, True)
    rows.append((1 - lid.state.pos[2] / begin, last / SIDE**2, work, sum(dict(O.energy.items()).values()) - start))
    if last > STRESS * SIDE**2:
        lid.state.vel = Vector3(0, 0, SPEED)
strain, stress, done, stored = np.array(rows).T
top = stress.argmax()
summary = {
    "bodies": COUNT, "steps": O.iter, "strain_at_stress": strain[top],
    "modulus_of_loading_Pa": (stress[top] - stress[top // 2]) /
                             (strain[top] - strain[top // 2]), "energy_over_work": stored[top] / done[top] - 1,
    "after_unloading": stored[-1] / done[-1] - 1, "overlap_over_r": potential_particles.overlap_ratio()
}
os.makedirs(OUT, exist_ok=True)
picture, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3), layout="constrained")
left.plot(100 * strain, stress / 1e3)
right.plot(100 * strain, np.transpose([done, stored]), label=["work of the lid", "springs, friction, motion"])
right.legend()
for place, label in (left, "stress of the lid, kPa"), (right, "J"):
    place.set(xlabel="strain, %", ylabel=label)
picture.savefig(os.path.join(OUT, "oedometer.png"), dpi=130)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
