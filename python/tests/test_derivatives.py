# SPDX-License-Identifier: MIT OR Apache-2.0
"""Derivatives against closed forms, differences and each other, and the recipes of docs/derivatives.md where JAX or
PyTorch is there.
"""
import contextlib
import importlib.util
import io
import re
import sys
import unittest
from pathlib import Path

import numpy as np
import potential_particles as pp

PAGE = Path(__file__).resolve().parents[2] / "docs/derivatives.md"
CUBE = np.array([(1, 0, 0, 0.9), (-1, 0, 0, 0.9), (0, 1, 0, 0.9), (0, -1, 0, 0.9), (0, 0, 1, 0.9), (0, 0, -1, 0.9)])
RKR = np.array((0.1, 0.05, 2.0))
PLACE = np.array((0.3, 0.2, 1.9))


def overlap(planes, rkR, place):
    body = pp.Particle(planes, *rkR)
    return pp.detect(body, pp.Pose((0, 0, 0)), body, pp.Pose(tuple(place))).overlap


def differences(inputs, i, h=1e-6):
    """Of the overlap in input i."""
    found = np.zeros_like(inputs[i])
    for place in np.ndindex(found.shape):
        ends = []
        for step in (h, -h):
            moved = [v.copy() for v in inputs]
            moved[i][place] += step
            ends.append(overlap(*moved))
        found[place] = (ends[0] - ends[1]) / (2 * h)
    return found


def recipe(mark):
    """The block of the page that holds this."""
    found = [
        block for block in re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
        if mark in block
    ]
    names = {"__name__": "recipe"}
    exec(compile(found[0], PAGE.name, "exec"), names)
    return names


class Derivatives(unittest.TestCase):
    def setUp(self):
        self.a, self.b = pp.Particle(CUBE, *RKR), pp.Particle.sphere(0.5)
        self.poses = pp.Pose((0.1, 0, 0), (1, 0.2, 0.1, 0)), pp.Pose((0.4, 0.3, 1.3), (1, 0, 0.3, 0.1))
        self.given = self.a, self.poses[0], self.b, self.poses[1]
        self.contact = pp.detect(*self.given)
        self.assertTrue(self.contact.overlapping)

    def test_forward_and_reverse_agree(self):
        d = pp.contact_derivatives(*self.given, self.contact)
        self.assertEqual(d.flags, [])
        self.assertTrue(np.isnan(d.s_b).all())
        w = np.array((0.3, -0.2, 0.9))
        g = pp.contact_gradient(*self.given, self.contact, s=0.5, overlap=2.0, normal=w, point=w, point_on_a=w,
                                point_on_b=-w)
        expected = 0.5 * d.s + 2 * d.overlap + w @ (d.normal + d.point + d.point_on_a - d.point_on_b)
        np.testing.assert_allclose(g.poses, expected, atol=1e-12)
        self.assertEqual((g.planes_a.shape, g.rounding_a.shape, g.planes_b.shape), ((6, 4), (3,), (0, 4)))

    def test_shape_and_place_as_differences_say(self):
        inputs = [CUBE, RKR, PLACE]
        body, at = pp.Particle(CUBE, *RKR), (pp.Pose((0, 0, 0)), pp.Pose(tuple(PLACE)))
        g = pp.contact_gradient(body, at[0], body, at[1], pp.detect(body, at[0], body, at[1]), overlap=1.0)
        for i, found in enumerate((g.planes_a + g.planes_b, g.rounding_a + g.rounding_b, g.poses[6:9])):
            np.testing.assert_allclose(found, differences(inputs, i), atol=1e-8)

    def test_boundary_and_patch(self):
        pose = pp.Pose((0, 0, 0.97))
        contact = pp.contact_with_plane(self.a, pose, pp.Wall((0, 0, 0), (0, 0, 1)))
        d = pp.boundary_derivatives(self.a, pose, contact)
        g = pp.boundary_gradient(self.a, pose, contact, overlap=1.0, on_boundary=(1, 0, 0))
        np.testing.assert_allclose(g.poses, d.overlap + d.point_on_b[0], atol=1e-12)
        self.assertIsNone(g.planes_b)
        triangle = pp.Triangle((-5, 0.1, 0), (5, 0.1, 0), (0, -5, -5))
        at_edge = pp.contact_with_triangle(self.a, pose, triangle)
        with self.assertRaisesRegex(ValueError, "give the triangle"):
            pp.boundary_derivatives(self.a, pose, at_edge)
        self.assertTrue(np.isfinite(pp.boundary_derivatives(self.a, pose, at_edge, triangle).overlap).all())
        patch = pp.patch_of_contact(*self.given, self.contact, stiffness=True, tolerance=1e-7)
        force = pp.patch_derivatives(patch, self.contact).force
        np.testing.assert_allclose(force[:, :3], force[:, :3].T, atol=1e-3 * np.abs(force[:, :3]).max())
        np.testing.assert_allclose(force[:, 6:9], -force[:, :3], atol=1e-12)
        self.assertEqual(
            pp.patch_derivatives(pp.patch_on_plane(self.a, pose, contact, stiffness=True), contact).torque_on_a.shape,
            (3, 12))
        with self.assertRaisesRegex(ValueError, "stiffness=True"):
            pp.patch_derivatives(pp.patch_of_contact(*self.given, self.contact), self.contact)

    def test_what_is_refused(self):
        far = pp.Pose((9, 0, 0))
        rejected = pp.detect(self.a, self.poses[0], self.b, far)
        with self.assertRaisesRegex(ValueError, "solve_separated"):
            pp.contact_derivatives(self.a, self.poses[0], self.b, far, rejected)
        with self.assertRaisesRegex(ValueError, "finite"):
            pp.contact_gradient(*self.given, self.contact, s=float("nan"))
        with self.assertRaisesRegex(ValueError, "normal must be 3 numbers"):
            pp.contact_gradient(*self.given, self.contact, normal=(1, 2))


class Examples(unittest.TestCase):
    """Those of examples/derivatives, but for their pictures."""

    def setUp(self):
        sys.path.insert(0, str(PAGE.parents[1] / "examples/derivatives"))
        self.addCleanup(sys.path.pop, 0)

    def test_arch(self):
        import arch
        with contextlib.redirect_stdout(io.StringIO()):
            t, _, haunch = arch.least_thickness()
        self.assertAlmostEqual(t, 0.10748, delta=1e-5)
        self.assertAlmostEqual(np.degrees(haunch * arch.STEP), 54.5, delta=0.3)

    def test_run_out(self):
        import run_out
        history, by_mu = run_out.run(0.5)
        resistance = 0.5 * np.cos(run_out.SLOPE) - np.sin(run_out.SLOPE)
        way = run_out.SPEED**2 / (2 * run_out.GRAVITY * resistance)
        self.assertAlmostEqual(history[-1, 0], way, delta=2e-3 * way)
        self.assertAlmostEqual(by_mu, -way * np.cos(run_out.SLOPE) / resistance, delta=0.02 * abs(by_mu))

    def test_grain(self):
        import grain
        points, normals = grain.scanned(np.random.default_rng(7))
        fit = grain.Fit(points[::20], normals[::20])
        start = grain.start_from(points)
        found, h = fit.jacobian(start), 1e-6
        for column in (0, 17, 43, -2, -1):
            step = np.zeros(len(start))
            step[column] = h
            expected = (fit.residuals(start + step) - fit.residuals(start - step)) / (2 * h)
            np.testing.assert_allclose(found[:, column], expected, atol=1e-6)


class Recipes(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("jax"), "JAX is not installed")
    def test_jax(self):
        names = recipe("jax.custom_vjp")
        inputs = [CUBE, RKR, PLACE]
        found = names["jax"].grad(names["overlap"], argnums=(0, 1, 2))(*(names["jnp"].asarray(v) for v in inputs))
        for i in range(3):
            np.testing.assert_allclose(found[i], differences(inputs, i), atol=1e-8)

    @unittest.skipUnless(importlib.util.find_spec("torch"), "PyTorch is not installed")
    def test_torch(self):
        names = recipe("torch.autograd.Function")
        inputs = [CUBE, RKR, PLACE]
        tensors = [names["torch"].tensor(v, dtype=names["torch"].float64, requires_grad=True) for v in inputs]
        names["Overlap"].apply(*tensors).backward()
        for i in range(3):
            np.testing.assert_allclose(tensors[i].grad.numpy(), differences(inputs, i), atol=1e-8)
