#!/usr/bin/env bash
# The examples of one file each with few bodies and steps, judged by their own summaries: nothing failed, nobody is lost.
set -euo pipefail
cd "$(dirname "$0")/.."

root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
(cd "$folder" && "$root"/scripts/yade.sh -j1 "$root"/examples/first_pile.py)
BODIES=40 STEPS=5000 OUTPUT=$folder/rocks scripts/yade.sh -j1 examples/rocks.py
BODIES=60 STEPS=7000 OUTPUT=$folder/hopper scripts/yade.sh -j1 examples/hopper.py

/usr/bin/python3 - "$folder" <<'PYTHON'
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
rocks, hopper = (json.loads((folder / name / "summary.json").read_text()) for name in ("rocks", "hopper"))
pictures = [folder / "first_pile.png", folder / "rocks" / "rocks.png", folder / "hopper" / "hopper.png"]
checks = {
    "pictures": all(picture.stat().st_size > 10_000 for picture in pictures),
    "rocks: all are there": rocks["bodies"] == 40 and rocks["lost"] == 0,
    "rocks: no failure": rocks["failures"] == 0,
    "rocks: they touch": rocks["contacts"] > 10,
    "rocks: overlaps are small": 0 < rocks["largest_overlap_over_smallest_diameter"] < 0.05,
    "rocks: frames": len(list((folder / "rocks").glob("rocks.bodies.*.vtp"))) == 6,
    "hopper: no failure": hopper["failures"] == 0,
    "hopper: nobody goes through the wall": hopper["rocks_beside_the_hopper"] == 0,
    "hopper: rocks flow out": 0 < hopper["mass_out_kg"] <= hopper["mass_kg"] * (1 + 1e-9),
}
for name, good in checks.items():
    if not good:
        print(f"short examples: {name}: does not hold; summaries: {rocks} {hopper}")
print(f"{sum(checks.values())} passed, {sum(not good for good in checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
