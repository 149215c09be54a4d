# SPDX-License-Identifier: MIT OR Apache-2.0
"""One run for benches/mpi_scale.py: settles a tile of a wide pile, or puts tiles side by side and times steps.

    TILE=tile.npz yade -x -n -j1 benches/yade/tiles.py
    TILE=tile.npz TILES=8,5 BOXES=ball RESULT=result.json scripts/yade_mpi.sh 3 -j1 benches/yade/tiles.py

A tile settles between four walls. Without them tiles fit together, since no body reaches across its walls by more than
an overlap.
"""

import json
import os
import sys
import time
from pathlib import Path

STUDIES = Path(sys.argv[0]).resolve().parent.parent.parent / "studies"
sys.path.insert(0, str(STUDIES))

import numpy as np
import yade
from potential_particles import mpi
from potential_particles.mpi.ranks import mpy
from yade import O

import pile
from box import Box

CELLS = (6, 6, 14)  # bodies of a tile, as they start
WIDTH = 0.15  # of a cell, m: two bodies never touch across
SETTLE_STEPS = 7000
VERLET_DISTANCE = 0.06 * pile.SIZE
# Steps before the clock starts, and so many blocks of steps under it: the fastest counts.
WARM_STEPS, BLOCKS = 15, 4
EXCHANGES = 200


def main():
    tile = Path(os.environ["TILE"])
    if "RESULT" not in os.environ:
        settle(tile)
        return
    across, along = map(int, os.environ["TILES"].split(","))
    steps = int(os.environ["STEPS"])
    ball = os.environ["BOXES"] == "ball"
    if mpi.rank() == 0:
        ids = lay(np.load(tile), across, along)
        if ball:
            mpi.safe_boxes(VERLET_DISTANCE)
        mpi.divide(ids)
    begin = time.perf_counter()
    mpi.run(WARM_STEPS, reallocate=0)
    started = time.perf_counter() - begin
    result = measure(steps)
    gathered = mpi.gather(result)
    if mpi.rank() == 0:
        Path(os.environ["RESULT"]).write_text(
            json.dumps({"ranks": mpi.ranks(), "first_seconds": started, "parts": gathered}))


def settle(path):
    """Positions and orientations of a tile at rest."""
    nx, ny, nz = CELLS
    random = np.random.default_rng(pile.SEED)
    grid = np.stack(np.meshgrid(np.arange(nx), np.arange(ny), np.arange(nz), indexing="ij"), -1).reshape(-1, 3)
    positions = (grid + [0.5 - nx / 2, 0.5 - ny / 2, 0.5]) * WIDTH
    orientations = random.normal(size=(len(grid), 4))
    fill(positions, orientations, nx * WIDTH / 2, ny * WIDTH / 2, nz * WIDTH)
    mpi.run(SETTLE_STEPS)
    found = pile.states(range(5, len(O.bodies)))
    np.savez(path, positions=found["pos"], orientations=found["ori"], kinetic=yade.utils.kineticEnergy())


def lay(tile, across, along):
    """So many tiles side by side, at rest."""
    wide, long = CELLS[0] * WIDTH, CELLS[1] * WIDTH
    shifts = [((i + 0.5 - across / 2) * wide, (j + 0.5 - along / 2) * long, 0.0) for i in range(across)
              for j in range(along)]
    positions = np.vstack([tile["positions"] + np.array(shift) for shift in shifts])
    orientations = np.vstack([tile["orientations"]] * len(shifts))
    return fill(positions, orientations, across * wide / 2, along * long / 2, tile["positions"][:, 2].max() + 0.2)


def fill(positions, orientations, half_x, half_y, height):
    """The scene of pile.py with these bodies; returns their ids."""
    heap = pile.Pile(1, measure_time=False)
    heap.box = Box(half_x, half_y, height, thickness=pile.SIZE)
    heap.start()
    heap.lay(positions, orientations)
    heap.finish()
    return heap.ids


def measure(steps):
    """Of this rank: seconds a step, of its engines and of an exchange of states, and what it had to do."""
    blocks, engines = [], {}
    for _ in range(BLOCKS):
        for engine in O.engines:
            engine.execTime = 0
        # Not mpi.run: mpy switches the timing of engines off.
        O.timingEnabled = True
        begin = time.perf_counter()
        O.run(steps, True)
        blocks.append((time.perf_counter() - begin) / steps)
        if blocks[-1] == min(blocks):
            engines = {engine.label or type(engine).__name__: 1e-9 * engine.execTime / steps for engine in O.engines}
    result = {
        "seconds": min(blocks),
        "engines": engines,
        "bodies": len(mpi.owned_bodies()),
        "pairs": len(O.interactions),
        "contacts": sum(1 for contact in O.interactions if contact.isReal),
        "states_sent": 0,
        "exchange_seconds": 0.0,
        "collide_seconds": 0.0,
    }
    if mpi.ranks() > 1:
        here = mpi.rank()
        if here:
            result["states_sent"] = sum(
                len(O.subD.intersections[k]) for k in O.subD.intersections[here] if k not in (0, here))
        result["exchange_seconds"] = timed(exchange, EXCHANGES)
        result["collide_seconds"] = timed(mpy.parallelCollide, 2)
    return result


def exchange():
    """What every step sends, without the step."""
    mpy.isendRecvForces()
    mpy.sendRecvStates()
    mpy.comm.allreduce(0)


def timed(action, times):
    mpy.comm.Barrier()
    begin = time.perf_counter()
    for _ in range(times):
        action()
    return (time.perf_counter() - begin) / times


mpi.launch(main)
