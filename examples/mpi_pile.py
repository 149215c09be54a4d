# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks fall into a box on several processes (ranks), through YADE's module mpy:

    scripts/yade_mpi.sh 3 -j1 examples/mpi_pile.py

Rank 0 holds the box, the other ranks divide the rocks; with one rank it is a serial run. Environment: BODIES (1000),
STEPS (5000), OUTPUT (out/mpi_rocks). Writes rocks.*.pvd for ParaView and rocks.yade.gz, the saved scene, from which
mpi.load goes on. SI units; z up.
"""
import os

import potential_particles
from potential_particles import boundaries, mpi, packing, shapes
from yade import *

COUNT, STEPS = int(os.environ.get("BODIES", 1000)), int(os.environ.get("STEPS", 5000))
OUT = os.environ.get("OUTPUT", "out/mpi_rocks")
SIZE = 0.1  # of a rock, m
LOOKS = 5


def build():
    """Fills the scene of rank 0 and divides it; returns the ids of the rocks."""
    O.materials.append(FrictMat(young=2e7, poisson=0.3, frictionAngle=0.5, density=2600))
    side = SIZE * (2.0 * COUNT) ** (1 / 3)
    rocks = [shapes.random_rock(seed, size=SIZE) for seed in range(8)]
    placed = potential_particles.pack(packing.Box((0, 0, 0), (side, side, 2 * side)), rocks, number=COUNT,
                                      progress=False)
    O.bodies.append(boundaries.box_walls((0, 0, 0), (side, side, 2 * side)))
    ids = potential_particles.add_packing(placed, color=(0.75, 0.55, 0.35))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([PotentialParticle2AABB(), Bo1_Facet_Aabb()]),
        InteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()],
                        [Ip2_FrictMat_FrictMat_FrictPhys()],
                        [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
        NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True),
    ]
    O.dt = potential_particles.critical_time_step()
    mpi.safe_boxes(0.06 * SIZE)
    mpi.divide(ids)
    return ids


def main():
    """The same on every rank; what only rank 0 knows is asked for there."""
    os.makedirs(OUT, exist_ok=True)
    ids = build() if mpi.rank() == 0 else None
    record = potential_particles.Recorder(os.path.join(OUT, "rocks"))
    mpi.run(0)
    record()
    for look in range(LOOKS):
        mpi.run(STEPS * (look + 1) // LOOKS - O.iter)
        record()
        if mpi.interrupted():  # Ctrl-C
            break
    states, failures, steps = mpi.states(ids), mpi.failures(), O.iter
    mpi.save(os.path.join(OUT, "rocks.yade.gz"))
    if mpi.rank() == 0:
        print(
            f"{COUNT} rocks on {mpi.ranks()} ranks, {steps} steps: mean height {states['position'][:, 2].mean():.3f} m, "
            f"lowest {states['position'][:, 2].min():.3f} m; failures: {failures or 'none'}")


mpi.launch(main)
