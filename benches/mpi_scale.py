#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""When several processes pay: steps of a wide pile on one process, two threads, and two and three ranks; and a model of
many nodes.

    benches/mpi_scale.py [RUN ...]       (RUN: a name in RUNS; default: all that have no result yet)

The pile is made of equal tiles at rest. Each run writes its result to out/mpi/scale; with all there, summary.json,
scale.png and a table follow. The machine must be left alone meanwhile: several minutes and 8 GB.
"""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

TOP = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(TOP / "studies"))

from summary import made, print_columns, print_targets, results_of, target, write_summary

OUT = TOP / "out" / "mpi" / "scale"
SMALL, LARGE = "8,5", "20,10"  # tiles of 504 bodies
# Name: ranks, threads, boxes, tiles, steps of a block.
RUNS = {
    "small_1": (1, 1, "tight", SMALL, 8),
    "small_1_ball": (1, 1, "ball", SMALL, 8),
    "small_threads": (1, 2, "tight", SMALL, 8),
    "small_2": (2, 1, "ball", SMALL, 8),
    "small_3": (3, 1, "ball", SMALL, 8),
    "large_1": (1, 1, "tight", LARGE, 3),
    "large_threads": (1, 2, "tight", LARGE, 3),
    "large_3": (3, 1, "ball", LARGE, 3),
}
TILE_SIDE, TILE_BODIES = 0.9, 504  # m
STATE_BYTES = 13 * 8  # position, velocity, angular velocity, orientation

# Assumptions of the model that are not measured here.
BYTES_PER_SECOND = 1.25e9  # 10 Gbit/s for each worker
LATENCY = 10e-6  # s, for each of the log2(ranks) rounds of a collective call, of which a step has two
STEPS_BETWEEN_COLLISIONS = 40  # bodies at 1 m/s, 0.15 ms a step, and a Verlet distance of 6 mm
MODELLED = (10**5, 10**6, 10**7)


def measure(name):
    ranks, threads, boxes, tiles, steps = RUNS[name]
    tile = OUT / "tile.npz"
    if not tile.exists():
        start(1, 2, TILE=str(tile))
    result = OUT / "result.json"
    start(ranks, threads, TILE=str(tile), TILES=tiles, BOXES=boxes, STEPS=str(steps), RESULT=str(result))
    return json.loads(result.read_text())


def start(ranks, threads, **environment):
    launcher = [TOP / "scripts" / "yade.sh"] if ranks == 1 else [TOP / "scripts" / "yade_mpi.sh", str(ranks)]
    done = subprocess.run([*launcher, f"-j{threads}", TOP / "benches" / "yade" / "tiles.py"],
                          env={**os.environ, **environment}, stdout=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(f"mpi_scale.py: {environment} on {ranks} ranks ended with exit code {done.returncode}.")


def costs(runs):
    """Seconds for a body, a pair, a contact, a state sent, ..., from the measured runs."""
    tight, ball = runs["small_1"]["parts"][0], runs["small_1_ball"]["parts"][0]
    pair, contact = contact_costs(runs)
    workers = [part for name in ("small_3", "large_3") for part in runs[name]["parts"][1:]]
    alone = runs["small_2"]["parts"][1]
    sent = max(workers, key=lambda part: part["states_sent"])
    collide = sum(part["collide_seconds"] / part["bodies"] for part in workers) / len(workers)
    return {
        "body": tight["engines"]["motion"] / tight["bodies"],
        "serial_collider_a_body": tight["engines"]["collider"] / tight["bodies"],
        "pair": pair,
        "contact": contact,
        "collide_a_body": collide,
        "exchange": alone["exchange_seconds"],
        "state": (sent["exchange_seconds"] - alone["exchange_seconds"]) / sent["states_sent"],
        "pairs_a_body_tight": tight["pairs"] / tight["bodies"],
        "pairs_a_body_ball": ball["pairs"] / ball["bodies"],
        "contacts_a_body": tight["contacts"] / tight["bodies"],
        "states_a_metre": sent_states_a_metre(runs),
    }


def busy(runs):
    """The processes of one thread that had bodies."""
    return [part for name, run in runs.items() if RUNS[name][1] == 1 for part in run["parts"] if part["contacts"]]


def contact_costs(runs):
    """Seconds for a pair that is looked at, and more for one in contact: least squares of relative errors over all
    runs.
    """
    seconds = np.array([part["engines"]["contacts"] for part in busy(runs)])
    counts = np.array([(part["pairs"], part["contacts"]) for part in busy(runs)])
    return map(float, np.linalg.lstsq(counts / seconds[:, None], np.ones(len(seconds)), rcond=None)[0])


def sent_states_a_metre(runs):
    parts = runs["small_3"]["parts"][1:]
    # The two workers meet across the shorter side of the pile.
    return sum(part["states_sent"] for part in parts) / len(parts) / (int(SMALL.split(",")[1]) * TILE_SIDE)


def serial_step(bodies, cost):
    each = cost["body"] + cost["serial_collider_a_body"] + cost["pairs_a_body_tight"] * cost["pair"]
    return bodies * (each + cost["contacts_a_body"] * cost["contact"])


def step(bodies, workers, cost, sides=4, moving=True, network=True):
    """Seconds of a step with so many workers; sides: of a square worker's piece, across which it has neighbours."""
    share = bodies / workers
    each = cost["body"] + cost["pairs_a_body_ball"] * cost["pair"] + cost["contacts_a_body"] * cost["contact"]
    if moving:
        each += cost["collide_a_body"] / STEPS_BETWEEN_COLLISIONS
    side = TILE_SIDE * math.sqrt(share / TILE_BODIES)
    states = cost["states_a_metre"] * side * sides
    seconds = share * each + states * cost["state"]
    # Rank 0 takes the forces on floor and walls from one worker after the other.
    seconds += workers * cost["exchange"]
    if network:
        seconds += states * STATE_BYTES / BYTES_PER_SECOND + 2 * math.log2(workers + 1) * LATENCY
    return seconds


def at_rest(runs, name, cost):
    """Seconds of a step of a measured run by the model: bodies at rest, one border, one machine."""
    ranks, _, _, tiles, _ = RUNS[name]
    bodies, workers = runs[name]["parts"][1]["bodies"] * (ranks - 1), ranks - 1
    side = TILE_SIDE * math.sqrt(bodies / workers / TILE_BODIES)
    border = int(tiles.split(",")[1]) * TILE_SIDE if workers > 1 else 0.0
    return step(bodies, workers, cost, sides=border / side, moving=False, network=False)


def report(runs):
    cost = costs(runs)
    rows = []
    for size in ("small", "large"):
        one = runs[f"{size}_1"]["parts"][0]
        for name in [name for name in RUNS if name.startswith(size)]:
            seconds = runs[name]["parts"][0]["seconds"]
            rows.append({
                "run": name, "bodies": one["bodies"] - 5, "seconds": seconds, "ratio": one["seconds"] / seconds,
                "pairs": sum(part["pairs"] for part in runs[name]["parts"])
            })
    ratio = {row["run"]: row["ratio"] for row in rows}
    error = max(
        abs(at_rest(runs, name, cost) / runs[name]["parts"][0]["seconds"] - 1)
        for name in ("small_2", "small_3", "large_3"))
    model = [
        {
            "bodies": bodies,
            "workers": workers,
            "step_seconds": step(bodies, workers, cost),
            "ratio": serial_step(bodies, cost) / step(bodies, workers, cost),
        }
        for bodies in MODELLED
        for workers in [2**i for i in range(1, 11)]
    ]
    targets = [
        target("step of one process over that of 3 ranks, 20,160 bodies", "at least", 1.0, ratio["small_3"]),
        target("the same, 100,800 bodies", "at least", 1.0, ratio["large_3"]),
        target("model against the measured steps of 2 and 3 ranks, largest relative difference", "at most", 0.25,
               error),
    ]
    write_summary(OUT / "summary.json", {"targets": targets, "runs": rows, "costs_s": cost, "model": model,
                                         **made("make mpi-scale")})
    draw(rows, model)
    show(rows, model, targets)


def show(rows, model, targets):
    print_columns([("run", "bodies", "pairs", "ms a step", "times as fast")] + [
        (row["run"], f"{row['bodies']:,}", f"{row['pairs']:,}", f"{1e3 * row['seconds']:.1f}", f"{row['ratio']:.2f}")
        for row in rows])
    print_columns([("model: bodies", "workers", "ms a step", "times as fast")] + [
        (f"{row['bodies']:,}", str(row["workers"]), f"{1e3 * row['step_seconds']:.2f}", f"{row['ratio']:.1f}")
        for row in model if row["workers"] in (2, 8, 32, 128, 512)])
    print_targets(targets)


def draw(rows, model):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.6), dpi=150)
    labels = {
        "1": "one process", "1_ball": "one process, boxes of balls", "threads": "two threads", "2": "2 ranks, 1 worker",
        "3": "3 ranks, 2 workers"
    }
    order = sorted(rows, key=lambda row: (row["bodies"], row["run"]), reverse=True)
    left.barh([f"{labels[row['run'].split('_', 1)[1]]}, {row['bodies']:,}" for row in order],
              [1e6 * row["seconds"] / row["bodies"] for row in order], color="0.55")
    left.set_xlabel("measured: step, µs for each body")
    for bodies in MODELLED:
        points = [(row["workers"], row["ratio"]) for row in model if row["bodies"] == bodies]
        right.loglog(*zip(*points), marker=".", label=f"{bodies:,} bodies")
    right.loglog([2, 1024], [2, 1024], color="0.8", zorder=0)
    right.set_xlabel("workers, one core each")
    right.set_ylabel("model: times as fast as one process")
    right.legend(frameon=False)
    for axis in (left, right):
        axis.tick_params(labelsize=7)
    figure.tight_layout()
    figure.savefig(OUT / "scale.png")


found = results_of(OUT, RUNS, measure)
if missing := [name for name in RUNS if name not in found]:
    print(f"still to be run: {', '.join(missing)}")
else:
    report(found)
