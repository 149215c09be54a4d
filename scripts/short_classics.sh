#!/usr/bin/env bash
# A little of each of the classics, judged by their own summary, and the closed forms against numbers from books.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
CASES=short OUTPUT=$folder studies/classics/run.py

/usr/bin/python3 - "$folder" <<'PYTHON'
import json, math, pathlib, sys
folder = pathlib.Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
cases = summary["cases"]


def rows(name, key="found"):
    return [row[key] for row in cases[name]["rows"]]


met = {one["name"]: one["met"] for one in summary["targets"]}
# YADE's own rule for free rotation is known to miss; the rule beside it is not.
expected = {name: good for name, good in met.items() if "YADE's rule" not in name}
checks = {"not interrupted": not summary["interrupted"], "every case ran": len(cases) == 11 and not summary["failed"]}
checks |= {f"target: {name}": good for name, good in expected.items()}
checks["a target each"] = len(expected) >= 12
# Published: Milankovitch's arch of few stones is a little thinner; Goodman & Bray; Housner for b/h = 1/4; sums of 1/i.
checks["closed form of the arch"] = 0.1060 < cases["arch"]["rows"][0]["closed_form"] < 0.1075
checks["closed form of the toppling slope"] = abs(cases["toppling"]["rows"][0]["closed_form"] - 38.15) < 0.005
checks["closed form of the impact"] = abs(cases["rocking"]["rows"][-1]["closed_form"] - (1.0 - 1.5 / 17.0)) < 1e-12
checks["closed form of the overhang"] = abs(rows("overhang", "closed_form")[0] - 11.0 / 12.0) < 1e-12
checks["rolling: few sides are slow"] = rows("rolling", "error")[0] < -0.05
# One point has no lever for a moment about the normal; a patch nearly has that of an even pressure.
one, patch = rows("twist", "error")
checks["one contact point does not stop a spin"] = abs(one + 1.0) < 1e-6
checks["a patch of points stops it"] = abs(patch) < 0.01
checks["pictures"] = all((folder / name).stat().st_size > 10_000 for name in ("classics.png", "classics_arch.png"))
checks["table"] = (folder / "table.md").read_text().count("\n| ") > 25
for name, good in checks.items():
    if not good:
        print(f"short classics: {name}: does not hold; summary: {summary}")
print(f"{sum(checks.values())} passed, {sum(not good for good in checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
