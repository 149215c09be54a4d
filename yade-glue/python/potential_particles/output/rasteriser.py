# SPDX-License-Identifier: GPL-3.0-or-later
"""Which triangle is nearest at each pixel, in numpy: no display, no graphics library."""
import numpy as np

NOTHING = -1
_MOST_FRAGMENTS = 2_000_000  # at a time; about 100 bytes each


def nearest_triangles(corners, width, height):
    """The triangle nearest to the eye at each pixel: (closeness, index), each (height, width).

    corners: (n, 3, 3), of each triangle three rows of x, y and closeness. x runs to the right and y down, in pixels, so that
    pixel (0, 0) has its centre at (0.5, 0.5). Closeness grows towards the eye and is linear on the picture of a plane: the
    inverse of the depth in a perspective view, its negative in a parallel one. Triangles that turn clockwise on the picture
    are seen from behind and left out. Where there is none, closeness is -inf and the index NOTHING.
    """
    closeness = np.full(width * height, -np.inf)
    index = np.full(width * height, NOTHING)
    area = _cross(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2])
    # y runs down: what turns counter-clockwise for the eye has a negative area.
    seen = np.flatnonzero((area < 0.0) & np.isfinite(corners).all((1, 2)))
    # From far to near, so that most pixels get the right triangle at the first attempt.
    seen = seen[np.argsort(corners[seen, :, 2].mean(1), kind="stable")]
    triangles = corners[seen]
    top, bottom = (_pixel(edge(triangles[:, :, 1], axis=1), height) for edge in (np.min, np.max))
    rows = bottom - top
    # As an estimate of the fragments, half of the box around each triangle.
    wide = _pixel(triangles[:, :, 0].max(1), width) - _pixel(triangles[:, :, 0].min(1), width)
    part = np.cumsum(rows * (0.5 * wide + 2.0)) // _MOST_FRAGMENTS
    for chosen in np.split(np.arange(len(seen)), np.flatnonzero(np.diff(part)) + 1):
        _draw(triangles[chosen], seen[chosen], top[chosen], rows[chosen], width, closeness, index)
    return closeness.reshape(height, width), index.reshape(height, width)


def interpolate(corners, values, chosen, x, y):
    """Values (n, 3, m), given at the corners of triangles, at points (x, y) of the picture of the triangles `chosen`."""
    a, b, c = (corners[chosen, i, :2] for i in range(3))
    p = np.column_stack([x, y])
    whole = _cross(b - a, c - a)
    at_b, at_c = _cross(p - a, c - a) / whole, _cross(b - a, p - a) / whole
    of = values[chosen]
    return (1.0 - at_b - at_c)[:, None] * of[:, 0] + at_b[:, None] * of[:, 1] + at_c[:, None] * of[:, 2]


def _draw(triangles, names, top, rows, width, closeness, index):
    """Enters the fragments of some triangles, row by row, into the two flat maps."""
    which, row = _runs(top, rows)
    first, last = _spans(triangles[which], row + 0.5, width)
    entry, column = _runs(first, np.maximum(last - first, 0))
    which, row = which[entry], row[entry]
    slope, start = _planes(triangles)
    near = start[which] + slope[which, 0] * (column + 0.5) + slope[which, 1] * (row + 0.5)
    pixel = row * width + column
    while len(pixel):
        # Of several fragments for one pixel the last one stays; those that are nearer still come again.
        better = near > closeness[pixel]
        pixel, near, which = pixel[better], near[better], which[better]
        closeness[pixel] = near
        index[pixel] = names[which]


def _runs(first, lengths):
    """The numbers first[i], first[i] + 1, ..., lengths[i] of them, one after the other: (i, number) for each."""
    which = np.repeat(np.arange(len(lengths)), lengths)
    before = np.cumsum(lengths) - lengths
    return which, first[which] + np.arange(len(which)) - before[which]


def _spans(triangles, y, width):
    """First pixel, and the one after the last, of each triangle in the row with its centre at y."""
    left, right = np.full(len(y), -np.inf), np.full(len(y), np.inf)
    for i in range(3):
        (x0, y0), (x1, y1) = triangles[:, i, :2].T, triangles[:, (i + 1) % 3, :2].T
        rise = y1 - y0
        with np.errstate(divide="ignore", invalid="ignore"):
            at = x0 + (y - y0) / rise * (x1 - x0)
        # The inside lies on the left of an edge that runs up the picture, and on the right of one that runs down.
        left = np.where(rise > 0.0, np.maximum(left, at), left)
        right = np.where(rise < 0.0, np.minimum(right, at), right)
    return _pixel(left, width), _pixel(right, width)


def _planes(triangles):
    """Closeness of each triangle as slope (n, 2) and value at the corner of the picture, (n,)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    u, v = b - a, c - a
    area = _cross(u, v)
    slope = np.stack([u[:, 2] * v[:, 1] - u[:, 1] * v[:, 2], u[:, 0] * v[:, 2] - u[:, 2] * v[:, 0]], axis=1) / area[:, None]
    return slope, a[:, 2] - (slope * a[:, :2]).sum(1)


def _pixel(edge, count):
    """The first pixel whose centre lies at or beyond an edge, within 0 to count."""
    return np.ceil(np.clip(edge, -1.0, count + 1.0) - 0.5).clip(0, count).astype(int)


def _cross(u, v):
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
