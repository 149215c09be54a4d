# SPDX-License-Identifier: MIT OR Apache-2.0
"""Run time against error, from the figures of the work-precision benchmark.

    python3 benches/plot.py [out/bench]

Reads work_precision.csv and summary.json of that folder and draws work_precision.png there.
"""

import csv
import json
import statistics
import sys
from collections import defaultdict
from pathlib import Path

try:
    import matplotlib
except ImportError:
    sys.exit("plot.py: no picture without matplotlib (Debian: python3-matplotlib); the figures are in the .csv file")

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Title, formulation and families of each panel.
ROUNDED = ["generic", "far_origin", "scaled_units", "sphere_mix"]
FLAT = ["face_face", "edge_edge", "plates", "polyhedra_k0"]
PANELS = [
    ("midway: rounded bodies", "midway", ROUNDED),
    ("midway: faces, edges, plates, k = 0", "midway", FLAT),
    ("midway: nearly polyhedral, r and k down to 1e-8", "midway", ["near_polyhedral"]),
    ("closest: rounded and flat bodies", "closest", ROUNDED + FLAT),
]
# Name in the data: colour, marker, label.
STYLES = {"fast": ("#0b3c8c", "o", "this library"), "cone_program": ("#1aa0a8", "s", "the cone program, by clarabel")}
# An error of exactly zero has no place on a logarithmic axis.
LEAST_ERROR = 3e-17


def curves(path):
    """(solver, formulation) -> tolerance -> rows of the pairs that were answered."""
    data = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if not row["failure"]:
                data[row["solver"], row["formulation"]][float(row["tolerance"])].append(row)
    return data


def points(by_tolerance, families):
    """Per tolerance, loosest first: median time, median error, worst error."""
    for tolerance in sorted(by_tolerance, reverse=True):
        rows = [row for row in by_tolerance[tolerance] if row["family"] in families]
        if rows:
            errors = [max(float(row["s_error"]), LEAST_ERROR) for row in rows]
            yield statistics.median(float(row["time_us"]) for row in rows), statistics.median(errors), max(errors)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/bench")
    data = curves(folder / "work_precision.csv")
    machine = json.loads((folder / "summary.json").read_text())["machine"]
    figure, grid = plt.subplots(2, 2, figsize=(11, 8.5), sharex=True, sharey=True, layout="constrained")
    for axes, (title, formulation, families) in zip(grid.flat, PANELS):
        for solver, (colour, marker, label) in STYLES.items():
            found = list(points(data.get((solver, formulation), {}), families))
            if found:
                times, medians, worst = zip(*found)
                axes.loglog(worst, times, ":", marker=marker, color=colour, ms=4, mfc="white", label=f"{label}: worst")
                axes.loglog(medians, times, "-", marker=marker, color=colour, ms=6, label=f"{label}: median")
        axes.set_title(title)
        axes.grid(color="#dddddd", lw=0.6)
    for axes in grid[1]:
        axes.set_xlabel("relative error of s")
    for axes in grid[:, 0]:
        axes.set_ylabel("time of a call, µs")
    grid[0][0].legend(fontsize=8)
    figure.suptitle("Run time against error, one marker a tolerance; "
                    f"{machine['processor']}, {machine['cores']} cores, {machine['date'][:10]}", fontsize=10)
    figure.savefig(folder / "work_precision.png", dpi=110)
    print(f"written: {folder / 'work_precision.png'}")


main()
