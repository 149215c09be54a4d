# SPDX-License-Identifier: MIT OR Apache-2.0
"""Equilibrium of scenes from Python: closed forms, a rock mass, and what is refused."""
import math
import unittest

import numpy as np
from potential_particles import equilibrium, rock

SQUARE = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]


def block(height, friction, force=(0, 0, -1), **more):
    scene = equilibrium.Scene()
    scene.add_body((0, 0, -1), held=True)
    scene.add_body((0, 0, height / 2), force=force, live_force=(1, 0, 0))
    scene.add_contact(0, 1, SQUARE, (0, 0, 1), friction=friction, **more)
    return scene


class Block(unittest.TestCase):
    def test_it_slides_or_turns_over(self):
        for height, friction in ((0.5, 0.5), (3.0, 0.5)):
            for dilatant in (False, True):
                found = block(height, friction).load_factor(dilatant=dilatant)
                self.assertAlmostEqual(found.factor, min(friction, 1 / height), delta=1e-6)
                np.testing.assert_allclose(found.forces.sum(axis=0), (-found.factor, 0, 1), atol=1e-6)
                self.assertGreater(found.mechanism[1, 0], 0.0)
                np.testing.assert_allclose(found.contacts, [(1, found.factor, found.factor / friction)], atol=1e-5)
                self.assertAlmostEqual(found.bound, found.factor, delta=1e-6)
        self.assertAlmostEqual(block(0.2, 0.5, cohesion=0.7).load_factor().factor, 1.2, delta=1e-6)

    def test_what_stands_has_forces_and_what_falls_a_mechanism(self):
        stands, falls = (block(0.5, friction, force=(0.4, 0, -1)).stands() for friction in (0.5, 0.3))
        self.assertTrue(stands.stands and len(stands.mechanism) == 0)
        np.testing.assert_allclose(stands.forces.sum(axis=0), (-0.4, 0, 1), atol=1e-6)
        self.assertTrue(not falls.stands and len(falls.forces) == 0 and falls.mechanism[1, 0] > 0)

    def test_anchors_bolts_and_stress_in_situ(self):
        self.assertAlmostEqual(block(0.5, 0.5).strength_factor(live=0.2).factor, 2.5, delta=1e-5)
        scene = block(0.5, 0.5)
        scene.add_force(1, (0, 0, 0.5), (0, 0, -3))
        scene.add_force(1, (0.25, 0, 0.25), (0.5, 0, 0), live=True)
        self.assertAlmostEqual(scene.load_factor().factor, 4 * 0.5 / 1.5, delta=1e-5)
        # A bolt of 0.001 m2 yields at 2,000.
        scene = equilibrium.Scene()
        scene.add_body((0, 0, -1), held=True)
        scene.add_body((0, 0, 0.25), force=(0, 0, -1), live_force=(0, 0, 1))
        scene.add_contact(0, 1, SQUARE, (0, 0, 1), friction=0.5)
        scene.add_contact(0, 1, [(0, 0, 0)], (0, 0, 1), friction=0.0, tension=2000.0, cohesion=1000.0, area=0.001)
        self.assertAlmostEqual(scene.load_factor().factor, 3.0, delta=1e-5)
        # Between two walls, pressed by 4 from the sides.
        for stress in (np.diag([4.0, 0, 0]), lambda at: np.diag([4.0 * (at[0] != 0), 0, 0])):
            scene = equilibrium.Scene()
            for x, held in ((-1, True), (0, False), (1, True)):
                scene.add_body((x, 0, 0), held=held, force=(0, 0, -1))
            for x, first in ((-0.5, 0), (0.5, 1)):
                square = [(x, y, z) for y, z, _ in SQUARE]
                scene.add_contact(first, first + 1, square, (1, 0, 0), friction=0.5)
            self.assertFalse(scene.stands().stands)
            scene.press(stress)
            self.assertAlmostEqual(scene.strength_factor().factor, 4.0, delta=1e-5)
        with self.assertRaisesRegex(ValueError, "stress"):
            scene.press([1.0, 2.0, 3.0])
        with self.assertRaises(ZeroDivisionError):
            scene.press(lambda at: 1 / 0)
        with self.assertRaisesRegex(ValueError, "body=7: the scene has 3 bodies"):
            scene.add_force(7, (0, 0, 0), (1, 0, 0))

    def test_what_is_refused(self):
        scene = block(0.5, 0.5)
        scene.add_body((0, 0, 9))
        with self.assertRaisesRegex(ValueError, "body 2 is free and has no contact"):
            scene.stands()
        with self.assertRaisesRegex(ValueError, "however small friction"):
            block(0.5, 0.5).strength_factor()
        with self.assertRaisesRegex(ValueError, "friction=35 is a coefficient.*35 degrees are 0.7002"):
            block(0.5, 35.0)


class Rock(unittest.TestCase):
    def test_blocks_on_one_joint(self):
        box = np.vstack([[s * a for a in row] + [1] for row in np.eye(3) for s in (1, -1)])
        mass = rock.slice(rock.Domain(box), [rock.joint((0, 0, 0), 25, 90), rock.joint((0, 0, 0), 90, 0)])
        held = [i for i, one in enumerate(mass) if one.centroid[2] < 0]
        scene = rock.limit_scene(mass, held, friction=0.8)
        self.assertEqual((scene.body_count, scene.contact_count), (4, 3))
        self.assertEqual(scene.corners.shape, (len(scene.contact_of_corner), 3))
        self.assertAlmostEqual(scene.strength_factor().factor, 0.8 / math.tan(math.radians(25)), delta=2e-6)
        with self.assertRaisesRegex(ValueError, "held must be numbers from 0 to 3"):
            rock.limit_scene(mass, [9])
        # Strength by joint: that of the joint on which it slides counts.
        for friction, expected in (((0.8, 0.1), 0.8), ((0.5, 9.0), 0.5)):
            scene = rock.limit_scene(mass, held, friction={**dict(enumerate(friction)), None: 0.0})
            found = scene.strength_factor().factor
            self.assertAlmostEqual(found, expected / math.tan(math.radians(25)), delta=2e-6)
        scene.push((1, 0, 0))
        self.assertGreater(scene.load_factor().factor, 0.0)
