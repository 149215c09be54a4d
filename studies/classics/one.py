# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cases in YADE, one after the other: run.py starts it with CASES (names), OUTPUT (a folder) and SHORT in the
environment.

Lines "part NAME 0.25" on standard output say how far it is; each case leaves NAME.json.
"""

import importlib
import os
import sys
import time
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import yade
import potential_particles

from summary import write_summary


def main():
    for name in os.environ["CASES"].split(","):
        one(name, Path(os.environ["OUTPUT"]), os.environ.get("SHORT") == "1")


def one(name, folder, short):
    """Runs a case and writes what it found."""
    begin = time.perf_counter()
    case = importlib.import_module(name)
    result = case.run(lambda part: print(f"part {name} {part:.4f}", flush=True), short)
    result["wall_seconds"] = time.perf_counter() - begin
    result["versions"] = {
        "yade": yade.config.version,
        "library": potential_particles.library_version(),
        "glue": potential_particles.__version__,
    }
    write_summary(folder / f"{name}.json", result)


main()
