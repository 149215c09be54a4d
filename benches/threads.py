#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""One thread of YADE against two, on piles of pyramids: how much faster, and how alike the results.

    /usr/bin/python3 benches/threads.py [BODIES ...]       (default: 200 2000)

Each pile falls first; its state is then taken further by `yade -j1` and by `yade -j2`, in turns.
The functor's time is that of the thread that spent most in it; the loop's is YADE's InteractionLoop
(contacts, physics and law), by the clock on the wall; a step is the sum of all engines. Of many short
blocks of steps the fastest counts: what else the machine does can only add. It needs two cores for
itself all the same; the load of the last minute is kept with the results, in out/threads/summary.json.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(TOP / "studies"))

import machine
from summary import write_summary

PILES = (200, 2000)
# Until the last ones of the tower have landed.
STEPS = 7000
ROUNDS = 5


def yade(threads, **environment):
    done = subprocess.run(
        [TOP / "scripts" / "yade.sh", f"-j{threads}", TOP / "benches" / "yade" / "pile.py"],
        env={**os.environ, **environment},
        stdout=subprocess.DEVNULL if "RESULT" in environment else None,
    )
    if done.returncode:
        raise SystemExit(f"threads.py: yade -j{threads} ended with exit code {done.returncode}.")


def compare(count, folder):
    scene = str(folder / "pile.yade.gz")
    print(f"{count:,} pyramids fall for {STEPS:,} steps", flush=True)
    yade(2, BODIES=str(count), STEPS=str(STEPS), SCENE=scene)
    runs = {1: [], 2: []}
    for _ in range(ROUNDS):
        for threads, results in runs.items():
            result = folder / "result.json"
            yade(threads, SCENE=scene, RESULT=str(result))
            results.append(json.loads(result.read_text()))
    one, two = runs[1][0], runs[2][0]
    steps = one["block_steps"]

    def fastest(threads, what):
        return min(block[what] for run in runs[threads] for block in run["blocks"])

    return {
        "bodies": one["bodies"],
        "pairs": one["pairs"],
        "contacts": one["contacts"],
        "skipped_share": one["skipped"],
        "failures": one["failures"] + two["failures"],
        "functor_ratio": fastest(1, "functor") / fastest(2, "functor"),
        "loop_ratio": fastest(1, "loop") / fastest(2, "loop"),
        "step_ratio": fastest(1, "steps") / fastest(2, "steps"),
        "us_per_pair": {threads: 1e6 * fastest(threads, "functor") / (steps * one["pairs"]) for threads in runs},
        "largest_distance": largest(one["positions"], two["positions"]),
        "largest_turn": largest(one["orientations"], two["orientations"]),
        "steps_compared": steps * len(one["blocks"]),
    }


def largest(first, second):
    return max(math.dist(a, b) for a, b in zip(first, second, strict=True))


def main():
    piles = [int(argument) for argument in sys.argv[1:]] or PILES
    rows, load = [], os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        for count in piles:
            rows.append(compare(count, Path(folder)))
    out = TOP / "out" / "threads"
    out.mkdir(parents=True, exist_ok=True)
    summary = {"machine": machine.machine_line(), "date": machine.now(), "load_before": load, "piles": rows}
    write_summary(out / "summary.json", summary)
    print(f"\n  {'bodies':>7} {'pairs':>7} {'in contact':>10}   time of one thread / of two     off by, after steps")
    print(f"  {'':26}   {'functor':>8} {'loop':>7} {'step':>7}")
    for row in rows:
        print(
            f"  {row['bodies']:>7,} {row['pairs']:>7,.0f} {row['contacts']:>10,.0f}   {row['functor_ratio']:>8.2f} "
            f"{row['loop_ratio']:>7.2f} {row['step_ratio']:>7.2f}     {row['largest_distance']:.1e} m, "
            f"{row['largest_turn']:.1e}; {row['steps_compared']:,} steps"
        )
    print(f"\n  {summary['machine']}; load before: {load:.1f}; {out}/summary.json")


main()
