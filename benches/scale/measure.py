# SPDX-License-Identifier: MIT OR Apache-2.0
"""Times the steps of one pile at rest, in YADE. Environment:

KIND (pyramids, spheres), COUNT (bodies of the kept pile), COPIES of it, PILE (where it is kept; settled
and written there if it is not), WAY (best: ConicInteractionLoop and BoundWatch, plain: YADE's own loop and boxes),
STUDIES (the folder with the scenes of its commit), WINDOWS and STEPS (of each), SAVE (a file: also saves and loads the
scene), RESULT (where the JSON goes).
"""

import json
import os
import resource
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

import numpy as np
import yade
from yade import O

from piles import PYRAMIDS, SETTLING_DAMPING, SETTLING_STEPS, Pile

WARMING = 60  # steps before the first window: memories, sleeping pairs and caches are then as they stay


def main():
    kind, count = os.environ["KIND"], int(os.environ["COUNT"])
    copies = int(os.environ.get("COPIES", "1"))
    kept = Path(os.environ["PILE"])
    if not kept.exists():
        settle(kind, count, kept)
    import_plugin(kind)
    best = kind == PYRAMIDS and os.environ.get("WAY", "best") == "best"
    pile = Pile(kind, count, loop=None if best else yade.InteractionLoop, watched=best)
    started = time.perf_counter()
    before = memory()
    pile.kept(np.load(kept), copies)
    set_up = time.perf_counter() - started
    O.run(WARMING, True)
    result = windows(int(os.environ.get("WINDOWS", "12")), int(os.environ.get("STEPS", "60")))
    real = sum(1 for contact in O.interactions if contact.isReal)
    result.update(
        kind=kind, bodies=len(pile.ids), contacts=real, threads=O.numThreads, set_up_seconds=set_up,
        pairs=sum(1 for _ in O.interactions.all()),
        bytes_a_body=(memory() - before) / len(pile.ids),
        failures=pile.contact.functor.failures if pile.contact else 0,
    )
    if os.environ.get("SAVE"):
        result.update(save_and_load(os.environ["SAVE"]))
    Path(os.environ["RESULT"]).write_text(json.dumps(result))


def import_plugin(kind):
    if kind == PYRAMIDS:
        import potential_particles  # noqa: F401 (its classes stand beside YADE's)


def settle(kind, count, path):
    import_plugin(kind)
    pile = Pile(kind, count)
    pile.loose()
    O.engines[-1].damping = SETTLING_DAMPING
    O.run(SETTLING_STEPS, True)
    np.savez(path, **pile.states())


def windows(number, steps):
    """Fastest window of each engine and of the whole step, and the medians, ms a step."""
    rows = []
    for _ in range(number):
        before = [engine.execTime for engine in O.engines]
        started = time.perf_counter()
        O.run(steps, True)
        row = {"step": (time.perf_counter() - started) / steps * 1e3}
        for engine, earlier in zip(O.engines, before):
            row[engine.label or "reset"] = (engine.execTime - earlier) / steps * 1e-6
        # O.run waits in pieces of many milliseconds; the engines know better.
        row["step"] = sum(value for name, value in row.items() if name != "step")
        rows.append(row)
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    return {
        "fastest": {name: min(values) for name, values in columns.items()},
        "median": {name: float(np.median(values)) for name, values in columns.items()},
    }


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
