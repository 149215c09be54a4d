# SPDX-License-Identifier: MIT OR Apache-2.0
"""Reads the file of pairs that pairs.py writes; for drivers in Python."""

from dataclasses import dataclass


@dataclass
class Group:
    r: float
    k: float
    shadow: float
    swept: float
    planes: list  # normal and offset, before r is added
    corners: list
    triangles: list
    pairs: list  # (pose of A, [poses of B]); a pose is position and quaternion w x y z, seven numbers


def read(path):
    """Groups by name."""
    with open(path) as file:
        words = iter(file.read().split())
    numbers = lambda count: [float(next(words)) for _ in range(count)]
    whole = lambda count: [int(next(words)) for _ in range(count)]
    groups = {}
    for _ in range(whole(1)[0]):
        name = next(words)
        rounding = numbers(4)
        planes, corners, triangles, pairs, poses = whole(5)
        groups[name] = Group(
            *rounding,
            [numbers(4) for _ in range(planes)],
            [numbers(3) for _ in range(corners)],
            [whole(3) for _ in range(triangles)],
            [(numbers(7), [numbers(7) for _ in range(poses)]) for _ in range(pairs)],
        )
    return groups
