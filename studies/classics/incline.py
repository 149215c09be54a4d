# SPDX-License-Identifier: MIT OR Apache-2.0
"""A block on an incline: does it stay, slide, topple, or slide and topple?

Hoek & Bray (1974) drew four regions in the plane of the slope angle and b/h. For a block that slides and topples at
once, they compared b/h with the slope. The balance of momentum, which Bray & Goodman (1981) and Sagaseta
(1986) wrote down, compares it with friction: a block that slides is turned over by friction alone.
"""

import numpy as np
from yade import O

from report import row, target
from block_scene import Scene, box_corners, place_of, tilted_gravity, turn_about_y

STAYS, SLIDES, TOPPLES, BOTH = "stays", "slides", "topples", "slides and topples"
TITLE = "a block on an incline"
MARGIN, NEAR = 0.2, 1.0  # degrees off the borders: all of the points; the nearest border of every second one
FRICTION = (20.0, 30.0, 40.0)  # degrees

RAMP = 60  # beats in which the plane is tilted
# Seen after so small a turn (radians) or slip (m) that angles are still those at rest to half of MARGIN; tilts of a
# block that rests are some 1e-6.
TURNED, SLID, TILTED = 1e-3, 0.02, 1e-4
PATIENCE = 1.2  # s for a block of 1 m


def region(slope, aspect, friction):
    """What a block does from rest; slope and friction in degrees, aspect = atan(b/h) in degrees.

    It topples if the reaction would have to leave the base: below the slope if it rests, below friction if it slides.
    Turning about its lower edge it needs the friction F/N of that motion, less than that of rest.
    """
    if min(slope, friction) <= aspect:
        return SLIDES if slope > friction else STAYS
    return BOTH if friction < _needed(slope, aspect) else TOPPLES


def _needed(slope, aspect):
    """Friction angle, degrees, with which a block that topples keeps its edge where it is."""
    a, d = np.radians(slope), np.radians(aspect)
    b, h = np.sin(d), np.cos(d)
    angular = 1.5 * (h * np.sin(a) - b * np.cos(a))  # acceleration times diagonal^2 / (g diagonal)
    along = np.sin(a) - 0.5 * h * angular
    across = np.cos(a) + 0.5 * b * angular
    return np.degrees(np.arctan2(along, across))


def region_of_hoek_and_bray(slope, aspect, friction):
    """The four regions of their chart."""
    topples = aspect < slope
    if slope > friction:
        return BOTH if topples else SLIDES
    return TOPPLES if topples else STAYS


def points(count, seed=1):
    """(slope, aspect, friction) at random, as many in each region, none within MARGIN of a border, half of them within
    NEAR.
    """
    random = np.random.default_rng(seed)
    found = {(name, near): [] for name in (STAYS, SLIDES, TOPPLES, BOTH) for near in (False, True)}
    each = {near: (count // 4 + near) // 2 for near in (False, True)}
    while any(len(some) < each[near] for (_, near), some in found.items()):
        point = random.uniform(2.0, 60.0), random.uniform(8.0, 70.0), float(random.choice(FRICTION))
        here = _around(*point, MARGIN)
        if len(here) > 1:
            continue
        near = len(_around(*point, NEAR)) > 1
        some = found[here.pop(), near]
        if len(some) < each[near]:
            some.append(point)
    return [point for some in found.values() for point in some]


def _around(slope, aspect, friction, angle):
    """The regions that are met within an angle of a point, along each of the three axes."""
    shifts = angle * np.vstack([np.zeros(3), np.eye(3), -np.eye(3)])
    return {region(slope + i, aspect + j, friction + k) for i, j, k in shifts}


def simulate(slope, aspect, friction):
    """What the block does in YADE: (region, turn in radians, slip of the base in m). It slides if friction is at its
    limit.
    """
    height, base = np.cos(np.radians(aspect)), np.sin(np.radians(aspect))
    scene = Scene(size=min(base, height), load=base * height * min(base, height))
    scene.block(box_corners(8.0, 2.0, 1.0), fixed=True, position=(0, 0, -0.5))
    block = scene.block(box_corners(base, min(base, height), height), position=(0, 0, 0.5 * height))
    edge = (0.5 * base - scene.rounding, 0.0, 0.0)
    scene.start(friction)
    scene.settle()
    # Slowly at the beginning and at the end, so that the springs do not swing.
    for part in np.linspace(0.0, 1.0, RAMP + 1)[1:]:
        scene.set_gravity(tilted_gravity(slope * part * part * (3.0 - 2.0 * part)))
        scene.run(scene.beat)
    until = O.time + PATIENCE
    while O.time < until:
        scene.run(5.0 * scene.beat)
        turn, slip = turn_about_y(block), place_of(block, edge)[0] - edge[0]
        if turn > TURNED or slip > SLID or scene.at_rest():
            break
    scene.check()
    topples, slides = turn > TILTED, _at_limit()
    name = BOTH if topples and slides else TOPPLES if topples else SLIDES if slides else STAYS
    return name, float(turn), float(slip)


def _at_limit():
    """Whether the shear force of the only contact is all that friction allows."""
    physics = next(one.phys for one in O.interactions if one.isReal)
    return physics.shearForce.norm() > (1.0 - 1e-6) * physics.tangensOfFrictionAngle * physics.normalForce.norm()


def run(note, short):
    """100 points, or 8."""
    places, looks = points(8 if short else 100), []
    for number, place in enumerate(places, 1):
        found, turn, slip = simulate(*place)
        looks.append({
            "slope": place[0], "aspect": place[1], "friction": place[2], "found": found, "turn": turn, "slip": slip,
            "region": region(*place), "hoek_and_bray": region_of_hoek_and_bray(*place),
        })  # fmt: skip
        note(number / len(places))
    right = sum(look["found"] == look["region"] for look in looks)
    charted = sum(look["found"] == look["hoek_and_bray"] for look in looks)
    rows = [
        row("points in their region, by the balance of momentum", len(looks), right),
        row("points in their region of Hoek & Bray's chart", len(looks), charted),
    ]
    aim = target(f"incline: points of {len(looks)} outside their region", 0, len(looks) - right)
    return {"title": TITLE, "rows": rows, "targets": [aim], "data": {"points": looks}}
