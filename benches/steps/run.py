#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Where the time of a step goes: in piles at rest of 200 to 100,000 bodies, beside spheres; or of rocks on facets, in a
drum, out of a hopper, compressed.

    benches/steps/run.py piles|scenes [--before COMMIT] [--rounds 3] [--quick]

The runs take turns, each in a process of its own and from the same state; of each window, a stretch of steps, the
fastest turn counts. Results go to out/scale or out/scenes: summary.json with targets, a picture, and the settled
bodies for the next time. Leave the machine alone meanwhile.
"""

import argparse
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "studies"))

from timed_run import PACKAGE, Run, measured

from summary import made, print_columns, print_table, print_targets, save_bars, target, write_summary

PARTS = ("reset", "watch", "collider", "contacts", "mover", "motion")


# By memories, skipped pairs and caches a pile needs 60 steps until they are as they stay.
PILES = {
    "spheres 300": Run("spheres", 60, 60, 60, 300),
    "pyramids 200": Run("pyramids", 60, 60, 60, 200),
    "spheres 2,000": Run("spheres", 60, 60, 12, 2000),
    "pyramids 2,000": Run("pyramids", 60, 60, 12, 2000),
    "pyramids 2,000, YADE's loop": Run("pyramids", 60, 60, 12, 2000, best=False),
    "spheres 20,000": Run("spheres", 60, 18, 4, 2000, 10),
    "pyramids 20,000": Run("pyramids", 60, 18, 4, 2000, 10),
    "pyramids 20,000, two threads": Run("pyramids", 60, 18, 4, 2000, 10, threads=2),
    "pyramids 100,000": Run("pyramids", 60, 3, 4, 2000, 50, once=True),
}
SCENES = {
    "5,000 facets": Run("5,000 facets", 50, 8, 50),
    "5,000 facets and 45,000 far off": Run("5,000 facets and 45,000 far off", 50, 8, 50),
    "drum": Run("drum", 50, 10, 20),
    "hopper": Run("hopper", 1500, 10, 40),  # until they flow
    "compression": Run("compression", 50, 10, 40),
}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("which", choices=("piles", "scenes"))
    arguments.add_argument("--before", help="a commit that is measured beside this one")
    arguments.add_argument("--rounds", type=int, default=3, help="turns of each run")
    arguments.add_argument("--quick", action="store_true",
                           help="one turn of two windows, no pile above 300 bodies, a tenth of the rocks")
    options = arguments.parse_args()
    of_piles = options.which == "piles"
    name, runs = ("scale", PILES) if of_piles else ("scenes", SCENES)
    out = TOP / "out" / name
    out.mkdir(parents=True, exist_ok=True)
    packages = {"": PACKAGE}
    if options.before:
        packages[", before"] = earlier(out, options.before)
    if options.quick:
        runs = {name: replace(run, part=10) for name, run in runs.items() if run.size <= 300}
    best, rounds = {}, 1 if options.quick else options.rounds
    for turn in range(rounds):
        for number, (scene, run) in enumerate(runs.items(), 1):
            for label, package in packages.items() if not (turn and run.once) else ():
                print(f"  turn {turn + 1} of {rounds}, {number} of {len(runs)}: {scene}{label}", flush=True)
                keep(best, scene + label, measured(out, run, package, options.quick))
    for row in best.values():
        columns = {part: [window.get(part, 0.0) for window in row["windows"]] for part in (*PARTS, "step")}
        # Windows of a pile at rest are alike, and what else the machine does only adds; scenes move on.
        row["ms"] = {part: min(some) if of_piles else sum(some) / len(some) for part, some in columns.items()}
    judged = list(of_these_piles(best) if of_piles else of_these_scenes(best))
    print_columns([("a step, ms", "contacts", *PARTS, "step")] + [
        (scene, f"{row['contacts']:,}", *(f"{value:.3f}" for value in row["ms"].values()))
        for scene, row in best.items()])
    print_targets(judged)
    write_summary(out / "summary.json", {"targets": judged, "runs": best, "before": options.before,
                                         **made(f"make {name}")})
    shares = {scene: {part: row["ms"][part] * (1e3 / row["bodies"] if of_piles else 1.0) for part in PARTS}
              for scene, row in best.items()}
    label = "a step, µs a body (fastest window)" if of_piles else "a step, ms"
    save_bars(out / f"{name}.png", shares, label, "Where the time of a step goes")
    print_table([("results", f"{out}: {name}.png, summary.json")])


def earlier(out, commit):
    """The package of another commit, built in a work tree of its own."""
    tree = out / "before"
    package = tree / "yade-glue" / "build" / "python"
    if not package.exists():
        print(f"  building {commit} in {tree}", flush=True)
        target = tree / "target"
        for command in (["git", "-C", TOP, "worktree", "prune"],
                        ["git", "-C", TOP, "worktree", "add", "--force", "--detach", tree, commit],
                        ["cargo", "build", "--release", "--quiet", "--manifest-path", tree / "Cargo.toml"],
                        ["cmake", "-S", tree / "yade-glue", "-B", tree / "yade-glue/build",
                         f"-DPP_LIBRARY={target}/release/libpotential_particles.so"],
                        ["cmake", "--build", tree / "yade-glue/build"]):  # fmt: skip
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL,
                           env=dict(os.environ, CARGO_TARGET_DIR=str(target)))
    return package


def keep(best, name, result):
    """Of each window the fastest turn, by its step; everything else from the first turn."""
    first = best.setdefault(name, result)
    first["windows"] = [min(both, key=lambda row: row["step"]) for both in zip(first["windows"], result["windows"])]


def of_these_piles(best):
    """Ratios of two runs, where both were measured."""
    contact = lambda run: run["ms"]["contacts"] / run["contacts"]
    step = lambda run: run["ms"]["step"]
    for name, of, over, value, sense, limit in (
        ("contact loop a touching contact, 2,000 pyramids / spheres", "pyramids 2,000", "spheres 2,000", contact,
         "at most", 3.0),
        ("the same at 20,000", "pyramids 20,000", "spheres 20,000", contact, "at most", 2.5),
        ("step a contact of 200 pyramids / of spheres with as many contacts", "pyramids 200", "spheres 300",
         lambda run: step(run) / run["contacts"], "at most", 2.0),
        ("contact loop of 20,000, one thread / two", "pyramids 20,000", "pyramids 20,000, two threads",
         lambda run: run["ms"]["contacts"], "at least", 1.9),
        ("step of 20,000, one thread / two", "pyramids 20,000", "pyramids 20,000, two threads", step, "at least", 1.9),
        ("step a body, 100,000 / 2,000 pyramids", "pyramids 100,000", "pyramids 2,000",
         lambda run: step(run) / run["bodies"], "at most", 1.3),
    ):  # fmt: skip
        known = of in best and over in best
        yield target(name, sense, limit, value(best[of]) / value(best[over]) if known else None)


def of_these_scenes(best):
    """Facets far off, and failures."""
    far, near = (best[name]["ms"]["contacts"] for name in ("5,000 facets and 45,000 far off", "5,000 facets"))
    yield target("contact loop with 45,000 facets far off / without", "at most", 1.2, far / near)
    for name, run in best.items():
        yield target(f"contacts that failed, {name}", "at most", 0, run["failures"])


if __name__ == "__main__":
    main()
