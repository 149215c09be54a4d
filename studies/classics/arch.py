# SPDX-License-Identifier: MIT OR Apache-2.0
"""The least thickness of a semicircular arch that carries itself.

Milankovitch (1907): t/R = 0.1075, R the radius of the middle line; it falls with hinges at the springings, at the
crown, and between them at 54.5 degrees from the crown. (Heyman's 0.106 takes the weight along the middle line.) For so
many stones,
hinges can form at their joints alone, and less thickness is enough: by the static theorem (Heyman 1966) the arch stands
if some line of thrust passes every joint within its thickness.
"""

import numpy as np
from scipy.optimize import linprog
from yade import O

from report import halved, row, target, worst
from block_scene import ROUNDING, Scene, box_corners, place_of

TITLE = "a semicircular arch"
MILANKOVITCH = 0.1075
HINGE = 54.5  # degrees
RADIUS = 1.0  # m
FRICTION = 60.0  # degrees: no joint slides
STONES = 20
SEARCH = (0.09, 0.13)  # t/R
BRACKET = 4e-4  # of t/R
# Stones, r over t, k: each row changes one thing.
VARIED = (
    (10, ROUNDING, 0.0), (40, ROUNDING, 0.0), (20, 1e-2, 0.0), (20, 3e-2, 0.0),
    (20, ROUNDING, 0.01), (20, ROUNDING, 0.1), (20, 1e-2, 0.1),
)  # fmt: skip
BULGES = 1e-4  # k r over t: above that stones are no trapezia any more
MOVED = 100.0  # overlaps of points: it falls; an arch that stands settles by some 0.6 of them a stone
PATIENCE = 1.5  # s; what stands rests after a tenth of that


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
    return halved(0.0, 0.5, 0.5 / 2**40, lambda thickness: line_of_thrust(thickness, stones, inset) is not None)[1]


def line_of_thrust(thickness, stones, inset=0.0):
    """Force (x, z) and moment about the origin at the left springing, with which some line of thrust passes every joint
    within its thickness, `inset` t inside the edges; None if there is none. The density is 1, the width too.
    """
    rows, sides = [], []
    for normal, turn in _resultants(thickness, stones):
        for sign in (1.0, -1.0):
            reach = (0.5 - inset) * thickness
            rows.append(sign * turn[0] - reach * normal[0])
            sides.append(reach * normal[1] - sign * turn[1])
    found = linprog(np.zeros(3), A_ub=rows, b_ub=sides, bounds=[(None, None)] * 3, method="highs")
    return None if found.status == 2 else found.x


def eccentricities(thickness, stones, reaction):
    """Where the line of thrust meets each joint: from its middle outwards, as part of the thickness."""
    return np.array([
        -(turn[0] @ reaction + turn[1]) / (normal[0] @ reaction + normal[1]) / thickness
        for normal, turn in _resultants(thickness, stones)
    ])  # fmt: skip


def _resultants(thickness, stones):
    """Of each joint its normal force and its moment about the middle of the joint, counterclockwise, on what is right
    of it: both as (coefficients of the reaction at the left springing, constant).
    """
    angles = joints(stones)
    weights, moments = _weights(thickness, angles)
    for angle, weight, moment in zip(angles, weights, moments):
        along, outward = np.array([np.cos(angle), -np.sin(angle)]), np.array([np.sin(angle), np.cos(angle)])
        # What is left of the joint passes on F = (X, Z - weight), and M about the origin; about p it is M - (p_x F_z -
        # p_z F_x).
        middle = RADIUS * outward
        turn = np.array([middle[1], -middle[0], 1.0]), middle[0] * weight + moment
        normal = np.array([along[0], along[1], 0.0]), -along[1] * weight
        yield normal, turn


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
        """The largest way of a centroid so far, overlaps of points."""
        return max((one.state.pos - one.state.refPos).norm() for one in self.stones) / self.scene.motion_unit

    def stands(self):
        """Whether it comes to rest before a stone has moved by MOVED, and within PATIENCE."""
        return self.scene.comes_to_rest(PATIENCE, every=100.0, fails=lambda: self.moved() > MOVED)

    def thrust(self):
        """Where the contact point of each joint is: from its middle outwards, as part of the thickness."""
        ends = {}
        for one in O.interactions:
            if one.isReal:
                x, _, z = one.geom.contactPoint
                angle = round(float(np.degrees(np.arctan2(x, z))), 2)
                ends[angle] = (np.hypot(x, z) - RADIUS) / self.thickness
        return sorted(ends.items())

    def outlines(self):
        """The stones where they are now, each as corners (x, z)."""
        drawn = []
        for one, (start, end) in zip(self.stones, zip(joints(len(self.stones))[:-1], joints(len(self.stones))[1:])):
            section = outline(self.thickness, start, end)
            drawn.append([place_of(one, (x, 0.0, z))[::2].tolist() for x, z in section])
        return drawn


def run(note, short):
    """The arch of STONES, and others with other stones, r and k; or one of ten stones."""
    cases = [(10, ROUNDING, 0.0)] if short else [(STONES, ROUNDING, 0.0), *VARIED]
    bracket = 2e-3 if short else BRACKET
    costs = np.cumsum([0.0, *(case[0] ** 2 for case in cases)])
    rows, flat = [], []
    for number, (stones, rounding, sphericity) in enumerate(cases):
        here, cost = costs[number], costs[number + 1] - costs[number]
        # The largest t/R that falls, and the smallest that stands.
        low, high = halved(*SEARCH, bracket, lambda thickness: Arch(thickness, stones, rounding, sphericity).stands(),
                           lambda part: note((here + part * cost) / costs[-1]))
        name = f"least t/R, {stones} stones, r = {rounding:g} t, k = {sphericity:g}"
        rows.append(row(name, least_thickness(stones, rounding), 0.5 * (low + high)))
        rows[-1]["bracket"] = high - low
        flat.append(sphericity * rounding <= BULGES)
        if number == 0:
            data = _picture(high, low, stones)
    angles, offsets = np.array(data["thrust"]).T
    hinge = float(np.abs(angles)[np.argmin(offsets)])
    least = rows[0]["found"]
    rows += [
        row(f"least t/R, {cases[0][0]} stones, against Milankovitch", MILANKOVITCH, least),
        row("hinge at the intrados, from the crown", HINGE, hinge, "°"),
    ]
    named = "arch: error of t/R against that of so many stones, hinges r inside the edges"
    aims = [target(named, 1e-3, worst([one for one, good in zip(rows, flat) if good]))]
    if not short:
        spacing = 180.0 / STONES
        aims += [
            target(f"{named}, k r above {BULGES:g} t", 1e-3, worst([one for one, good in zip(rows, flat) if not good])),
            target("arch: error of t/R against Milankovitch", 1e-3, abs(rows[-2]["error"])),
            target("arch: hinge against 54.5 degrees, in joints", 0.5, abs(rows[-1]["error"]) / spacing),
        ]
    return {"title": TITLE, "rows": rows, "targets": aims, "data": data}


def _picture(stands, falls, stones):
    """The arch at rest with its line of thrust, and one that is falling."""
    arch = Arch(stands, stones)
    arch.stands()
    data = {"thrust": arch.thrust(), "rest": arch.outlines(), "thickness": stands}
    least = least_thickness(stones, ROUNDING)
    line = eccentricities(least, stones, line_of_thrust(least, stones, ROUNDING))
    data["line"] = [np.degrees(joints(stones)).tolist(), line.tolist()]
    arch = Arch(0.9 * falls, stones)
    while arch.moved() * arch.scene.motion_unit < 1.5 * arch.thickness and O.time < 2.0 * PATIENCE:
        arch.scene.run(0.02)
    data["fallen"] = arch.outlines()
    return data
