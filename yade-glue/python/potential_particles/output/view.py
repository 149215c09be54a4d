# SPDX-License-Identifier: GPL-3.0-or-later
"""A pinhole camera, and how far it has to stand off. World frame, z up."""
from dataclasses import dataclass

import numpy as np

from ..arguments import unit as direction


@dataclass
class View:
    """A pinhole camera at `eye`, looking at `target`; `angle` is the full height of view, radians."""

    eye: np.ndarray
    target: np.ndarray
    angle: float

    def axes(self):
        """Right, up, forward."""
        forward = unit(self.target - self.eye)
        # Straight down or up, right is anywhere.
        across = np.cross(forward, [0.0, 0.0, 1.0])
        right = unit(across if np.linalg.norm(across) > 1e-6 else np.cross(forward, [0.0, 1.0, 0.0]))
        return np.stack([right, np.cross(right, forward), forward])


def framing_view(points, towards, angle, aspect, margin=1.03):
    """The view from direction `towards` (scene to eye) that just holds `points` (n, 3).

    aspect: width over height of the picture; margin: 1 fits tightly.
    """
    points, towards = np.asarray(points, float), direction(towards, "towards")
    half_y = np.tan(0.5 * angle) / margin
    half_x = half_y * aspect
    target, distance = points.mean(0), np.ptp(points, axis=0).max() * 4.0
    for _ in range(20):
        view = View(target + distance * towards, target, angle)
        right, up, forward = view.axes()
        x, y, near = (points - target) @ right, (points - target) @ up, (points - target) @ forward
        distance = max((np.abs(x) / half_x - near).max(), (np.abs(y) / half_y - near).max())
        spread_x, spread_y = x / (distance + near), y / (distance + near)
        target = target + 0.5 * distance * (
            (spread_x.max() + spread_x.min()) * right + (spread_y.max() + spread_y.min()) * up)
    return View(target + distance * towards, target, angle)


def unit(vector):
    """A vector, or rows of vectors, of unit length."""
    vector = np.asarray(vector, float)
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)
