# SPDX-License-Identifier: GPL-3.0-or-later
"""One sun, and a sky of many faint ones, whose shadows add up to the darkening of gaps and contacts.

A light is far away. Whether a point sees it is read from a map: the nearest surface to the light on a grid across its
direction.
"""
import numpy as np

from .rasteriser import nearest_triangles
from .view import unit

SUN = unit([-0.45, -0.55, 1.0])  # from the scene to the sun
SUN_PIXELS = 1000  # of its map, along the longer side
SKY_LIGHTS = 14
SKY_PIXELS = 200
SUN_SHARE, SKY_SHARE = 0.62, 0.50  # of the light; their sum may exceed 1 where both reach fully
BOUNCE = 0.10  # from below, so that undersides do not turn black


class ShadowMap:
    """The surface nearest to a light in `direction` (scene to light); triangles: (n, 3, 3), world frame."""

    def __init__(self, triangles, direction, pixels):
        across = np.cross(direction, [0.0, 1.0, 0.1])
        side = unit(across)
        # Right, down, and towards the light.
        self.axes = np.stack([side, np.cross(side, direction), direction])
        corners = triangles @ self.axes.T
        self.low = corners[:, :, :2].min((0, 1))
        extent = np.ptp(corners[:, :, :2], axis=(0, 1))
        self.step = extent.max() / pixels
        corners[:, :, :2] = (corners[:, :, :2] - self.low) / self.step
        width, height = np.ceil(extent / self.step).astype(int) + 1
        self.nearest, _ = nearest_triangles(corners, width, height)

    def lit(self, points, normals):
        """Whether points (n, 3), with outward normals, see the light."""
        # From slightly above their own surface, by about one pixel of the map.
        axes = self.axes.astype(points.dtype)
        x, y, height = axes @ (points + points.dtype.type(1.5 * self.step) * normals).T
        column, row = ((x - self.low[0]) / self.step).astype(np.int32), ((y - self.low[1]) / self.step).astype(np.int32)
        inside = (column >= 0) & (row >= 0) & (column < self.nearest.shape[1]) & (row < self.nearest.shape[0])
        lit = np.ones(len(points), bool)
        lit[inside] = height[inside] >= self.nearest[row[inside], column[inside]]
        return lit


def brightness(points, normals, triangles):
    """Light that falls on points (n, 3) with normals (n, 3), about 0 to 1, among these triangles (m, 3, 3)."""
    points, normals = points.astype(np.float32), normals.astype(np.float32)
    lights = [(SUN, SUN_SHARE, SUN_PIXELS)]
    sky = _sky()
    share = SKY_SHARE / np.maximum(sky[:, 2], 0.0).sum()
    lights += [(direction, share, SKY_PIXELS) for direction in sky]
    light = BOUNCE * (0.5 - 0.5 * normals[:, 2])
    for direction, strength, pixels in lights:
        facing = normals @ direction
        seen = np.flatnonzero(facing > 0.0)
        if len(triangles):
            seen = seen[ShadowMap(triangles, direction, pixels).lit(points[seen], normals[seen])]
        light[seen] += strength * facing[seen]
    return light


def _sky():
    """Evenly spread directions of the upper half sphere (golden spiral)."""
    index = np.arange(SKY_LIGHTS) + 0.5
    z = 1.0 - index / SKY_LIGHTS * 0.95
    angle = np.pi * (1.0 + np.sqrt(5.0)) * index
    flat = np.sqrt(1.0 - z**2)
    return np.stack([flat * np.cos(angle), flat * np.sin(angle), z], axis=1)
