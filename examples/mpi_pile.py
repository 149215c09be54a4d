# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks fall into a box on several processes (ranks), through YADE's module mpy:

    scripts/yade_mpi.sh 3 -j1 examples/mpi_pile.py

Rank 0 holds the box, the other ranks divide the rocks; with one rank it is a serial run. Environment: BODIES (1000),
STEPS (5000), RESUME (1: go on from the saved scene, to STEPS), OUTPUT (out/mpi). Writes rocks.png, rocks.*.pvd for
ParaView, rocks.yade.gz, the saved scene, and summary.json. Ctrl-C saves and ends. SI units; z up.
"""
import os
import time

import numpy as np
import potential_particles
from potential_particles import ConicPotentialParticle, boundaries, files, mpi, packing, shapes
from yade import *

COUNT, STEPS = int(os.environ.get("BODIES") or 1000), int(os.environ.get("STEPS") or 5000)
OUT, RESUME = os.environ.get("OUTPUT") or "out/mpi", os.environ.get("RESUME") == "1"
SCENE = os.path.join(OUT, "rocks.yade.gz")
SIZE = 0.1  # of a rock, m
SIDE = SIZE * (2.0 * COUNT) ** (1 / 3)  # of the box, m
LOOKS = 10


def build():
    """Fills the scene of rank 0."""
    O.materials.append(FrictMat(young=2e7, poisson=0.3, frictionAngle=0.5, density=2600))
    rocks = [shapes.random_rock(seed, size=SIZE) for seed in range(8)]
    placed = potential_particles.pack(packing.Box((0, 0, 0), (SIDE, SIDE, 2 * SIDE)), rocks, number=COUNT,
                                      progress=False)
    O.bodies.append(boundaries.box_walls((0, 0, 0), (SIDE, SIDE, 2 * SIDE)))
    potential_particles.add_packing(placed, color=(0.75, 0.55, 0.35))
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


def main():
    """The same on every rank; what only rank 0 knows is asked for there."""
    os.makedirs(OUT, exist_ok=True)
    ids = None
    if mpi.rank() == 0:
        mpi.load(SCENE) if RESUME else build()
        ids = [body.id for body in O.bodies if isinstance(body.shape, ConicPotentialParticle)]
        mpi.divide(ids)
    record = potential_particles.Recorder(os.path.join(OUT, "rocks"))
    mpi.run(0)
    first, seconds, overlap, stopped = O.iter, 0.0, 0.0, False
    record()
    for look in range(1, LOOKS + 1):
        if STEPS * look // LOOKS <= O.iter:
            continue
        begin = time.perf_counter()
        mpi.run(STEPS * look // LOOKS - O.iter)
        seconds += time.perf_counter() - begin
        depths = mpi.gather(max((one.geom.penetrationDepth for one in mpi.owned_contacts()), default=0.0))
        record()
        if mpi.rank() == 0:
            overlap = max(overlap, *depths)
            print(f"step {O.iter:,} of {STEPS:,}, {seconds:.0f} s", flush=True)
        stopped = mpi.interrupted()  # Ctrl-C
        if stopped:
            break
    states, failures, counters, steps = mpi.states(ids), mpi.failures(), mpi.counters(), O.iter
    parts = mpi.gather((len(mpi.owned_bodies()), len(mpi.owned_contacts())))
    mpi.save(SCENE)
    if mpi.rank():
        return
    place, shares = states["position"], [bodies for bodies, _ in parts[1:]]
    found = {
        "bodies": len(ids), "ranks": mpi.ranks(), "first_step": first, "steps": steps, "interrupted": stopped,
        "stepping_seconds": seconds, "mean_height_m": float(place[:, 2].mean()), "bodies_of_workers": shares,
        "contacts": sum(contacts for _, contacts in parts), "counters": counters, "failure_report": failures,
        "failures": len(failures), "lost": int(((place < 0) | (place > [SIDE, SIDE, 4 * SIDE])).any(1).sum()),
        "largest_overlap_over_size": overlap / SIZE,
        "largest_share_over_mean": max(shares) / np.mean(shares) if shares else 1.0
    }
    found["targets"] = [{"name": name, "sense": "at most", "target": most, "measured": found[name],
                         "met": bool(found[name] <= most)} for name, most in (
                             ("failures", 0), ("lost", 0), ("largest_overlap_over_size", 0.05),
                             ("largest_share_over_mean", 1.2))]
    files.write_summary(os.path.join(OUT, "summary.json"), found)
    O.load(SCENE)
    potential_particles.plot(os.path.join(OUT, "rocks.png"))
    print(f"{len(ids)} rocks on {mpi.ranks()} ranks, {steps} steps, {seconds:.1f} s: mean height "
          f"{found['mean_height_m']:.3f} m, {found['contacts']} contacts; failures: {failures or 'none'}; "
          f"missed: {[one['name'] for one in found['targets'] if not one['met']] or 'nothing'}")


mpi.launch(main)
