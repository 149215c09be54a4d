# SPDX-License-Identifier: GPL-3.0-or-later
# The wedge of studies/wedge.py: its closed form, what it refuses, and the angle that the simulation finds, whatever
# size, stiffness and density.
import sys
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parents[2] / "studies"))

import numpy as np
import yade
from dataclasses import replace
from friction_reduction import FrictionReduction, errors
from harness import *
from joint_planes import Plane, plunge_and_trend, sliding
from wedge_blocks import WedgeBlocks
from wedge_cases import NEAR_POLYHEDRAL, OTHERS, PAPER
from wedge_scene import WedgeScene

check = Checks()

# The closed form, against numbers of the literature and against the balance of forces itself.
check.close(sliding(Plane(40, 130), Plane(60, 220)).friction_angle, 33.357, 5e-4, "the paper's wedge")
worked = sliding(Plane(45, 105), Plane(70, 235))
check.close(worked.plunge, 31.20, 5e-3, "Hoek & Bray, worked example: plunge")
check.close(worked.trend, 157.73, 5e-3, "Hoek & Bray, worked example: trend")
charts = sliding(Plane(40, 165), Plane(70, 285))
drive = np.sin(np.radians(charts.plunge))
check.close(charts.force_a / drive, 1.5, 0.02, "Hoek & Bray, friction only: A read from the chart")
check.close(charts.force_b / drive, 0.7, 0.02, "Hoek & Bray, friction only: B read from the chart")
for case in [PAPER, *OTHERS]:
    limit, a, b = sliding(case.plane_a, case.plane_b), case.plane_a.normal, case.plane_b.normal
    friction = np.tan(np.radians(limit.friction_angle))
    total = limit.force_a * (a - friction * limit.line) + limit.force_b * (b - friction * limit.line)
    check.close(Vector3(*total), Vector3(0, 0, 1), 1e-12, f"{case.name}: reactions carry the weight")
    check.close(abs(limit.line @ a) + abs(limit.line @ b), 0, 1e-12, f"{case.name}: the line lies in both planes")
    swapped = sliding(case.plane_b, case.plane_a)
    check.close(swapped.friction_angle, limit.friction_angle, 1e-12, f"{case.name}: order of the joints")
symmetric = sliding(Plane(50, 135), Plane(50, 225))
check.close(symmetric.force_a, symmetric.force_b, 1e-12, "symmetric: equal forces")
check.close(symmetric.trend, 180, 1e-9, "symmetric: slides to the south")
check.close(plunge_and_trend((1.0, 0.0, -1.0))[0], 45, 1e-12, "plunge of a vector")

# Bad input says what is wrong.
for build, text in [
    (lambda: Plane(95, 10), "dip 95"),
    (lambda: Plane(-1, 10), "dip -1"),
    (lambda: Plane(float("nan"), 10), "dip nan"),
    (lambda: Plane(40, 400), "dip direction 400"),
    (lambda: sliding(Plane(40, 130), Plane(40, 130)), "parallel"),
    (lambda: sliding(Plane(40, 130), Plane(60, 130)), "level"),
    (lambda: sliding(Plane(47, 52), Plane(70, 18)), "leave plane B"),
    (lambda: WedgeBlocks(PAPER.plane_a, PAPER.plane_b, size=0.0), "size 0"),
    (lambda: WedgeBlocks(PAPER.plane_a, PAPER.plane_b, face=Plane(30, 156)), "does not come out"),
    (lambda: WedgeBlocks(PAPER.plane_a, PAPER.plane_b, face=Plane(85, 90)), "removable"),
    (lambda: WedgeBlocks(Plane(30, 150), Plane(75, 240)), "turn over"),
]:
    check.raises(ValueError, build, f"refused: {text}", text)

# Four blocks that meet as they should: the wedge's centroid lies above both joints, each other block below.
blocks = WedgeBlocks(PAPER.plane_a, PAPER.plane_b, size=2.0)
sides = {name: (getattr(blocks, name).centroid @ blocks.plane_a.normal > 0,
                getattr(blocks, name).centroid @ blocks.plane_b.normal > 0)
         for name in ("wedge", "block_a", "block_b", "base")}
check.equal(sides, {"wedge": (True, True), "block_a": (False, True), "block_b": (True, False),
                    "base": (False, False)}, "which block lies where")
corners = blocks.wedge.corners
check.close(np.ptp(corners[:, 2]), 2.0, 1e-9, "height of the wedge")

# The simulation: the paper's wedge with flat and with rounded faces, then size, stiffness and density in turn.
BRACKET = 1.0 / 128.0
CASES = [
    PAPER,
    NEAR_POLYHEDRAL,
    replace(PAPER, name="20 times as large", size=20.0),
    replace(PAPER, name="4 times as stiff", weight_over_stiffness=2.5e-5),
    replace(PAPER, name="half as dense", density=1300.0, weight_over_stiffness=5e-5),
    OTHERS[2],
]
# Two threads only take longer over four bodies: there it is enough that they find the same.
for case in CASES if O.numThreads == 1 else CASES[:2]:
    scene = WedgeScene(case, WedgeBlocks(case.plane_a, case.plane_b, case.size))
    result = FrictionReduction(scene, bracket=BRACKET).run()
    error = errors(result, scene.blocks.limit, scene.weight)
    check.true(0 < result.holds_at - result.slides_at <= 0.01, f"{case.name}: bracket")
    check.close(result.angle, scene.blocks.limit.friction_angle, case.target, f"{case.name}: critical friction angle")
    check.true(error["direction"] < 0.1, f"{case.name}: slides {error['direction']} degrees off the line")
    check.true(max(abs(error["force_a"]), abs(error["force_b"])) < 1e-3, f"{case.name}: normal forces {error}")
    check.equal(scene.failed_contacts(), 0, f"{case.name}: failed contacts")

check.finish()
