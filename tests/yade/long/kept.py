# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that saves itself every so many steps; or one of its saves, taken further.

    BODIES=30 FUNCTOR=library STEPS=4000 EVERY=500 SCENE=s LATER=1000 RESULT=unbroken.json \\
        scripts/yade.sh -j1 tests/yade/long/kept.py
    SCENE=s FROM=2500 EVERY=500 LATER=1000 RESULT=reloaded.json scripts/yade.sh -j1 tests/yade/long/kept.py

The first form runs to STEPS, saving as it goes, and LATER steps beyond. RESULT gets the states at all
multiples of EVERY. Run by tests/yade/long/run.py, which kills it.
"""
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

import potential_particles
from yade import O

import scene
from stepping import advance

path, every, states = os.environ["SCENE"], int(os.environ["EVERY"]), {}


def go_on(steps):
    for stop in range(O.iter + every, O.iter + steps + 1, every):
        advance(stop)
        states[stop] = scene.state()
        yield stop


if "BODIES" in os.environ:
    scene.build(int(os.environ["BODIES"]), os.environ["FUNCTOR"])
    for step in go_on(int(os.environ["STEPS"])):
        # Whole or not at all, so that a kill while it is written leaves no part of a save.
        potential_particles.save(f"{path}-{step}.yade.gz")
        print(f"saved at step {step}", flush=True)
else:
    O.load(f"{path}-{os.environ['FROM']}.yade.gz")
first = O.iter
for _ in go_on(int(os.environ["LATER"])):
    pass
functor = O.engines[2].geomDispatcher.functors[0]
Path(os.environ["RESULT"]).write_text(json.dumps({
    "saved_at": first, "states": states, "failures": getattr(functor, "failures", None),
    "contacts": sum(c.isReal for c in O.interactions)}))
