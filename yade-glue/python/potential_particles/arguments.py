# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as a script gives them: each is checked before anything is made of it."""
import math

import numpy as np


def number(value, name):
    """A finite number, or ValueError."""
    try:
        found = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name}={value!r} is no number") from None
    if not math.isfinite(found):
        raise ValueError(f"{name}={found} must be finite")
    return found


def positive(value, name):
    """A number above 0, or ValueError."""
    found = number(value, name)
    if found <= 0.0:
        raise ValueError(f"{name}={found:g} must be above 0")
    return found


def within(value, low, high, name):
    """A number of [low, high], or ValueError."""
    found = number(value, name)
    if not low <= found <= high:
        raise ValueError(f"{name}={found:g} must lie between {low:g} and {high:g}")
    return found


def is_friction_angle(value):
    """Whether it is in [0, pi/2)."""
    return 0.0 <= value < 0.5 * math.pi


def radians(value, name):
    """An angle of friction in [0, pi/2), or ValueError."""
    try:
        found = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {value!r} is no number: give radians in [0, pi/2)") from None
    if not is_friction_angle(found):
        raise ValueError(f"{name} = {found:g}: give radians in [0, pi/2)")
    return found


def whole(value, least, name):
    """A whole number that is not below `least`, or ValueError."""
    found = number(value, name)
    if found != int(found) or found < least:
        raise ValueError(f"{name}={value!r} must be a whole number of at least {least}")
    return int(found)


def vector(value, name):
    """Three finite numbers as an array, or ValueError."""
    return rows([value], 3, name, "the three numbers x, y, z")[0]


def rows(values, width, name, meaning):
    """Rows of `width` finite numbers as an array (n, width), or ValueError that says which row is at fault."""
    try:
        found = [[float(one) for one in row] for row in values]
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be {meaning}, each a number") from None
    for i, row in enumerate(found):
        if len(row) != width:
            raise ValueError(f"{name}: row {i} has {len(row)} numbers, not {meaning}")
        if not all(map(math.isfinite, row)):
            raise ValueError(f"{name}: row {i} is {tuple(row)}, and each of its numbers must be finite")
    return np.array(found, float).reshape(-1, width)


def unit_quaternion(value, name):
    """(w, x, y, z) of unit length from a yade.Quaternion, or from four numbers w, x, y, z."""
    if hasattr(value, "toAxisAngle"):
        value = (value[3], value[0], value[1], value[2])
    found = rows([value], 4, name, "a Quaternion or the four numbers w, x, y, z")[0]
    length = np.linalg.norm(found)
    if not 1e-100 < length < 1e100:
        raise ValueError(f"{name}={tuple(found)} has no direction: a quaternion must not be zero")
    return found / length
