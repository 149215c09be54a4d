# SPDX-License-Identifier: MIT OR Apache-2.0
"""Run time against error, from the figures of the work-precision benchmark.

    python3 benches/plot.py [out/bench]

Reads work_precision_pairs.csv and summary.json of that folder and draws work_precision.png there.
"""

import csv
import json
import math
import statistics
import sys
from collections import defaultdict
from pathlib import Path

try:
    import matplotlib
except ImportError:
    sys.exit("plot.py: no picture without matplotlib (Debian: python3-matplotlib); the figures are in the .csv files")

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

# Title, formulation and families of each panel.
ROUNDED, FLAT = ["generic", "far_origin", "scaled_units",
                 "sphere_mix"], ["face_face", "edge_edge", "plates", "polyhedra_k0"]
PANELS = [
    ("midway: rounded bodies", "midway", ROUNDED),
    ("midway: faces, edges, plates, k = 0", "midway", FLAT),
    ("midway: nearly polyhedral, r and k down to 1e-8", "midway", ["near_polyhedral"]),
    ("closest: rounded and flat bodies", "closest", ROUNDED + FLAT),
]

# Name in the data: colour, marker, label.
STYLES = {
    "fast": ("#0b3c8c", "o", "fast (this library)"),
    "cone_program": ("#1aa0a8", "s", "cone program (this library, clarabel scaled)"),
    "clarabel, paper's program": ("#e07b00", "D", "clarabel, program as the paper writes it"),
    "Newton (Houlsby), plain": ("#f08a9b", "v", "Newton on Lagrange conditions (Houlsby), plain"),
    "Newton (Houlsby), halved": ("#c2182f", "^", "the same with step halving"),
    "cubic Newton (Harkness), plain": ("#c3a5e0", "<", "cubic particle (Harkness), plain"),
    "cubic Newton (Harkness), halved": ("#6b3fa0", ">", "the same with step halving"),
    "YADE built-in": ("#2e8b3d", "P", "YADE's Ig2_PP_PP_ScGeom, without contact area"),
    "YADE built-in, with area": ("#0d4f1b", "X", "the same with contact area, its default"),
}
USUAL = {"fast": 1e-12, "cone_program": 1e-12, "YADE built-in": 1e-7, "YADE built-in, with area": 1e-7}
USUAL_OTHERWISE = 1e-8

# An error of exactly zero has no place on a logarithmic axis; one above 10 is as wrong as any.
LEAST_ERROR, MOST_ERROR = 3e-17, 10.0


def read(path):
    """(solver, formulation) -> tolerance -> list of (family, time in µs, error of s or None, answered, wrong side)."""
    data = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            error = float(row["s_error"]) if row["s_error"] else None
            time = float(row["time_us"]) if row["time_us"] else math.nan
            entry = row["family"], time, error, not row["failure"], row["wrong_side"] == "1"
            data[row["solver"], row["formulation"]][float(row["tolerance"])].append(entry)
    return data


def curve(by_tolerance, families):
    """Per tolerance, loosest first: median time, median error, worst error over the pairs that were answered."""
    points = []
    for tolerance in sorted(by_tolerance, reverse=True):
        known = [(time, min(max(error, LEAST_ERROR), MOST_ERROR))
                 for family, time, error, answered, _ in by_tolerance[tolerance]
                 if family in families and answered and error is not None]
        if known:
            times, errors = zip(*known)
            points.append((statistics.median(times), statistics.median(errors), max(errors)))
    return points


def draw(axes, data, formulation, families):
    for solver, (colour, marker, _) in STYLES.items():
        points = curve(data.get((solver, formulation), {}), families)
        if not points:
            continue
        times, medians, worst = zip(*points)
        fast = solver == "fast"
        axes.plot(worst, times, ":", color=colour, lw=1, marker=marker, ms=4, mfc="white", mew=0.8,
                  zorder=3 if fast else 2)
        axes.plot(medians, times, "-", color=colour, lw=2.2 if fast else 1.3, marker=marker, ms=6 if fast else 5,
                  zorder=5 if fast else 4)
    axes.set(xscale="log", yscale="log", xlim=(1e-17, 30))
    failed_share(axes, data, formulation, families)
    axes.grid(which="major", color="#dddddd", lw=0.6)
    axes.xaxis.set_major_locator(LogLocator(numticks=20))
    axes.set_xticks([10.0**e for e in range(-16, 1, 4)])
    axes.xaxis.set_minor_formatter(NullFormatter())
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def failed_share(axes, data, formulation, families):
    """A strip of numbers in the colours of the solvers: without them, whoever gives up on hard pairs looks quick."""
    left = 0.2
    for solver, (colour, *_) in STYLES.items():
        by_tolerance = data.get((solver, formulation), {})
        entries = [entry for entry in by_tolerance.get(usual(solver), []) if entry[0] in families]
        if entries:
            failed = sum(not answered or wrong for *_, answered, wrong in entries)
            axes.text(left, 0.015, f"{100 * failed / len(entries):.0f}", transform=axes.transAxes, fontsize=10,
                      color=colour, weight="bold", ha="center")
            left += 0.095
    if left > 0.2:
        axes.text(0.0, 0.015, " % failed", transform=axes.transAxes, fontsize=8.5, color="#555555")


def usual(solver):
    return USUAL.get(solver, USUAL_OTHERWISE)


def failures(data, solver):
    """'midway 3 + 1 of 360, closest ...' at the usual tolerance: no answer + wrong side."""
    parts = []
    for formulation in ("midway", "closest"):
        entries = data.get((solver, formulation), {}).get(usual(solver), [])
        if entries:
            failed = sum(not answered for *_, answered, _ in entries)
            wrong = sum(wrong for *_, wrong in entries)
            parts.append(f"{formulation} {failed} + {wrong} of {len(entries)}")
    return ", ".join(parts)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/bench")
    data = read(folder / "work_precision_pairs.csv")
    machine = json.loads((folder / "summary.json").read_text())["machine"]

    figure, grid = plt.subplots(2, 2, figsize=(14, 12.5), sharex=True, sharey=True)
    for axes, (title, formulation, families) in zip(grid.flat, PANELS):
        draw(axes, data, formulation, families)
        axes.set_title(title, fontsize=15)
        axes.tick_params(labelsize=13)
    for axes in grid[1]:
        axes.set_xlabel("relative error of s", fontsize=14)
    for axes in grid[:, 0]:
        axes.set_ylabel("time of a call, µs", fontsize=14)
    grid[0][0].set_ylim(0.08, 3e5)

    handles = [Line2D([], [], color=colour, marker=marker, lw=2.2 if solver == "fast" else 1.3,
                      label=f"{label}: {failures(data, solver)}")
               for solver, (colour, marker, label) in STYLES.items()
               if any(key[0] == solver for key in data)]
    handles += [Line2D([], [], color="#555555", marker="o", label="filled: median error over the pairs"),
                Line2D([], [], color="#555555", marker="o", ls=":", lw=1, mfc="white", label="open: worst error")]
    legend = figure.legend(
        handles=handles, loc="lower center", ncol=1, fontsize=12, frameon=False,
        title="solver: pairs without an answer + pairs on the wrong side of contact, at its usual tolerance")
    legend.get_title().set_fontsize(12)
    figure.suptitle("Run time against error, one marker a tolerance; lower left is better", fontsize=17, y=0.985)
    figure.text(0.995, 0.006, f"{machine['processor']}, {machine['cores']} cores, {machine['date'][:10]}",
                ha="right", fontsize=8, color="#666666")
    figure.subplots_adjust(left=0.07, right=0.99, top=0.92, bottom=0.29, hspace=0.13, wspace=0.05)
    figure.savefig(folder / "work_precision.png", dpi=110)
    print(f"written: {folder / 'work_precision.png'}")


main()
