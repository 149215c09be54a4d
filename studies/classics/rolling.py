# SPDX-License-Identifier: MIT OR Apache-2.0
"""A cylinder of n planes rolls down an incline; a round one has the acceleration 2/3 g sin a.

A prism of n sides goes from side to side, and each new side that it lands on costs it a part of its velocity, the
smaller the more
there are: its angular momentum about the new edge is kept, that about its axis is not.
"""

import numpy as np
import yade
from potential_particles import fitting, shapes
from yade import O

from report import row, target
from block_scene import GRAVITY, ROUNDING, Scene, box_corners, tilted_gravity

TITLE = "a cylinder of n planes rolls down an incline"
SLOPE, FRICTION = 20.0, 40.0  # degrees
RADIUS, WIDTH = 0.5, 1.0  # m
SIDES = (12, 24, 48, 96, 192, 384)
WAY = np.pi  # m, one turn
LOOKS = 60


def acceleration(slope):
    """Of a round cylinder, m/s^2."""
    return 2.0 / 3.0 * GRAVITY * np.sin(np.radians(slope))


def simulate(sides, slope=SLOPE, way=WAY):
    """Time (s) and way (m) down the plane from rest."""
    scene = Scene(size=2.0 * RADIUS, load=np.pi * RADIUS**2 * WIDTH, moving=True)
    scene.block(box_corners(16.0, 4.0, 1.0), fixed=True, position=(0.0, 0.0, -0.5))
    shape = shapes.cylinder(RADIUS, WIDTH, sides, rounding=ROUNDING, k=0.0)
    # On a side, its axis along y.
    height = float(fitting.radii(shape.planes, shape.r, shape.k, shape.R, np.array([(1.0, 0.0, 0.0)]))[0])
    turn = yade.Quaternion((1, 0, 0), 0.5 * np.pi)
    roller = scene.add(shape, orientation=turn, position=(-3.0, 0.0, height))
    scene.start(FRICTION, gravity=tilted_gravity(slope))
    origin, looks = roller.state.pos[0], [(0.0, 0.0)]
    step = np.sqrt(2.0 * way / acceleration(slope)) / LOOKS
    while looks[-1][1] < way and O.time < 200.0 * step:
        scene.run(step)
        looks.append((O.time, roller.state.pos[0] - origin))
    scene.check()
    return np.array(looks).T


def run(note, short):
    """Six numbers of sides, or two."""
    rows, paths, numbers = [], [], SIDES[1:4] if short else SIDES
    for number, sides in enumerate(numbers, 1):
        time, way = simulate(sides)
        found = 2.0 * WAY / float(np.interp(WAY, way, time)) ** 2
        name = f"mean acceleration over one turn, n = {sides}"
        rows.append(row(name, acceleration(SLOPE), found, "m/s²", relative=True))
        paths.append({"sides": sides, "time": time.tolist(), "way": way.tolist()})
        note(number / len(numbers))
    errors = [abs(one["error"]) for one in rows]
    # Of prisms whose sides are more than their rounding: the others are as good as round.
    edged = [error for error, n in zip(errors, numbers) if 1.0 - np.cos(np.pi / n) > 2.0 * ROUNDING]
    growth = max((later / earlier for earlier, later in zip(edged, edged[1:])), default=0.0)
    aims = [
        target("rolling: error with n over that with the n before, while sides are above r, largest", 1.0, growth),
        target("rolling: error of the acceleration of the others, relative, largest", 1e-3, max(errors[len(edged):])),
    ]
    return {"title": TITLE, "rows": rows, "targets": aims, "data": {"paths": paths}}
