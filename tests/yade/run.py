#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the test_*.py scripts of this folder in YADE, with one and with two threads, and sums up.

    tests/yade/run.py [-j 1] [-j 2] [-v] [name ...]

As many scripts run at once as there are processors: each is a process, and most of its time is YADE's start.
Each script prints 'N passed, N failed' alone on its last line. Exit status 1 if anything failed, if
a script died, or if a script checked nothing.
"""
import argparse
import functools
import os
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent.parent / "yade-glue" / "build" / "python"
SECONDS = 300
SUMMARY = re.compile(r"(\d+) passed, (\d+) failed")
NOISE = re.compile(r"Welcome to Yade|Using python version|XMLRPC info|TCP python prompt|Running script")


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
        done = subprocess.run(command, env=environment, cwd=scratch, text=True, timeout=SECONDS,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    except subprocess.TimeoutExpired as late:
        return 0, 1, f"{late.stdout or ''}\nstill running after {SECONDS} s"
    lines = [line for line in done.stdout.splitlines() if line and not NOISE.match(line)]
    summary = next((found for found in map(SUMMARY.fullmatch, reversed(lines)) if found), None)
    text = "\n".join(lines)
    if not summary:
        return 0, 1, f"{text}\nexit status {done.returncode}, no summary"
    passed, failed = map(int, summary.groups())
    if (done.returncode == 0) != (failed == 0) or passed + failed == 0:
        return passed, failed + 1, f"{text}\nexit status {done.returncode} does not fit"
    return passed, failed, text


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("-j", dest="threads", type=int, action="append",
                           help="threads of YADE (default: once 1, once 2)")
    arguments.add_argument("-v", dest="verbose", action="store_true", help="show the output of scripts that pass, too")
    arguments.add_argument("--package", type=lambda folder: Path(folder).resolve(), default=PACKAGE, help="folder that holds the built package")
    arguments.add_argument("names", nargs="*", help="only scripts whose name contains one of these")
    options = arguments.parse_args()
    if not (options.package / "potential_particles" / "_glue.so").exists():
        sys.exit(f"no plugin in {options.package}; build it: "
                 "cmake -S yade-glue -B yade-glue/build && cmake --build yade-glue/build")

    scripts = [script for script in sorted(HERE.glob("test_*.py"))
               if not options.names or any(name in script.name for name in options.names)]
    total_passed = total_failed = 0
    for threads in options.threads or [1, 2]:
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            results = pool.map(functools.partial(run, threads=threads, package=options.package), scripts)
            for script, (passed, failed, text, seconds) in zip(scripts, results):
                total_passed += passed
                total_failed += failed
                print(f"{'FAIL' if failed else 'ok  '} {script.stem:24} -j{threads}  {passed:4} passed {failed:3} failed"
                      f"  {seconds:5.1f} s", flush=True)
                # What failed stands first: logs of a build server are cut.
                lines = sorted(text.splitlines(), key=lambda line: not line.startswith("FAILED"))
                for line in lines if failed or options.verbose else [line for line in lines if line.startswith("skipped")]:
                    print("    " + line)
    print(f"{total_passed} passed, {total_failed} failed")
    return 1 if total_failed or not total_passed else 0


if __name__ == "__main__":
    sys.exit(main())
