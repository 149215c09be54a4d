# SPDX-License-Identifier: MIT OR Apache-2.0
"""Points and polygons of STL and OBJ files.

Libraries were tried: the readers of VTK take counts and indices as they are, where one that is wrong ends the process,
and numbers by the locale of the process, which Qt sets; the crates stl_io and tobj refuse files that others read.
"""
import decimal
import math
import os
import re

import numpy as np

_HEADER = 84  # bytes of a binary STL file before its triangles
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# A corner of an OBJ file: v, v/vt, v//vn or v/vt/vn.
_INDEX = "(-?[0-9]{1,18})"
_CORNER, _NAMED = re.compile(f"{_INDEX}(?:/{_INDEX}|/{_INDEX}?/{_INDEX})?"), ("v", "vt", "vt", "vn")

# How far from its plane the fourth corner of a face may be, over what each coordinate may be off.
OF_CORNERS = 8.0
# What a number of single precision may be off, as a share of it.
OF_SINGLE = 2.0**-24
# Digits that a number of double precision always has: with more it is taken as it stands.
OF_DOUBLE = 15
# Numbers of less than so many digits may have been typed, and are exact if the last digit is beyond this share of the
# extent; beyond the other nothing is known of a body.
TYPED, COARSE, COARSEST = 6, 1e-3, 2e-2


def read(file, readers=None, readable=".stl (binary or text) and .obj"):
    """Points (n, 3) and polygons, lists of indices of points, by the reader of the file's ending. ValueError for a file
    that cannot be read, or holds no polygon.
    """
    file = os.fspath(file)
    if not os.path.isfile(file):
        raise ValueError(f"{file}: there is no such file")
    kind = os.path.splitext(file)[1].lower()
    readers = readers or READERS
    if kind not in readers:
        raise ValueError(f"{file}: files that can be read are {readable}")
    try:
        points, polygons = readers[kind](file)
    except (OSError, ValueError) as error:
        raise ValueError(f"{file} cannot be read as {kind}: {error}") from None
    if len(polygons) == 0:
        raise ValueError(f"{file} holds no triangles: it is empty, or not what its ending says")
    return points, polygons


def known_to(points):
    """The length to which faces of points of a file are known, by the digits of the points.

    Numbers have all been rounded to a decimal place (%.4f), to significant digits (%.8g) or to single precision, or not
    at all: whole numbers, numbers of few digits for the size of the body, and those of double precision are exact. Of
    place and digits that one counts which more numbers make full use of: the last digit is seldom a zero.
    """
    some = np.unique(np.abs(points[:1000]))
    some, largest, extent = some[some > 0.0], np.abs(points).max(), np.ptp(points, axis=0).max()
    if len(some) == 0 or np.array_equal(some, np.round(some)):
        return 0.0
    written = [decimal.Decimal(repr(float(one))).normalize() for one in some]
    digits = np.array([len(one.as_tuple().digits) for one in written])
    places = np.array([-one.as_tuple().exponent for one in written])
    if digits.max() > OF_DOUBLE:
        return OF_CORNERS * OF_SINGLE * float(largest) if np.array_equal(some, some.astype(np.float32)) else 0.0
    by_place = (places == places.max()).mean() >= (digits == digits.max()).mean()
    last = 10.0**-places.max() if by_place else 10.0**(math.floor(math.log10(largest)) + 1 - digits.max())
    if last > (COARSE if digits.max() < TYPED else COARSEST) * extent:
        return 0.0
    # Single precision that was written with some more digits.
    own = last if by_place else 10.0**(np.floor(np.log10(some)) + 1 - digits.max())
    single = OF_SINGLE * largest if (np.abs(some - some.astype(np.float32)) <= 0.51 * own).all() else 0.0
    return OF_CORNERS * float(max(0.5 * last, single))


def read_text(file):
    """The lines of a text in UTF-8, with or without its mark; other bytes stand for themselves. ValueError for UTF-16.
    """
    with open(file, "rb") as opened:
        return lines_of(opened.read())


def lines_of(content):
    """As read_text, of bytes."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise ValueError("it is text in UTF-16: save it as UTF-8")
    return content.decode("utf-8-sig", errors="replace").splitlines()


def read_stl(file):
    """Points (3 m, 3) and triangles (m, 3) of a binary or text file; ValueError where it states what it does not hold.
    """
    with open(file, "rb") as opened:
        content = opened.read()
    stated = int.from_bytes(content[80:_HEADER], "little")
    if len(content) >= _HEADER and len(content) == _HEADER + _TRIANGLE.itemsize * stated:
        points = np.frombuffer(content, _TRIANGLE, offset=_HEADER)["corners"].astype(float).reshape(-1, 3)
    else:
        points = _stl_text(content, stated)
    return points, np.arange(len(points)).reshape(-1, 3)


def _stl_text(content, stated):
    lines = lines_of(content)
    if b"\0" in content or not "".join(lines[:1]).lstrip().lower().startswith("solid"):
        if len(content) < _HEADER:
            raise ValueError(f"it has {len(content)} bytes, and the header of a binary file alone has {_HEADER}")
        raise ValueError(
            f"its header states {stated} triangles, and its {len(content)} bytes hold {(len(content) - _HEADER) / _TRIANGLE.itemsize:.6g}"
        )
    facets, vertices = 0, []
    for words in filter(None, map(str.split, lines)):
        word = words[0].lower()
        facets += word == "facet"
        if word == "vertex":
            vertices.append(numbers(words[1:], float, 3, "vertex"))
    if len(vertices) != 3 * facets:
        raise ValueError(f"{facets} facets have {len(vertices)} vertices in all")
    return np.array(vertices, float).reshape(-1, 3)


def read_obj(file):
    """Points (n, 3) and polygons, lists of numbers of points; ValueError where it names what it does not hold."""
    # An element may name points that come later: counts are of the whole file.
    lines = [line.split("#")[0].split() for line in "\n".join(read_text(file)).replace("\\\n", " ").splitlines()]
    counts, points, polygons = {"v": 0, "vt": 0, "vn": 0}, [], []
    for words in lines:
        if words and words[0] in counts:
            counts[words[0]] += 1
            if words[0] == "v":
                points.append(numbers(words[1:4], float, 3, "v"))
    so_far = dict.fromkeys(counts, 0)
    for words in lines:
        if words and words[0] in counts:
            so_far[words[0]] += 1
        elif words and words[0] in ("f", "l", "p"):
            if len(words) == 1:
                raise ValueError(f"an element {words[0]!r} names no point")
            corners = [_CORNER.fullmatch(corner) for corner in words[1:]]
            if None in corners or len({tuple(one is None for one in corner.groups()) for corner in corners}) > 1:
                raise ValueError(
                    f"the element {' '.join(words)[:60]!r} has corners in more than one form, or none that is known")
            for corner in corners:
                for index, what in zip(corner.groups(), _NAMED):
                    if index is not None:
                        _in_range(int(index), counts[what], so_far[what], what)
            if words[0] == "f":
                named = [int(corner[1]) for corner in corners]
                polygons.append([one - 1 if one > 0 else so_far["v"] + one for one in named])
    return np.array(points, float).reshape(-1, 3), polygons


def _in_range(number, count, so_far, what):
    if not (1 <= number <= count or -so_far <= number <= -1):
        raise ValueError(f"an element names {what} {number}, and there are {count}")


def numbers(words, kind, count, what):
    """`count` words as numbers of a kind, int or float; ValueError that names what they should be."""
    try:
        found = [kind(word) for word in words]
    except ValueError:
        found = []
    if len(found) != count:
        raise ValueError(
            f"{what} has {' '.join(words)[:40]!r} where {count} {'whole ' if kind is int else ''}number{'s' * (count > 1)} should stand"
        )
    return found


READERS = {".stl": read_stl, ".obj": read_obj}
