# SPDX-License-Identifier: MIT OR Apache-2.0
"""A loose packing: a tower of bodies on a jittered grid, each turned at random."""

from dataclasses import dataclass

import numpy as np

TALLNESS = 1.6  # height over width of the tower


@dataclass
class LooseGrid:
    """Where and how bodies start; the grid stands on z = 0, centred on the z axis."""

    positions: np.ndarray  # (n, 3)
    orientations: np.ndarray  # (n, 4), unit quaternions w, x, y, z
    layers: np.ndarray  # (n,), from 0 at the bottom
    half_width: float  # of the grid with its cells
    height: float


def loose_grid(count, ball_radius, jitter, seed):
    """Places `count` bodies that each fit in a ball; jitter: the most along each axis, length.

    Cells are cubes so wide that no two balls can touch, however the bodies are turned.
    """
    random = np.random.default_rng(seed)
    side = int(np.ceil(round((count / TALLNESS) ** (1.0 / 3.0), 9)))
    cell = 2.0 * (ball_radius + jitter)
    index = np.arange(count)
    steps = np.column_stack([index % side, index // side % side, index // side**2])
    corner = np.array([0.5 - 0.5 * side, 0.5 - 0.5 * side, 0.5])
    positions = cell * (steps + corner) + random.uniform(-jitter, jitter, (count, 3))
    # Four normal deviates point evenly in all directions of quaternion space.
    orientations = random.normal(size=(count, 4))
    orientations /= np.linalg.norm(orientations, axis=1, keepdims=True)
    return LooseGrid(
        positions,
        orientations,
        layers=steps[:, 2],
        half_width=0.5 * side * cell,
        height=cell * (steps[-1, 2] + 1),
    )
