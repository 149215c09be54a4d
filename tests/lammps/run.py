#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The LAMMPS plugin against a loop in Python, closed forms, itself on several ranks, and bad input.

Needs `scripts/lammps_setup.sh`, and cc for one test. The last line is 'N passed, N failed'; exit status 1 if anything
failed.
"""
import argparse
import inspect
import os
import resource
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "out" / "lammps" / "build" / "python")]

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


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="part of the name of a test")
    parser.add_argument("--all", action="store_true", help="without names: those that take long, too")
    parser.add_argument("--times", action="store_true", help="the processor time of each")
    return parser.parse_args()


def chosen(names, with_long):
    found = []
    for module in (test_patch, test_motion, test_ranks, test_walls, test_seams, test_remembered, test_entered,
                   test_input, test_examples):
        for name, test in inspect.getmembers(module, inspect.isfunction):
            if name.startswith("test_") and test.__module__ == module.__name__:
                if any(part in name for part in names) or not names and (with_long or not hasattr(test, "long")):
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
    asked = arguments()
    tests = chosen(asked.names, asked.all)
    failed, total = 0, 0.0
    with ProcessPoolExecutor(max_workers=min(2, len(os.sched_getaffinity(0)))) as pool:
        for test, (failure, seconds) in zip(tests, pool.map(tried, tests)):
            failed += failure is not None
            total += seconds
            if failure:
                print(failure, flush=True)
            if asked.times:
                print(f"{seconds:6.1f} s  {test.__module__}.{test.__name__}", flush=True)
    if asked.times:
        print(f"{total:6.1f} s of processor time")
    print(f"{len(tests) - failed} passed, {failed} failed")
    sys.exit(failed > 0 or not tests)
