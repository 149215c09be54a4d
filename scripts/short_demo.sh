#!/usr/bin/env bash
# The demo with few bodies and steps, judged by its own summary: every file is written, nothing failed, nobody is
# lost, and the energy never rises. Results go to a folder of their own.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
STEPS=1500 BODIES=12 OUTPUT=$folder scripts/yade.sh -j1 studies/pyramids.py

/usr/bin/python3 - "$folder" <<'PYTHON'
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
checks = {
    "all steps done": summary["steps"] == 1500 and not summary["interrupted"],
    "no failure": summary["failures"] == 0,
    "nobody below the floor": summary["bodies_below_floor"] == 0,
    "contacts were made": summary["contact_functor"]["solved"] > 0,
    "overlaps are small": 0 < summary["largest_overlap_over_size_in_run"] < 0.05,
    "energy never rises": summary["largest_energy_rise_J"] < 1e-3 * summary["initial_potential_energy_J"],
    "picture": (folder / "pyramids.png").stat().st_size > 10_000,
    "series": len(list(folder.glob("pyramids.bodies.*.vtp"))) >= 2,
}
for name, good in checks.items():
    if not good:
        print(f"short demo: {name}: does not hold; summary: {summary}")
print(f"{sum(checks.values())} passed, {sum(not good for good in checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
