#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the test_*.py scripts of this folder in YADE, as many at once as there are processors, and sums up.

    tests/yade/run.py [-j N]... [--long] [-v] [NAME ...]

Of its first lines, "# threads" says that a script is about threads: it runs with two, the others with one. "# long"
says that it takes long and says
little to a user: it is left to --long, which runs what is left out otherwise: those scripts, and all with the other
number of threads. -j, or a NAME: all scripts, with so many threads. Each script prints 'N passed, N failed' alone on
its last line. Exit status 1 if anything failed, if a script died, or if it checked nothing.
"""
import argparse
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from checks import jobs, short

PACKAGE = HERE.parent.parent / "yade-glue" / "build" / "python"
# What takes longer hangs: on one busy processor each takes below a minute.
SECONDS = 600
SUMMARY = re.compile(r"(\d+) passed, (\d+) failed")


def marked(script, mark):
    return f"# {mark}" in script.read_text().splitlines()[:5]


def run(script, threads, package):
    """(passed, failed, text, seconds) of one script, in a folder of its own."""
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        return *judged(script, threads, package, scratch), time.monotonic() - begin


def judged(script, threads, package, scratch):
    """(passed, failed, text) of one script; a script that died counts as one failure."""
    # Passive: threads of OpenMP that wait by spinning crawl when the machine is busy.
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(package), str(HERE)]), PP_PACKAGE=str(package),
                       OMP_WAIT_POLICY="passive")
    command = ["yade", "-x", "-n", f"-j{threads}", str(script)]
    try:
        done = subprocess.run(command, env=environment, cwd=scratch, text=True, errors="replace", timeout=SECONDS,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    except subprocess.TimeoutExpired as late:
        said = (late.stdout or b"").decode(errors="replace") if isinstance(late.stdout,
                                                                           (bytes, type(None))) else late.stdout
        return 0, 1, f"{said}\nFAILED: still running after {SECONDS} s"
    summary = next(filter(None, map(SUMMARY.fullmatch, reversed(done.stdout.splitlines()))), None)
    if not summary:
        return 0, 1, f"{done.stdout}\nFAILED: exit status {done.returncode}, no summary; its last words:\n    {short(done.stdout[-2000:], 8)}"
    passed, failed = map(int, summary.groups())
    if (done.returncode == 0) != (failed == 0) or passed + failed == 0:
        return passed, failed + 1, f"{done.stdout}\nFAILED: exit status {done.returncode} with {passed} passed, {failed} failed"
    return passed, failed, done.stdout


def faults(text):
    """The failed checks alone, each with the lines that belong to it; a script that died says its last words there."""
    taken = False
    for line in text.splitlines():
        taken = line.startswith("FAILED") or taken and line.startswith("    ")
        if taken:
            yield line


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("-j", dest="threads", type=int, action="append", help="threads of YADE")
    arguments.add_argument("--long", action="store_true", help="what is left out without it")
    arguments.add_argument("-v", dest="verbose", action="store_true", help="show the whole output of every script")
    arguments.add_argument("--package", type=lambda folder: Path(folder).resolve(), default=PACKAGE,
                           help="folder that holds the built package")
    arguments.add_argument("names", nargs="*", help="only scripts whose name contains one of these")
    options = arguments.parse_args()
    if not (options.package / "potential_particles" / "_glue.so").exists():
        sys.exit(f"no plugin in {options.package}: run make build")

    tasks = []
    for script in sorted(HERE.glob("test_*.py")):
        if options.names and not any(name in script.name for name in options.names):
            continue
        usual = 2 if marked(script, "threads") else 1
        if options.threads or options.names:
            counts = options.threads or [usual]
        elif options.long:
            counts = [1, 2] if marked(script, "long") else [3 - usual]
        else:
            counts = [] if marked(script, "long") else [usual]
        tasks += [(script, count, options.package) for count in counts]
    # The order must not matter: tests/flaky tries others.
    if os.environ.get("SHUFFLE"):
        random.Random(os.environ["SHUFFLE"]).shuffle(tasks)
    total_passed = total_failed = 0
    with ThreadPoolExecutor(jobs()) as pool:
        for (script, count, _), (passed, failed, text, seconds) in zip(tasks, pool.map(lambda task: run(*task), tasks)):
            total_passed += passed
            total_failed += failed
            print(
                f"{'FAIL' if failed else 'ok  '} {script.stem:24} -j{count}  {passed:4} passed {failed:3} failed  {seconds:5.1f} s",
                flush=True)
            for line in text.splitlines() if options.verbose else faults(text):
                print("    " * options.verbose + line)
            for line in text.splitlines():
                if line.startswith("skipped") and not options.verbose:
                    print("    " + line)
    print(f"{total_passed} passed, {total_failed} failed")
    return 1 if total_failed or not total_passed else 0


if __name__ == "__main__":
    sys.exit(main())
