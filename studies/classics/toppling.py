# SPDX-License-Identifier: MIT OR Apache-2.0
"""A slope of 16 columns that topple on a stepped base, held by their toe: at which friction angle does it fail?

The example of Goodman & Bray (1976; Hoek & Bray 1974 and later editions; Wyllie & Mah 2004): columns of 10 m dip at 60
degrees into a slope of 56.6 degrees, 92.5 m high. Each column pushes the next with the force that keeps it from
toppling, or from sliding, about its base; at the limit no force is left below the lowest. Their solution: 38.15
degrees.
"""

import numpy as np
from scipy.optimize import brentq
from yade import O

from report import halved, row, target
from block_scene import GRAVITY, Scene, box_corners, tilted_gravity

TITLE = "a toppling slope of 16 columns"
COUNT, CREST = 16, 10
WIDTH = 10.0  # of a column, m
BASE = 30.0  # degrees: dip of the base of a column; the base as a whole is stepped by STEP, steeper
STEP = 1.0  # m
HELD = 43.0  # friction angle with which the columns come to rest at first, degrees
SEARCH = (36.0, HELD)  # degrees
BRACKET = 0.02  # degrees
MOVED = 10.0  # overlaps of points: it fails
PATIENCE = 5.0  # s; what rests does so after a tenth of that
BELOW, ABOVE = 5.0, 5.0  # by how much tops step down towards the toe, and down behind the crest, m


def heights():
    """y_n of columns 1 (the toe) to 16, m."""
    below = [(BELOW - STEP) * n for n in range(1, CREST + 1)]
    above = [below[-1] - (ABOVE + STEP) * n for n in range(1, COUNT - CREST + 1)]
    return np.array(below + above)


def levers(n, y):
    """(M_n, L_n): heights above the base of column n at which the column above pushes it and at which it pushes the one
    below, m.
    """
    if n < CREST:
        return y, y - BELOW
    return y - ABOVE, (y - BELOW if n == CREST else y)


def forces(friction):
    """Force (per unit weight of rock, m^2) of each column 16..1 on the next below, and how it fails; degrees.

    The last, P_0, is the force by which the toe would have to be held: 0 at the limit.
    """
    a, t = np.radians(BASE), np.tan(np.radians(friction))
    pushes, modes, push = [], [], 0.0
    for n in range(COUNT, 0, -1):
        y = heights()[n - 1]
        upper, lower = levers(n, y)
        weight = WIDTH * y
        slides = push - weight * (t * np.cos(a) - np.sin(a)) / (1.0 - t * t)
        topples = -np.inf
        if lower > 0.0:
            topples = (push * (upper - WIDTH * t) + 0.5 * weight * (y * np.sin(a) - WIDTH * np.cos(a))) / lower
        push = max(slides, topples, 0.0)
        modes.append("stable" if push == 0.0 else "topples" if topples > slides else "slides")
        pushes.append(push if push > 0.0 or n > 1 else max(slides, topples))
    return np.array(pushes), modes


def limit():
    """Friction angle of limit equilibrium, degrees."""
    return float(brentq(lambda friction: forces(friction)[0][-1], 20.0, 44.0, xtol=1e-12))


class Slope:
    """The columns in YADE, at rest with friction HELD. The base is level here, and gravity is tilted."""

    def __init__(self, held):
        y = heights()
        self.scene = scene = Scene(size=y.min(), load=WIDTH**2 * y.max())
        self.columns = []
        for n in range(1, COUNT + 1):
            # Column n, on its own step of the base, touches its neighbours and that step alone.
            place = np.array([-(n - 0.5) * WIDTH, 0.0, n * STEP])
            step = box_corners(WIDTH, 2.0 * WIDTH, 0.5 * WIDTH)
            scene.block(step, fixed=True, position=place - (0, 0, 0.25 * WIDTH), mask=1 << n)
            column = box_corners(WIDTH, WIDTH, y[n - 1])
            self.columns.append(scene.block(column, position=place + (0, 0, 0.5 * y[n - 1]), mask=1 | 1 << n))
        scene.start(held, gravity=tilted_gravity(BASE))
        self.rested = scene.settle()
        self.places = [np.array(one.state.pos) for one in self.columns]

    def moved(self):
        """The largest way of a centroid since friction was lowered, m."""
        return max(np.linalg.norm(one.state.pos - place) for one, place in zip(self.columns, self.places))

    def holds(self, friction):
        """Whether the columns come to rest again after friction was lowered, degrees, before one has moved by MOVED,
        and within PATIENCE.
        """
        self.scene.set_friction(friction)
        return self.scene.comes_to_rest(PATIENCE, every=50.0,
                                        fails=lambda: self.moved() > MOVED * self.scene.motion_unit)

    def pushes(self):
        """Normal force between columns n and n - 1, n = 16..2, per unit weight of rock, m^2."""
        found = {}
        for one in O.interactions:
            if one.isReal:
                found[frozenset((one.id1, one.id2))] = one.phys.normalForce.norm()
        ids = [one.id for one in self.columns]
        unit = WIDTH * self.columns[0].mat.density * GRAVITY
        return np.array([found.get(frozenset(ids[n - 1:n + 1]), 0.0) / unit for n in range(COUNT - 1, 0, -1)])


def critical_angle(bracket=BRACKET, look=lambda part: None):
    """Largest friction angle at which it fails and smallest at which it holds, degrees, and the pushes there."""
    found = []

    def holds(friction):
        slope = Slope(HELD)
        if is_held := slope.holds(friction):
            found.append(slope.pushes())
        return is_held

    return *halved(*SEARCH, bracket, holds, look), found[-1]


def run(note, short):
    """The bracket; or a wide one."""
    closed = limit()
    low, high, pushes = critical_angle(0.5 if short else BRACKET, note)
    found = 0.5 * (low + high)
    expected, modes = forces(closed)
    largest = int(np.argmax(expected))
    heaviest = WIDTH * heights().max()
    name = "largest push between two columns over the largest weight"
    rows = [
        row("friction angle of limit equilibrium", closed, found, "°"),
        row(name, float(expected[largest] / heaviest), float(pushes[largest] / heaviest), relative=True),
    ]
    rows[0]["bracket"] = high - low
    aim = target("Goodman & Bray: error of the friction angle, degrees", 0.3, abs(rows[0]["error"]))
    data = {"pushes": pushes.tolist(), "expected": expected.tolist(), "modes": modes, "heights": heights().tolist()}
    return {"title": TITLE, "rows": rows, "targets": [aim], "data": data}
