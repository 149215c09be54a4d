# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressure on faces as forces on blocks: water in a joint, a surcharge.

Over a triangle of area A a pressure that is p_i at its corners x_i, and linear between, has

    integral of p = A/3 sum p_i,    integral of p x = A/12 (sum p_i sum x_i + sum p_i x_i).
"""
import numpy as np

from ..arguments import number, positive
from ..bodies import owner
from .scene import marked, loads_of


def face_pressure(mass, faces, pressure):
    """Force and torque about the centroid of each block, (blocks, 6), of an even pressure on faces: a surcharge.

    faces: numbers or (faces,) of bool, as mass.faces_on gives them. The pressure pushes inwards.
    """
    pressure = number(pressure, "pressure")
    return _summed(mass, faces, lambda corners: (corners, np.full(len(corners), pressure)))


def water_pressure(mass, faces, level, unit_weight=9810.0):
    """The same of water up to a level z: the pressure unit_weight (level - z) below it, none above.

    faces: as mass.faces_of gives them; both sides of a joint, whose forces are opposite.
    """
    level, unit_weight = number(level, "level"), positive(unit_weight, "unit_weight")

    def below(corners):
        depth = level - corners[:, 2]
        cut = []
        for i, here in enumerate(corners):
            there, left = depth[i], depth[(i + 1) % len(corners)]
            if there >= 0.0:
                cut.append(here)
            if (there < 0.0) != (left < 0.0):
                cut.append(here + there / (there - left) * (corners[(i + 1) % len(corners)] - here))
        cut = np.array(cut).reshape(-1, 3)
        return cut, unit_weight * (level - cut[:, 2])

    return _summed(mass, faces, below)


def apply_loads(ids, loads):
    """Gives bodies lasting forces and torques, in the place of those that they have: ids (blocks,) of bodies(), loads
    (blocks, 6). On a clump, those of its members.

    YADE does not save lasting forces: call it again after O.load(), and O.forces.reset(resetAll=True) where other
        bodies take the ids.
    """
    import yade
    forces, loads = {}, loads_of(loads, len(ids))
    for one, load in zip(ids, loads):
        body = yade.O.bodies[int(one)]
        if body is None:
            continue
        carrier = owner(body)
        arm = np.array(body.state.pos) - np.array(carrier.state.pos)
        turned = np.concatenate([load[:3], load[3:] + np.cross(arm, load[:3])])
        forces[carrier.id] = forces.get(carrier.id, 0.0) + turned
    for one, load in forces.items():
        yade.O.forces.setPermF(one, yade.Vector3(*load[:3]))
        yade.O.forces.setPermT(one, yade.Vector3(*load[3:]))


def _summed(mass, faces, loaded):
    loads = np.zeros((len(mass), 6))
    for face in np.flatnonzero(marked(faces, len(mass.faces), "faces")):
        corners, pressure = loaded(mass.outline(face))
        if len(corners) < 3:
            continue
        block = int(mass.faces["block"][face])
        normal = mass.faces["plane"][face, :3]
        force, moment = 0.0, np.zeros(3)
        for i in range(1, len(corners) - 1):
            x, p = corners[[0, i, i + 1]] - mass.blocks["centroid"][block], pressure[[0, i, i + 1]]
            area = 0.5 * np.linalg.norm(np.cross(x[1] - x[0], x[2] - x[0]))
            force += area / 3.0 * p.sum()
            moment += area / 12.0 * (p.sum() * x.sum(0) + p @ x)
        loads[block, :3] -= force * normal
        loads[block, 3:] -= np.cross(moment, normal)
    return loads
