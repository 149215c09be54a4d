# SPDX-License-Identifier: GPL-3.0-or-later
# One law of joints however a boundary is cut: restitution, spin, energy, and what other bodies side by side change.
import math

import numpy as np
import potential_particles
import yade
from tiles import *

check = Checks()


def rebound(kind, restitution, step=0.01, turn=Quaternion.Identity, loop=yade.ConicInteractionLoop, shape=None,
            lower=0.0, own=Quaternion.Identity, place=(0, 0)):
    """Speed after over speed before of a block that lands; step: times the circular frequency of the block on its
    springs.
    """
    scene(loop, restitution=restitution)
    floor(kind, turn)
    body = block(1e-6 - lower, turn, place, shape)
    body.state.ori = turn * own
    up = turn * Vector3(0, 0, 1)
    body.state.vel = -0.1 * up
    O.dt = step / math.sqrt(STIFFNESS * (2 * (HALF - RADIUS))**2 / body.state.mass)
    while (body.state.vel.dot(up) < 0 or O.interactions.countReal()) and O.iter < 40 / step:
        run(20)
    return body.state.vel.dot(up) / 0.1


# --- a block that lands flat ------------------------------------------------------------------------------------------

FLOORS = {"wall": "wall", "box": "box", "2 triangles": grid(1), "8 triangles": fan(8), "200 triangles": grid(10),
          "4 blocks": 2, "9 blocks": 3}
for name, kind in FLOORS.items():
    check.close(rebound(kind, 0.5), 0.5, 0.005, f"restitution 0.5 on {name}")
for name in ("8 triangles", "4 blocks"):
    check.close(rebound(FLOORS[name], 0.05, step=0.003), 0.05, 5e-4, f"restitution 0.05 on {name}")
    check.close(rebound(FLOORS[name], 0.95), 0.95, 5e-3, f"restitution 0.95 on {name}")
tilt = turned((1, 2, 0.5), 0.9)
for name in ("box", "8 triangles", "9 blocks"):
    check.close(rebound(FLOORS[name], 0.3, turn=tilt), 0.3, 0.003, f"restitution 0.3 on {name}, tilted")
check.close(rebound(grid(3), 0.5, loop=yade.InteractionLoop), rebound(grid(3), 0.5), 1e-9, "YADE's own loop")

# --- a rounded corner on a seam: the area grows with the overlap -------------------------------------------------

corner = Quaternion(Vector3(1, -1, 0).normalized(), math.atan(math.sqrt(2)))
ball = cube(r=0.45, k=0.0, half=0.5)
lower = 0.5 - (0.05 * math.sqrt(3) + 0.45)
whole = rebound(grid(1, 4.0), 0.5, shape=ball, lower=lower, own=corner, place=(0.5, -0.5), step=0.005)
for name, kind in (("a seam", grid(1, 4.0)), ("a vertex of six", grid(2, 4.0)), ("many", grid(9, 0.3))):
    found = rebound(kind, 0.5, shape=ball, lower=lower, own=corner, step=0.005)
    check.close(found, whole, 0.01 * whole, f"a rounded corner on {name}")

# --- Housner's impact is that of the whole face ---------------------------------------------------------------------


def rocked(kind):
    scene(restitution=0.1, frictionAngle=0.0)  # springs along a tile begin when it is touched
    floor(kind)
    body = block(-1e-9, radius=1e-4)
    body.state.vel, body.state.angVel = Vector3(0.005, 0, -0.005), Vector3(0, 0.01, 0)
    body.state.angMom = Vector3(0, 0.01 * body.state.inertia[1], 0)
    O.dt = 1e-5
    run(2000)
    return body.state.vel[0], body.state.vel[2], body.state.angVel[1]


on_wall = Vector3(*rocked("wall"))
for name, kind in (("8 triangles", fan(8)), ("72 triangles", grid(6)), ("9 blocks", 3)):
    check.close(Vector3(*rocked(kind)), on_wall, 0.01 * on_wall.norm(), f"a block that rocks on {name}")

# --- a spin is braked by mu N times the mean distance from its centre -----------------------------------------------


def brake(kind, place=(0, 0)):
    scene()
    floor(kind)
    body = block(-1e-5, place=place, radius=1e-3)
    body.state.blockedDOFs, body.state.angVel = "xyzXYZ", Vector3(0, 0, 1)
    O.dt = 1e-5
    run(2000)
    return -O.forces.t(body.id)[2] / (0.5 * O.forces.f(body.id)[2] * 0.998 * 0.382598)


def points_of(spots):
    """The 16 points of the law for a tile that these fill: on two ellipses with its second moments, at its mean
    distance from its centre.
    """
    middle = spots.mean(axis=0)
    values, axes = np.linalg.eigh((spots - middle).T @ (spots - middle) / len(spots))
    angles = np.radians(22.5 + 45 * np.arange(8))
    ring = np.sqrt(values) * np.column_stack([np.cos(angles), np.sin(angles)]) @ axes.T
    ring *= np.hypot(*(spots - middle).T).mean() / np.hypot(*ring.T).mean()
    off = math.sqrt(max(0.0, values.sum() / (ring**2).sum(axis=1).mean() - 1))
    return np.vstack([middle + (1 + sign * off) * ring for sign in (1, -1)])


def of_the_law(tiles, place):
    """What friction at the points of all tiles does, over what it does spread over the face."""
    # So many spots along the two sides that none is on the edge of a tile.
    u, v = np.meshgrid(*((np.arange(number) + 0.5) / number - 0.5 for number in (300, 302)))
    face = 0.998 * np.column_stack([u.ravel(), v.ravel()]) + place
    total = 0.0
    for tile in tiles:
        a, b, c = (np.array(corner) for corner in tile)
        left = lambda p, q: (q[0] - p[0]) * (face[:, 1] - p[1]) > (q[1] - p[1]) * (face[:, 0] - p[0])
        spots = face[left(a, b) & left(b, c) & left(c, a)]
        if len(spots):
            total += len(spots) * np.hypot(*(points_of(spots) - place).T).mean()
    return total / len(face) / (0.998 * 0.382598)


# Points with its moments are not a triangle about whose corner the body turns: 1.5 and 2.1 % on 2 and 4 of them.
for name, kind, allowed in (("a wall", "wall", 0), ("2 triangles", grid(1), 0.022), ("4 triangles", fan(4), 0.022),
                            ("8 triangles", fan(8), 0.01), ("200 triangles", grid(10), 0.002)):
    for place in ((0, 0), (0.05, 0.02)):
        expected = 1.0 if kind == "wall" else of_the_law(kind, np.array(place))
        check.close(expected, 1.0, allowed, f"friction at points of {name} at {place}")
        check.close(brake(kind, place), expected, 2e-3, f"a spin on {name} at {place}")
check.close(brake(2), 1.0, 0.01, "a spin on 4 blocks")

# --- other bodies beside it, of other materials -----------------------------------------------------------------

# On blocks of different stiffness and restitution each damps by its own, and none pulls: a mass on springs with
# dashpots side by side.
def ratio_of(restitution):
    """Of a dashpot to the critical one, below 1."""
    low, high = 0.0, 1.0
    for _ in range(60):
        z = 0.5 * (low + high)
        w = math.sqrt(1 - z * z)
        left = math.exp(-z / w * math.atan2(2 * z * w, 2 * z * z - 1))
        low, high = (z, high) if left > restitution else (low, z)
    return z


def left_by(springs):
    """Speed after over speed before of a unit mass; springs: pairs of stiffness and ratio."""
    frequency = math.sqrt(sum(stiffness for stiffness, _ in springs))
    depth, speed, step = 0.0, 1.0, 1e-4 / frequency
    while depth > 0 or speed > 0:
        speed -= step * sum(max(0.0, k * (depth + 2 * z / frequency * speed)) for k, z in springs)
        depth += step * speed
    return -speed


for first, second in ((0.9, 0.3), (0.3, 0.3), (0.95, 0.2)):
    scene(restitution=1.0)
    floor(2)
    body = block(1e-6)
    for number, of in enumerate((first, second, second, first)):
        O.bodies[number].mat = yade.ConicJointMat(normalStiffness=(1 if number in (0, 3) else 4) * STIFFNESS,
                                                  shearStiffness=STIFFNESS, frictionAngle=0.0, restitution=of)
    body.state.blockedDOFs, body.state.vel = "xyXYZ", Vector3(0, 0, -0.01)
    O.dt = 0.003 / math.sqrt(STIFFNESS / body.state.mass)
    while (body.state.vel[2] < 0 or O.interactions.countReal()) and O.iter < 10000:
        run(20)
    # Harmonic means with the block's own stiffness: 1 and 1.6 times that.
    expected = left_by([(1.0, ratio_of(first)), (1.6, ratio_of(second))])
    check.close(body.state.vel[2] / 0.01, expected, 0.01 * expected, f"on blocks of {first} and {second}")

# A block between two walls swings on both: its dashpots are those of that motion.
scene(restitution=0.5)
O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1))
body = block(-1e-4)
O.bodies.append(utils.wall((0, 0, 2 * HALF - 2e-4), axis=2, sense=-1))
for one in O.bodies:
    one.state.blockedDOFs = one.state.blockedDOFs or "xyXYZ"
O.dt = 1e-5
run(2)
check.equal(O.interactions.countReal(), 2, "between two walls")
check.close(O.forces.f(body.id), Vector3.Zero, 1e-3 * STIFFNESS * 1e-4, "at rest")

# --- a run goes on from a save as without, and in periodic cells ----------------------------------------------------


def landed(saved, periodic=False):
    scene(restitution=0.2, periodic=periodic)
    if periodic:
        O.cell.setBox(6, 6, 6)
    floor([[(x + 0.1, y + 0.1) for x, y in one] for one in grid(4)])
    body = block(1e-4, turned((1, 2, 0), 0.01), (0.1, 0.1))
    body.state.vel = Vector3(0.05, 0, -0.3)
    O.dt = 2e-5
    run(100)
    if saved:
        O.saveTmp("tiles")
        O.loadTmp("tiles")
        potential_particles.prepare()
    run(300)
    return state_numbers()


straight = landed(False)
check.true(max(abs(a - b) for a, b in zip(landed(True), straight)) < 1e-6, "from a save")
check.true(max(abs(a - b) for a, b in zip(landed(False, True), straight)) < 1e-9, "in a periodic cell")

check.finish()
