# SPDX-License-Identifier: MIT OR Apache-2.0
"""A scene of piles.py or scenes.py, settled once and kept, and timed by measure.py in a process of its own."""

import hashlib
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parents[1] / "yade-glue" / "build" / "python"


@dataclass(frozen=True)
class Run:
    """What measure.py does. Windows of piles are short, to fit between what else the machine does."""

    scene: str
    warming: int  # steps before the first window
    windows: int
    steps: int  # of a window
    count: int = 0  # of the settled pile
    copies: int = 1
    threads: int = 1
    best: bool = True
    once: bool = False  # long: in the first turn alone, and it is saved and loaded, too
    part: int = 1  # of a scene's rocks and settling, one in so many

    @property
    def size(self):
        return self.count * self.copies


def settled(out, run):
    """The file with the bodies of a run, made where it is not there yet."""
    name = run.scene.replace(" ", "_").replace(",", "")
    # What made the bodies is part of the name: another scene is settled anew.
    made_by = hashlib.sha256((HERE / "scenes.py").read_bytes()).hexdigest()[:8]
    kept = out / (f"{name}_{run.count}.npz" if run.count else f"{name}_{made_by}_{run.part}.pickle")
    if not kept.exists():
        _measure(run, PACKAGE, kept, {"scene": run.scene, "count": run.count, "part": run.part, "kept": str(kept)})
    return kept


def measured(out, run, package=PACKAGE, quick=False):
    """What measure.py says of a run."""
    result = out / "result.json"
    result.unlink(missing_ok=True)
    _measure(run, package, result, {
        "scene": run.scene, "count": run.count, "copies": run.copies, "best": run.best, "warming": run.warming,
        "windows": 2 if quick else run.windows, "steps": run.steps, "kept": str(settled(out, run)),
        "result": str(result), "save": str(out / "saved.yade.gz") if run.once else None
    })  # fmt: skip
    return json.loads(result.read_text())


def _measure(run, package, wanted, job):
    command = ["/usr/bin/yade", "-x", "-n", f"-j{run.threads}", str(HERE / "measure.py")]
    environment = dict(os.environ, PYTHONPATH=str(package), OMP_WAIT_POLICY="passive", JOB=json.dumps(job))
    done = subprocess.run(command, env=environment, text=True, stdin=subprocess.DEVNULL, capture_output=True)
    if not wanted.exists():
        sys.exit(f"{run.scene}: no result\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
