# SPDX-License-Identifier: MIT OR Apache-2.0
"""Points and triangles of a GTS file: a line of counts, the points, the edges as pairs of points, the triangles as
three edges.

Read here, since GTS's own reader ends the process where edges do not make the triangle that they should.
"""
import numpy as np

from .mesh_text import numbers, read_text


def read_gts(file):
    """Points (n, 3) and triangles (m, 3), numbers of points; ValueError for what is no such file."""
    lines = [line.split() for line in read_text(file) if line.strip() and line.lstrip()[0] not in "#!"]
    if not lines:
        raise ValueError("it holds no line")
    counts = numbers(lines[0][:3], int, 3, "the first line")
    if min(counts) < 0 or sum(counts) != len(lines) - 1:
        raise ValueError("its first line states {} vertices, {} edges and {} faces, and {} lines follow".format(
            *counts,
            len(lines) - 1))
    ends = np.cumsum([1] + counts)
    points, edges, faces = (lines[begin:end] for begin, end in zip(ends, ends[1:]))
    points = np.array([numbers(line[:3], float, 3, "a vertex") for line in points], float).reshape(-1, 3)
    edges = [_named(line, 2, counts[0], "vertex") for line in edges]
    triangles = [_corners([edges[i] for i in _named(line, 3, counts[1], "edge")], line) for line in faces]
    return points, np.array(triangles, int).reshape(-1, 3)


def _named(line, many, count, what):
    found = numbers(line[:many], int, many, f"a list of {what} numbers")
    for number in found:
        if not 1 <= number <= count:
            raise ValueError(f"{what} {number} is named, and there are {count}")
    return [number - 1 for number in found]


def _corners(edges, line):
    """The corners of three edges in the order of GTS: the point that the first two share is the second one."""
    first, second, third = (set(edge) for edge in edges)
    shared = [first & second, second & third, third & first]
    if any(len(one) != 1 for one in shared) or len(set.union(*shared)) != 3:
        raise ValueError(f"the edges {' '.join(line[:3])} do not make a triangle")
    b, c, a = (one.pop() for one in shared)
    return a, b, c
