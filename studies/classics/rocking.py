# SPDX-License-Identifier: MIT OR Apache-2.0
"""A column rocks freely from edge to edge (Housner 1963).

About its edge it is a pendulum turned over: theta'' = -p^2 sin(a - theta), p^2 = 3 g / (4 R), R half the diagonal, a =
atan(b/h). From rest at theta0 it is upright again after a quarter period. If it neither bounces nor slides when it
lands on the other edge, its angular momentum about that edge is kept, and the angular velocity after is 1 - 1.5 sin^2 a
times that before.
"""

import numpy as np
from yade import O, Quaternion, Vector3

from report import row, target, worst
from block_scene import GRAVITY, Scene, box_corners, turn_about_y

TITLE = "a column rocks on its base"
BASE, HEIGHT = 1.0, 4.0  # m
TILTS = (0.2, 0.4, 0.6, 0.8)  # theta0 over a
FRICTION = 45.0  # degrees


def slenderness():
    """a, radians."""
    return np.arctan2(BASE, HEIGHT)


def pace():
    """p, 1/s."""
    return np.sqrt(0.75 * GRAVITY / np.hypot(0.5 * BASE, 0.5 * HEIGHT))


def quarter_period(tilt):
    """s, from rest at theta0 = tilt a; the integral of dtheta / theta' without linearising.

    With a - theta = y, y from a - theta0 = c to a: theta'^2 / 2 = p^2 (cos c - cos y). y = c + s^2 takes the pole away.
    """
    a = slenderness()
    c = a * (1.0 - tilt)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    s = 0.5 * np.sqrt(a - c) * (nodes + 1.0)
    # cos c - cos(c + s^2) = 2 sin(c + s^2/2) sin(s^2/2)
    speed = np.sqrt(4.0 * np.sin(c + 0.5 * s * s) * np.sin(0.5 * s * s))
    return float(0.5 * np.sqrt(a - c) * np.sum(weights * 2.0 * s / speed) / pace())


def housner_ratio():
    """Of the angular velocities after and before an impact."""
    return 1.0 - 1.5 * np.sin(slenderness()) ** 2


def simulate(tilt, after):
    """Looks (n, 2): time (s), turn (radians), from rest at theta0 = tilt a until `after` s after the first impact."""
    scene = Scene(size=BASE, load=BASE * BASE * HEIGHT, moving=True)
    scene.block(box_corners(8.0, 4.0, 1.0), fixed=True, position=(0, 0, -0.5))
    block = scene.block(box_corners(BASE, BASE, HEIGHT), position=(0, 0, 0.5 * HEIGHT))
    turn = tilt * slenderness()
    # On its right edge; what is turned by theta about y falls towards +x.
    edge = np.array([0.5 * BASE, 0.0, 0.0])
    arm = np.array([-0.5 * BASE, 0.0, 0.5 * HEIGHT])
    c, s = np.cos(turn), np.sin(turn)
    place = edge + np.array([c * arm[0] + s * arm[2], 0.0, -s * arm[0] + c * arm[2]])
    block.state.pos = Vector3(*map(float, place))
    block.state.ori = Quaternion((0, 1, 0), float(turn))
    scene.start(FRICTION)
    looks, end = [(0.0, turn)], np.inf
    while O.time < end:
        scene.run(2.0 * scene.beat)
        looks.append((O.time, turn_about_y(block)))
        if looks[-1][1] < 0.0 and end == np.inf:
            end = O.time + after
    scene.check()
    return np.array(looks)


def first_upright(looks):
    """Time at which the turn is 0 first, s, between two looks."""
    i = int(np.argmax(looks[:, 1] <= 0.0))
    (t0, a0), (t1, a1) = looks[i - 1], looks[i]
    return t0 + (t1 - t0) * a0 / (a0 - a1)


def kept_at_first_impact(looks, tilt):
    """Angular velocity after the first impact over that before, from how far the column turns afterwards: energy is
    kept then.
    """
    first = int(np.argmax(looks[:, 1] <= 0.0))
    a, highest = slenderness(), float(-looks[first:, 1].min())
    return float(np.sqrt((np.cos(a - highest) - np.cos(a)) / (np.cos(a * (1.0 - tilt)) - np.cos(a))))


def run(note, short):
    """Four tilts, or one."""
    periods, losses, paths, tilts = [], [], [], TILTS[1:2] if short else TILTS
    for number, tilt in enumerate(tilts, 1):
        quarter = quarter_period(tilt)
        looks = simulate(tilt, quarter)
        found = first_upright(looks)
        periods.append(row(f"quarter period from {tilt:g} of the largest tilt", quarter, found, "s", relative=True))
        ratio = kept_at_first_impact(looks, tilt)
        losses.append(row(f"angular velocity kept at the impact, from {tilt:g}", housner_ratio(), ratio, relative=True))
        time, turn = looks[::10].T.tolist()
        paths.append({"tilt": tilt, "time": time, "turn": turn, "quarter": quarter})
        note(number / len(tilts))
    aims = [
        target("rocking: error of the quarter period, relative", 1e-2, worst(periods)),
        target("rocking: error of what is kept at an impact, relative", 1e-2, worst(losses)),
    ]
    data = {"paths": paths, "slenderness": slenderness()}
    return {"title": TITLE, "rows": periods + losses, "targets": aims, "data": data}
