# SPDX-License-Identifier: MIT OR Apache-2.0
"""Convex polyhedra with their faces, corners and edges, and the exact distance or penetration depth of two of them.

Independent of every contestant: closest features are found by trying all that can matter, and the answer is checked
from both sides (a pair of points bounds a distance from above, a direction from below). Lengths in one unit, bodies of
size 1.
"""

import numpy as np
from scipy.spatial import ConvexHull, HalfspaceIntersection


class Polyhedron:
    """{x : normals·x <= offsets}, origin inside: corners (n, 3), triangles (m, 3) outwards, edges (k, 2)."""

    def __init__(self, normals, offsets):
        self.normals = np.asarray(normals, float)
        self.offsets = np.asarray(offsets, float)
        corners = HalfspaceIntersection(np.column_stack([self.normals, -self.offsets]), np.zeros(3)).intersections
        # A corner where more than three faces meet comes several times.
        kept = []
        for corner in corners:
            if not kept or np.min(np.linalg.norm(np.array(kept) - corner, axis=1)) > 1e-9:
                kept.append(corner)
        self.corners = np.array(kept)
        hull = ConvexHull(self.corners)
        outward = np.einsum("ij,ij->i", _cross(self.corners, hull.simplices), hull.equations[:, :3]) > 0
        self.triangles = np.where(outward[:, None], hull.simplices, hull.simplices[:, ::-1])
        on_face = np.abs(self.corners @ self.normals.T - self.offsets) < 1e-8
        self.edges = np.array(sorted(self._edges(on_face)))

    def _edges(self, on_face):
        """Sides of triangles whose ends lie on two common faces: the others are diagonals of a face."""
        sides = {tuple(sorted((t[i], t[i - 1]))) for t in self.triangles for i in range(3)}
        return {(a, b) for a, b in sides if (on_face[a] & on_face[b]).sum() >= 2}

    def radius(self):
        return float(np.linalg.norm(self.corners, axis=1).max())

    def placed(self, position, rotation):
        """The same body elsewhere."""
        moved = object.__new__(Polyhedron)
        moved.normals = self.normals @ rotation.T
        moved.offsets = self.offsets + moved.normals @ position
        moved.corners = self.corners @ rotation.T + position
        moved.triangles, moved.edges = self.triangles, self.edges
        return moved


def _cross(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def pyramid():
    slope = np.sqrt(5.0)
    sides = [(2, 0, 1), (-2, 0, 1), (0, 2, 1), (0, -2, 1)]
    return Polyhedron([*(np.array(side) / slope for side in sides), (0, 0, -1)], [0.3] * 4 + [0.25])


def regular(planes):
    """Tetrahedron, cube, dodecahedron or icosahedron with inner radius 0.5 (the tetrahedron: 0.3)."""
    golden = (1 + np.sqrt(5)) / 2
    if planes == 4:
        normals = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    elif planes == 6:
        normals = [*np.eye(3), *-np.eye(3)]
    elif planes == 12:
        normals = [np.roll((0, a, b * golden), i) for i in range(3) for a in (-1, 1) for b in (-1, 1)]
    else:
        cube = [(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
        normals = cube + [np.roll((0, a / golden, b * golden), i) for i in range(3) for a in (-1, 1) for b in (-1, 1)]
    normals = np.array(normals, float)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return Polyhedron(normals, np.full(len(normals), 0.3 if planes == 4 else 0.5))


def ball(planes):
    """Planes on a golden spiral about a ball of radius 0.5: every one of them is a face."""
    i = np.arange(planes)
    z = 1 - (2 * i + 1) / planes
    angle = 2 * np.pi * i / ((1 + np.sqrt(5)) / 2)
    across = np.sqrt(1 - z * z)
    return Polyhedron(np.column_stack([across * np.cos(angle), across * np.sin(angle), z]), np.full(planes, 0.5))


def named(planes):
    return pyramid() if planes == 5 else regular(planes) if planes in (4, 6, 12, 20) else ball(planes)


def penetration(a, b, rows=200):
    """(depth, direction from a to b): the least translation that parts two bodies that meet.

    h_a(n) + h_b(-n) is an upper bound of it for every unit n, and some face normal or cross product of two edges
    attains it. Only edges that come as near to the other body as the best face says can take part.
    """
    candidates = np.vstack([a.normals, -b.normals])
    depths = _depths(a, b, candidates)
    best = np.argmin(depths)
    depth, direction = depths[best], candidates[best]
    along_a, along_b = (_near_edges(one, other, depth) for one, other in ((a, b), (b, a)))
    for start in range(0, len(along_a), rows):
        crosses = np.cross(along_a[start : start + rows, None], along_b[None]).reshape(-1, 3)
        lengths = np.linalg.norm(crosses, axis=1)
        crosses = crosses[lengths > 1e-9] / lengths[lengths > 1e-9][:, None]
        for sense in (crosses, -crosses):
            if len(sense) == 0:
                continue
            depths = _depths(a, b, sense)
            best = np.argmin(depths)
            if depths[best] < depth:
                depth, direction = depths[best], sense[best]
    return float(depth), direction


def _depths(a, b, directions):
    return (a.corners @ directions.T).max(axis=0) - (b.corners @ directions.T).min(axis=0)


def _near_edges(one, other, reach):
    """Unit vectors along those edges of `one` that may come as near to `other` as `reach`."""
    heights = one.corners @ other.normals.T - other.offsets
    lowest = np.minimum(heights[one.edges[:, 0]], heights[one.edges[:, 1]]).max(axis=1)
    edges = one.edges[lowest <= reach]
    along = one.corners[edges[:, 1]] - one.corners[edges[:, 0]]
    return along / np.linalg.norm(along, axis=1)[:, None]


def distance(a, b, tolerance=1e-13):
    """(distance, point on a, point on b) of two bodies apart: corner to face and edge to edge, whichever is least."""
    reach = _first_reach(a, b)
    best = (np.inf, None, None)
    for one, other, swapped in ((a, b, False), (b, a, True)):
        found = _corner_to_face(one, other)
        if found[0] < best[0]:
            best = (found[0], found[2], found[1]) if swapped else found
    reach = min(reach, best[0]) * (1 + 1e-9)
    found = _edge_to_edge(*(_segments(one, other, reach) for one, other in ((a, b), (b, a))))
    best = min(best, found, key=lambda one: one[0])
    direction = (best[2] - best[1]) / best[0]
    below = (b.corners @ direction).min() - (a.corners @ direction).max()
    if not abs(best[0] - below) <= tolerance * max(1.0, np.abs(a.corners).max() + np.abs(b.corners).max()):
        raise ArithmeticError(f"the distance {best[0]!r} is not proved: the bodies are known to be {below!r} apart")
    return best


def _first_reach(a, b):
    return np.linalg.norm(a.corners[:, None] - b.corners[None, :300], axis=2).min()


def _corner_to_face(one, other):
    """Least distance of a corner of `one` to a face of `other` that it stands over; the points on both."""
    heights = one.corners @ other.normals.T - other.offsets
    face = heights.argmax(axis=1)
    height = heights[np.arange(len(face)), face]
    feet = one.corners - height[:, None] * other.normals[face]
    inside = ((feet @ other.normals.T - other.offsets).max(axis=1) < 1e-13 * 10) & (height > 0)
    if not inside.any():
        return (np.inf, None, None)
    corner = np.flatnonzero(inside)[height[inside].argmin()]
    return (float(height[corner]), one.corners[corner], feet[corner])


def _segments(one, other, reach):
    heights = one.corners @ other.normals.T - other.offsets
    lowest = np.minimum(heights[one.edges[:, 0]], heights[one.edges[:, 1]]).max(axis=1)
    edges = one.edges[lowest <= reach]
    return one.corners[edges[:, 0]], one.corners[edges[:, 1]]


def _edge_to_edge(first, second):
    """Least distance of a segment of each set, ends included; the points on both."""
    p, u = np.repeat(first[0], len(second[0]), 0), np.repeat(first[1] - first[0], len(second[0]), 0)
    q, v = np.tile(second[0], (len(first[0]), 1)), np.tile(second[1] - second[0], (len(first[0]), 1))
    if len(p) == 0:
        return (np.inf, None, None)
    w = p - q
    dot = lambda x, y: np.einsum("ij,ij->i", x, y)
    uu, uv, vv, uw, vw = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    determinant = uu * vv - uv * uv
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.where(determinant > 1e-14 * uu * vv, np.clip((uv * vw - vv * uw) / determinant, 0, 1), 0.0)
    # Twice to and fro: each is the best against the other, which is the least distance of two segments.
    for _ in range(2):
        t = np.clip((uv * s + vw) / vv, 0, 1)
        s = np.clip((uv * t - uw) / uu, 0, 1)
    x, y = p + s[:, None] * u, q + t[:, None] * v
    lengths = np.linalg.norm(x - y, axis=1)
    best = lengths.argmin()
    return (float(lengths[best]), x[best], y[best])
