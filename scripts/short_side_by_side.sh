#!/usr/bin/env bash
# The comparison of both functors at a small size, judged by its own summary: every part ran, pictures are there,
# no contact was missed, and the physics are those of the closed forms. Speed is not judged.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
QUICK=1 OUTPUT=$folder scripts/yade.sh -j1 studies/side_by_side/run.py

/usr/bin/python3 - "$folder" <<'PYTHON'
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
rows = {(row["scene"], row["springs"]): row for row in summary["rows"]}
ours = [row["library"] for row in rows.values()]
furthest = max(row["steps_compared"] for row in rows.values())
tower = rows["tower", "fixed"]["library"]
bounce = summary["bounces"][0]
answers = summary["known_answers"]
free = summary["free_collision"]["drop-in"]
stages = summary["step_by_part"]["stages"]
pictures = ("side_by_side.png", "side_by_side_per_area.png", "bounce.png", "step_time.png")
checks = {
    "three cases ran": len(rows) == 3 and not summary["interrupted"],
    "both functors stepped them": all(row["steps_compared"] > 50 for row in rows.values()),
    "no failure": all(row["library_failures"] == 0 for row in rows.values()),
    # The slower functor has a few seconds: on a busy machine it may not come as far as many contacts, or any.
    "contacts were checked": sum(it["contacts_checked"] for it in ours) > 0 or furthest < 1000,
    "none was missed or invented": all(it["missed_contacts"] + it["invented_contacts"] == 0 for it in ours),
    "overlaps are those of the cone programs": all(it["overlap_error"] < 1e-7 for it in ours),
    "forces of a pair cancel": all(it["momentum_error"] < 1e-12 for it in ours),
    # The first step without force lets the tower sink, by far less than its overlaps of 2e-3.
    "the tower stands": tower["tower_height_error"] < 2e-4 and tower["contacts"] == 10,
    "damped energy does not rise": all(it["energy_rise"] < 1e-5 for it in ours if it["energy_rise"] is not None),
    "cubes bounce like springs": abs(bounce["library"]["drift"] / bounce["exact_springs_drift"] - 1) < 1e-6,
    "and do not spin": bounce["library"]["spin"] < 1e-9,
    "a free collision keeps momenta": max(free.values()) < 1e-10,
    "known contacts are found": answers["drop-in"]["touching"] > 5
    and answers["drop-in"]["missed"] + answers["drop-in"]["invented"] == 0,
    "every state of the pile was timed": len(stages) == 3
    and all(min(stage[f"{who}_microseconds"]["step"] for who in ("library", "built_in", "idle")) > 0 for stage in stages),
    "pictures": all((folder / name).stat().st_size > 10_000 for name in pictures),
}
for name, good in checks.items():
    if not good:
        print(f"short side by side: {name}: does not hold; summary: {summary}")
print(f"{sum(checks.values())} passed, {sum(not good for good in checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
