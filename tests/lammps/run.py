#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The LAMMPS plugin against a loop in Python, closed forms, itself on several ranks, and bad input.

    tests/lammps/run.py [NAME ...]      (NAME: part of the name of a test)

Needs `scripts/lammps_setup.sh`, and g++ for one test. The last line is 'N passed, N failed'; exit status 1 if anything failed.
"""
import inspect
import sys
import tempfile
import traceback
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "lammps-glue" / "python")]

import test_examples
import test_input
import test_motion
import test_patch
import test_ranks
import test_walls

passed = failed = 0
for module in (test_motion, test_walls, test_patch, test_ranks, test_input, test_examples):
    for name, test in inspect.getmembers(module, inspect.isfunction):
        if not name.startswith("test_") or test.__module__ != module.__name__ or (sys.argv[1:] and not any(part in name for part in sys.argv[1:])):
            continue
        with tempfile.TemporaryDirectory() as folder:
            try:
                test(Path(folder))
                passed += 1
            except Exception:
                failed += 1
                print(f"FAILED: {module.__name__}: {name}\n{traceback.format_exc()}", flush=True)
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0 or passed == 0)
