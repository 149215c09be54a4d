# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the numbers in a mesh file fit each other: counts against what is there, indices against counts.

The readers of VTK take them as they are: an index beyond the last point, or a count that is wrong, ends the process.
"""
import os
import re

_HEADER, _TRIANGLE = 84, 50  # bytes of a binary STL file
# A corner of an OBJ file: v, v/vt, v//vn or v/vt/vn.
_INDEX = "(-?[0-9]{1,18})"
_CORNER, _NAMED = re.compile(f"{_INDEX}(?:/{_INDEX}|/{_INDEX}?/{_INDEX})?"), ("v", "vt", "vt", "vn")


def refuse_misstated(file, kind):
    """ValueError where a file of this kind (.stl, .obj) states what it does not hold."""
    try:
        {".stl": _stl, ".obj": _obj}[kind](file)
    except ValueError as error:
        raise ValueError(f"{file} cannot be read as {kind}: {error}") from None


def _stl(file):
    size = os.path.getsize(file)
    with open(file, "rb") as opened:
        begin = opened.read(_HEADER)
    stated = int.from_bytes(begin[80:84], "little")
    if len(begin) == _HEADER and size == _HEADER + _TRIANGLE * stated:
        return
    with open(file, "rb") as opened:
        text = opened.read()
    if begin.lstrip()[:5].lower() != b"solid" or b"\0" in text:
        if size < _HEADER:
            raise ValueError(f"it has {size} bytes, and the header of a binary file alone has {_HEADER}")
        raise ValueError(f"its header states {stated} triangles, and its {size} bytes hold {(size - _HEADER) / _TRIANGLE:.6g}")
    facets, vertices = (re.findall(rb"^[ \t]*" + word + rb"\b(.*)$", text, re.M | re.I) for word in (b"facet", b"vertex"))
    if len(vertices) != 3 * len(facets):
        raise ValueError(f"{len(facets)} facets have {len(vertices)} vertices in all")
    for place in vertices:
        numbers(place.decode().split(), float, 3, "vertex")


def _obj(file):
    counts = {"v": 0, "vt": 0, "vn": 0}
    with open(file, errors="replace") as opened:
        text = opened.read().replace("\\\n", " ")
    # An element may name points that come later: counts are of the whole file, as the reader takes them.
    lines = [line.split("#")[0].split() for line in text.splitlines()]
    for words in lines:
        if words and words[0] in counts:
            counts[words[0]] += 1
            if words[0] == "v":
                numbers(words[1:4], float, 3, "v")
    so_far = dict.fromkeys(counts, 0)
    for words in lines:
        if words and words[0] in counts:
            so_far[words[0]] += 1
        elif words and words[0] in ("f", "l", "p"):
            if len(words) == 1:
                raise ValueError(f"an element {words[0]!r} names no point")
            corners = [_CORNER.fullmatch(corner) for corner in words[1:]]
            if None in corners or len({tuple(one is None for one in corner.groups()) for corner in corners}) > 1:
                raise ValueError(f"the element {' '.join(words)[:60]!r} has corners in more than one form, or none that is known")
            for corner in corners:
                for index, what in zip(corner.groups(), _NAMED):
                    if index is not None:
                        _in_range(int(index), counts[what], so_far[what], what)


def _in_range(number, count, so_far, what):
    if not (1 <= number <= count or -so_far <= number <= -1):
        raise ValueError(f"an element names {what} {number}, and there are {count}")


def numbers(words, kind, count, what):
    """So many words as numbers of a kind, int or float; ValueError that names what they should be."""
    try:
        found = [kind(word) for word in words]
    except ValueError:
        found = []
    if len(found) != count:
        raise ValueError(f"{what} has {' '.join(words)[:40]!r} where {count} {'whole ' if kind is int else ''}number{'s' * (count > 1)} should stand")
    return found
