# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of joints against closed forms, energy and rest: table, picture and summary.json in out/patch-yade.

CASES="face spin" runs some of the rows, TOLERANCE=1e-3 with that of patches where a row asks for no other; OUTPUT names
another folder; BLOCKS=2000 makes the rock of reduced_tunnel so large, about.
"""
import os
import sys
from pathlib import Path

HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import bonds  # noqa: E402
import buildings  # noqa: E402
import cost  # noqa: E402
import impacts  # noqa: E402
import pictures  # noqa: E402
import piles  # noqa: E402
import reduced  # noqa: E402
import rows  # noqa: E402
from summary import print_targets, target, write_summary  # noqa: E402

ROWS = rows.ROWS | impacts.ROWS | bonds.ROWS | piles.ROWS | buildings.ROWS | reduced.ROWS | cost.ROWS


def targets(name, row):
    """Every value of a row that has a target: NAME and NAME_target, or the value itself."""
    for key in [key for key in row if key == "target" or key.endswith("_target")]:
        value = key[:-len("target")].rstrip("_") or "value"
        label = name if value == "value" else f"{name}, {value.replace('_', ' ')}"
        yield target(label, "at most", row[key], row[value])
    if "falls" in row:
        yield target(f"{name}, falls below", "at least", 1, int(row["falls"]))


def main():
    chosen = os.environ.get("CASES", "").split() or list(ROWS)
    folder = Path(os.environ.get("OUTPUT") or HERE.parents[1] / "out/patch-yade")
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for name in chosen:
        found[name] = ROWS[name]()
        print(f"{name}: {found[name]}", flush=True)
        if name in pictures.OF_SCENES:
            pictures.OF_SCENES[name](folder / f"{name}.png")
    listed = [one for name, row in found.items() for one in targets(name, row)]
    write_summary(folder / "summary.json", {"rows": found, "targets": listed})
    pictures.all_rows([entry for entry in listed if entry["sense"] == "at most"], folder / "joints.png")
    for name in found.keys() & pictures.OF_ROWS.keys():
        pictures.OF_ROWS[name](found[name], folder / f"{name}.png")
    print_targets(listed)


main()
