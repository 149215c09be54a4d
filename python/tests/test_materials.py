# SPDX-License-Identifier: MIT OR Apache-2.0
"""What is suggested for a material, against the motion of a mass on a spring."""
import math
import unittest

import potential_particles as pp


def deepest(mass, stiffness, speed, force, step):
    """Largest overlap of a mass on a spring, by leapfrog."""
    depth = most = 0.0
    while depth >= most:
        most = depth
        speed += step * (force - stiffness * depth) / mass
        depth += step * speed
    return most


class Materials(unittest.TestCase):
    def test_the_largest_overlap_is_kept(self):
        for more in (dict(fall=0.7), dict(fall=0.02, r=1e-4), dict(fall=3.0, overlap=0.5, density=1000)):
            found = pp.suggest("rock", size=0.1, **more)
            mass = found.density * math.pi / 6 * 0.1**3
            most = deepest(mass, found.normal_stiffness, math.sqrt(2 * 9.81 * more["fall"]), 0.0, found.time_step / 50)
            self.assertEqual(found.asked_by, "impact")
            self.assertAlmostEqual(most / found.largest_overlap, 1, delta=1e-3)
        found = pp.suggest("sand", size=1e-3, load=2.0)
        self.assertEqual(found.asked_by, "weight")
        self.assertAlmostEqual(2.0 / found.normal_stiffness, found.largest_overlap, delta=1e-18)

    def test_the_time_step_is_stable(self):
        # A ball on three springs, each at a corner of its box that holds both its way and its turn: omega^2 is at most
        # the sum of k (1/m + |x|^2 / I), of which two bodies share each spring.
        found = pp.suggest("brick", size=0.2, fall=0.1)
        mass = found.density * math.pi / 6 * 0.2**3
        omega = math.sqrt(2 * 3 * found.normal_stiffness * (1 / mass + 3 * 0.1**2 / (0.4 * mass * 0.1**2)))
        self.assertAlmostEqual(found.time_step * omega, 1.0, delta=1e-12)

    def test_arguments_of_yade(self):
        found = pp.suggest("ballast", size=0.05, depth=0.3, friction=0.7, energy_matters=True)
        self.assertEqual(found.frict_mat()["frictionAngle"], math.atan(0.7))
        self.assertAlmostEqual(found.frict_mat()["young"] * 0.025, found.normal_stiffness)
        self.assertEqual(found.damping, 0.0)

    def test_refused(self):
        for given, sentence in [
            (dict(material="cheese", size=1, fall=1), "material='cheese': there are rock, ballast, sand, brick"),
            (dict(fall=1), "size=None: give the diameter"),
            (dict(size=1), "fall=depth=load=0: give the height"),
            (dict(size=-1, fall=1), "size=-1 must be above 0"),
            (dict(size=1, fall=-1), "fall=-1 must lie between"),
            (dict(size=1, fall=1, overlap=2), "overlap=2 must lie between"),
            (dict(size=1, fall=1, friction=35), "friction=35 must lie between 0 and 3")]:
            with self.assertRaisesRegex(ValueError, sentence.replace("(", r"\(")):
                pp.suggest(**given)
