# SPDX-License-Identifier: MIT OR Apache-2.0
"""Times the steps of one scene, in YADE. Environment: JOB, an object in JSON with

scene: pyramids, spheres, or a name of scenes.KINDS; count, copies, best: of a pile, see piles.py; kept: where its bodies
are kept (settled and written there, and nothing measured, if they are not); part: one in so many rocks settles, in as
many of the steps; warming: steps before the clock starts; windows and steps: of each;
save: a file, through which the scene also goes; result: where the JSON goes.
"""

import json
import os
import pickle
import resource
import sys
import time
from dataclasses import replace
from pathlib import Path

HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "studies")]

import numpy as np
import potential_particles  # noqa: F401 (its classes stand beside YADE's)
from yade import O

import piles
import scenes

JOB = json.loads(os.environ["JOB"])


def main():
    kept, of_pile = Path(JOB["kept"]), JOB["scene"] in piles.KINDS
    if not kept.exists():
        if of_pile:
            piles.settle(JOB["scene"], JOB["count"], kept)
        else:
            kind, part = scenes.KINDS[JOB["scene"]], JOB["part"]
            scenes.settle(replace(kind, count=kind.count // part, settling=kind.settling // part), kept)
        return
    started, before = time.perf_counter(), memory()
    if of_pile:
        ids = piles.start(JOB["scene"], JOB["count"], np.load(kept), JOB["copies"], JOB["best"])
    else:
        rocks = pickle.loads(kept.read_bytes())
        ids = scenes.start(scenes.KINDS[JOB["scene"]], rocks, settling=False)
        O.dt = rocks["dt"]
    result = {"bodies": len(ids), "threads": O.numThreads, "set_up_seconds": time.perf_counter() - started}
    O.timingEnabled = True
    O.run(JOB["warming"], True)
    result["windows"] = [window(JOB["steps"]) for _ in range(JOB["windows"])]
    real, bodies = [pair for pair in O.interactions if pair.isReal], set(ids)
    functors = next(engine for engine in O.engines if engine.label == "contacts").geomDispatcher.functors
    result.update(
        contacts=len(real), with_boundaries=sum(not {pair.id1, pair.id2} <= bodies for pair in real),
        pairs=sum(1 for _ in O.interactions.all()), bytes_a_body=(memory() - before) / len(ids),
        failures=sum(getattr(functor, "failures", 0) for functor in functors))
    if JOB.get("save"):
        result.update(save_and_load(JOB["save"]))
    Path(JOB["result"]).write_text(json.dumps(result))


def window(steps):
    """Milliseconds a step by engine and in all; O.run waits in pieces of many milliseconds, the engines know better."""
    before = [engine.execTime for engine in O.engines]
    O.run(steps, True)
    row = {engine.label or "reset": (engine.execTime - earlier) / steps * 1e-6
           for engine, earlier in zip(O.engines, before)}
    return row | {"step": sum(row.values())}


def save_and_load(path):
    started = time.perf_counter()
    O.save(path)
    saved = time.perf_counter()
    O.load(path)
    loaded = time.perf_counter()
    return {"save_seconds": saved - started, "load_seconds": loaded - saved, "file_bytes": Path(path).stat().st_size}


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


main()
