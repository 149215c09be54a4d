#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks on floors of facets, in a drum, out of a hopper, compressed: the time of a step, beside earlier commits.

    benches/scenes/run.py [--packages NAME=FOLDER ...] [--rounds 3] [--scenes NAME ...] [--quick]

FOLDER holds another commit's package, as built in its yade-glue/build/python. The runs take turns, each in a process of
its own and from the same state; of each window, a stretch of steps, the fastest turn counts, and a figure is the mean
over the windows. Results go to out/scenes: summary.json with targets, scenes.png.
"""
import argparse
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
OUT = TOP / "out" / "scenes"
# Name: steps before the first window, windows, steps of each, whether earlier commits are run too.
SCENES = {
    "5,000 facets": (50, 8, 50, True),
    "5,000 facets and 45,000 far off": (50, 8, 50, False),
    "drum": (50, 10, 20, True),
    "hopper": (1500, 10, 40, True),  # until they flow
    "compression": (50, 10, 40, True),
}
PARTS = ("reset", "watch", "collider", "contacts", "mover", "motion")


def main():
    sys.path.insert(0, str(TOP / "studies"))
    import machine
    from summary import write_summary

    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--packages", nargs="*", default=[], metavar="NAME=FOLDER", help="packages of other commits")
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    arguments.add_argument("--quick", action="store_true", help="one turn of short windows")
    options = arguments.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    packages = {"here": TOP / "yade-glue" / "build" / "python"} | dict(one.split("=", 1) for one in options.packages)
    turns = {}
    for turn in range(1 if options.quick else options.rounds):
        for scene in options.scenes:
            for name, package in list(packages.items())[:: -1 if turn % 2 else 1]:
                if name == "here" or SCENES[scene][3]:
                    print(f"  turn {turn + 1}: {scene}, {name}", flush=True)
                    turns.setdefault((scene, name), []).append(measured(scene, package, options.quick))
    best = {f"{scene}, {name}": fastest(runs) for (scene, name), runs in turns.items()}
    for name, row in best.items():
        print(f"{name:<42} " + "  ".join(f"{part} {row['mean'].get(part, 0):.3f}"
                                         for part in (*PARTS, "step")) + f" ms; {row['counts']}")
    targets = [{
        "name": name, "sense": sense, "target": goal, "measured": found,
        "met": bool(found <= goal if sense == "<=" else found >= goal)
    } for name, found, sense, goal in compared(best, options.scenes, packages)]
    for row in targets:
        print(
            f"{row['name']:<80} {row['sense']} {row['target']} {row['measured']:.2f} {'met' if row['met'] else 'MISSED'}"
        )
    write_summary(
        OUT / "summary.json", {
            "targets": targets, "runs": best, "machine": machine.machine_line(), "date": machine.now(),
            "command": "benches/scenes/run.py"
        })
    draw(best)


def compared(best, scenes, packages):
    """Name, ratio, sense and target of each comparison."""
    ratio = lambda part, one, other: best[one]["mean"][part] / best[other]["mean"][part]
    near, far = "5,000 facets", "5,000 facets and 45,000 far off"
    if near in scenes and far in scenes:
        yield "contact loop with 45,000 facets far off / without", ratio("contacts", f"{far}, here",
                                                                         f"{near}, here"), "<=", 1.2
    for scene in scenes:
        for name in packages:
            if name != "here" and SCENES[scene][3]:
                for part, key in (("contact loop", "contacts"), ("step", "step")):
                    yield f"{part}, {scene}: {name} / here", ratio(key, f"{scene}, {name}", f"{scene}, here"), ">=", 2.0
    for scene in scenes:
        yield f"contacts that failed, {scene}", best[f"{scene}, here"]["counts"]["failures"], "<=", 0


def fastest(runs):
    """Of each window the fastest turn, by its step; the mean over the windows, ms."""
    windows = [min(rows, key=lambda row: row["step"]) for rows in zip(*(run["windows"] for run in runs))]
    return {
        "mean": {part: sum(row[part] for row in windows) / len(windows)
                 for part in windows[0]}, "counts": runs[-1]["counts"]
    }


def measured(scene, package, quick):
    made_by = hashlib.sha256(Path(__file__).with_name("scenes.py").read_bytes()).hexdigest()[:8]
    result, kept = OUT / "result.json", OUT / f"{scene.replace(' ', '_').replace(',', '')}_{made_by}.pickle"
    warming, windows, steps, _ = SCENES[scene]
    environment = dict(os.environ, OMP_WAIT_POLICY="passive", SCENE=scene, KEPT=str(kept), WARMING=str(warming),
                       WINDOWS=str(2 if quick else windows), STEPS=str(steps // 5 if quick else steps),
                       RESULT=str(result))
    if not kept.exists():
        yade(dict(environment, PYTHONPATH=str(TOP / "yade-glue" / "build" / "python")), kept)
    result.unlink(missing_ok=True)
    yade(dict(environment, PYTHONPATH=str(package)), result)
    return json.loads(result.read_text())


def yade(environment, wanted):
    done = subprocess.run(["/usr/bin/yade", "-x", "-n", "-j1",
                           str(Path(__file__).with_name("measure.py"))], env=environment, text=True,
                          stdin=subprocess.DEVNULL, capture_output=True)
    if not wanted.exists():
        sys.exit(
            f"{environment['SCENE']}, {environment['PYTHONPATH']}: no result\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}"
        )


def draw(best):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 0.4 * len(best) + 1.5), layout="constrained")
    names, left = list(best)[::-1], [0.0] * len(best)
    for part in PARTS:
        widths = [best[name]["mean"].get(part, 0.0) for name in names]
        axes.barh(names, widths, left=left, label=part)
        left = [start + width for start, width in zip(left, widths)]
    axes.set(xlabel="a step, ms", title="Rocks and boundaries")
    axes.legend()
    figure.savefig(OUT / "scenes.png", dpi=120)


main()
