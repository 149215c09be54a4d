# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of joints against closed forms, energy and rest: table, picture and summary.json in out/patch-yade.

CASES="face spin" runs some of the rows, OUTPUT names another folder.
"""
import os
import sys
from pathlib import Path

HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import cost  # noqa: E402
from rows import ROWS  # noqa: E402
from summary import print_table, write_summary  # noqa: E402

ROWS.update(cost.ROWS)


def picture(found, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    names = list(found)
    figure, axes = pyplot.subplots(figsize=(7, 0.45 * len(names) + 1.2))
    shares = [max(found[name]["value"] / found[name]["target"], 1e-6) for name in names]
    axes.barh(names, shares, left=1e-6, color=["#4a7fb5" if share <= 1 else "#c0563b" for share in shares])
    axes.axvline(1, color="black", linewidth=1)
    axes.set_xscale("log")
    axes.set_xlabel("measured / target")
    axes.invert_yaxis()
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    chosen = os.environ.get("CASES", "").split() or list(ROWS)
    folder = Path(os.environ.get("OUTPUT") or HERE.parents[1] / "out/patch-yade")
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for name in chosen:
        found[name] = ROWS[name]()
        print(f"{name}: {found[name]}", flush=True)
    for row in found.values():
        row["met"] = row["value"] <= row["target"] and row.get("falls", True) and row.get("falling", 0) <= row.get("falling_target", 1)
    write_summary(folder / "summary.json", {"rows": found, "targets": {name: row["target"] for name, row in found.items()}})
    picture(found, folder / "joints.png")
    print_table([(name, f"{row['value']:.3g}  (target {row['target']:g}) {'met' if row['met'] else 'MISSED'}  {ROWS[name].__doc__}")
                 for name, row in found.items()])


main()
