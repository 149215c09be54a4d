# SPDX-License-Identifier: MIT OR Apache-2.0
"""A triangle mesh of a potential particle, dense where it bends.

The planes give a sharp polyhedron. Each of its faces is covered with rings of points that crowd
towards its edges, along edges that crowd towards their corners; every point is then moved along
its ray from the centre onto the true surface. A few hundred points so show rounded edges that an
even subdivision of a sphere would blur with many thousands.
"""

from itertools import combinations

import numpy as np

# Fractions from the middle of a face (0) to its edge (1), and from an edge's middle to its end.
RINGS = (0.86, 0.95, 1.0)
ALONG_EDGE = (0.0, 0.86, 0.95, 1.0)


def polyhedron_faces(normals, offsets):
    """Corner polygons, counter-clockwise from outside, of {x: n_i.x <= offset_i}: one (m, 3) a face."""
    normals, offsets = np.asarray(normals, float), np.asarray(offsets, float)
    size = np.abs(offsets).max()
    corners = []
    for triple in combinations(range(len(normals)), 3):
        matrix = normals[list(triple)]
        if abs(np.linalg.det(matrix)) < 1e-9:
            continue
        corner = np.linalg.solve(matrix, offsets[list(triple)])
        inside = (normals @ corner <= offsets + 1e-9 * size).all()
        if inside and all(np.linalg.norm(corner - c) > 1e-9 * size for c in corners):
            corners.append(corner)
    corners = np.array(corners)
    faces = []
    for normal, offset in zip(normals, offsets):
        on_face = corners[np.abs(corners @ normal - offset) < 1e-7 * size]
        if len(on_face) >= 3:
            faces.append(_around(on_face, normal))
    return faces


def _around(points, normal):
    """Points of one plane, sorted counter-clockwise about their middle as seen against `normal`."""
    arms = points - points.mean(0)
    first = arms[0] / np.linalg.norm(arms[0])
    second = np.cross(normal, first)
    return points[np.argsort(np.arctan2(arms @ second, arms @ first))]


def sharp_mesh(normals, offsets, rings=RINGS, along_edge=ALONG_EDGE):
    """Points (n, 3) and triangles (m, 3) on the sharp polyhedron; faces share no points."""
    half = np.asarray(along_edge, float)
    fractions = 0.5 + 0.5 * np.concatenate([-half[:0:-1], half])[:-1]
    points, triangles, count = [], [], 0
    for polygon in polyhedron_faces(normals, offsets):
        middle = polygon.mean(0)
        ends = np.roll(polygon, -1, axis=0)
        border = (polygon[:, None] + fractions[:, None] * (ends - polygon)[:, None]).reshape(-1, 3)
        width = len(border)
        points.append(middle[None])
        points.extend(middle + ring * (border - middle) for ring in rings)
        here = count + 1 + np.arange(width)
        there = np.roll(here, -1)
        triangles.append(np.column_stack([np.full(width, count), here, there]))
        for level in range(1, len(rings)):
            low, high = (level - 1) * width, level * width
            triangles.append(np.column_stack([here + low, here + high, there + high]))
            triangles.append(np.column_stack([here + low, there + high, there + low]))
        count += 1 + width * len(rings)
    return np.vstack(points), np.vstack(triangles).astype(np.int32)


def surface_mesh(surface, rings=RINGS, along_edge=ALONG_EDGE):
    """Points, unit outward normals and triangles (counter-clockwise from outside), local frame.

    `surface`: a PotentialSurface whose planes enclose a bounded volume around the centre.
    """
    rays, triangles = sharp_mesh(surface.normals, surface.offsets + surface.r, rings, along_edge)
    unit = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    points = unit * surface.distance(unit)[:, None]
    points, triangles = _weld(points, triangles)
    return points, surface.outward(points), triangles


def _weld(points, triangles):
    """Joins the points that neighbouring faces have in common, so that the mesh is closed."""
    size = np.abs(points).max()
    _, first, where = np.unique(np.round(points / size, 9), axis=0, return_index=True, return_inverse=True)
    return points[first], where.reshape(-1)[triangles].astype(np.int32)
