#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""What limits a call from memory, and a step of a pile at rest: instructions, arithmetic, bytes, or results that wait
for each other.

    benches/peers/roofline.py

Needs the pairs and states of `make peers`. Results go to out/roofline: summary.json, table.md, roofline.png.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "studies"))

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import counts
import install
import latency
from summary import made, markdown, print_table, target, write_summary

OUT = install.TOP / "out" / "roofline"
PAIRS = install.OUT / "pairs_potential.txt"
STATES = install.OUT / "piles" / "200_at_rest.npz"
TOOLS = ("valgrind", "binutils", "gdb", "llvm", "python3-matplotlib")
# Group of pairs, what it is called, and how many pairs a pass has.
GROUPS = (
    ("5-sharp-touching", "5 planes, sharp, touching", 100),
    ("5-rounded-touching", "5 planes, k = 0, touching", 100),
    ("5-potential-touching", "5 planes, k = 0.02, touching", 100),
    ("100-potential-touching", "100 planes, k = 0.02, touching", 100),
    ("5-sharp-near", "5 planes, sharp, near", 100),
    ("1000-potential-near", "1,000 planes, k = 0.02, near", 30),
)
# Ways to call: name of the way, what it is called, part of the symbol of what each call runs once.
WAYS = (("midway", "alone", "detect6detect17"), ("carried", "in a batch", "batch8carry_on17"))
PASSES = 20  # of one request: two walks through six poses, to and fro
SECONDS, TRIALS = 0.5, 5
LEAST_SHARE = 0.8  # of the cycles of a call, that its highest limit accounts for
# Zen 3 and 4, a cycle: six instructions, four of floating point, three loads, two stores, 32 bytes from the second
# cache; a division takes the divider five cycles, a root nine.
LIMITS = {
    "instructions": lambda count: count["instructions"] / 6,
    "arithmetic": lambda count: count["arithmetic"] / 4,
    "divisions and roots": lambda count: 5 * count["divisions"] + 9 * count["roots"],
    "loads and stores": lambda count: max(count["loads"] / 3, count["stores"] / 2),
    "bytes": lambda count: counts.LINE * (count["load misses"] + count["store misses"] + count["code misses"]) / 32,
}
WAITING = "waiting"
ALL_LIMITS = (*LIMITS, WAITING)
# The step: how the functions look in callgrind's annotation.
STEP = "yade::Scene::moveToNextTimeStep()"
FUNCTIONS = {
    "step": r"yade::Scene::moveToNextTimeStep\(\) \[",
    "contact loop": r"ConicInteractionLoop::action",
    "contact functor": r"Ig2_ConicPP_ConicPP_ScGeom::go",
    "of it, the library": r"pp_contact_detect",
    "force law": r":yade::Law2_SCG_KnKsPhys_KnKsLaw::go",
    "integrator": r"yade::NewtonIntegrator::action\(\) \[",
    "collider": r"yade::InsertionSortCollider::action\(\) \[",
}
STEPS, SETTLE = 25, 300  # of each of two windows; before them


def main():
    install.packages(TOOLS)
    for needed in (PAIRS, STATES):
        if not needed.exists():
            sys.exit(f"roofline.py: {needed} is not there: run `make peers` first")
    OUT.mkdir(parents=True, exist_ok=True)
    (command, _), (clock, _) = install.rust("ours"), install.rust("clock")
    cycle = float(subprocess.run(clock, check=True, capture_output=True, text=True).stdout)
    calls = [row for group in GROUPS for row in measured([*command, PAIRS], cycle, *group)]
    step = of_step()
    summary = {
        **made("make roofline"), "nanoseconds_a_cycle": cycle, "calls": calls, "step": step, "targets": [judged(row) for row in calls]
    }
    line = f"{summary['machine']}, {1 / cycle:.2f} GHz, {summary['date']}"
    write_summary(OUT / "summary.json", summary)
    (OUT / "table.md").write_text("\n\n".join([f"*{line}*", call_table(calls), step_table(step)]) + "\n")
    draw(calls, line)
    print((OUT / "table.md").read_text())
    print_table([("results", f"{OUT}: table.md, roofline.png, summary.json")])


def judged(row):
    return target(f"{row['bodies']}, {row['way']}: highest limit / measured", "at least", LEAST_SHARE, row["share"])


def measured(command, cycle, group, label, pairs):
    program = counts.Program(command)
    for way, called, function in WAYS:
        request = f"time {group} {way} warm"
        print(f"  {label}, {called}", flush=True)
        count = {what: number / (PASSES * pairs) for what, number in program.of_request(f"{request} 0").items()}
        nanoseconds = _shortest(command, f"{request} {SECONDS}")
        limits = {name: limit(count) for name, limit in LIMITS.items()}
        limits[WAITING] = latency.cycles(command, f"{request} 0", function, count["instructions"])
        highest = max(limits, key=limits.get)
        yield {
            "bodies": label,
            "way": called,
            "counts": count,
            "nanoseconds": nanoseconds,
            "cycles": nanoseconds / cycle,
            "limits": limits,
            "highest": highest,
            "share": limits[highest] * cycle / nanoseconds,
            # Each call waits for the answer of the one before, if calls alone are at issue.
            "one_after_the_other": _shortest(command, f"time {group} {way}+wait warm {SECONDS}")
                                   if way == "midway" else None,
        }


def _shortest(command, request):
    answers = subprocess.run(command, input=f"{request}\n" * TRIALS, check=True, capture_output=True, text=True).stdout
    return min(float(answer.lstrip(">")) for answer in answers.split()) * 1e9


def of_step():
    """Counts of a step by function; contacts and pairs of the pile."""
    print("  a step of 200 pyramids at rest", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "result"
        job = {
            "kind": "ours", "count": 200, "task": "windows", "start": str(STATES), "settle": SETTLE, "seconds": 3600,
            "windows": 2, "steps": STEPS, "result": str(result)
        }
        environment = dict(os.environ, JOB=json.dumps(job), OMP_WAIT_POLICY="passive",
                           PYTHONPATH=str(install.TOP / "yade-glue" / "build" / "python"))
        command = ["/usr/bin/python3", str(install.YADE_PROGRAM), "-x", "-n", "-j1", str(install.HERE / "yade_pile.py")]
        found = counts.of_functions(command, environment, STEP, FUNCTIONS)
        run = json.loads(result.read_text())
    functions = {name: {what: number / run["steps"] for what, number in count.items()} for name, count in found.items()}
    return {"contacts": run["contacts"], "pairs": run["pairs"], "functions": functions}


def call_table(calls):
    """Measured cycles, counts, and the least number of cycles by each limit."""
    heads = ("bodies", "call", "cycles, measured", "instructions", "divisions, roots", "bytes from the second cache",
             *(f"least: {name}" for name in ALL_LIMITS), "highest / measured", "each after the other")
    rows = []
    for row in calls:
        count = row["counts"]
        misses = counts.LINE * (count["load misses"] + count["store misses"] + count["code misses"])
        limits = [
            f"**{row['limits'][name]:,.0f}**" if name == row["highest"] else f"{row['limits'][name]:,.0f}"
            for name in ALL_LIMITS
        ]
        waits = row["one_after_the_other"]
        rows.append([
            row["bodies"], row["way"], f"{row['cycles']:,.0f}", f"{count['instructions']:,.0f}",
            f"{count['divisions']:.0f}, {count['roots']:.0f}", f"{misses:,.0f}", *limits, f"{row['share']:.2f}",
            f"{waits / row['nanoseconds']:.2f}" if waits else "–"
        ])
    return markdown(heads, rows)


def step_table(step):
    whole = step["functions"]["step"]["instructions"]
    rows = [(name, f"{count['instructions']:,.0f}", f"{count['instructions'] / whole:.0%}",
             f"{count['code misses']:,.0f}", f"{count['load misses'] + count['store misses']:,.0f}")
            for name, count in step["functions"].items()]
    heads = ("part of a step", "instructions", "share", "lines of code fetched anew", "lines of data")
    return (f"200 pyramids at rest: {step['contacts']} contacts, {step['pairs']} pairs.\n\n" + markdown(heads, rows))


def draw(calls, line):
    """Cycles of each call: a bar; the limits: a mark each."""
    figure, panel = plt.subplots(figsize=(9.5, 0.42 * len(calls) + 2.0))
    places = range(len(calls))[::-1]
    panel.barh(places, [row["cycles"] for row in calls], color="#c9d6e8", label="measured")
    for mark, name in zip("|ox^sD", ALL_LIMITS):
        panel.plot([row["limits"][name] for row in calls], places, mark, markersize=7, label=name, linestyle="")
    panel.set_yticks(places, [f"{row['bodies']}, {row['way']}" for row in calls], fontsize=8)
    panel.set(xscale="log", xlabel="cycles a call from memory, and the least that each part of the processor takes")
    panel.legend(fontsize=8, ncols=4, loc="upper center", bbox_to_anchor=(0.35, -0.15), frameon=False)
    panel.set_title(line, fontsize=8)
    figure.savefig(OUT / "roofline.png", dpi=110, bbox_inches="tight")
    plt.close(figure)


if __name__ == "__main__":
    main()
