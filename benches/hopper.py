# SPDX-License-Identifier: MIT OR Apache-2.0
"""examples/hopper.py with 1,000 rocks and a hopper of 5,184 facets: the time of a step, and whether anybody goes
through.

    [BODIES=1000] [STEPS=20000] /usr/bin/python3 benches/hopper.py

Each triangle of the example's hopper is cut into nine. Results go to out/hopper: summary.json with targets, hopper.png,
flow.csv.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOP / "studies"))

import machine
from summary import write_summary

OUT = TOP / "out" / "hopper"
STL = TOP / "examples" / "data" / "hopper.stl"
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    finer(STL, OUT / "hopper.stl")
    environment = {
        "BODIES": "1000", "STEPS": "20000", **os.environ, "HOPPER": str(OUT / "hopper.stl"), "OUTPUT": str(OUT)
    }
    subprocess.run([TOP / "scripts" / "yade.sh", "-j1", TOP / "examples" / "hopper.py"], env=environment, check=True)
    summary = json.loads((OUT / "summary.json").read_text())
    summary["targets"] = [target(name, summary[field], most) for name, field, most in (
        ("contacts that failed", "failures", 0), ("rocks that went through the wall", "rocks_beside_the_hopper", 0))]
    summary |= {
        "machine": machine.machine_line(), "date": machine.now(), "command": "/usr/bin/python3 benches/hopper.py"
    }
    write_summary(OUT / "summary.json", summary)
    print(f"{summary['bodies']} rocks, {summary['facets']} facets: {1e3 * summary['seconds_a_step']:.2f} ms a step")
    sys.exit(not all(row["met"] for row in summary["targets"]))


def target(name, measured, most):
    return {"name": name, "sense": "<=", "target": most, "measured": measured, "met": measured <= most}


def finer(source, destination):
    """A binary STL file with each triangle cut into nine of its shape."""
    data = source.read_bytes()
    facets = np.frombuffer(data, RECORD, offset=84)
    a, b, c = np.moveaxis(facets["corners"].astype(float), 1, 0)
    at = lambda i, j: a + (i * (b - a) + j * (c - a)) / 3
    corners = [(at(i, j), at(i + 1, j), at(i, j + 1)) for i in range(3) for j in range(3 - i)]
    corners += [(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(2) for j in range(2 - i)]
    records = np.zeros(len(corners) * len(facets), RECORD)
    records["corners"] = np.concatenate([np.stack(three, 1) for three in corners])
    destination.write_bytes(data[:80] + np.uint32(len(records)).tobytes() + records.tobytes())


main()
