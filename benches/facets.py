#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rocks at rest on a floor of facets in YADE: the time of a step by what is near and by what is listed, beside earlier commits.

    benches/facets.py [--packages NAME=FOLDER ...] [--rounds 3] [--quick]

FOLDER holds another commit's package, as built in its yade-glue/build/python. The runs take turns, each in a process of its own, and of each
figure the fastest window counts. Results go to out/facets: summary.json with targets, facets.png.
"""
import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
OUT = TOP / "out" / "facets"
COUNT, DIAMETER, CELL, WAVE = 256, 0.045, 0.02, 0.004  # rocks; intermediate extent of a rock, legs of a facet, height of the floor's waves, m
WINDOWS, STEPS, SETTLING = 8, 100, 3000
# Cells along a side of the floor that the rocks lie on, and triangles of a floor elsewhere, which nobody touches.
SCENES = {"5,000 facets": (50, 0), "5,000 facets and 45,000 far off": (50, 45_000)}


def main():
    sys.path.insert(0, str(TOP / "studies"))
    import machine
    from summary import write_summary

    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--packages", nargs="*", default=[], metavar="NAME=FOLDER", help="packages of other commits")
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--quick", action="store_true", help="one turn of short windows")
    options = arguments.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    packages = dict(one.split("=", 1) for one in options.packages) | {"here": TOP / "yade-glue" / "build" / "python"}
    best = {}
    for turn in range(1 if options.quick else options.rounds):
        for scene in SCENES:
            for name, package in packages.items():
                if "far off" in scene and name != "here":
                    continue
                found = run(scene, package, options.quick)
                kept = best.setdefault(f"{scene}, {name}", found)
                kept["fastest"] = {part: min(value, found["fastest"][part]) for part, value in kept["fastest"].items()}
    for name, row in best.items():
        print(f"{name:<42} " + "  ".join(f"{part} {value:.3f}" for part, value in row["fastest"].items()) + f" ms; {row['counts']}")
    ratio = lambda part, one, other: best[one]["fastest"][part] / best[other]["fastest"][part]
    rows = [("contact loop with 45,000 facets far off / without", ratio("contacts", "5,000 facets and 45,000 far off, here", "5,000 facets, here"), "<=", 1.2)]
    rows += [(f"{part} on 5,000 facets, {name} / here", ratio(key, f"5,000 facets, {name}", "5,000 facets, here"), ">=", 2.0)
             for name in packages if name != "here" for part, key in (("contact loop", "contacts"), ("step", "step"))]
    targets = [{"name": name, "sense": sense, "target": target, "measured": found, "met": bool(found <= target if sense == "<=" else found >= target)}
               for name, found, sense, target in rows]
    for row in targets:
        print(f"{row['name']:<80} {row['sense']} {row['target']} {row['measured']:.2f} {'met' if row['met'] else 'MISSED'}")
    write_summary(OUT / "summary.json", {"targets": targets, "runs": best, "machine": machine.machine_line(), "date": machine.now(), "command": "benches/facets.py"})
    draw(best)


def run(scene, package, quick):
    result = OUT / "result.json"
    result.unlink(missing_ok=True)
    environment = dict(os.environ, PYTHONPATH=str(package), OMP_WAIT_POLICY="passive", SCENE=scene, QUICK="1" if quick else "", RESULT=str(result))
    done = subprocess.run(["/usr/bin/yade", "-x", "-n", "-j1", __file__], env=environment, text=True, stdin=subprocess.DEVNULL, capture_output=True)
    if not result.exists():
        sys.exit(f"{scene}, {package}: no result\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return json.loads(result.read_text())


def draw(best):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 0.4 * len(best) + 1.5), layout="constrained")
    names, left = list(best)[::-1], [0.0] * len(best)
    for part in [part for part in best[names[0]]["fastest"] if part != "step"]:
        widths = [best[name]["fastest"][part] for name in names]
        axes.barh(names, widths, left=left, label=part)
        left = [start + width for start, width in zip(left, widths)]
    axes.set(xlabel="a step, ms (fastest window)", title=f"{COUNT} rocks at rest on facets")
    axes.legend()
    figure.savefig(OUT / "facets.png", dpi=120)


def inside_yade():
    import time

    import numpy as np
    import potential_particles
    from potential_particles import shapes
    from yade import (BoundWatch, Bo1_ConicPP_Aabb, Bo1_Facet_Aabb, ConicInteractionLoop, ForceResetter, FrictMat, Ig2_ConicPP_ConicPP_ScGeom,
                      Ig2_Facet_ConicPP_ScGeom, InsertionSortCollider, Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator, O, utils)

    cells, far = SCENES[os.environ["SCENE"]]
    O.materials.append(FrictMat(young=2e7, poisson=0.3, frictionAngle=np.radians(30), density=2650))
    side = 50 * CELL
    leg = side / cells
    height = lambda x, y: WAVE * np.sin(40 * x) * np.cos(35 * y)

    def floor(cells, shift=0.0):
        at = lambda i, j: (shift + i * leg, j * leg, height(i * leg, j * leg))
        for i in range(cells):
            for j in range(cells):
                for three in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))):
                    facet = utils.facet(three, fixed=True)
                    facet.mask = 3
                    O.bodies.append(facet)

    floor(cells)
    if far:
        floor(int((far / 2) ** 0.5), shift=10 * side)
    kinds = [shapes.random_rock(seed, size=DIAMETER, elongation=0.8, flatness=0.75) for seed in range(8)]
    rng = np.random.default_rng(3)
    across = int(np.ceil(COUNT**0.5))
    for i in range(COUNT):
        turn = rng.normal(size=4)
        place = ((i % across + 0.5) * side / across, (i // across + 0.5) * side / across, 0.06)
        O.bodies.append(potential_particles.body(kinds[i % 8], position=place, orientation=tuple(turn / np.linalg.norm(turn))))
    functors = [Ig2_ConicPP_ConicPP_ScGeom(), Ig2_Facet_ConicPP_ScGeom()]
    O.engines = [ForceResetter(label="reset"), BoundWatch(label="watch"),
                 InsertionSortCollider([Bo1_ConicPP_Aabb(), Bo1_Facet_Aabb()], verletDist=0.05 * DIAMETER, avoidSelfInteractionMask=2, label="collider"),
                 ConicInteractionLoop(functors, [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)], label="contacts"),
                 NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True, label="motion")]
    O.dt = potential_particles.critical_time_step()
    O.timingEnabled = True
    shorter = 10 if os.environ["QUICK"] else 1
    steps = STEPS // shorter
    O.run(SETTLING // shorter, True)
    for functor in functors:
        functor.resetCounters()
    rows = []
    for _ in range(WINDOWS):
        before = [engine.execTime for engine in O.engines]
        O.run(steps, True)
        row = {engine.label: (engine.execTime - earlier) / steps * 1e-6 for engine, earlier in zip(O.engines, before)}
        rows.append(row | {"step": sum(row.values())})
    real = [pair for pair in O.interactions if pair.isReal]
    facets = len(O.bodies) - COUNT  # they come first
    counts = {"contacts": len(real), "with facets": sum(min(pair.id1, pair.id2) < facets for pair in real), "pairs": sum(1 for _ in O.interactions.all()),
              "failures": sum(functor.failures for functor in functors), "facet answers": functors[1].answers}
    Path(os.environ["RESULT"]).write_text(json.dumps({"fastest": {name: min(row[name] for row in rows) for name in rows[0]}, "counts": counts}))


if "RESULT" in os.environ:
    inside_yade()
elif __name__ == "__main__":
    main()
