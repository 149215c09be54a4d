#!/usr/bin/env bash
# The examples of one file each with few bodies and steps, judged by their own summaries: nothing failed, nobody is lost.
set -euo pipefail
cd "$(dirname "$0")/.."

root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Runs a command beside at most one other, its output in a file of that name; one that fails ends all.
beside() {
    while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n; done
    local name=$1
    shift
    "$@" >"$folder/$name.txt" 2>&1 || { cat "$folder/$name.txt"; return 1; } &
}
example() {
    local name=$1
    shift
    beside "$name" env OUTPUT="$folder/$name" "$@" scripts/yade.sh -j1 "examples/${SCRIPT:-$name}.py"
}
there() {
    cd "$folder" && "$root/scripts/yade.sh" -j1 "$root/examples/$1.py"
}

# The longest first.
example shear BODIES=60 STRAIN=0.05
example ballast BODIES=40 CYCLES=3
example drum BODIES=60 TURNS=0.4
example repose BODIES=60
example triaxial BODIES=60 STRAIN=0.02
example oedometer BODIES=20 STRESS=5e4
example rocks BODIES=40 STEPS=5000
example hopper BODIES=60 STEPS=7000
example pyramids BODIES=20 STEPS=3500
SCRIPT=pyramids example joints LAW=joint BODIES=10 STEPS=9000
SCRIPT=rock_tunnel example tunnel SPACING=4 SECONDS=0.1
example voxels BODIES=12
example wedge
beside first_pile there first_pile
beside arch there arch
while [ -n "$(jobs -rp)" ]; do wait -n; done
if LAW=jiont scripts/yade.sh -j1 examples/first_pile.py >"$folder/law.txt" 2>&1; then echo 'a law that is none was taken' >"$folder/law.txt"; fi
BODIES=60 STEPS=1500 OUTPUT=$folder/mpi scripts/yade_mpi.sh 3 -j1 examples/mpi_pile.py 2>&1 | tee "$folder/mpi.txt"

/usr/bin/python3 - "$folder" <<'PYTHON'
import json, pathlib, re, sys
folder = pathlib.Path(sys.argv[1])
names = ("rocks", "hopper", "triaxial", "oedometer", "voxels", "shear", "repose", "drum", "ballast", "tunnel")
summaries = rocks, hopper, triaxial, oedometer, voxels, shear, repose, drum, ballast, tunnel = [json.loads((folder / name / "summary.json").read_text()) for name in names]
said = {name: (folder / f"{name}.txt").read_text() for name in ("pyramids", "joints", "arch", "wedge", "mpi", "triaxial", "law")}
wedge = [float(number) for number in re.findall(r"slides below (\S+) degrees; closed form (\S+),", said["wedge"])[0]]
pictures = [folder / "first_pile.png", folder / "arch.png", folder / "rocks" / "rocks.png", folder / "hopper" / "hopper.png", folder / "triaxial" / "triaxial.png",
            folder / "oedometer" / "oedometer.png", *(folder / name / f"{name}.png" for name in names[4:-1]), folder / "tunnel" / "key_blocks.png", folder / "tunnel" / "fallen.png",
            *(folder / "pyramids" / f"pyramids_{i}.png" for i in range(3))]
checks = {
    "pictures": all(picture.stat().st_size > 10_000 for picture in pictures),
    "rocks: all are there": rocks["bodies"] == 40 and rocks["lost"] == 0,
    "rocks: no failure": rocks["failures"] == 0,
    "rocks: they touch": rocks["contacts"] > 10,
    "rocks: overlaps are small": 0 < rocks["largest_overlap_over_smallest_diameter"] < 0.05,
    "rocks: frames": len(list((folder / "rocks").glob("rocks.bodies.*.vtp"))) == 6,
    "hopper: no failure": hopper["failures"] == 0,
    "hopper: nobody goes through the wall": hopper["rocks_beside_the_hopper"] == 0,
    "pyramids: all are there, none failed": "20 pyramids" in said["pyramids"] and " 0 lost, 0 failures" in said["pyramids"],
    "pyramids with joints: all are there, none failed": "10 pyramids" in said["joints"] and " 0 lost, 0 failures" in said["joints"],
    "arch: its stones rest": float(re.findall(r"fastest stone (\S+) m/s", said["arch"])[0]) < 1e-4,
    "wedge: slides where the closed form has it": abs(wedge[0] - wedge[1]) < 0.01,
    "rocks on 3 ranks: no failure, no warning": "60 rocks on 3 ranks" in said["mpi"] and "failures: none" in said["mpi"]
        and "Warning" not in said["mpi"] and "pass through" not in said["mpi"],
    "rocks on 3 ranks: saved": (folder / "mpi" / "rocks.yade.gz").stat().st_size > 1000,
    "triaxial: walls and contacts have the same deviator, to the unrest of so few": abs(triaxial["contacts_against_walls"]) < 0.02,
    "triaxial: with what accelerates rocks, the same to a thousandth": triaxial["moving_against_walls"] < 1e-3,
    "shear: a friction angle of rocks": 25 < shear["friction_angle_end"] < 55,
    "shear: at the pressure that was asked for": abs(shear["normal_stress_end"] / 1e5 - 1) < 0.1,
    "repose: rocks lie on the floor": repose["below_floor"] == 0 and 5 < repose["angle_of_repose"] < 45,
    "drum: the surface is as steep as rocks are": drum["out_of_drum"] == 0 and 20 < drum["slope"] < 60,
    # On a layer of two rocks it may go up or down by a millimetre.
    "ballast: the sleeper stays on the rocks": abs(ballast["settlement_mm"][-1]) < 3 and ballast["overlap_over_r"] < 1,
    "a law that is none is refused": "LAW='jiont' in the environment: it is point" in said["law"],
    "triaxial: a friction angle of rocks": 25 < triaxial["friction_angle_end"] < 50,
    "triaxial: as dense as rocks can be": 0.3 < triaxial["porosity"][0] < 0.45,
    "triaxial: contacts turn towards the axis": triaxial["fabric_end"] > 0,
    "triaxial: no warning": "SceneWarning" not in said["triaxial"],
    "oedometer: work is energy, to what overlaps add or lose": abs(oedometer["energy_over_work"]) < 0.05 and abs(oedometer["after_unloading"]) < 0.05,
    "oedometer: pressed rocks are stiff": oedometer["modulus_of_loading_Pa"] > 1e5 and 0 < oedometer["overlap_over_r"] < 1,
    "voxels: a body for each grain, of its volume, near to it": voxels["grains"] == 12 and voxels["volume_off"] < 1e-6 and voxels["mean_off"] < 0.03,
    "tunnel: what block theory frees moves": 0 < tunnel["of_these_moved"] == tunnel["pieces_that_block_theory_frees"],
    "tunnel: bodies do not sink into each other": tunnel["overlap_over_r"] < 1,
    "hopper: rocks flow out": 0 < hopper["mass_out_kg"] <= hopper["mass_kg"] * (1 + 1e-9),
}
for name, good in checks.items():
    if not good:
        print(f"short examples: {name}: does not hold; summaries: {dict(zip(names, summaries))}")
print(f"{sum(checks.values())} passed, {sum(not good for good in checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
