#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Where the time of a step goes in piles at rest of 200 to 100,000 bodies, beside spheres and an earlier commit.

    benches/scale/run.py [--before COMMIT] [--rounds 3] [--quick]

The runs take turns, each in a process of its own, and of each figure the fastest window counts. Results go to
out/scale: summary.json with targets, scale.png, and the settled piles for the next time. Leave the machine alone
meanwhile.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "studies"))

import machine
from summary import print_table, write_summary

OUT = TOP / "out" / "scale"
PARTS = ("reset", "watch", "collider", "contacts", "motion")
# Name: kind, bodies of the settled pile, copies of it, threads, way, windows, steps of a window: short, to fit between
# what else the machine does.
RUNS = {
    "spheres 300": ("spheres", 300, 1, 1, "plain", 60, 60),
    "pyramids 200": ("pyramids", 200, 1, 1, "best", 60, 60),
    "spheres 2,000": ("spheres", 2000, 1, 1, "plain", 60, 12),
    "pyramids 2,000": ("pyramids", 2000, 1, 1, "best", 60, 12),
    "pyramids 2,000, YADE's loop": ("pyramids", 2000, 1, 1, "plain", 60, 12),
    "before 2,000": ("pyramids", 2000, 1, 1, "best", 60, 12),
    "spheres 20,000": ("spheres", 2000, 10, 1, "plain", 18, 4),
    "pyramids 20,000": ("pyramids", 2000, 10, 1, "best", 18, 4),
    "before 20,000": ("pyramids", 2000, 10, 1, "best", 18, 4),
    "pyramids 20,000, two threads": ("pyramids", 2000, 10, 2, "best", 18, 4),
    "pyramids 100,000": ("pyramids", 2000, 50, 1, "best", 3, 4),
}
ONCE = {"pyramids 100,000"}
DEMO_STEPS = 14_000


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--before", default="82754b2",
                           help="the commit that is measured beside this one; '' for none")
    arguments.add_argument("--rounds", type=int, default=3, help="turns of each run")
    arguments.add_argument("--quick", action="store_true",
                           help="one turn, nothing above 2,000 bodies: to see that it runs")
    options = arguments.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    packages = {"here": TOP / "yade-glue" / "build" / "python"}
    names = list(RUNS)
    if options.before:
        packages["before"] = earlier(options.before)
    else:
        names = [name for name in names if not name.startswith("before")]
    if options.quick:
        names = [name for name in names if RUNS[name][2] == 1]
    best, demos = {}, {}
    rounds = 1 if options.quick else options.rounds
    for turn in range(rounds):
        for number, name in enumerate(names):
            if turn and name in ONCE:
                continue
            print(f"  turn {turn + 1} of {rounds}, {number + 1} of {len(names)}: {name}", flush=True)
            keep(best, name, measured(name, packages["before" if name.startswith("before") else "here"]))
        for name, package in packages.items():
            print(f"  turn {turn + 1} of {rounds}: make demo, {name}", flush=True)
            demos[name] = min(demos.get(name, float("inf")), demo(package, DEMO_STEPS // (10 if options.quick else 1)))
    targets = compare(best, demos)
    for target in targets:
        print(
            f"  {target['name']:<86} {target['sense']} {target['target']:<5} {shown(target['measured']):>7}  {verdict(target)}"
        )
    write_summary(
        OUT / "summary.json",
        {
            "targets": targets,
            "runs": best,
            "demo_seconds": demos,
            "before": options.before,
            "machine": machine.machine_line(),
            "date": machine.now(),
            "command": "make scale",
        },
    )
    draw(best)
    print_table([("results", f"{OUT}: scale.png, summary.json")])


def earlier(commit):
    """The package of another commit, built in out/scale/before."""
    tree = OUT / "before"
    package = tree / "yade-glue" / "build" / "python"
    if not tree.exists():
        run(["git", "-C", TOP, "worktree", "prune"])
        run(["git", "-C", TOP, "worktree", "add", "--force", "--detach", tree, commit])
    if not package.exists():
        print(f"  building {commit} in {tree}", flush=True)
        target = tree / "target"
        environment = dict(os.environ, CARGO_TARGET_DIR=str(target))
        run(["cargo", "build", "--release", "--quiet"], cwd=tree, env=environment)
        library = target / "release" / "libpotential_particles.so"
        run(["cmake", "-S", "yade-glue", "-B", "yade-glue/build", f"-DPP_LIBRARY={library}"], cwd=tree,
            stdout=subprocess.DEVNULL)
        run(["cmake", "--build", "yade-glue/build"], cwd=tree, stdout=subprocess.DEVNULL)
    return package


def run(command, **more):
    subprocess.run([str(part) for part in command], check=True, **more)


def studies(package):
    """The folder with the scenes of the tree to which a package belongs; earlier commits have them among their
    examples.
    """
    tree = package.parents[2]
    return next(folder for folder in (tree / "studies", tree / "examples") if folder.exists())


def measured(name, package):
    kind, count, copies, threads, way, windows, steps = RUNS[name]
    result = OUT / "result.json"
    result.unlink(missing_ok=True)
    environment = dict(
        os.environ,
        PYTHONPATH=str(package),
        STUDIES=str(studies(package)),
        OMP_WAIT_POLICY="passive",
        KIND=kind,
        COUNT=str(count),
        COPIES=str(copies),
        PILE=str(OUT / f"{kind}_{count}.npz"),
        WAY=way,
        WINDOWS=str(windows),
        STEPS=str(steps),
        RESULT=str(result),
    )
    if name in ONCE:
        environment["SAVE"] = str(OUT / "saved.yade.gz")
    command = ["/usr/bin/yade", "-x", "-n", f"-j{threads}", str(TOP / "benches" / "scale" / "measure.py")]
    done = subprocess.run(command, env=environment, text=True, stdin=subprocess.DEVNULL, capture_output=True)
    if not result.exists():
        sys.exit(f"{name}: no result\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return json.loads(result.read_text())


def demo(package, steps):
    """Seconds of all engines in the pyramids of `make demo`, of the tree to which the package belongs."""
    out, script = OUT / "demo", studies(package) / "pyramids.py"
    (out / "summary.json").unlink(missing_ok=True)
    environment = dict(
        os.environ,
        PYTHONPATH=str(package),
        OMP_WAIT_POLICY="passive",
        STEPS=str(steps),
        BODIES="200",
        FUNCTOR="library",
        OUTPUT=str(out),
    )
    command = ["/usr/bin/yade", "-x", "-n", "-j1", str(script)]
    done = subprocess.run(command, env=environment, text=True, stdin=subprocess.DEVNULL, capture_output=True)
    if not (out / "summary.json").exists():
        sys.exit(f"{script}: no result\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return sum(json.loads((out / "summary.json").read_text())["engine_seconds"].values())


def keep(best, name, result):
    """Of all turns the fastest windows; everything else from the first."""
    if name not in best:
        best[name] = result
        return
    fastest = best[name]["fastest"]
    for part, value in result["fastest"].items():
        fastest[part] = min(fastest[part], value)


def contact_us(run):
    return run["fastest"]["contacts"] / run["contacts"] * 1e3


def compare(best, demos):
    def ratio(name, of, over, value):
        known = of in best and over in best
        return (name, value(best[of], best[over]) if known else None)

    def loop(a, b):
        return contact_us(a) / contact_us(b)

    def step(a, b):
        return a["fastest"]["step"] / b["fastest"]["step"]

    def per_body(a, b):
        return step(a, b) / (a["bodies"] / b["bodies"])

    rows = [
        (*ratio("contact loop a touching contact, 2,000 pyramids / spheres", "pyramids 2,000", "spheres 2,000", loop),
         "<=", 3.0),
        (*ratio("the same at 20,000", "pyramids 20,000", "spheres 20,000", loop), "<=", 2.5),
        (*ratio("step of 200 pyramids / of spheres with as many contacts (step a contact)", "pyramids 200",
                "spheres 300", lambda a, b: step(a, b) * b["contacts"] / a["contacts"]), "<=", 2.0),
        (*ratio("body-steps a second, 2,000 pyramids, after / before", "before 2,000", "pyramids 2,000", step), ">=",
         2.5),
        (*ratio("the same at 20,000", "before 20,000", "pyramids 20,000", step), ">=", 2.5),
        ("`make demo`, all engines, before / after", demos["before"] / demos["here"] if "before" in demos else None,
         ">=", 2.0),
        (*ratio("contact loop of 20,000, one thread / two", "pyramids 20,000", "pyramids 20,000, two threads",
                lambda a, b: a["fastest"]["contacts"] / b["fastest"]["contacts"]), ">=", 1.9),
        (*ratio("step of 20,000, one thread / two", "pyramids 20,000", "pyramids 20,000, two threads", step), ">=",
         1.9),
        (*ratio("step a body, 100,000 / 2,000 pyramids", "pyramids 100,000", "pyramids 2,000", per_body), "<=", 1.3),
    ]
    targets = []
    for name, found, sense, target in rows:
        met = None if found is None else bool(found <= target if sense == "<=" else found >= target)
        targets.append({"name": name, "sense": sense, "target": target, "measured": found, "met": met})
    return targets


def shown(value):
    return "-" if value is None else f"{value:.2f}"


def verdict(target):
    return {True: "met", False: "MISSED", None: "not measured"}[target["met"]]


def draw(best):
    """Microseconds a body a step, by part."""
    figure, axes = plt.subplots(figsize=(9, 0.5 * len(best) + 1.5), layout="constrained")
    names = list(best)[::-1]
    left = [0.0] * len(names)
    for part in PARTS:
        widths = [best[name]["fastest"].get(part, 0.0) / best[name]["bodies"] * 1e3 for name in names]
        axes.barh(names, widths, left=left, label={"contacts": "contact loop", "motion": "Newton"}.get(part, part))
        left = [start + width for start, width in zip(left, widths)]
    axes.set_xlabel("a step, microseconds a body (fastest window)")
    axes.set_title("Piles at rest: where the time of a step goes")
    axes.legend(loc="upper right")
    figure.savefig(OUT / "scale.png", dpi=120)


if __name__ == "__main__":
    main()
