# SPDX-License-Identifier: MIT OR Apache-2.0
"""A ballast box: a sleeper on rocks under a load that comes and goes. yade -x -n -j2 examples/ballast.py

Environment: BODIES (250), CYCLES (20), OUTPUT (out/ballast). Writes ballast.png, load against settlement and settlement
    against cycles, and summary.json. SI units; z up.
"""
import os

import numpy as np
import potential_particles
from matplotlib import pyplot
from potential_particles import boundaries, files, packing, shapes
from yade import *
from yade import utils

COUNT, CYCLES, OUT = int(os.environ.get("BODIES",
                                        250)), int(os.environ.get("CYCLES",
                                                                  20)), os.environ.get("OUTPUT", "out/ballast")
LEAST, MOST, FREQUENCY = 1e3, 10e3, 4.0  # of the load, N; Hz
LENGTH, WIDTH, DEPTH = 0.7, 0.3, 1e-3 * COUNT  # of the box, m
O.materials.append(FrictMat(young=5e7, poisson=0.3, frictionAngle=np.radians(35), density=2650))
kinds = [shapes.random_rock(seed, elongation=0.75, flatness=0.7, faces=16, roughness=0.3) for seed in range(12)]
rocks = potential_particles.pack(packing.Box((0, 0, 0), (LENGTH, WIDTH, 2.5 * DEPTH)), kinds, sizes=[(0.025, 0.0),
                                                                                                     (0.04, 0.4),
                                                                                                     (0.06, 1.0)],
                                 shares="passing", number=COUNT)
ids = potential_particles.add_packing(rocks, color=(0.55, 0.53, 0.5))
O.bodies.append(boundaries.box_walls((0, 0, 0), (LENGTH, WIDTH, 3 * DEPTH),
                                     mask=3))  # 2 is theirs alone: no pairs of two facets
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB(), Bo1_Facet_Aabb()], verletDist=0, avoidSelfInteractionMask=2),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                         [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(safety=0.8),
    PyRunner(command="press()", iterPeriod=10, dead=True),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True)
]
while O.time < 1 or utils.unbalancedForce() > 0.01 and O.time < 3:
    O.run(250, True)
place = (0.5 * LENGTH, 0.5 * WIDTH, potential_particles.extrema(ids)[1][2] + 0.06)
sleeper = O.bodies[O.bodies.append(
    potential_particles.body(shapes.cuboid((0.25, 0.9 * WIDTH, 0.12)), position=place, color=(0.75, 0.72, 0.68)))]
sleeper.state.blockedDOFs = "xyXYZ"  # it goes up and down
O.engines[4].dead, begin, rows = False, O.time, []


def press():
    """Lets the load grow for a quarter of a second, then come and go."""
    cycles = FREQUENCY * (O.time - begin - 0.5)
    load = LEAST * min(4 * (O.time - begin), 1) + (MOST - LEAST) * 0.5 * (1 - np.cos(2 * np.pi * max(cycles, 0)))
    O.forces.setPermF(sleeper.id, Vector3(0, 0, -load))
    rows.append((cycles, load, sleeper.state.pos[2]))


while FREQUENCY * (O.time - begin - 0.5) < CYCLES:
    O.run(500, True)
cycle, load, height = np.array([row for row in rows if row[0] > 0]).T
settlement = 1e3 * (height[0] - height)
ends = settlement[np.searchsorted(cycle, np.arange(1, CYCLES))]
summary = {
    "bodies": len(ids), "steps": O.iter, "settlement_mm": ends.tolist(),
    "overlap_over_r": potential_particles.overlap_ratio()
}
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(os.path.join(OUT, "box.png"), size=(700, 500))
picture, (left, middle, right) = pyplot.subplots(1, 3, figsize=(12, 3.4), layout="constrained")
left.imshow(pyplot.imread(os.path.join(OUT, "box.png")))
left.axis("off")
for place, x, y, along, up in (middle, settlement, load / 1e3, "settlement, mm", "load, kN"), (right, range(
        1, CYCLES), ends, "cycles", "settlement at the least load, mm"):
    place.plot(x, y, lw=0.8)
    place.set(xlabel=along, ylabel=up)
picture.savefig(os.path.join(OUT, "ballast.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(summary)
