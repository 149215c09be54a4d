# SPDX-License-Identifier: MIT OR Apache-2.0
"""A cylinder of n planes rolls down an incline; a round one has the acceleration 2/3 g sin a.

A prism of n sides goes from side to side. Where it does not bounce, each new side costs it a part of its velocity: its angular
momentum about the new edge is kept, I = I_c + m R^2, so that the angular velocity is (I_c + m R^2 cos e)/I times that before,
e = 2 pi/n.
"""

import numpy as np
import yade
from potential_particles import shapes
from yade import O

from rocking import Dashpots
from scene import GRAVITY, ROUNDING, box_corners, tilted_gravity

SLOPE, FRICTION = 20.0, 40.0  # degrees
RADIUS, WIDTH = 0.5, 1.0  # m
SIDES = (12, 24, 48, 96, 192, 384)
WAY = np.pi  # m, one turn
LOOKS = 60


def acceleration(slope):
    """Of a round cylinder, m/s^2."""
    return 2.0 / 3.0 * GRAVITY * np.sin(np.radians(slope))


def time_of_prism(sides, slope, way):
    """Time (s) from rest, standing on an edge, over a way (m) by the closed form of one side after the other."""
    e, a = 2.0 * np.pi / sides, np.radians(slope)
    half = np.sin(0.5 * e)  # half a side over the radius R of the corners
    corner = np.sqrt(2.0 * np.pi / (sides * np.sin(e))) * RADIUS
    # m R^2 and I_c over m R^2, of a regular polygon.
    about_centre = 0.5 * (1.0 - 2.0 / 3.0 * half**2)
    about_edge = about_centre + 1.0
    kept = (about_centre + np.cos(e)) / about_edge
    pull = GRAVITY / (corner * about_edge)
    # theta is the direction from the edge to the centre, from the normal of the plane, downhill; it grows from -e/2 to e/2.
    omega, theta, time, gone = 0.0, 0.0, 0.0, 0.0
    while gone < way:
        nodes = np.linspace(0.0, 1.0, 801) ** 2 if omega == 0.0 else np.linspace(0.0, 1.0, 801)
        angles = theta + (0.5 * e - theta) * nodes
        squares = omega**2 + 2.0 * pull * (np.cos(a + theta) - np.cos(a + angles))
        speeds = np.sqrt(np.maximum(squares, 0.0))
        time += float(np.sum(np.diff(angles) * 2.0 / (speeds[1:] + speeds[:-1])))
        gone += 2.0 * half * corner * (0.5 * e - theta) / e
        omega, theta = kept * speeds[-1], -0.5 * e
    return time, gone


def simulate(sides, slope=SLOPE, way=WAY):
    """Time (s) and way (m) down the plane from rest."""
    scene = Dashpots(size=2.0 * RADIUS, load=np.pi * RADIUS**2 * WIDTH)
    scene.block(box_corners(16.0, 4.0, 1.0), fixed=True, position=(0.0, 0.0, -0.5))
    shape = shapes.cylinder(RADIUS, WIDTH, sides, r=ROUNDING, k=0.0)
    # On an edge, its axis along y.
    corner = RADIUS * np.sqrt(2.0 * np.pi / (sides * np.sin(2.0 * np.pi / sides)))
    turn = yade.Quaternion((0, 1, 0), np.pi / sides) * yade.Quaternion((1, 0, 0), 0.5 * np.pi)
    turn = yade.Quaternion((0, 1, 0), 0.0 if sides % 4 else np.pi / sides) * yade.Quaternion((1, 0, 0), 0.5 * np.pi)
    roller = scene.add(shape, orientation=(turn[3], turn[0], turn[1], turn[2]), position=(-3.0, 0.0, corner))
    scene.start(FRICTION, damping=0.0, gravity=tilted_gravity(slope))
    origin, looks = roller.state.pos[0], [(0.0, 0.0)]
    step = np.sqrt(2.0 * way / acceleration(slope)) / LOOKS
    while looks[-1][1] < way and O.time < 200.0 * step:
        scene.run(step)
        looks.append((O.time, roller.state.pos[0] - origin))
    scene.check()
    return np.array(looks).T
