#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Draws out/patch/patch.png from out/patch/summary.json: time against tolerance, and error against the estimate."""

import json
import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


def main():
    folder = pathlib.Path(__file__).resolve().parents[2] / "out/patch"
    kinds = json.loads((folder / "summary.json").read_text())["kinds"]
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    names = list(dict.fromkeys(kind["kind"] for kind in kinds))
    for colour, name in enumerate(names):
        for i, kind in enumerate(kind for kind in kinds if kind["kind"] == name):
            rows = kind["rows"]
            label = name if i == 0 else None
            left.loglog([row["tolerance"] for row in rows], [row["units"] for row in rows], "o-", color=f"C{colour}",
                        label=label, ms=3, lw=0.7)
            errors = [max(row["error"], 1e-16) for row in rows]
            right.loglog([max(row["estimate"], 1e-16) for row in rows], errors, "o", color=f"C{colour}", ms=3)
    left.set(xlabel="tolerance", ylabel="time / evaluation of both bodies")
    left.legend(fontsize=8)
    right.axline((1e-10, 1e-10), (1, 1), color="grey", lw=0.7)
    right.set(xlabel="estimated error", ylabel="error")
    figure.savefig(folder / "patch.png", dpi=150)


main()
