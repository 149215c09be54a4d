# SPDX-License-Identifier: MIT OR Apache-2.0
"""How long it takes to pack 10,000 rocks, how densely they lie, and whether any two overlap.

    [BODIES=10000] scripts/yade.sh -j2 benches/packing.py

Results go to out/packing: summary.json with targets, packing.png. Leave the machine alone meanwhile: times are
wall-clock times; processor seconds stand beside them.
"""

import os
import resource
import sys
import time
from pathlib import Path

import numpy as np
from matplotlib import colormaps

TOP = Path(sys.argv[0]).resolve().parents[1]
sys.path.insert(0, str(TOP / "studies"))

import yade
from potential_particles import add_packing, pack, packing, plot, shapes
from summary import made, print_table, print_targets, target, write_summary
from yade import O

OUT = TOP / "out" / "packing"
THREADS = 2
# By mass: sizes between 0.7 and 1.4, evenly spread.
GRADING = [(0.7, 0.0), (1.4, 1.0)]


def main():
    count = int(os.environ.get("BODIES", 10_000))
    OUT.mkdir(parents=True, exist_ok=True)
    rocks = [shapes.random_rock(seed, elongation=0.8, flatness=0.75) for seed in range(20)]
    # A packing of 10,000 is 20 sizes wide and about 25 high.
    edge = (count / 10_000) ** (1 / 3) * 20.0
    runs = {}
    for name, dense, sizes, height in [
        ("scattered", False, 1.0, 3.0 * edge),
        ("settled", True, 1.0, 2.0 * edge),
        ("settled, graded", True, GRADING, 2.0 * edge),
    ]:
        space = packing.Box((0, 0, 0), (edge, edge, height))
        runs[name], placements = measured(space, rocks, sizes, count, dense)
        print(f"  {name}: {runs[name]}", flush=True)
        if name == "settled, graded":
            draw(placements, edge)
    targets = compare(runs, count)
    write_summary(OUT / "summary.json", {
        "targets": targets, "runs": runs, "bodies": count, "threads": THREADS,
        **made("scripts/yade.sh -j2 benches/packing.py"),
    })
    print_targets(targets)
    print_table([("results", f"{OUT}: summary.json, packing.png")])


def measured(space, rocks, sizes, count, dense):
    clock, used = time.monotonic(), processor_seconds()
    passing = "passing" if hasattr(sizes, "__len__") else "number"
    placements = pack(space, rocks, sizes, count, dense=dense, seed=1, threads=THREADS, shares=passing)
    seconds, used = time.monotonic() - clock, processor_seconds() - used
    area = space.upper[0] * space.upper[1]
    top = max(one.position[2] for one in placements)
    # Free of the floor and of the rough surface.
    low, high = 0.1 * top, 0.8 * top
    return {
        "bodies": len(placements), "seconds": seconds, "processor_seconds": used,
        "solid_fraction_of_the_middle": packing.volume_between(placements, low, high) / (area * (high - low)),
        "overlapping": overlapping(placements),
    }, placements


def overlapping(placements):
    """Contacts of the bodies in a scene of YADE, in its first step."""
    O.reset()
    O.materials.append(yade.FrictMat(density=2600))
    contacts = yade.Ig2_ConicPP_ConicPP_ScGeom()
    O.engines = [
        yade.ForceResetter(), yade.InsertionSortCollider([yade.Bo1_ConicPP_Aabb()], verletDist=0),
        yade.InteractionLoop([contacts], [yade.Ip2_FrictMat_FrictMat_KnKsPhys()], [yade.Law2_SCG_KnKsPhys_KnKsLaw()]),
    ]
    add_packing(placements)
    O.step()
    if contacts.failures:
        raise SystemExit(f"packing.py: {contacts.failures} pairs were not solved")
    return contacts.overlapping


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def compare(runs, count):
    return [
        target(f"{count:,} rocks settled, seconds on {THREADS} cores", "at most", 60.0, runs["settled"]["seconds"]),
        target(f"{count:,} rocks scattered, seconds on {THREADS} cores", "at most", 60.0, runs["scattered"]["seconds"]),
        target("solid fraction of the settled rocks, in the middle", "at least", 0.5,
               runs["settled"]["solid_fraction_of_the_middle"]),
        target("pairs that overlap", "at most", 0, sum(run["overlapping"] for run in runs.values())),
        target("rocks without a place", "at most", 0, sum(count - run["bodies"] for run in runs.values())),
    ]


def draw(placements, edge):
    """The packing from above and aside, colour by size; without its hidden inside."""
    top, deep = max(body.state.pos[2] for body in O.bodies), 2.0
    seen = [body for body in O.bodies
            if body.state.pos[2] > top - 2 * deep or body.state.pos[0] > edge - deep or body.state.pos[1] < deep]
    size = np.array([body.state.mass for body in seen]) ** (1 / 3)
    for body, colour in zip(seen, colormaps["YlOrBr"](0.75 - 0.5 * (size - size.min()) / np.ptp(size))):
        body.shape.color = yade.Vector3(*map(float, colour[:3]))
    plot(str(OUT / "packing.png"), towards=(0.8, -1.0, 0.75), size=(910, 700), bodies=[body.id for body in seen])


main()
