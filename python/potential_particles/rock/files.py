# SPDX-License-Identifier: MIT OR Apache-2.0
"""Joints from files: discrete fracture networks, and the tables of YADE's BlockGen."""
import itertools
import math
import re

import numpy as np

from ..arguments import MANY, is_number, positive
from .joints import Joint, JointSet, joint, polygon


# Names of columns, without blanks, signs and units, and what the number there is made into.
COLUMNS = ("x", "y", "z", "dip", "dip direction", "radius")
_SAME = 1.0, 0.0
_NAMES = {
    "x": ("x", _SAME), "easting": ("x", _SAME), "y": ("y", _SAME), "northing": ("y", _SAME), "z": ("z", _SAME),
    "elevation": ("z", _SAME), "dip": ("dip", _SAME), "dipangle": ("dip", _SAME), "plunge": ("dip", (-1.0, 90.0)),
    "dipdirection": ("dip direction", _SAME), "direction": ("dip direction", _SAME), "dipdir": ("dip direction", _SAME),
    "strike": ("dip direction", (1.0, 90.0)), "trend": ("dip direction", (1.0, 180.0)), "radius": ("radius", _SAME),
    "diameter": ("radius", (0.5, 0.0))
}


def read_dfn(file):
    """Joints as discs from a table of the columns x, y, z of the centre, dip, dip direction and radius; a list of
    Joint.

    Separated by commas, semicolons or blanks, in degrees and the script's unit; empty lines and those that begin with #
    are passed over. A first line without any number names the columns, in any order and among others: in the place of
    the dip direction "strike" (by the right hand), of both angles "trend" and "plunge" of the pole, which points
    downwards, of the radius "diameter". One that has none of these names is passed over. A radius of inf is a joint
    without end. ValueError with file, line and value for what is no such table.
    """
    named, found = _named_columns(file), []
    columns, made = named or (range(6), 6 * [_SAME])
    for number, values in _rows(file, columns, ", ".join(COLUMNS), exactly=not named, discs=True):
        values = [factor * value + more for value, (factor, more) in zip(values, made)]
        found.append(_told(file, number, lambda: joint(values[:3], values[3], values[4], values[5])))
    return found


def _named_columns(file):
    """Where each of COLUMNS stands by the first line, and what is made of the number there; None without such names."""
    with open(file, encoding="utf-8-sig") as lines:
        filled = filter(None, (line.split("#")[0].strip() for line in _decoded(lines, file)))
        first, second = next(filled, ""), next(filled, "")
    words = _words(first)
    if not second or any(map(is_number, words)):
        return None
    if len(words) > len(_words(second)):
        # Names of two words, or with a unit, between blanks.
        words = _words(re.sub(r"\s+(?=direction|angle|[(\[])", "_", first, flags=re.I))
    found = {}
    for column, word in enumerate(words):
        meant, made = _NAMES.get(re.sub(r"[(\[].*|[^a-z]", "", word.lower()), ("", _SAME))
        found.setdefault(meant, (column, made))
    missing = [one for one in COLUMNS if one not in found]
    if len(missing) == len(COLUMNS):
        return None
    if missing:
        raise ValueError(f"{file}: the names {first[:80]!r} lack {', '.join(missing)}: name the columns "
                         f"{', '.join(COLUMNS)}, or leave the names out")
    return tuple(zip(*(found[one] for one in COLUMNS)))


def read_blockgen(file, kind, size=None):
    """The joints of a table of YADE's BlockGen, as it reads them; a list of Joint.

    kind: "probabilistic" (filenameProbabilistic) has dip; dip direction; x; y; z; half lengths along strike and dip in
    each row; "persistent" (filenamePersistentPlanes) dip; dip direction; spacing, and joints through the origin and on
    both sides of it as far as `size`/2, the boundarySize of BlockGen; YADE takes the difference of its two extents
    there, so that a symmetric domain gets one plane of each row. "boundary" (filenameBoundaries) dip; dip direction; x;
    y; z. Further columns are passed over. In BlockGen's axes the normal of a plane is (-sin d cos a, -sin d sin a, cos
    d), d the dip and a the dip direction: x is north and y east where z points downwards. A joint that ends is a
    rectangle.
    """
    return [one for one, _ in rows_of_blockgen(file, kind, size)]


def rows_of_blockgen(file, kind, size=None):
    """(Joint, dict of frictionAngle, residualFrictionAngle, cohesion and tensileStrength, as of ConicJointMat, where
    the row has them) of each joint of read_blockgen().
    """
    kinds = {"probabilistic": 7, "persistent": 3, "boundary": 5}
    if kind not in kinds:
        raise ValueError(f"kind={kind!r} must be one of {', '.join(kinds)}")
    if kind == "persistent":
        if size is None:
            raise ValueError("size is missing: planes of a spacing are laid over a domain of that size (boundarySize)")
        size = positive(size, "size")
    found = []
    for number, values in _rows(file, range(kinds[kind]), "the columns of BlockGen"):
        dip, direction = values[:2]
        # BlockGen takes dips above 90, as of planes that overhang.
        normal = _told(file, number, lambda: _blockgen_normal(dip, direction))
        strength = _strength(values[kinds[kind]:])
        if kind == "persistent":
            _told(file, number, lambda: JointSet(min(dip, 180 - dip), direction, values[2]))
            half = round(size / values[2]) // 2
            if len(found) + 2 * half + 1 > MANY:
                raise ValueError(
                    f"{file}, line {number}: spacing={values[2]:g} over size={size:g} makes {2 * half + 1:.3g} joints, and no more than {MANY} are read"
                )
            found += [(Joint(tuple(step * values[2] * one for one in normal), normal), strength)
                      for step in range(-half, half + 1)]
        elif kind == "probabilistic":
            if not (values[5] > 0.0 and values[6] > 0.0):
                raise ValueError(f"{file}, line {number}: half lengths {values[5]:g} and {values[6]:g} must be above 0")
            found.append(
                (_told(file, number,
                       lambda: _rectangle(values[2:5], normal, math.radians(direction), *values[5:7])), strength))
        else:
            found.append((Joint(tuple(values[2:5]), normal), strength))
    return found


def _rectangle(centre, normal, direction, along, down):
    """The polygon of BlockGen's half lengths: along the strike, 90 degrees before the dip direction, and across it."""
    strike = np.array([math.sin(direction), -math.cos(direction), 0.0])
    along, down = along * strike, down * np.cross(normal, strike)
    return polygon([centre + along + down, centre - along + down, centre - along - down, centre + along - down])


def _strength(values):
    """phi_b; phi_r; JRC; JCS; asperity; sigmaC; cohesion; tension."""
    if len(values) < 8:
        return {}
    return {
        "frictionAngle": math.radians(values[0]), "residualFrictionAngle": math.radians(values[1]),
        "cohesion": values[6], "tensileStrength": values[7]
    }


def _blockgen_normal(dip, direction):
    if not 0.0 <= dip <= 180.0:
        raise ValueError(f"dip={dip:g} must lie between 0 and 180")
    dip, direction = math.radians(dip), math.radians(direction)
    return -math.sin(dip) * math.cos(direction), -math.sin(dip) * math.sin(direction), math.cos(dip)


def _rows(file, columns, meaning, exactly=False, discs=False):
    """(line, numbers) of each row: those in the columns, counted from 0; of discs, the last of which may be infinite,
    no others, else the numbers after them, too.
    """
    found, names, width = [], False, max(columns) + 1
    with open(file, encoding="utf-8-sig") as lines:
        for number, line in enumerate(_decoded(lines, file), 1):
            line = line.split("#")[0].strip()
            if not line:
                continue
            words = _words(line)
            # BlockGen's lines end with a separator.
            while words and not words[-1]:
                words.pop()
            if not found and not names and not any(map(is_number, words)):
                names = True
                continue
            for column in columns:
                word = words[column] if column < len(words) else "0"
                # A disc without end has a radius of inf, and nothing else is infinite.
                if not is_number(word) or not math.isfinite(float(word)) and not (
                        discs and column == columns[-1] and float(word) == math.inf):
                    raise ValueError(f"{file}, line {number}, column {column + 1}: {word!r} is no finite number")
            if len(words) < width or exactly and len(words) != width:
                raise ValueError(f"{file}, line {number}: {len(words)} numbers, and {width} are needed: {meaning}")
            further = [] if discs else list(itertools.takewhile(is_number, words[width:]))
            if not all(math.isfinite(float(word)) for word in further):
                raise ValueError(f"{file}, line {number}: {', '.join(further)}: each must be finite")
            found.append((number, [float(word) for word in [words[column] for column in columns] + further]))
    if not found:
        raise ValueError(f"{file}: there is no row of numbers: {meaning}")
    return found


def _words(line):
    """Blanks separate where nothing else does."""
    separator = ";" if ";" in line else "," if "," in line else None
    return [word.strip() for word in line.split(separator)]


def _decoded(lines, file):
    try:
        yield from lines
    except UnicodeDecodeError as error:
        raise ValueError(f"{file} is no text in UTF-8: {error}") from None


def _told(file, line, make):
    try:
        return make()
    except ValueError as error:
        raise ValueError(f"{file}, line {line}: {error}") from None
