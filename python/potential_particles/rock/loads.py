# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pressure on faces as forces on blocks: water in a joint, a surcharge.

Over a triangle of area A a pressure that is p_i at its corners x_i, and linear between, has

    integral of p = A/3 sum p_i,    integral of p x = A/12 (sum p_i sum x_i + sum p_i x_i).
"""
import numpy as np

from ..arguments import number, positive
from .mass import marked


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


def loads_of(loads, count):
    """Forces and torques as an array (count, 6), torques 0 where only forces are given; ValueError for what is neither.
    """
    try:
        found = np.asarray(loads, float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.ndim != 2 or found.shape[0] != count or found.shape[1] not in (3, 6) or not np.isfinite(found).all():
        raise ValueError(
            f"loads must be ({count}, 6) finite numbers, force and torque of each block, as of water_pressure()")
    return np.column_stack([found, np.zeros((count, 6 - found.shape[1]))])


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
