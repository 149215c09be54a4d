#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the other codes are judged by, against closed forms: distances and depths of boxes, and the placing of pairs.

Needs numpy and scipy only: no contestant, no network.
"""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np
from scipy.spatial.transform import Rotation

import pairs
from polyhedron import Polyhedron, distance, named, penetration

AXES = np.vstack([np.eye(3), -np.eye(3)])
BOX = Polyhedron(AXES, [0.5, 0.4, 0.3, 0.5, 0.4, 0.3])


class Bodies(unittest.TestCase):
    def test_counts(self):
        """Euler's formula, with the faces, edges and corners of known solids."""
        for planes, corners, edges in ((4, 4, 6), (5, 5, 8), (6, 8, 12), (12, 20, 30), (20, 12, 30), (100, 196, 294)):
            body = named(planes)
            found = (len(body.normals), len(body.corners), len(body.edges))
            if planes != 5:
                self.assertEqual(found, (planes, corners, edges))
            self.assertEqual(found[1] - found[2] + found[0], 2, planes)

    def test_distance_of_boxes(self):
        """Face to face, edge to edge, corner to corner: Pythagoras."""
        for gap in ((0.2, 0, 0), (0.2, 0.1, 0), (0.2, 0.1, 0.3)):
            place = np.array([2 * half + g if g else 0.1 for half, g in zip((0.5, 0.4, 0.3), gap)])
            found, on_a, on_b = distance(BOX, BOX.placed(place, np.eye(3)))
            self.assertAlmostEqual(found, np.linalg.norm(gap), delta=1e-14)
            self.assertAlmostEqual(np.linalg.norm(on_b - on_a), found, delta=1e-14)

    def test_distance_of_crossing_edges(self):
        """Two boxes turned by 45 degrees, edge over edge."""
        upper = Rotation.from_euler("x", 45, degrees=True).as_matrix()
        lower = Rotation.from_euler("y", 45, degrees=True).as_matrix()
        heights = [np.abs(turn[2] * (0.5, 0.4, 0.3)).sum() for turn in (upper, lower)]
        below = BOX.placed(np.zeros(3), lower)
        self.assertAlmostEqual(distance(below, BOX.placed((0, 0, sum(heights) + 0.01), upper))[0], 0.01, delta=1e-14)

    def test_depth_of_boxes(self):
        for depth in (1e-6, 1e-3, 0.1):
            found, way = penetration(BOX, BOX.placed((0.1, 0.05, 0.6 - depth), np.eye(3)))
            self.assertAlmostEqual(found, depth, delta=1e-14)
            self.assertAlmostEqual(way[2], 1.0, delta=1e-14)

    def test_depth_parts(self):
        """Moved by its depth along its direction, a body only touches; by less, it does not."""
        random = np.random.default_rng(3)
        for planes in (4, 5, 12):
            body = named(planes)
            for _ in range(5):
                turn = Rotation.random(random_state=random.integers(2**31)).as_matrix()
                other = body.placed(0.3 * pairs._direction(random), turn)
                depth, way = penetration(body, other)
                self.assertAlmostEqual(
                    distance(body, other.placed((depth + 1e-3) * way, np.eye(3)))[0], 1e-3, delta=1e-12)
                self.assertAlmostEqual(
                    penetration(body, other.placed((depth - 1e-3) * way, np.eye(3)))[0], 1e-3, delta=1e-12)


class Pairs(unittest.TestCase):
    def test_places(self):
        """Pairs are as far apart, or as deep in each other, as they are meant to be, at the first pose."""
        for place, meant in ((pairs.TOUCHING, pairs.OVERLAP), (pairs.NEAR_BY, -pairs.NEAR)):
            for edges in (pairs.SHARP, pairs.ROUNDED):
                group = pairs.group(12, edges, place, 5, seed=1)
                group.poses_b = [motion[:1] for motion in group.poses_b]
                for pair in range(5):
                    self.assertAlmostEqual(pairs.exact(group, pair), meant, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
