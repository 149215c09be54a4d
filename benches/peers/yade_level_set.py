# SPDX-License-Identifier: MIT OR Apache-2.0
"""Bodies of YADE's LevelSet class from a convex hull that is swept by a ball; inside YADE only."""

import numpy as np
import yade
from yade import Vector3, utils

GRID, NODES = 25, 500  # cells across the body, and nodes on its surface
MARGIN = 3  # cells around the body


def signed_distances(corners, triangles, swept):
    """A grid about the body, and the distance to its surface at every point of it, negative inside."""
    corners = np.asarray(corners, float)
    low, high = corners.min(axis=0) - swept, corners.max(axis=0) + swept
    step = (high - low).max() / GRID
    counts = np.ceil((high - low) / step).astype(int) + 2 * MARGIN + 1
    start = low - MARGIN * step
    grid = yade.RegularGrid(min=Vector3(*start), nGP=yade.Vector3i(*map(int, counts)), spacing=float(step))
    axes = [start[i] + step * np.arange(counts[i]) for i in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return grid, (_hull_distance(corners, triangles, points) - swept).reshape(counts).tolist()


def body(grid, field, material):
    return utils.levelSetBody(grid=grid, distField=field, nSurfNodes=NODES, material=material)


def _hull_distance(corners, triangles, points):
    """Inside minus the distance to the nearest face, outside that to the nearest point of a triangle."""
    least, highest = np.full(len(points), np.inf), np.full(len(points), -np.inf)
    for triangle in triangles:
        a, b, c = corners[list(triangle)]
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal)
        highest = np.maximum(highest, (points - a) @ normal)
        least = np.minimum(least, _triangle_distance(points, (a, b, c), normal))
    return np.where(highest > 0, least, highest)


def _triangle_distance(points, corners, normal):
    inside = np.ones(len(points), bool)
    to_edges = np.full(len(points), np.inf)
    for p, q in zip(corners, (*corners[1:], corners[0])):
        along = q - p
        inside &= (points - p) @ np.cross(normal, along) >= 0
        share = np.clip((points - p) @ along / (along @ along), 0, 1)
        to_edges = np.minimum(to_edges, np.linalg.norm(points - p - share[:, None] * along, axis=1))
    return np.where(inside, np.abs((points - corners[0]) @ normal), to_edges)
