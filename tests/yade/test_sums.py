# SPDX-License-Identifier: GPL-3.0-or-later
# ConicInteractionLoop adds up forces in the order of ids: whatever the number of threads, all numbers are to the last
# bit those of YADE's loop in one thread that goes through its sorted list.
import os
import subprocess

import yade
from harness import *

check = Checks()
SCRIPT = os.path.join(os.environ["PYTHONPATH"].split(os.pathsep)[-1], "bits.py")


def cases(loop, threads):
    """What each case of bits.py prints, by its name."""
    environment = dict(os.environ, LOOP=loop)
    done = subprocess.run(["yade", "-x", "-n", f"-j{threads}", SCRIPT], env=environment, text=True, capture_output=True,
                          stdin=subprocess.DEVNULL)
    lines = [line.split("|")[1:] for line in done.stdout.splitlines() if line.startswith("case|")]
    check.equal(done.returncode, 0, f"{loop}, {threads} threads: {done.stdout[-1500:]}{done.stderr[-1500:]}")
    return {name: (int(used), int(most), int(failures), digests) for name, used, most, failures, digests in lines}


expected = cases("ConicInteractionLoop", 1)
check.equal(len(expected), 4, "cases")
for name, (_, most, failures, _) in expected.items():
    check.true(most >= 10, f"{name}: contacts at a time: {most}")
    check.equal(failures, 0, f"{name}: failures")
# In the run with one thread the other loop, in that with two other numbers of threads.
for loop, threads in [("InteractionLoop", 1)] if O.numThreads == 1 else [("ConicInteractionLoop", 2),
                                                                         ("ConicInteractionLoop", 3)]:
    for name, (used, *found) in cases(loop, threads).items():
        check.equal(used, threads, f"{name}: threads")
        check.equal(found, list(expected[name][1:]), f"{name}: {loop} in {threads} threads, to the last bit")
check.finish()
