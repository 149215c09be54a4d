# SPDX-License-Identifier: MIT OR Apache-2.0
"""Contacts of one pair and of many, against definitions and closed forms."""
import copy
import pickle
import re
import threading
import unittest

import numpy as np
import potential_particles as pp
from potential_particles import rock

BOX = [(1, 0, 0, 5), (-1, 0, 0, 5), (0, 1, 0, 5), (0, -1, 0, 5), (0, 0, 1, 5), (0, 0, -1, 5)]

CUBE = np.array([(1, 0, 0, 0.9), (-1, 0, 0, 0.9), (0, 1, 0, 0.9), (0, -1, 0, 0.9), (0, 0, 1, 0.9), (0, 0, -1, 0.9)])


def cube(k=0.0):
    return pp.Particle(CUBE, 0.1, k, 2.0)


def scene(count=400, seed=1):
    """Bodies of three kinds near each other: particles, poses, all pairs of neighbours by number."""
    random = np.random.default_rng(seed)
    kinds = [cube(), cube(0.1), pp.Particle.sphere(1.0)]
    poses = np.zeros(count, pp.pose_type)
    poses["position"] = random.uniform(0, 1.2 * count ** (1 / 3), (count, 3))
    poses["orientation"] = random.normal(size=(count, 4))
    pairs = np.array([(i, (i + j) % count) for i in range(count) for j in (1, 2, 5)], np.uint32)
    return [kinds[i % 3] for i in range(count)], poses, pairs


class OnePair(unittest.TestCase):
    def test_spheres(self):
        ball = pp.Particle.sphere(1.0)
        contact = pp.detect(ball, pp.Pose((0, 0, 0)), ball, pp.Pose((0, 1.5, 0)))
        self.assertTrue(contact.overlapping)
        self.assertEqual(contact.kind, "overlapping")
        self.assertAlmostEqual(contact.overlap, 0.5, delta=1e-12)
        self.assertAlmostEqual(contact.s, 0.75, delta=1e-12)
        np.testing.assert_allclose(contact.normal, (0, 1, 0), atol=1e-12)
        np.testing.assert_allclose(contact.point, (0, 0.75, 0), atol=1e-12)
        apart = pp.detect(ball, pp.Pose((0, 0, 0)), ball, pp.Pose((0, 2.5, 0)))
        self.assertEqual((apart.kind, apart.overlapping), ("separated", False))
        self.assertIn("rejected", apart.flags)
        self.assertTrue(np.isnan(apart.overlap))

    def test_midway_is_where_both_potentials_are_least(self):
        a, b = cube(0.05), cube(0.3)
        pose_a, pose_b = pp.Pose((0, 0, 0), (1, 0.1, 0.2, 0)), pp.Pose((0.2, 0.3, 1.8), (1, 0, 0.1, 0.4))
        contact = pp.detect(a, pose_a, b, pose_b)
        potentials = [
            particle.potential(pose.to_local(contact.point)) + 1 for particle, pose in ((a, pose_a), (b, pose_b))
        ]
        np.testing.assert_allclose(potentials, contact.s**2, atol=1e-10)
        for point, particle, pose in ((contact.point_on_a, a, pose_a), (contact.point_on_b, b, pose_b)):
            self.assertAlmostEqual(particle.potential(pose.to_local(point)), 0, delta=1e-9)
        np.testing.assert_allclose(contact.point_on_a - contact.point_on_b, contact.overlap * contact.normal,
                                   atol=1e-12)

    def test_closest(self):
        ball, settings = pp.Particle.sphere(1.0), pp.Settings("closest", weight_on_a=0.25)
        contact = pp.detect(ball, pp.Pose((0, 0, 0)), ball, pp.Pose((1.5, 0, 0)), settings)
        self.assertEqual(contact.formulation, "closest")
        np.testing.assert_allclose(contact.point, (0.5 + 0.25 * 0.5, 0, 0), atol=1e-12)
        deepest = pp.closest_point(ball, pp.Pose((0, 0, 0)), ball, pp.Pose((1.5, 0, 0)), "b")
        np.testing.assert_allclose(deepest.point, (0.5, 0, 0), atol=1e-12)
        self.assertIsNone(pp.closest_point(ball, pp.Pose((0, 0, 0)), ball, pp.Pose((0.5, 0, 0)), "a"))

    def test_a_state_starts_from_the_last_solution(self):
        a, state = cube(0.1), pp.PairState()
        poses = pp.Pose((0, 0, 0)), pp.Pose((0.1, 0.2, 1.9), (1, 0.1, 0, 0))
        first = pp.detect(a, poses[0], a, poses[1], None, state)
        again = pp.detect(a, poses[0], a, poses[1], None, state)
        self.assertNotIn("warm", first.flags)
        self.assertIn("warm", again.flags)
        self.assertAlmostEqual(first.s, again.s, delta=first.gap + again.gap)

    def test_area_and_patch(self):
        ball = pp.Particle.sphere(1.0)
        poses = pp.Pose((0, 0, 0)), pp.Pose((1.2, 0, 0))
        contact = pp.detect(ball, poses[0], ball, poses[1])
        self.assertAlmostEqual(pp.contact_area(ball, poses[0], ball, poses[1], contact), 0.64 * np.pi, delta=1e-10)
        for ask in (pp.contact_area, pp.patch_of_contact, pp.contact_derivatives):
            with self.assertRaisesRegex(ValueError, "the contact is of other poses"):
                ask(ball, poses[0], ball, pp.Pose((50, 0, 0)), contact)
        patch = pp.patch_of_contact(ball, poses[0], ball, poses[1], contact, tolerance=1e-8)
        # Equal balls meet in the flat disc of the section, and s = |x| there: K l times the integral of 1 - s over it.
        rho = np.sqrt(1 - 0.36)
        force = patch.length * 2 * np.pi * (rho**2 / 2 - ((0.36 + rho**2) ** 1.5 - 0.216) / 3)
        np.testing.assert_allclose(patch.force, (force, 0, 0), atol=1e-7)
        self.assertAlmostEqual(patch.area, 0.64 * np.pi, delta=1e-6)
        points = patch.points
        self.assertAlmostEqual((points[:, 3] * points[:, 4]).sum(), force, delta=1e-6)
        with_stiffness = pp.patch_of_contact(ball, poses[0], ball, poses[1], contact, stiffness=True, energy=True)
        self.assertEqual(with_stiffness.stiffness.shape, (6, 6))
        self.assertGreater(with_stiffness.energy, 0)

    def test_walls(self):
        ball, pose = pp.Particle.sphere(1.0), pp.Pose((3, 4, 0.75))
        contact = pp.contact_with_plane(ball, pose, pp.Wall((0, 0, 0), (0, 0, 2)))
        self.assertAlmostEqual(contact.overlap, 0.25, delta=1e-14)
        np.testing.assert_allclose(contact.normal, (0, 0, -1))
        triangle = pp.Triangle((3, 4, 0), (9, 4, 0), (9, 9, 0))
        at_corner = pp.contact_with_triangle(ball, pp.Pose((2.9, 3.9, 0.75)), triangle)
        self.assertEqual(at_corner.feature, ("vertex", 0))
        self.assertAlmostEqual(at_corner.s, np.sqrt(0.02 + 0.75**2), delta=1e-12)
        patch = pp.patch_on_plane(ball, pose, contact)
        self.assertAlmostEqual(patch.area, np.pi * (1 - 0.75**2), delta=1e-3)
        below = pp.patch_on_triangle(ball, pose, triangle, contact)
        self.assertLess(below.area, patch.area)


class Batches(unittest.TestCase):
    def test_each_answer_is_that_of_a_single_call(self):
        particles, poses, pairs = scene()
        for settings in (pp.Settings(), pp.Settings("closest"), pp.Settings(carry_tolerance=1e-9)):
            for threads in (1, 3):
                found = pp.detect_batch(particles, poses, pairs, settings, threads=threads)
                self.assertEqual(found.dtype, pp.contact_type)
                self.assertGreater((found["kind"] == pp.OVERLAPPING).sum(), 50)
                for (i, j), record in zip(pairs[::37], found[::37]):
                    pose = [pp.Pose(poses["position"][n], poses["orientation"][n]) for n in (i, j)]
                    alone = pp.detect(particles[i], pose[0], particles[j], pose[1], settings).record()
                    self.assertEqual(alone.tobytes(), record.tobytes())

    def test_arrays_are_read_and_written_in_place(self):
        particles, poses, pairs = scene(50)
        out = np.zeros(len(pairs), pp.contact_type)
        self.assertIs(pp.detect_batch(particles, poses, pairs, out=out), out)
        rows = poses.view(float).reshape(-1, 7)
        np.testing.assert_array_equal(out.view(np.uint64),
                                      pp.detect_batch(particles, rows, pairs.tolist()).view(np.uint64))
        for bad in (out[::2], np.zeros(len(pairs)), np.zeros(3, pp.contact_type)):
            with self.assertRaisesRegex(ValueError, "out"):
                pp.detect_batch(particles, poses, pairs, out=bad)
        out.flags.writeable = False
        with self.assertRaisesRegex(ValueError, "out"):
            pp.detect_batch(particles, poses, pairs, out=out)
        with self.assertRaisesRegex(ValueError, "poses"):
            pp.detect_batch(particles, rows.astype(np.float32), pairs)
        with self.assertRaisesRegex(ValueError, "49 poses given where 50"):
            pp.detect_batch(particles, poses[1:], pairs)

    def test_memories_follow_a_changing_list(self):
        particles, poses, pairs = scene(200)
        batch = pp.Batch(particles)
        first = batch.detect(poses, pairs)
        solved = first["kind"] == pp.OVERLAPPING
        self.assertFalse((first["flags"] & 8).any())
        random = np.random.default_rng(3)
        order = random.permutation(len(pairs))[: len(pairs) // 2]
        mixed = np.vstack([pairs[order], pairs[order, ::-1]])
        again = batch.detect(poses, mixed)
        known = np.zeros(len(mixed), bool)
        known[: len(order)] = solved[order]
        self.assertTrue((again["flags"][known] & 8).all(), "what was solved starts from its solution")
        self.assertFalse((again["flags"][len(order):] & 8).any(), "the pair (j, i) is another one than (i, j)")
        np.testing.assert_allclose(again["s"][known], first["s"][order][solved[order]], atol=1e-9)
        batch.forget()
        self.assertFalse((batch.detect(poses, pairs)["flags"] & 8).any())

    def test_a_missing_body_is_told_and_nothing_is_lost(self):
        particles, poses, pairs = scene(30)
        pairs[4] = 3, 30
        with self.assertRaisesRegex(IndexError, "pair 4: body 30 does not exist: there are 30") as raised:
            pp.detect_batch(particles, poses, pairs)
        contacts = raised.exception.contacts
        self.assertEqual([pair for pair, _ in raised.exception.failures], [4])
        self.assertEqual(np.flatnonzero(contacts["kind"] == pp.FAILED).tolist(), [4])
        poses["position"][7] = np.nan
        with self.assertRaisesRegex(ValueError, "body 7: position .* is not finite"):
            pp.detect_batch(particles, poses, pairs)

    def test_nothing_is_given_and_nothing_comes_back(self):
        particles, poses, pairs = scene(20)
        row = poses.view(float).reshape(-1, 7)
        buffer = np.zeros(8 * len(pairs) + 3, np.uint8)
        # No rows as numpy makes them: new, of a larger array, of a part of a buffer that begins anywhere.
        no_pairs = ([], (), np.zeros((0, 2), np.uint32), np.zeros((0, 2), np.int64), np.zeros(
            (0, 2)), pairs[:0], pairs[5:5], pairs[::-3][:0], buffer[3:3].view(np.uint32).reshape(0, 2),
                    np.column_stack([np.zeros(0, int)] * 2))
        no_contacts = (None, np.empty(0, pp.contact_type), np.empty(5, pp.contact_type)[3:3], buffer[1:1].view(
            pp.contact_type))
        no_poses = (np.zeros(0, pp.pose_type), np.zeros((0, 7)), poses[7:7], row[:0], buffer[1:1].view(pp.pose_type))
        for bodies, places in [(particles, poses), (particles, row), *(([], places) for places in no_poses)]:
            for given in no_pairs:
                for out in no_contacts:
                    for remember in (True, False):
                        batch = pp.Batch(bodies, remember=remember, threads=2)
                        for found in (batch.detect(places, given, out), pp.detect_batch(bodies, places, given,
                                                                                        out=out)):
                            self.assertEqual((found.shape, found.dtype), ((0,), pp.contact_type))
                        self.assertEqual((batch.pairs.shape, batch.solutions.shape), ((0, 2), (0, 8)))
        with self.assertRaisesRegex(IndexError, "pair 0: body 0 does not exist: there are 0"):
            pp.detect_batch([], no_poses[0], [[0, 0]])
        with self.assertRaisesRegex(ValueError, "0 poses given where 20"):
            pp.detect_batch(particles, poses[:0], [])
        with self.assertRaisesRegex(ValueError, "out has 1 records where 0"):
            pp.detect_batch(particles, poses, [], out=np.empty(1, pp.contact_type))

    def test_steps_without_pairs_forget_what_was_solved(self):
        batch = pp.Batch([pp.Particle.sphere(1.0)] * 2)
        flags = []
        for apart in (1.9, 5.0, 1.9, 1.9):
            poses = np.array([[0, 0, 0, 1, 0, 0, 0], [apart, 0, 0, 1, 0, 0, 0]], float)
            near = np.array([[0, 1]], np.uint32)[: int(apart < 2)]
            flags += [int(flag) & 8 for flag in batch.detect(poses, near)["flags"]]
        self.assertEqual(flags, [0, 0, 8])

    def test_arrays_that_begin_anywhere_in_memory(self):
        particles, poses, pairs = scene(20)
        expected = pp.detect_batch(particles, poses, pairs)

        def moved(array):
            buffer = np.zeros(array.nbytes + 1, np.uint8)[1:]
            buffer[:] = array.reshape(-1).view(np.uint8)
            return buffer.view(array.dtype).reshape(array.shape)
        self.assertFalse(moved(pairs).flags.aligned)
        for places in (moved(pairs), np.asfortranarray(pairs), moved(np.asfortranarray(pairs).T).T,
                       np.repeat(pairs, 2, 0)[::2]):
            found = pp.detect_batch(particles, poses, places)
            np.testing.assert_array_equal(found.view(np.uint64), expected.view(np.uint64))
        np.testing.assert_array_equal(pp.Particle(moved(CUBE), 0.1).planes, CUBE)
        for name, arguments in (("poses", (moved(poses), pairs)), ("out", (poses, pairs, None))):
            out = moved(expected) if name == "out" else None
            with self.assertRaisesRegex(ValueError, f"give a copy of it, {name}.copy()"):
                pp.detect_batch(particles, *arguments, out=out)

    def test_threads_share_a_batch(self):
        particles, poses, pairs = scene(300)
        expected, found, wrong = pp.detect_batch(particles, poses, pairs), [], []
        for remember in (True, False):
            batch = pp.Batch(particles, remember=remember)

            def steps():
                try:
                    for step in range(20):
                        few = pairs[: len(pairs) - step]
                        contacts = batch.detect(poses, few)
                        overlapping = contacts["kind"] == pp.OVERLAPPING
                        self.assertTrue((contacts["kind"] == expected["kind"][: len(few)]).all())
                        found.append(np.abs(contacts["s"] - expected["s"][: len(few)])[overlapping].max())
                        str(batch), batch.solutions, batch.pairs
                        if step % 7 == 3:
                            batch.forget()
                except BaseException as error:
                    wrong.append(error)
            threads = [threading.Thread(target=steps) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(wrong, [])
        self.assertLess(max(found), 1e-9)

    def test_an_array_in_use_is_told(self):
        particles, poses, pairs = scene(4)
        out = np.zeros(max(len(pairs), 4), pp.contact_type)
        places = out.view(np.uint8)[: poses.nbytes].view(pp.pose_type)
        places[:] = poses
        with self.assertRaisesRegex(ValueError, "no other argument or thread uses"):
            pp.detect_batch(particles, places, pairs, out=out[: len(pairs)])

    def test_other_threads_run_meanwhile(self):
        particles, poses, pairs = scene(3000)
        pairs = np.vstack([pairs] * 20)
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
        thread = threading.Thread(target=count)
        thread.start()
        before = counted[0]
        pp.detect_batch(particles, poses, pairs, pp.Settings(gap_tolerance=1e-14))
        meanwhile = counted[0] - before
        done.set()
        thread.join()
        self.assertGreater(meanwhile, 1000)


class Kept(unittest.TestCase):
    def test_pickle_and_copy(self):
        particle, wall = cube(0.3), pp.Wall((0, 0, 1), (0, 3, 4))
        things = [particle, pp.Pose((1, 2, 3), (1, 2, 0, 0)), pp.Settings("closest", gap_tolerance=1e-9)]
        for thing in things:
            for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
                self.assertEqual(pickle.loads(pickle.dumps(thing, protocol)), thing)
            self.assertEqual(copy.deepcopy(thing), thing)
        self.assertEqual(hash(copy.copy(particle)), hash(particle))
        self.assertEqual(repr(pickle.loads(pickle.dumps(wall))), repr(wall))
        state = pp.PairState()
        pp.detect(particle, pp.Pose((0, 0, 0)), particle, pp.Pose((0, 0, 1.9)), None, state)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(state)).solution, state.solution)

    def test_answers_are_pickled_and_copied(self):
        body, poses, floor = cube(0.3), [pp.Pose((0, 0, 0)), pp.Pose((0.1, 0.2, 1.9))], pp.Wall((0, 0, -0.97),
                                                                                                (0, 0, 3))
        contact, apart = pp.detect(body, poses[0], body, poses[1]), pp.detect(body, poses[0], body, pp.Pose((0, 0, 9)))
        flat = pp.contact_with_plane(body, poses[0], floor)
        patch = pp.patch_of_contact(body, poses[0], body, poses[1], contact)
        square = pp.Particle.polygon([(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)], r=0.05)
        places = pp.Pose.in_plane((0, 0)), pp.Pose.in_plane((1.9, 0.2))
        in_plane = pp.detect(square, places[0], square, places[1])
        mass = rock.slice(rock.Domain(BOX), [rock.JointSet(30, 90, 1.5, fisher=40), rock.joint((0, 1, 2), 50, 60, radius=2.0)])
        scene = rock.limit_scene(mass, [0, 1], friction=0.9)
        for one in [
                contact, apart, flat, patch,
                pp.closest_point(body, poses[0], body, poses[1], "a"),
                body.mass_properties(),
                body.mesh(0.01), in_plane,
                pp.patch_of_contact(square, places[0], square, places[1], in_plane),
                square.mass_properties(), scene, scene.stands(),
                pp.contact_derivatives(body, poses[0], body, poses[1], contact),
                pp.contact_gradient(body, poses[0], body, poses[1], contact, overlap=1.0),
                pp.boundary_gradient(body, poses[0], flat, overlap=1.0)
        ]:
            for again in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
                self.assertIs(type(again), type(one))
                self.same(again, one)
        make, (kind, version, state) = contact.__reduce__()
        for wrong in [(version, state[:9]), ("0.0.0", state)]:
            with self.assertRaisesRegex(ValueError, "pickle"):
                make(kind, *wrong)

    def same(self, found, expected):
        """All that can be read of both."""
        for name in (name for name in dir(type(expected)) if not name.startswith("_")):
            value, other = getattr(expected, name), getattr(found, name)
            if name in ("particle", "pose") and not callable(value):
                self.assertEqual(other, value)
            elif isinstance(value, pp.MassProperties):
                self.same(other, value)
            elif isinstance(value, list) and value and isinstance(value[0], np.ndarray):
                self.assertEqual([one.tolist() for one in other], [one.tolist() for one in value])
            elif not callable(value) and name != "blocks":
                np.testing.assert_array_equal(other, value, f"{type(expected)}.{name}")

    def test_directions_have_any_length(self):
        """Of a cube of half edge 0.5: closed forms."""
        body = pp.Particle((CUBE[:, :3], np.full(6, 0.5 - 1e-9)), 1e-9)
        for length in (1, 0.1, 2, 1e-300, 1e300, 5e-324):
            self.assertAlmostEqual(body.surface_distance((0, 0, 0), (length, 0, 0)), 0.5, 12)
            self.assertAlmostEqual(body.surface_distance((0.25, 0, 0), (length, 0, 0)), 0.25, 12)
            self.assertAlmostEqual(body.support((0, -length, 0)), 0.5, delta=2e-5)
        self.assertAlmostEqual(body.surface_distance((0, 0, 0), (1e-200, 1e-200, 0)), 0.5 * 2**0.5, 8)
        for none in [(0, 0, 0), (float("nan"), 0, 1), (float("inf"), 0, 0)]:
            for ask in (body.support, lambda direction: body.surface_distance((0, 0, 0), direction)):
                with self.assertRaisesRegex(ValueError, "direction = .*finite and not zero"):
                    ask(none)
        with self.assertRaisesRegex(ValueError, "start = .*finite"):
            body.surface_distance((0, float("nan"), 0), (1, 0, 0))

    def test_indices_beyond_32_bits_are_none(self):
        bodies, poses = [cube(), cube()], np.array([[0, 0, 0, 1, 0, 0, 0], [0, 0, 1.9, 1, 0, 0, 0]], float)
        for wrong in (2**32 + 1, -1, 2**63 - 1):
            for kind in (np.int64, object):
                with self.assertRaisesRegex(ValueError, str(wrong) if kind is np.int64 else "pairs"):
                    pp.detect_batch(bodies, poses, np.array([[0, wrong]], kind))
        with self.assertRaisesRegex(ValueError, str(2**32 + 1)):
            pp.detect_batch(bodies, poses, np.array([[0, 2**32 + 1]], np.uint64))
        self.assertEqual(pp.detect_batch(bodies, poses, np.array([[0, 1]], np.uint64))["kind"][0], pp.OVERLAPPING)

    def test_what_is_solved_to_the_end_knows_a_distance(self):
        body = cube()
        contact = pp.detect(body, pp.Pose((0, 0, 0)), body, pp.Pose((0, 0, 2.001)), pp.Settings(solve_separated=True))
        self.assertFalse(contact.overlapping)
        self.assertTrue(0.0 < contact.distance <= 1e-3, contact.distance)

    def test_classes_say_what_their_numbers_are(self):
        """Each attribute of an answer has a docstring, or stands in that of its class."""
        for one in (pp.Contact, pp.FlatContact, pp.Patch, pp.Settings):
            names = [name for name in dir(one) if not name.startswith("_") and not getattr(one, name).__doc__]
            self.assertEqual([name for name in names if re.search(rf"\b{name}\b", one.__doc__) is None], [])
        self.assertIn("unit contact normal", pp.Contact.normal.__doc__.lower())
        with self.assertRaisesRegex(TypeError, "it has formulation, solve_separated, gap_tolerance"):
            pp.Settings(tolerance=1e-9)

    def test_bad_input_is_told_in_the_librarys_sentences(self):
        cases = [
            (lambda: pp.Particle(CUBE, -0.1), "rounding radius r=-0.1 must be positive"),
            (lambda: pp.Particle(CUBE[:3], 0.1), "the planes do not enclose a volume"),
            (lambda: pp.Particle(CUBE, 0.1, 1.5), r"sphericity k=1.5 is outside \[0, 1\]"),
            (lambda: pp.Particle(CUBE[:, :3], 0.1), "the array has 3 columns"),
            (lambda: pp.Particle((CUBE[:, :3], [1, 2]), 0.1), "6 normals and 2 offsets"),
            (lambda: pp.Pose((0, 0, 0), (0, 0, 0, 0)), "not a quaternion"),
            (lambda: pp.Pose((0, 0)), "position must be 3 numbers"),
            (lambda: pp.Settings("nearest"), '"midway" or "closest"'),
            (lambda: pp.Settings(weight_on_a=2), "weight_on_a=2.0 must lie in"),
            (lambda: pp.Settings(gap_tolerance=float("nan")), "gap_tolerance=NaN"),
            (lambda: cube().mesh(0.0), "mesh tolerance"),
            (lambda: cube().mass_properties(float("nan")), "tolerance=NaN"),
            (lambda: pp.Wall((0, 0, 0), (0, 0, 0)), "no direction"),
            (lambda: pp.Triangle((0, 0, 0), (1, 0, 0), (2, 0, 0)), "area"),
        ]
        for make, sentence in cases:
            with self.assertRaisesRegex(ValueError, sentence):
                make()

    def test_planes_in_both_forms(self):
        self.assertEqual(pp.Particle((CUBE[:, :3], CUBE[:, 3]), 0.1, 0, 2.0), cube())
        np.testing.assert_array_equal(cube().planes, CUBE)
        self.assertNotEqual(cube(), cube(0.1))


if __name__ == "__main__":
    unittest.main()
