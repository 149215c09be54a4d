# SPDX-License-Identifier: MIT OR Apache-2.0
"""One case in YADE: run.py starts it with CASE, OUTPUT (a file) and SHORT in the environment.

Lines "part 0.25" on standard output say how far it is.
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


def note(part):
    print(f"part {part:.4f}", flush=True)


def main():
    begin = time.perf_counter()
    case = importlib.import_module(os.environ["CASE"])
    result = case.run(note, short=os.environ.get("SHORT") == "1")
    result["wall_seconds"] = time.perf_counter() - begin
    result["versions"] = {
        "yade": yade.config.version,
        "library": potential_particles.library_version(),
        "glue": potential_particles.__version__,
    }
    write_summary(Path(os.environ["OUTPUT"]), result)


main()
