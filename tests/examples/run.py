#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs the examples and studies with few bodies and steps, as many at once as there are processors, and judges what
they write.

    tests/examples/run.py [--long] [NAME ...]

--long: those that take long, and no others. NAME: those whose names hold it.
What each must have reached stands in judged.py. The last line is 'N passed, N failed'; exit status 1 if anything
failed.
"""
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parents[1]
sys.path[:0] = [str(HERE), str(HERE.parent)]

from checks import Checks, jobs, short
from judged import PARTS, Outcome

SECONDS = 600


def run(part, folder):
    """(outcome, exit status, seconds) of one script, which writes into a folder of its own."""
    begin, out = time.monotonic(), folder / part.name
    out.mkdir()
    environment = {**os.environ, "OUTPUT": str(out), **{key: str(value) for key, value in part.environment.items()}}
    try:
        done = subprocess.run([str(TOP / part.command[0]), *part.command[1:-1],
                               str(TOP / part.command[-1])], cwd=out, env=environment, text=True, errors="replace",
                              timeout=SECONDS, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        status, said = done.returncode, done.stdout
    except subprocess.TimeoutExpired as late:
        status, said = f"none after {SECONDS} s", str(late.stdout)
    return Outcome(out, said), status, time.monotonic() - begin


def main():
    names = [name for name in sys.argv[1:] if name != "--long"]
    parts = [
        part for part in PARTS
        if (any(name in part.name for name in names) if names else part.is_long == ("--long" in sys.argv))
    ]
    check = Checks()
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(jobs()) as pool:
        for part, (outcome, status, seconds) in zip(parts, pool.map(lambda part: run(part, Path(name)), parts)):
            failed = check.failed
            if check.equal(status, part.status,
                           f"{part.name}: exit status; its last words:\n{short(outcome.said[-2000:], 6)}\n"):
                try:
                    for text, holds in part.judge(outcome):
                        check.true(holds, f"{part.name}: {text}")
                except Exception as error:
                    check.true(False, f"{part.name}: its results cannot be read: {error!r}")
            print(f"{'FAIL' if check.failed > failed else 'ok  '} {part.name:20} {seconds:5.1f} s", flush=True)
    return check.summary()


if __name__ == "__main__":
    sys.exit(main())
