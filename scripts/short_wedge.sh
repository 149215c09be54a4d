#!/usr/bin/env bash
# Two of the wedges, judged by their own summary: every file is written, and every target is met. Results go to a
# folder of their own.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
CASES=short OUTPUT=$folder scripts/yade.sh -j1 studies/wedge.py

/usr/bin/python3 - "$folder" <<'PYTHON'
import csv, json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
trials = list(csv.DictReader(open(folder / "trials.csv")))
checks = {"not interrupted": not summary["interrupted"], "no failure": summary["failed_contacts"] == 0}
for row in summary["cases"]:
    name, limit = row["name"], row["closed_form_degrees"]
    checks[f"{name}: closed form"] = abs(limit - 33.357) < 5e-4
    checks[f"{name}: angle"] = abs(row["angle_degrees"] - limit) < row["target_degrees"]
    checks[f"{name}: bracket"] = 0 < row["holds_at_degrees"] - row["slides_at_degrees"] <= 0.01
    checks[f"{name}: direction"] = row["direction_error_degrees"] < 0.1
    checks[f"{name}: forces"] = max(abs(row["force_a_error"]), abs(row["force_b_error"])) < 1e-3
    verdicts = {t["verdict"] for t in trials if t["case"] == name}
    checks[f"{name}: trials of both kinds"] = {"holds", "slides"} <= verdicts
slide, (raw, held) = summary["studies"]["slide_out"], summary["studies"]["at_rest"]
checks["two cases"] = len(summary["cases"]) == 2
checks["slides along the line"] = slide["moved_over_size"] > 0.3 and slide["direction_error_degrees"] < 0.1
checks["forces while sliding"] = max(slide["largest_force_a_error"], slide["largest_force_b_error"]) < 1e-3
checks["sits still when regularised"] = held["spread_of_point_over_size"] < 1e-5
checks["rattles when not"] = raw["spread_of_point_over_size"] > 0.1
checks["picture"] = (folder / "wedge.png").stat().st_size > 10_000
checks["series"] = len(list(folder.glob("*.bodies.*.vtp"))) == slide["frames"] > 10
for name, good in checks.items():
    if not good:
        print(f"short wedge: {name}: does not hold; summary: {summary}")
print(f"{sum(checks.values())} passed, {sum(not good for good in checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
