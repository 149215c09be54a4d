# SPDX-License-Identifier: GPL-3.0-or-later
"""A pile of pyramids for very many steps, at rest or shaken; energies, overlaps, memory and the lost.

    BODIES=200 SETTLE=30000 STEPS=200000 SHAKEN=0 RESULT=rest.json scripts/yade.sh -j1 tests/yade/long/endurance.py

Run by tests/yade/long/run.py. Ctrl-C keeps what was found until then.
"""
import json
import os
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

import yade
from yade import O

import scene
import pile
from contact_functor import LIBRARY
from progress import Progress
from stepping import advance
from watch import Watch

LOOKS = int(os.environ.get("LOOKS", 200))
# Accelerations of 0.7, 0.8 and 0.35 g: the heap slides and hops, and lands again.
AMPLITUDE, FREQUENCY = (0.02, 0.015, 0.005), (3.0, 3.7, 4.2)  # m, Hz; along x, y, z


def main():
    bodies, settle, steps = (int(os.environ[name]) for name in ("BODIES", "SETTLE", "STEPS"))
    shaken = os.environ["SHAKEN"] == "1"
    box = scene.build(bodies, LIBRARY)
    watch = Watch(range(scene.SLABS, scene.SLABS + bodies), pile.GRAVITY)
    functor = O.engines[2].geomDispatcher.functors[0]
    progress = Progress(settle + steps)
    looks, interrupted = [], False
    try:
        for i in range(10):
            advance((i + 1) * settle // 10)
            progress.update(O.iter)
        if shaken:
            shake = yade.HarmonicMotionEngine(A=AMPLITUDE, f=FREQUENCY, ids=list(range(scene.SLABS)))
            O.engines = O.engines[:-1] + [shake, O.engines[-1]]
        looks.append(look(watch, box, functor))
        for i in range(LOOKS):
            advance(settle + (i + 1) * steps // LOOKS)
            looks.append(look(watch, box, functor))
            progress.update(O.iter)
    except KeyboardInterrupt:
        interrupted = True
    progress.close()
    Path(os.environ["RESULT"]).write_text(json.dumps({
        "bodies": bodies, "settle": settle, "steps": steps, "shaken": shaken, "interrupted": interrupted,
        "threads": O.numThreads, "looks": looks, "calls": functor.calls, "answers": functor.answers,
        "failure_report": functor.failureReport,
        "weight_times_size_J": sum(O.bodies[i].state.mass for i in range(scene.SLABS, scene.SLABS + bodies))
        * pile.GRAVITY * scene.SIZE}))


def look(watch, box, functor):
    sample = watch.look()
    floor = O.bodies[0].state
    positions = watch.poses()[0] - [floor.pos[0] - floor.refPos[0], floor.pos[1] - floor.refPos[1],
                                    floor.pos[2] - floor.refPos[2]]
    below, outside = box.lost(positions)
    return {
        "step": sample.step, "kinetic_J": sample.kinetic, "potential_J": sample.potential,
        "elastic_J": sample.elastic, "contacts": sample.contacts, "pairs": sample.candidates,
        "overlap_over_size": sample.overlap / scene.SIZE, "lost": int((below | outside).sum()),
        "failures": functor.failures, "resident_MiB": resident(), "fastest_m_per_s": float(watch.speeds().max()),
        "highest_m": float(positions[:, 2].max()),
    }


def resident():
    """Memory of this process now, MiB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 2**20


main()
