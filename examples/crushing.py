# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks that a lid crushes in a box: grading before and after. scripts/yade.sh -j2 examples/crushing.py

Environment: BODIES (100), HEIGHT (0.9, of the pressed box over its width), OUTPUT (out/crushing). Writes crushed.png
and summary.json. SI units; z up.
"""
import os

import potential_particles
from matplotlib import pyplot
from potential_particles import files, packing, shapes
from yade import *
from yade import utils

COUNT, HEIGHT, OUT = [os.environ.get(*one) for one in (("BODIES", 100), ("HEIGHT", 0.9), ("OUTPUT", "out/crushing"))]
SIDE, rocks = 0.1 * (0.8 * int(COUNT)) ** (1 / 3), [shapes.random_rock(seed, size=0.08) for seed in range(12)]
O.materials.append(FrictMat(young=1e8, poisson=0.3, frictionAngle=0.5, density=2650))
placed = potential_particles.pack(packing.Box((0, 0, 0), (SIDE, SIDE, 2 * SIDE)), rocks, number=int(COUNT))
potential_particles.add_packing(placed, color=(0.7, 0.7, 0.65))
walls = [utils.wall(height * SIDE, axis=axis) for axis, height in ((0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 2))]
lid = O.bodies[O.bodies.append(walls)[-1]]
engine = Breakage(tensileStrength=1e4, compressiveStrength=1e5, weibullModulus=4, referenceVolume=2.6e-4, seed=1,
                  pieces=4, leastSize=0.03)
O.engines = [
    ForceResetter(), BoundWatch(), InsertionSortCollider([Bo1_ConicPP_Aabb(), Bo1_Wall_Aabb()], verletDist=0.004),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Wall_ConicPP_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                         [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    potential_particles.time_stepper(period=20, safety=0.25),
    NewtonIntegrator(damping=0.4, gravity=(0, 0, -9.81), exactAsphericalRot=True), engine]
gradings, masses = {}, []
for label, height in (("before", 2), ("after", float(HEIGHT))):
    lid.state.vel[2] = -2
    while lid.state.pos[2] > height * SIDE:
        O.run(20, True)
    gradings[label], masses = potential_particles.grading_curve(), masses + [sum(one.state.mass for one in O.bodies)]
os.makedirs(OUT, exist_ok=True)
potential_particles.plot(f"{OUT}/pile.png", colour="generation", scale_bar=True)
picture, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
left.imshow(pyplot.imread(f"{OUT}/pile.png"))
for label, rows in gradings.items():
    right.semilogx(*zip(*rows), label=f"{label}: {len(rows):,} bodies")
left.set_axis_off()
right.set(xlabel="diameter of a ball of the same volume, m", ylabel="share of mass up to it")
right.legend()
picture.savefig(f"{OUT}/crushed.png", dpi=130)
d50 = [next(size for size, share in rows if share > 0.5) for rows in gradings.values()]
files.write_summary(f"{OUT}/summary.json", {"broken": len(engine.history), "masses": masses, "d50": d50})
