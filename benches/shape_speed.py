# SPDX-License-Identifier: GPL-3.0-or-later
"""What r, k and the number of planes cost: time of a contact of two rocks, for the table of docs/shapes.md.

    scripts/yade.sh -j1 benches/shape_speed.py

A block of rocks that touch their neighbours is held still. Each step solves every contact anew, from that of the step
before, without its area.
"""
import numpy as np

import potential_particles
from potential_particles import body, shapes
from yade import (FrictMat, ForceResetter, InsertionSortCollider, InteractionLoop, Ig2_ConicPP_ConicPP_ScGeom, O,
                  PotentialParticle2AABB, Ip2_FrictMat_FrictMat_KnKsPhys, Law2_SCG_KnKsPhys_KnKsLaw)

SIDE, STEPS = 5, 400


def microseconds(faces, r, k):
    """Least time of a pair over some runs, us."""
    O.reset()
    material = FrictMat(density=1000, frictionAngle=0.5)
    rocks = [shapes.random_rock(seed, faces=faces, rounding=r, k=k) for seed in range(4)]
    random = np.random.default_rng(1)
    for i in range(SIDE**3):
        place = 0.98 * np.array([i % SIDE, i // SIDE % SIDE, i // SIDE**2])
        O.bodies.append(
            body(rocks[i % len(rocks)], material, place, random.normal(size=4), velocity=1e-6 * random.normal(size=3)))
    contacts = Ig2_ConicPP_ConicPP_ScGeom(calContactArea=False, carryTolerance=0.0, measureTime=True)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB()], verletDist=0),
        InteractionLoop([contacts], [Ip2_FrictMat_FrictMat_KnKsPhys(Knormal=1e6, Kshear=1e6, kn_i=1e6, ks_i=1e6)],
                        [Law2_SCG_KnKsPhys_KnKsLaw()])
    ]
    O.dt = 1e-9
    least = np.inf
    O.run(2, True)
    for _ in range(5):
        before = contacts.seconds, contacts.calls
        O.run(STEPS // 5, True)
        least = min(least, (contacts.seconds - before[0]) / (contacts.calls - before[1]))
    return 1e6 * least


print("| planes | r | k | us a pair |\n|---|---|---|---|")
for faces, r, k in [(12, 0.05, 0.02), (24, 0.05, 0.02), (96, 0.05, 0.02), (24, 1e-4, 0.02), (24, 0.005, 0.02),
                    (24, 0.2, 0.02), (24, 0.05, 0.0), (24, 0.05, 1e-6), (24, 0.05, 0.2), (24, 0.05, 0.7)]:
    print(f"| {faces} | {r:g} | {k:g} | {microseconds(faces, r, k):.2f} |", flush=True)
