# SPDX-License-Identifier: MIT OR Apache-2.0
"""The picture of docs/shapes.md: one rock with several r and k.

    scripts/yade.sh -j1 docs/figures/shapes.py        # writes docs/pictures/shapes.png
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial import ConvexHull

import potential_particles
from potential_particles import shapes
from yade import Vector3

ROUNDINGS, SPHERICITIES = (0.005, 0.05, 0.25), (0.0, 0.2, 0.7)
DIRECTIONS = 8000
LIGHT = np.array([0.4, -0.6, 0.7])


def surface(shape):
    """Points of the surface in the principal frame, and triangles between them."""
    # Directions spread evenly on a spiral.
    i = np.arange(DIRECTIONS) + 0.5
    z, turn = 1.0 - 2.0 * i / DIRECTIONS, i * np.pi * (3.0 - np.sqrt(5.0))
    directions = np.column_stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z])
    lengths = np.array(potential_particles.conic_particle(shape).surfaceDistance([Vector3(*one) for one in directions]))
    points = directions * lengths[:, None]
    return points, ConvexHull(points)


def normals(shape, points):
    """Directions of the gradient of S at points (n, 3)."""
    planes = np.array(shape.planes)
    beyond = np.maximum(points @ planes[:, :3].T - planes[:, 3], 0.0)
    gradient = (1 - shape.k) / shape.r**2 * (beyond @ planes[:, :3]) + shape.k / shape.R**2 * points
    return gradient / np.linalg.norm(gradient, axis=1)[:, None]


def main():
    figure, axes = plt.subplots(3, 3, figsize=(7.2, 6.2), dpi=78, subplot_kw={"projection": "3d"})
    for row, r in zip(axes, ROUNDINGS):
        for axis, k in zip(row, SPHERICITIES):
            shape = shapes.random_rock(4, elongation=0.8, flatness=0.75, faces=14, rounding=r, k=k)
            points, hull = surface(shape)
            bright = np.clip(normals(shape, points)[hull.simplices].mean(1) @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1)
            colours = (0.25 + 0.75 * bright)[:, None] * np.array([0.80, 0.68, 0.52])
            axis.add_collection3d(
                Poly3DCollection(points[hull.simplices], facecolors=colours, edgecolors=colours, linewidths=0.5,
                                 antialiased=False))
            for limits in (axis.set_xlim, axis.set_ylim, axis.set_zlim):
                limits(-0.42, 0.42)
            axis.set_box_aspect((1, 1, 1))
            axis.view_init(24, -60)
            axis.set_axis_off()
            axis.set_title(f"r = {r:g},  k = {k:g}", fontsize=9, y=0.94)
    figure.subplots_adjust(0, 0, 1, 0.97, 0, 0)
    figure.savefig("docs/pictures/shapes.png")


main()
