# SPDX-License-Identifier: MIT OR Apache-2.0
"""Where one contact point is not enough: a block spins on its base, and friction should stop it.

With an even pressure on a square base of side a the moment of friction about the middle is mu W a c,
c = (sqrt 2 + ln(1 + sqrt 2))/6 = 0.3826, so that a block of the moment of inertia m a^2/6 loses 6 c mu g/a of its
angular velocity in a second. One point in the middle has no lever. Measured beside it: a patch, points of the face with
areas, each with its share of the springs and its own limit of friction. With LAW=joint: the contact patch, and the law
of joints.
"""

import numpy as np
from yade import O, Vector3

from report import row, target, worst
from block_scene import GRAVITY, JOINTS, SHEAR, Scene, box_corners

TITLE = "a contact patch: a block spins on its base" if JOINTS else "one point a face: a block spins on its base"
SIDE, FRICTION, SPIN = 1.0, 30.0, 1.0  # m, degrees, 1/s
MIDDLES = (2, 4, 8)  # patches of m x m cells, with a point in the middle of each
LOOKS = 30
LEVER = (np.sqrt(2.0) + np.log(1.0 + np.sqrt(2.0))) / 6.0


def deceleration(lever=LEVER):
    """1/s^2; lever: mean distance of the points of the base from its middle, over its side."""
    return 6.0 * lever * np.tan(np.radians(FRICTION)) * GRAVITY / SIDE


class Patch:
    """Springs at points of the base, on the plane z = 0: what a law would do that is given a patch. In Python, for this
    scene only.
    """

    def __init__(self, points, stiffness):
        self.points = np.column_stack([points * SIDE, np.full(len(points), -0.5 * SIDE)])  # block's axes
        self.stiffness = stiffness / len(points)
        self.shear = np.zeros((len(points), 2))

    def act(self, block):
        """Sets the force and the torque on the block for the next step."""
        state = block.state
        turn = np.array([state.ori * Vector3(*axis) for axis in np.eye(3)])
        levers = self.points @ turn
        velocity = np.array(state.vel) + np.cross(np.array(state.angVel), levers)
        normal = self.stiffness * np.maximum(-(state.pos[2] + levers[:, 2]), 0.0)
        self.shear -= SHEAR * self.stiffness * O.dt * velocity[:, :2]
        most, size = np.tan(np.radians(FRICTION)) * normal, np.linalg.norm(self.shear, axis=1)
        self.shear *= np.minimum(1.0, most / np.maximum(size, 1e-300))[:, None]
        forces = np.column_stack([self.shear, normal])
        O.forces.setPermF(block.id, Vector3(*map(float, forces.sum(axis=0))))
        O.forces.setPermT(block.id, Vector3(*map(float, np.cross(levers, forces).sum(axis=0))))


def middles(count):
    """Of count x count cells, (n, 2), over the side."""
    ticks = (np.arange(count) + 0.5) / count - 0.5
    return np.array([(x, y) for x in ticks for y in ticks])


def corners():
    """Of the base, over the side."""
    return np.array([(x, y) for x in (-0.5, 0.5) for y in (-0.5, 0.5)])


def simulate(points=None):
    """Times (s) and angular velocities (1/s), with the contact's own point (or patch, of joints) or with points of a
    face.
    """
    scene = Scene(size=SIDE, load=SIDE**3, moving=True)
    if points is None:
        scene.block(box_corners(4.0, 4.0, 1.0), fixed=True, position=(0.0, 0.0, -0.5))
    block = scene.block(box_corners(SIDE, SIDE, SIDE), position=(0.0, 0.0, 0.5 * SIDE - scene.overlap))
    scene.start(FRICTION)
    block.state.angVel = Vector3(0, 0, SPIN)
    block.state.angMom = Vector3(0, 0, SPIN * block.state.inertia[2])
    patch = None if points is None else Patch(points, scene.stiffness)
    looks, last = [(0.0, SPIN)], 0.9 * SPIN / deceleration()
    for _ in range(LOOKS):
        if patch is None:
            scene.run(last / LOOKS)
        else:
            for _ in range(round(last / LOOKS / O.dt)):
                patch.act(block)
                O.step()
        looks.append((O.time, block.state.angVel[2]))
    scene.check()
    return np.array(looks).T


def run(note, short):
    """The contact's point, the corners of the face, and three patches; or the first and one patch."""
    choices = [("one contact point", None), ("4 points, the corners", corners())]
    choices += [(f"{m} × {m} points, middles of cells", middles(m)) for m in MIDDLES]
    if short:
        choices = [choices[0], choices[-1]]
    if JOINTS:
        choices = [("contact patch", None)]
    rows, paths = [], []
    for number, (name, points) in enumerate(choices, 1):
        time, spin = simulate(points)
        moving = spin > 0.05 * SPIN
        found = float(-np.polyfit(time[moving], spin[moving], 1)[0])
        rows.append(row(f"loss of angular velocity, {name}", deceleration(), found, "1/s²", relative=True))
        lever = 0.0 if points is None else float(np.mean(np.hypot(*points.T)))
        rows[-1]["of_these_points"] = deceleration(lever)
        paths.append({"name": name, "time": time.tolist(), "spin": spin.tolist()})
        note(number / len(choices))
    data = {"paths": paths, "deceleration": deceleration(), "spin": SPIN}
    aims = [target("twist: error of the loss of angular velocity, relative", 2e-3, worst(rows))] if JOINTS else []
    return {"title": TITLE, "rows": rows, "targets": aims, "data": data}
