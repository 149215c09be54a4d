# SPDX-License-Identifier: MIT OR Apache-2.0
"""A block slides down a plane: x(t) = g (sin a - cos a tan(friction)) t^2 / 2."""

import numpy as np
from yade import O

from report import row, target, worst
from block_scene import GRAVITY, Scene, box_corners, tilted_gravity

TITLE = "a block slides down a plane"
SLOPES = (25.0, 35.0, 40.0)  # degrees
FRICTION = 20.0
HOLDS = 60.0  # friction angle until time 0
LOOKS = 40


def acceleration(slope, friction):
    """Along the plane, m/s^2; degrees."""
    a, phi = np.radians(slope), np.radians(friction)
    return GRAVITY * (np.sin(a) - np.cos(a) * np.tan(phi))


def simulate(slope, friction):
    """Times (s) and ways (m) of a cube of 1 m from rest, to one length and a little more."""
    scene = Scene(size=1.0, load=1.0, moving=True)
    scene.block(box_corners(8.0, 2.0, 1.0), fixed=True, position=(0.0, 0.0, -0.5))
    block = scene.block(box_corners(1.0, 1.0, 1.0), position=(0.0, 0.0, 0.5))
    scene.start(HOLDS, gravity=tilted_gravity(slope))
    scene.settle()
    scene.set_friction(friction)
    begin, origin, looks = O.time, block.state.pos[0], [(0.0, 0.0)]
    last = np.sqrt(2.0 / acceleration(slope, friction))
    for _ in range(LOOKS):
        scene.run(last / (LOOKS - 1))
        looks.append((O.time - begin, block.state.pos[0] - origin))
    scene.check()
    return np.array(looks).T


def run(note, short):
    """Three slopes, or one."""
    rows, paths, slopes = [], [], SLOPES[1:2] if short else SLOPES
    for number, slope in enumerate(slopes, 1):
        time, way = simulate(slope, FRICTION)
        when = float(np.interp(1.0, way, time))
        closed = 0.5 * acceleration(slope, FRICTION) * when**2
        name = f"way at {slope:g}°, friction {FRICTION:g}°, when it has slid one length"
        rows.append(row(name, closed, 1.0, "m", relative=True))
        paths.append({"slope": slope, "time": time.tolist(), "way": way.tolist()})
        paths[-1]["acceleration"] = acceleration(slope, FRICTION)
        note(number / len(slopes))
    aim = target("sliding block: error of the way after one length, relative", 1e-3, worst(rows))
    return {"title": TITLE, "rows": rows, "targets": [aim], "data": {"paths": paths}}
