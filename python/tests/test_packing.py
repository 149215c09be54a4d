# SPDX-License-Identifier: MIT OR Apache-2.0
"""Packings: nothing overlaps, seeds repeat, what is interrupted or does not fit is told, bad input is refused."""
import os
import re
import signal
import unittest

import numpy as np
import potential_particles as pp
import pytest
from potential_particles import packing, progress, shapes

ROCKS = [shapes.random_rock(seed, elongation=0.8, flatness=0.7) for seed in range(5)]
BOX = packing.Box((0, 0, 0), (5, 5, 12))


class Packings(unittest.TestCase):
    def test_nothing_overlaps(self):
        stones = [shapes.random_rock(seed) for seed in range(3)]
        placed = packing.pack(packing.Box((0, 0, 0), (6, 6, 6)), stones, number=30, seed=5, progress=False)
        self.assertEqual(len(placed), 30)
        bodies = [one.shape.scaled(one.scale) for one in placed]
        poses = [pp.Pose(np.add(one.position, pp.Pose((0, 0, 0), one.orientation).rotation @ shape.centroid),
                         product(one.orientation, shape.orientation)) for one, shape in zip(placed, bodies)]
        for one, body, pose in zip(placed, bodies, poses):
            self.assertEqual(one.particle, body.particle)
            np.testing.assert_allclose(one.pose.position, pose.position, rtol=0, atol=1e-12)
            np.testing.assert_allclose(one.pose.rotation, pose.rotation, rtol=0, atol=1e-12)
        for i in range(30):
            for j in range(i):
                self.assertFalse(pp.detect(bodies[i].particle, poses[i], bodies[j].particle, poses[j]).overlapping)


def product(first, second):
    """Of two quaternions w, x, y, z."""
    (a, *u), (b, *v) = first, second
    return (a * b - np.dot(u, v), *(a * np.array(v) + b * np.array(u) + np.cross(u, v)))


def test_seeds_repeat_and_threads_do_not_matter():
    first, again, other = (packing.pack(BOX, ROCKS, number=30, dense=True, seed=seed, threads=threads, progress=False)
                           for seed, threads in ((1, 1), (1, 2), (2, 1)))
    assert first == again and first != other


def test_what_fits_comes_back(capfd):
    few = packing.pack(packing.Box((0, 0, 0), (2, 2, 2)), shapes.sphere(0.5), number=100)
    said = capfd.readouterr().err
    assert 0 < len(few) < 8 and f"packed {len(few)} of 100 bodies" in said and "no more fit" in said
    assert len(packing.pack(BOX, ROCKS, number=3, progress=False)) == 3
    assert capfd.readouterr().err == ""


def test_ctrl_c_keeps_what_has_its_place(capfd, monkeypatch):
    before = signal.getsignal(signal.SIGINT)
    monkeypatch.setattr(progress.Bar, "reached",
                        lambda self, count: os.kill(os.getpid(), signal.SIGINT) if count >= 20 else None)
    some = packing.pack(BOX, ROCKS, number=500, dense=True)
    assert 20 <= len(some) < 100 and "stopped by Ctrl-C" in capfd.readouterr().err
    assert signal.getsignal(signal.SIGINT) == before
    monkeypatch.setattr(progress.Bar, "reached", lambda self, count: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        packing.pack(BOX, ROCKS, number=5)


@pytest.mark.parametrize("container, bodies, more, words", [
    (BOX, [], dict(number=5), "shapes is empty"), (BOX, [3], dict(number=5), "not a Shape"),
    ((1, 2, 3), ROCKS, dict(number=5), "not a packing.Box"),
    (BOX, ROCKS, dict(number=0), "number=0"), (BOX, ROCKS, dict(number=5, seed=-1), "seed=-1"),
    (BOX, ROCKS, dict(number=5, margin=-1), "margin=-1"), (BOX, ROCKS, dict(number=5, sizes=-1), "sizes=-1"),
    (BOX, ROCKS, dict(number=5, sizes=[]), "sizes is empty"),
    (BOX, ROCKS, dict(number=5, sizes=[(1, 0.5), (2, 0.4)]), "add up to 0.9"),
    (BOX, ROCKS, dict(number=5, sizes=[(1, 0.5), (-2, 0.5)]), "size -2.0 (entry 1)"),
    (BOX, ROCKS, dict(number=5, sizes=[(1, 0), (2, 0.4)], shares="passing"), "grading curve"),
    (BOX, ROCKS, dict(number=5, sizes=[(1, 1)], shares="weight"), "shares='weight'"),
    (packing.Box((0, 0, 0), (1, 0, 1)), ROCKS, dict(number=5), "no volume"),
    (packing.Box((0, 0, 0), (0.1, 1, 1)), ROCKS, dict(number=5), "no body fits"),
    (packing.Cylinder((0, 0, 0), -1, 1), ROCKS, dict(number=5), "radius=-1")])
def test_what_is_refused(container, bodies, more, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        packing.pack(container, bodies, **more)
