# SPDX-License-Identifier: MIT OR Apache-2.0
"""The least thickness of a semicircular arch that carries itself.

Milankovitch (1907): t/R = 0.1075, R the radius of the middle line; it falls with hinges at the springings, at the crown, and
between them at 54.5 degrees from the crown. (Heyman's 0.106 takes the weight along the middle line.) For so many stones,
hinges can form at their joints alone, and less thickness is enough: by the static theorem (Heyman 1966) the arch stands if
some line of thrust passes every joint within its thickness.
"""

import numpy as np
from scipy.optimize import linprog
from yade import O

from scene import ROUNDING, Scene, box_corners

MILANKOVITCH, HEYMAN = 0.1075, 0.106
HINGE = 54.5  # degrees
RADIUS = 1.0  # m
FRICTION = 60.0  # degrees: no joint slides
STONES = 40
BRACKET = 4e-4  # of t/R
MOVED = 0.01  # of the thickness: it falls
PATIENCE = 4.0  # s


def joints(stones):
    """Angles from the crown, radians, from springing to springing."""
    return np.linspace(-0.5 * np.pi, 0.5 * np.pi, stones + 1)


def outline(thickness, one, other):
    """Corners (4, 2), x and z, of a stone between two joints."""
    return np.array([
        (radius * np.sin(angle), radius * np.cos(angle))
        for angle, radii in ((one, (1, -1)), (other, (-1, 1)))
        for radius in (RADIUS + 0.5 * thickness * np.array(radii))
    ])  # fmt: skip


def least_thickness(stones, inset=0.0):
    """t/R of that many stones, hinges `inset` t inside the edges. Bisection over linear programs."""
    low, high = 0.0, 0.5
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if line_of_thrust(middle, stones, inset) is not None else (middle, high)
    return high


def line_of_thrust(thickness, stones, inset=0.0):
    """Where some line of thrust meets the joints, as parts of the thickness from the middle, outwards; None if there is none.

    Unknown: force (x, z) and moment about the origin at the left springing, and by how much of the thickness it stays inside.
    """
    angles = joints(stones)
    weights, moments = _weights(thickness, angles)
    rows, sides = [], []
    for angle, weight, moment in zip(angles, weights, moments):
        along, outward = np.array([np.cos(angle), -np.sin(angle)]), np.array([np.sin(angle), np.cos(angle)])
        # Force (X, Z - weight), moment M about the origin, counterclockwise, of what is left of the joint on what is right.
        # About a point p of the joint: M' = M - (p_x F_z - p_z F_x), and N = F . along; |M' at the middle| <= N t (1/2 - inset).
        middle = RADIUS * outward
        turn = np.array([middle[1], -middle[0], 1.0]), middle[0] * weight + moment
        normal = np.array([along[0], along[1], 0.0]), -along[1] * weight
        for sign in (1.0, -1.0):
            reach = (0.5 - inset) * thickness
            rows.append(sign * turn[0] - reach * normal[0])
            sides.append(-(sign * turn[1] - reach * normal[1]))
    found = linprog(np.zeros(3), A_ub=rows, b_ub=sides, bounds=[(None, None)] * 3, method="highs")
    return None if found.status == 2 else found.x


def _weights(thickness, angles):
    """Weights and their moments (x times weight) about the origin of all stones left of each joint."""
    weights, moments = [0.0], [0.0]
    for one, other in zip(angles[:-1], angles[1:]):
        area, centre = _area(outline(thickness, one, other))
        weights.append(weights[-1] + area)
        moments.append(moments[-1] - area * centre)
    return weights, moments


def _area(corners):
    """Area and the x of its centroid."""
    x, z = corners.T
    cross = x * np.roll(z, -1) - np.roll(x, -1) * z
    area = 0.5 * cross.sum()
    return abs(area), float(((x + np.roll(x, -1)) * cross).sum() / (6.0 * area))


if __name__ == "__main__":
    for n in (8, 10, 16, 20, 21, 30, 31, 40, 60, 100):
        print(n, least_thickness(n), least_thickness(n, 1e-3))


class Arch:
    """An arch of stones on two fixed blocks, in YADE."""

    def __init__(self, thickness, stones, rounding=ROUNDING, sphericity=0.0):
        self.thickness = thickness
        volume = 0.5 * np.pi * RADIUS * thickness**2
        self.scene = scene = Scene(size=thickness, load=volume, rounding=rounding, sphericity=sphericity)
        base = box_corners(4.0 * thickness, 4.0 * thickness, 2.0 * thickness)
        for side in (-1.0, 1.0):
            scene.block(base, fixed=True, position=(side * RADIUS, 0.0, -thickness))
        angles = joints(stones)
        self.stones = []
        for one, other in zip(angles[:-1], angles[1:]):
            section = outline(thickness * RADIUS, one, other)
            corners = [(x, y * thickness, z) for x, z in section for y in (-0.5, 0.5)]
            self.stones.append(scene.block(corners))
        scene.start(FRICTION)

    def moved(self):
        """The largest way of a centroid so far, thicknesses."""
        return max((one.state.pos - one.state.refPos).norm() for one in self.stones) / self.thickness

    def stands(self):
        """Whether it comes to rest before a stone has moved by MOVED."""
        while O.time < PATIENCE:
            self.scene.run(200.0 * self.scene.beat)
            if self.moved() > MOVED:
                self.scene.check()
                return False
            if self.scene.at_rest():
                break
        self.scene.check()
        return True
