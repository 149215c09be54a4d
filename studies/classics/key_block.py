# SPDX-License-Identifier: MIT OR Apache-2.0
"""A tetrahedral block in the roof of a tunnel, between three joints: does it fall or hold?

It rests on joints A and B, and joint C lies on it. Their line of intersection plunges out of the roof, and joint C
opens (Shi's mode of sliding on two faces; Goodman & Shi 1985). Without cohesion the limit is that of the wedge (Hoek &
Bray 1974; studies/joint_planes.py): tan(friction) = W sin(plunge) / (N_A + N_B).
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import yade
from potential_particles import shapes
from yade import O

from joint_planes import Plane, sliding_on
from report import row, target, worst
from block_scene import GRAVITY, ROUNDING, Scene

TITLE = "a key block in a roof"
HEIGHT = 1.0  # of the block above the roof, m
REACH = 0.6  # from where the line leaves the roof to joint C, along the line's trend, m
HEADROOM = 3.0  # of friction above the plunge, with which it is held at first, degrees
PARTS = (0.3, 0.4)  # of tan(plunge): tangents of friction at which it slides
NEAR = 0.02  # degrees on both sides of the angle found, at which it is tried whether it holds
WAY = (0.01, 0.04)  # from where to where the acceleration is measured, m
PATIENCE = 3.0  # s
STEEP = 80.0  # friction angle of the block that falls all the same, degrees


@dataclass(frozen=True)
class RoofBlock:
    """Two joints that carry it."""

    name: str
    plane_a: Plane
    plane_b: Plane

    @property
    def limit(self):
        """The closed form."""
        return sliding_on(self.plane_a.normal, self.plane_b.normal)

    def joint_c(self):
        """(unit normal upwards, offset) of the joint above, through the apex and a line across the roof."""
        line = self.limit.line
        across = np.cross([0.0, 0.0, 1.0], line)
        apex = -line / -line[2] * HEIGHT
        trend = np.array([line[0], line[1], 0.0]) / np.hypot(line[0], line[1])
        normal = np.cross(across, apex - REACH * trend)
        normal *= np.sign(normal[2]) / np.linalg.norm(normal)
        return normal, float(normal @ apex)

    def half_spaces(self):
        """Rows (outward normal, offset) of the block."""
        up = np.array([0.0, 0.0, 1.0])
        c, offset = self.joint_c()
        return [(*-self.plane_a.normal, 0.0), (*-self.plane_b.normal, 0.0), (*-up, 0.0), (*c, offset)]



CASES = (
    RoofBlock("steep", Plane(60, 130), Plane(60, 230)),
    RoofBlock("oblique", Plane(50, 150), Plane(65, 240)),
    RoofBlock("one flat, one steep", Plane(45, 140), Plane(75, 250)),
)


class HungBlock:
    """The scene: a block on its two joints, laid down without friction while a force along the line holds it."""

    def __init__(self, case):
        self.case, self.line = case, case.limit.line
        shape = shapes.from_planes(case.half_spaces(), rounding=ROUNDING, k=0.0)
        size = shape.r / ROUNDING
        self.scene = scene = Scene(size=size, load=shape.volume)
        self.block = scene.add(shape)
        for outward, offset in ((-case.plane_a.normal, 0.0), (-case.plane_b.normal, 0.0), case.joint_c()):
            scene.add(shapes.cuboid((8.0, 8.0, 1.0), rounding=ROUNDING * size, k=0.0), fixed=True,
                      **_behind(outward, offset))
        scene.start(friction=0.0)
        weight = self.block.state.mass * GRAVITY
        hold = weight * self.line[2] * self.line
        self._push(hold)
        scene.settle()
        scene.set_friction(case.limit.plunge + HEADROOM)
        for part in np.linspace(1.0, 0.0, 41)[1:]:
            self._push(part * hold)
            scene.run(5.0 * scene.beat)
        scene.settle()

    def _push(self, force):
        O.forces.setPermF(self.block.id, yade.Vector3(*map(float, force)))

    def slide(self, friction):
        """Sets the friction angle and lets go; looks (n, 2): time (s), way along the line (m)."""
        scene = self.scene
        scene.set_friction(friction)
        begin, start, looks = O.time, np.array(self.block.state.pos), []
        while O.time < begin + PATIENCE:
            scene.run(20.0 * scene.beat)
            looks.append((O.time - begin, (np.array(self.block.state.pos) - start) @ self.line))
            if looks[-1][1] > WAY[1] or scene.at_rest():
                break
        scene.check()
        return np.array(looks)


def corners(case):
    """Of the block, (4, 3), m."""
    spaces = np.array(case.half_spaces())
    return [np.linalg.solve(spaces[list(i), :3], spaces[list(i), 3]).tolist() for i in combinations(range(4), 3)]


def fall():
    """Acceleration (m/s^2) of a block between three joints that all overhang, between which friction cannot hold it."""
    normals = [Plane(70.0, bearing).normal for bearing in (90.0, 210.0, 330.0)]
    spaces = [(*normal, normal[2] * HEIGHT) for normal in normals] + [(0.0, 0.0, -1.0, 0.0)]
    shape = shapes.from_planes(spaces, rounding=ROUNDING, k=0.0)
    size = shape.r / ROUNDING
    scene = Scene(size=size, load=shape.volume, moving=True)
    block = scene.add(shape)
    for *outward, offset in spaces[:3]:
        scene.add(shapes.cuboid((8.0, 8.0, 1.0), rounding=ROUNDING * size, k=0.0), fixed=True,
                  **_behind(outward, offset))
    scene.start(friction=STEEP)
    start = block.state.pos[2]
    scene.run(np.sqrt(2.0 * 0.1 / GRAVITY))
    scene.check()
    return float(2.0 * (start - block.state.pos[2]) / O.time**2)


def critical_angle(case):
    """Degrees: where the acceleration, linear in tan(friction), is zero, from two angles at which it slides."""
    tangents = np.array(PARTS) * np.tan(np.radians(case.limit.plunge))
    found = []
    for tangent in tangents:
        time, way = HungBlock(case).slide(np.degrees(np.arctan(tangent))).T
        far = way > WAY[0]
        found.append(2.0 * np.polyfit(time[far], way[far], 2)[0])
    (one, other), (low, high) = found, tangents
    return float(np.degrees(np.arctan(low + one * (high - low) / (one - other))))


def holds(case, friction):
    """Whether it comes to rest at a friction angle, from rest at a larger one."""
    hung = HungBlock(case)
    hung.slide(friction)
    return hung.scene.at_rest()


def _behind(outward, offset):
    """Position and orientation of a slab of thickness 1 whose face is the plane outward . x = offset, beyond it."""
    outward = np.asarray(outward) / np.linalg.norm(outward)
    turn = yade.Quaternion()
    turn.setFromTwoVectors(yade.Vector3(0, 0, 1), yade.Vector3(*map(float, outward)))
    place = outward * (offset + 0.5)
    return {"position": place, "orientation": turn}


def run(note, short):
    """Three blocks on two joints, or one."""
    rows, cases, wrong = [], CASES[1:2] if short else CASES, 0
    for number, case in enumerate(cases, 1):
        found = critical_angle(case)
        # Held and let fall from a rest, on both sides of the angle: not from accelerations.
        wrong += bool(not holds(case, found + NEAR) or holds(case, found - NEAR))
        name = f"critical friction angle, joints {case.plane_a} and {case.plane_b}"
        rows.append(row(name, case.limit.friction_angle, found, "°"))
        note(number / len(cases))
    error = worst(rows)
    found = fall()
    name = f"acceleration between three joints that overhang, friction {STEEP:g}°"
    rows.append(row(name, GRAVITY, found, "m/s²", relative=True))
    aims = [
        target("key block: error of the friction angle, degrees", 0.05, error),
        target(f"key block: blocks that do not hold {NEAR:g}° above the angle found, or do {NEAR:g}° below", 0, wrong),
        target("key block: error of the free fall, relative", 1e-3, abs(rows[-1]["error"])),
    ]
    return {"title": TITLE, "rows": rows, "targets": aims, "data": {"corners": corners(cases[0])}}
