# SPDX-License-Identifier: MIT OR Apache-2.0
"""Times the steps of one scene, in YADE. Environment: SCENE (its name), KEPT (where its rocks are kept; settled and
written there, and nothing measured, if they are not), WARMING, WINDOWS and STEPS (of each), RESULT (where the JSON
goes).
"""
import json
import os
import pickle
import sys
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from yade import O

import scenes


def main():
    kind, kept = scenes.KINDS[os.environ["SCENE"]], Path(os.environ["KEPT"])
    if not kept.exists():
        scenes.settle(kind, kept)
        return
    rocks = pickle.loads(kept.read_bytes())
    ids = scenes.start(kind, rocks, settling=False)
    O.dt = rocks["dt"]
    O.timingEnabled = True
    O.run(int(os.environ["WARMING"]), True)
    rows = []
    steps = int(os.environ["STEPS"])
    for _ in range(int(os.environ["WINDOWS"])):
        before = [engine.execTime for engine in O.engines]
        O.run(steps, True)
        row = {engine.label: (engine.execTime - earlier) / steps * 1e-6 for engine, earlier in zip(O.engines, before)}
        rows.append(row | {"step": sum(row.values())})
    real = [pair for pair in O.interactions if pair.isReal]
    rocks = set(ids)
    functors = next(engine for engine in O.engines if engine.label == "contacts").geomDispatcher.functors
    counts = {"contacts": len(real), "with boundaries": sum(not {pair.id1, pair.id2} <= rocks for pair in real),
              "pairs": sum(1 for _ in O.interactions.all()), "failures": sum(functor.failures for functor in functors)}
    Path(os.environ["RESULT"]).write_text(json.dumps({"windows": rows, "counts": counts}))


main()
