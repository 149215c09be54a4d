# SPDX-License-Identifier: MIT OR Apache-2.0
"""Numbers as a script gives them: each is checked before anything is made of it."""
import importlib
import math
import warnings

import numpy as np


class SceneWarning(UserWarning):
    """What is allowed and may surprise: shapes that lose volume, and, in YADE, what check() finds."""


def warn(text):
    """Gives a SceneWarning without a place in a source file: it is about a scene or a shape, and stays one line."""
    warnings.warn_explicit(f"potential_particles: {text}", SceneWarning, "potential_particles", 0)


# Of what a script gives. Fifth powers of lengths, as moments of inertia are, and what is made of a few of them, are
# doubles with all their digits.
LEAST, MOST = 1e-50, 1e50
# Of what is made one by one in Python: more takes minutes or all memory, and is taken for a mistake.
MANY = 1_000_000
# Seeds, steps and numbers of things that are elsewhere: doubles count as far as this.
LARGE = 2**53
# The library has no particles of more.
MOST_PLANES = 65_536


def needed(module, package):
    """A module of another package; ImportError that names the package."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"this needs the Python package {package}, of which {module} cannot be imported ({error}): "
                          f"pip install {package}, or Debian's") from None


def is_number(word):
    """Whether a word of a file is a number, finite or not."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def number(value, name):
    """A finite number, or ValueError."""
    try:
        found = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name}={value!r} is no number") from None
    if not math.isfinite(found):
        raise ValueError(f"{name}={found} must be finite")
    if abs(found) > MOST:
        raise ValueError(f"{name}={found:g} must lie between {-MOST:g} and {MOST:g}")
    return found


def positive(value, name):
    """A number above 0, or ValueError."""
    found = number(value, name)
    if found <= 0.0:
        raise ValueError(f"{name}={found:g} must be above 0")
    if found < LEAST:
        raise ValueError(f"{name}={found:g} must be at least {LEAST:g}")
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


def whole(value, least, most, name):
    """A whole number from `least` to `most`, or ValueError."""
    found = number(value, name)
    if found != int(found) or not least <= found <= most:
        raise ValueError(f"{name}={value!r} must be a whole number between {least} and {most:.10g}")
    return int(found)


def vector(value, name):
    """Three numbers as an array, or ValueError."""
    return bearable(rows([value], 3, name, "the three numbers x, y, z"), name)[0]


def bearable(points, name, note=""):
    """Points (n, 3) as they are, if each of their numbers is finite and bearable, or ValueError that says which is not.
    """
    fine = (np.abs(points) <= MOST).all(1)
    if not fine.all():
        first = int(np.argmin(fine))
        found = ", ".join(f"{one:g}" for one in points[first])
        raise ValueError(
            f"{name}{f' {first}' if len(points) > 1 else ''}=({found}){note}: each number must lie between {-MOST:g} and {MOST:g}"
        )
    return points


def unit(value, name):
    """The direction of a vector of any length as a unit vector (3,), or ValueError."""
    found = rows([value], 3, name, "the three numbers x, y, z")[0]
    largest = np.abs(found).max()
    if not largest > 0.0:
        raise ValueError(f"{name}={tuple(found)} has no direction: it must not be zero")
    found = found / largest
    return found / np.linalg.norm(found)


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
    largest = np.abs(found).max()
    if not largest > 0.0:
        raise ValueError(f"{name}={tuple(found)} has no direction: a quaternion must not be zero")
    found = found / largest
    return found / np.linalg.norm(found)
