#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The LAMMPS plugin against a loop in Python, closed forms, itself on several ranks, and bad input.

    tests/lammps/run.py [--all] [--times] [NAME ...]      (NAME: part of the name of a test)

Without names the tests that are not marked `long`, or, with --all, all. Needs `scripts/lammps_setup.sh`, and cc for one
test. The last line is 'N passed, N failed'; exit status 1 if anything failed. --times: with the processor time of each.
"""
import inspect
import os
import resource
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "lammps-glue" / "python")]

import report
import test_entered
import test_examples
import test_input
import test_motion
import test_patch
import test_ranks
import test_remembered
import test_seams
import test_walls


def chosen(arguments):
    names, found = [a for a in arguments if not a.startswith("--")], []
    for module in (test_patch, test_motion, test_ranks, test_walls, test_seams, test_remembered, test_entered,
                   test_input, test_examples):
        for name, test in inspect.getmembers(module, inspect.isfunction):
            if name.startswith("test_") and test.__module__ == module.__name__:
                if any(part in name
                       for part in names) or not names and ("--all" in arguments or not hasattr(test, "long")):
                    found.append(test)
    return found


def tried(test):
    """(what failed, or nothing; processor time of LAMMPS and the test)."""
    before = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    failure = None
    with tempfile.TemporaryDirectory(prefix="lammps-") as folder:
        try:
            test(Path(folder))
        except Exception as raised:
            failure = report.of_failure(test, raised)
    after = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return failure, sum(a.ru_utime + a.ru_stime - b.ru_utime - b.ru_stime for a, b in zip(after, before))


if __name__ == "__main__":
    tests = chosen(sys.argv[1:])
    failed, total = 0, 0.0
    with ProcessPoolExecutor(max_workers=min(2, len(os.sched_getaffinity(0)))) as pool:
        for test, (failure, seconds) in zip(tests, pool.map(tried, tests)):
            failed += failure is not None
            total += seconds
            if failure:
                print(failure, flush=True)
            if "--times" in sys.argv:
                print(f"{seconds:6.1f} s  {test.__module__}.{test.__name__}", flush=True)
    if "--times" in sys.argv:
        print(f"{total:6.1f} s of processor time")
    print(f"{len(tests) - failed} passed, {failed} failed")
    sys.exit(failed > 0 or not tests)
