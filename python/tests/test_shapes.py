# SPDX-License-Identifier: MIT OR Apache-2.0
"""Builders, mass properties, meshes and the plane against closed forms; files; the stubs against the module."""
import ast
import math
import pickle
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import potential_particles as pp
from potential_particles import equilibrium, packing, rock, rounding, shapes

BOX = [(1, 0, 0, 5), (-1, 0, 0, 5), (0, 1, 0, 5), (0, -1, 0, 5), (0, 0, 1, 5), (0, 0, -1, 5)]


def write_stl(file, points, triangles):
    """As binary STL."""
    with open(file, "wb") as opened:
        opened.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            opened.write(struct.pack("<12fH", 0, 0, 0, *points[triangle].ravel(), 0))


class Builders(unittest.TestCase):
    def test_volumes(self):
        cases = [(shapes.cuboid((2, 1, 0.5), rounding=1e-4, k=0), 1.0),
                 (shapes.prism(4, 0.5, 3, 0, rounding=1e-4, k=0), 1.0),
                 (shapes.cylinder(1, 2, 64, rounding=1e-4, k=0), 2 * math.pi),
                 (shapes.sphere(2), 32 / 3 * math.pi),
                 *((shapes.prism(n, 0.5, 2, rounding=1e-4, k=0), n / 2 * math.tan(math.pi / n)) for n in (3, 6, 7)),
                 (shapes.from_planes([(1, 1, 1, 1), (-1, 0, 0, 0), (0, -1, 0, 0), (0, 0, -1, 0)], rounding=1e-4,
                                       k=0), 1 / 6)]
        for shape, volume in cases:
            self.assertAlmostEqual(shape.volume / volume, 1, delta=2e-5)
            mass = shape.particle.mass_properties()
            self.assertLess(np.abs(mass.centroid).max(), 1e-5)
            self.assertLess(np.abs(mass.inertia - np.diag(np.diag(mass.inertia))).max(), 1e-4 * mass.inertia.max())

    def test_regular_solids_balls_and_pyramids(self):
        volumes = {4: 1 / (6 * math.sqrt(2)), 6: 1.0, 8: math.sqrt(2) / 3, 12: (15 + 7 * math.sqrt(5)) / 4,
                   20: 5 * (3 + math.sqrt(5)) / 12}
        for faces, volume in volumes.items():
            solid = shapes.platonic_solid(faces, edge=2.0, rounding=1e-5, k=0)
            self.assertAlmostEqual(solid.volume / (8 * volume), 1, delta=1e-5)
            # Coplanar triangles are one; inertia is the same about all axes.
            self.assertEqual(len(solid.particle.planes), faces)
            self.assertAlmostEqual(max(solid.inertia) / min(solid.inertia), 1, delta=1e-5)
        box = shapes.cuboid((1, 2, 0.5), rounding=1e-5, k=0)
        np.testing.assert_allclose(box.inertia, np.array([4.25, 1.25, 5]) / 12, atol=2e-6)
        self.assertEqual((tuple(box.orientation), tuple(box.centroid)), ((1, 0, 0, 0), (0, 0, 0)))
        ball = shapes.sphere(2.0)
        self.assertAlmostEqual(ball.inertia[0] / (1.6 * ball.volume), 1, delta=1e-6)
        self.assertAlmostEqual(ball.equivalent_diameter, 4, delta=1e-5)
        pyramid = shapes.prism(4, 0.5, 1.0, top_radius=0.0, rounding=1e-5, k=0)
        self.assertAlmostEqual(pyramid.centroid[2], -0.25, delta=1e-5)
        for k in (0.0, 0.02, 0.2, 0.6):
            cube = shapes.cuboid(rounding=0.1, k=k)
            self.assertEqual((tuple(cube.centroid), cube.volume < 1), ((0, 0, 0), True))

    def test_round_bodies_keep_their_size(self):
        at = np.random.default_rng(3).normal(size=(800, 3))
        points = at / np.linalg.norm(at, axis=1)[:, None] * (1, 0.7, 0.5)
        hull = shapes.from_vertices(points, rounding=1e-3, k=0).sharp_volume
        for shape, volume in [(shapes.cylinder(0.05, 0.1), math.pi * 0.05**2 * 0.1),
                              (shapes.cylinder(0.05, 0.1, 256), math.pi * 0.05**2 * 0.1),
                              (shapes.cone(0.5, 1), math.pi / 12), (shapes.capsule(0.5, 1), math.pi * (0.25 + 1 / 6)),
                              (shapes.ellipsoid((1, 0.7, 0.5)), 1.4 / 3 * math.pi),
                              (shapes.superquadric((1, 0.7, 0.5), (1, 1)), 1.4 / 3 * math.pi),
                              (shapes.from_vertices(points, planes=40), hull)]:
            self.assertAlmostEqual(shape.volume / volume, 1, delta=5e-3)
            self.assertAlmostEqual(shape.sharp_volume / volume, 1, delta=1e-9)
            self.assertEqual(pickle.loads(pickle.dumps(shape)).sharp_volume, shape.sharp_volume)

    def test_a_shadow_sphere_that_cuts_is_told(self):
        with self.assertWarnsRegex(UserWarning, "R=0.1: a sphere of radius R/sqrt.k.=0.707107 cuts off"):
            shapes.cuboid((1, 1, 1), R=0.1)

    def test_the_digits_of_a_file_are_found(self):
        """Bricks, turned: six faces whatever wrote their numbers and wherever they stand; bodies of whole numbers are
        exact.
        """
        random = np.random.default_rng(17)
        corners = np.array([(x, y, z) for x in (0, 2) for y in (0, 1) for z in (0, 0.5)])
        faces = [(0, 1, 3), (0, 3, 2), (4, 7, 5), (4, 6, 7), (0, 5, 1), (0, 4, 5), (2, 3, 7), (2, 7, 6), (0, 2, 6),
                 (0, 6, 4), (1, 5, 7), (1, 7, 3)]
        with tempfile.TemporaryDirectory() as folder:
            for place in (0, 10, 1000):
                for form in ("%.4f", "%.5f", "%.6f", "%.7g", "%.8g", "%.9g", "%.17g", "single"):
                    for _ in range(4):
                        turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
                        points = corners @ turn.T + place * random.uniform(-1, 1, 3)
                        file = Path(folder) / "brick.stl"
                        if form == "single":
                            write_stl(file, points, np.array(faces))
                        else:
                            told = "".join("facet normal 0 0 0\nouter loop\n" + "".join(
                                "vertex " + " ".join(form % c for c in points[i]) + "\n" for i in face) +
                                "endloop\nendfacet\n" for face in faces)
                            file.write_text("solid brick\n" + told + "endsolid brick\n")
                        shape = shapes.from_mesh(file)
                        self.assertEqual(len(shape.particle.planes), 6, f"{form} at {place}")
                        self.assertAlmostEqual(shape.sharp_volume, 1, delta=2e-3)
            file = Path(folder) / "cut.obj"
            for far in (0, 1_000_000, 5_000_000):
                cut = [p for c in np.ndindex(2, 2, 2) for axis in range(3)
                       for p in [[far + 10 * one + (axis == i) * (1 - 2 * one) for i, one in enumerate(c)]]]
                file.write_text("".join("v %d %d %d\n" % tuple(p) for p in cut) + "f 1 2 3\n")
                self.assertEqual(len(shapes.from_mesh(file, hull=True).particle.planes), 14)

    def test_r_is_a_length(self):
        rounding._warn_of_lengths.cache_clear()  # it is given once a process
        with self.assertWarnsRegex(FutureWarning, "r=0.05 of then is rounding=0.05"):
            shape = shapes.cuboid((4, 2, 3), r=0.1, k=0, R=3)
        self.assertEqual((shape.particle.r, shape.particle.R), (0.1, 3))
        # The one without a name is the share, as before.
        self.assertEqual(shapes.cuboid((4, 2, 3), 0.05, 0.0), shapes.cuboid((4, 2, 3), rounding=0.05, k=0.0))
        self.assertAlmostEqual(shapes.cuboid((4, 2, 3), rounding=0.05, k=0).volume, shape.volume, delta=1e-9)

    def test_a_hull_stands_where_its_points_are(self):
        points = np.random.default_rng(5).normal(size=(60, 3)) + 10
        shape = shapes.from_vertices(points, rounding=1e-3, k=0)
        local = np.array([shape.pose.to_local(point) for point in points])
        heights = local @ shape.particle.planes[:, :3].T - shape.particle.planes[:, 3]
        # No point lies above a face, and each face has a corner.
        self.assertLess(heights.max(), shape.particle.r * (1 + 1e-6) + 1e-9)
        self.assertGreater(heights.max(0).min(), shape.particle.r * (1 - 1e-6) - 1e-9)

    def test_flat_and_far_hulls(self):
        square = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
        for height in (0.02, 1e-4):
            self.assertAlmostEqual(
                shapes.from_vertices(square + [(0.5, 0.5, height)], k=0, rounding=1e-4).volume * 3 / height, 1, delta=2e-5)
            self.assertAlmostEqual(
                shapes.from_vertices(square[:3] + [(0, 0, height)], k=0, rounding=1e-4).volume * 6 / height, 1, delta=2e-5)
        cube = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        shape = shapes.from_vertices(cube + 1e10, k=0, rounding=1e-4)
        self.assertAlmostEqual(shape.volume, 1, delta=2e-5)
        np.testing.assert_allclose(shape.centroid, 1e10 + 0.5, rtol=1e-15)
        with self.assertRaisesRegex(ValueError, "8 points are flat.*nearer to the origin"):
            shapes.from_vertices(cube + 1e17)

    def test_no_rows(self):
        """Arrays and lists without rows are sphere, domain and rock, or are told."""
        for none in ([], np.zeros((0, 4)), np.zeros((0, 4), np.float32), np.zeros((0, 4), int), (np.zeros((0, 3)), [])):
            sphere = pp.Particle(none, r=0.1, k=1, R=2)
            self.assertEqual((sphere.planes.shape, sphere.potential((2, 0, 0))), ((0, 4), 0))
            self.assertEqual(pickle.loads(pickle.dumps(sphere)), sphere)
            for make, sentence in [(lambda: pp.Particle(none, r=0.1), "do not enclose"),
                                   (lambda: shapes.from_planes(none), "planes is empty|a, b, c, h")]:
                with self.assertRaisesRegex(ValueError, sentence):
                    make()
        for none in ([], np.zeros((0, 3)), np.zeros((0, 3), np.uint32)):
            with self.assertRaisesRegex(ValueError, "0 points"):
                shapes.from_vertices(none)
            with self.assertRaisesRegex(ValueError, "0 points"):
                shapes.from_surface(none, none)
            with self.assertRaisesRegex(ValueError, "do not enclose|enclose no area"):
                pp.Particle.in_plane(none, r=0.1)

    def test_files(self):
        ball = shapes.sphere(1.0).particle.mesh(0.1)
        points, triangles = ball.vertices, ball.triangles
        with tempfile.TemporaryDirectory() as folder:
            stl, obj = Path(folder, "ball.stl"), Path(folder, "ball.obj")
            write_stl(stl, points, triangles)
            obj.write_text("".join("v %r %r %r\n" % tuple(map(float, p)) for p in points)
                           + "".join("f %d %d %d\n" % tuple(t + 1) for t in triangles))
            read = [shapes.from_mesh(file, scale=2.0, rounding=1e-4, k=0) for file in (stl, str(obj))]
            a, b, c = (points[triangles[:, i]] for i in range(3))
            volume = 8 * np.einsum("ij,ij->", a, np.cross(b, c)) / 6
            for shape in read:
                self.assertAlmostEqual(shape.volume / volume, 1, delta=5e-4)
            write_stl(stl, points, triangles[1:])
            with self.assertRaisesRegex(ValueError, "ball.stl: the surface is open"):
                shapes.from_mesh(stl)
            self.assertAlmostEqual(shapes.from_mesh(stl, hull=True, rounding=1e-4, k=0).volume * 8 / volume, 1, delta=5e-4)
            for name, text in (("none.stl", None), ("empty.obj", ""), ("bad.stl", "no mesh"), ("wrong.ply", "ply")):
                if text is not None:
                    Path(folder, name).write_text(text)
                with self.assertRaisesRegex(ValueError, name):
                    shapes.from_mesh(Path(folder, name))

    def test_dialects_of_files(self):
        """What other programs write: a wedge, in letters, line ends and bytes of all kinds."""
        points = [(0, 0, 0), (2, 0, 0), (0, 1, 0), (0, 0, 3), (2, 0, 3), (0, 1, 3)]
        faces = [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
        obj = "".join("v %g %g %g\n" % p for p in points) + "".join("f " + " ".join(str(i + 1) for i in f) + "\n"
                                                                   for f in faces)
        fans = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
        stl = "solid wedge\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % points[i]
                                                                                     for i in f) +
                                        "endloop\nendfacet\n" for f in fans) + "endsolid wedge\n"
        texts = [("a.obj", obj.encode()), ("b.obj", b"# caf\xe9 25 \xb0C\n" + obj.encode()),
                 ("c.OBJ", obj.replace("f 1 2", "f 1 \\\n2").replace("\n", "\r\n").encode()),
                 ("d.obj", b"\xef\xbb\xbf" + obj.encode()), ("e.stl", stl.encode()), ("f.STL", stl.upper().encode()),
                 ("g.stl", stl.replace("\n", "\r").encode()), ("h.stl", stl.replace(" 1 ", " 1.00e+0 ").encode())]
        with tempfile.TemporaryDirectory() as folder:
            for name, text in texts:
                Path(folder, name).write_bytes(text)
                shape = shapes.from_mesh(Path(folder, name), rounding=1e-4, k=0)
                self.assertEqual(len(shape.particle.planes), 5, name)
                self.assertAlmostEqual(shape.volume, 3.0, delta=1e-3)
            short = bytes(80) + struct.pack("<I", 9) + bytes(50 * 4)
            beyond, nan = obj.replace("f 1 3 2", "f 1 3 20"), obj.replace("v 2 0 3", "v 2 0 nan")
            for name, text, words in [("i.stl", short, "states 9 triangles.* hold 4"),
                                      ("j.obj", beyond.encode(), "names v 20, and there are 6"),
                                      ("k.obj", nan.encode(), "point 4="), ("l.stl", stl.encode("utf-16"), "UTF-16"),
                                      ("m.off", b"", r"\.stl .* \.obj")]:
                Path(folder, name).write_bytes(text)
                with self.assertRaisesRegex(ValueError, f"{name}.*{words}"):
                    shapes.from_mesh(Path(folder, name))

    def test_points_are_known_to_a_length(self):
        corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        rough = corners + 1e-5 * np.random.default_rng(7).uniform(-1, 1, (8, 3))
        self.assertGreater(len(shapes.from_vertices(rough).particle.planes), 6)
        known = shapes.from_vertices(rough, known=5e-5)
        self.assertEqual(len(known.particle.planes), 6)
        self.assertAlmostEqual(known.volume / shapes.from_vertices(corners).volume, 1, delta=1e-4)

    def test_files_are_known_to_their_digits(self):
        """A turned cube, as far from the origin as its digits allow: six faces, or a refusal."""
        corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        triangles = [three for a, b, c, d in quads for three in ((a, b, c), (a, c, d))]
        turn = pp.Pose((0, 0, 0), (0.8, 0.3, -0.4, 0.2)).rotation
        exact = shapes.cuboid((1, 1, 1), k=0).volume
        with tempfile.TemporaryDirectory() as folder:
            for offset in (0, 1, 100, 1e4, 1e7):
                points = corners @ turn.T + offset * np.array((0.7, 0.9, 0.6))
                binary, text = Path(folder, "binary.stl"), Path(folder, "text.stl")
                facets = (struct.pack("<12fH", 0, 0, 0, *points[list(three)].ravel(), 0) for three in triangles)
                binary.write_bytes(bytes(80) + struct.pack("<I", 12) + b"".join(facets))
                lines = ("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.6g %.6g %.6g\n" % tuple(points[i])
                                                                    for i in three) + "endloop\nendfacet\n"
                         for three in triangles)
                text.write_text("solid a\n" + "".join(lines) + "endsolid a\n")
                for file, far in ((binary, 1e7), (text, 1e5)):
                    if offset >= far:
                        with self.assertRaises(ValueError, msg=f"{file} {offset}"):
                            shapes.from_mesh(file, k=0)
                        continue
                    for hull in (False, True):
                        shape = shapes.from_mesh(file, hull=hull, k=0)
                        self.assertEqual(len(shape.particle.planes), 6, f"{file} {offset}")
                        self.assertAlmostEqual(shape.volume / exact, 1, delta=1e-5 + 1e-5 * offset)

    def test_bad_input_is_told(self):
        nan, wedge = float("nan"), [(0, 0, -2, -18), (0, 3, 0, 18), (0, -1, 0, -4.5), (2, 0, 1, 21), (-1, 0, 1, 6.5)]
        square = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
        for make, sentence in [
                (lambda: shapes.sphere(-1), "radius=-1"), (lambda: shapes.sphere(nan), "radius=nan"),
                (lambda: shapes.sphere("a"), "is no number"), (lambda: shapes.sphere(1e300), "radius=1e.300"),
                (lambda: shapes.sphere(1e-110), "radius=1e-110 must be at least 1e-50"),
                (lambda: shapes.sphere(1e-30).scaled(1e-30), "bounding radius"),
                (lambda: shapes.sphere(1).scaled(0), "factor=0"),
                (lambda: shapes.cuboid((1, -1, 1)), "edges=-1 must be"),
                (lambda: shapes.cuboid((1, 1, 0)), "above 0"), (lambda: shapes.cuboid((1, 1)), "has 2 numbers"),
                (lambda: shapes.cuboid((1e-60, 1e-60, 1e-60)), "edges=1e-60 must be at least"),
                (lambda: shapes.cuboid(rounding=0), "rounding=0"),
                (lambda: shapes.cuboid(rounding=0.5), "between 0 and 0.5"),
                (lambda: shapes.cuboid((1, 1, 1), rounding=0.6), "rounding=0.6 is a share of the size"),
                (lambda: shapes.cuboid((1, 1, 1), r=0.6), "r=0.6 is a length and must lie between 0 and 0.5"),
                (lambda: shapes.cuboid((1, 1, 1), rounding=0.1, r=0.1), "rounding=0.1 and r=0.1 both"),
                (lambda: shapes.cuboid(k=-0.1), "k=-0.1"), (lambda: shapes.cuboid(k=1.5), "k=1.5"),
                (lambda: shapes.cuboid(k=nan), "k=nan"), (lambda: shapes.cuboid(k=1), "k=1 leaves no face: take sphere"),
                (lambda: shapes.cuboid(k=0.1, R=0), "R=0"), (lambda: shapes.cuboid(R=1e-110), "R=1e-110"),
                (lambda: shapes.prism(-6), "sides=-6 must"), (lambda: shapes.prism(2), "sides=2 must"),
                (lambda: shapes.prism(6, 0.5, -1), "height=-1"),
                (lambda: shapes.prism(10**9), "sides=1000000000"), (lambda: shapes.cylinder(0), "radius=0"),
                (lambda: shapes.cylinder(sides=10**12), "sides=1000000000000 must"),
                (lambda: shapes.platonic_solid(7), "4, 6, 8, 12 or 20"),
                (lambda: shapes.platonic_solid(8, edge=nan), "edge=nan"),
                (lambda: shapes.random_rock(-1), "seed"), (lambda: shapes.random_rock(1, faces=4), "faces"),
                (lambda: shapes.random_rock(1, faces=10**9), "faces=1000000000"),
                (lambda: shapes.random_rock(1, elongation=0), "elongation=0"),
                (lambda: shapes.random_rock(1, flatness=2), "flatness=2"),
                (lambda: shapes.from_vertices([(0, 0, 0)], known=-1e-9), "known=-1e-09 must lie"),
                (lambda: shapes.from_vertices(square), "flat"), (lambda: shapes.from_vertices([(0, 0, 0)] * 9), "flat"),
                (lambda: shapes.from_vertices([*square[:3], (nan, 1, 1)]), "row 3"),
                (lambda: shapes.from_vertices([*square[:3], (1e200, 0, 1)]), r"points 3=\(1e.200, 0, 1\)"),
                (lambda: shapes.from_vertices(np.eye(3).tolist() + [(0, 0, 0)], planes=10**9), "planes=1000000000"),
                (lambda: shapes.from_planes([(1, 0, 0)]), "row 0 has 3 numbers"),
                (lambda: shapes.from_planes([(1, 0, 0, nan)]), "row 0"),
                (lambda: shapes.from_planes([(0, 0, 0, 1)] + wedge), "plane 0 is none"),
                (lambda: shapes.from_planes(wedge[:4], k=0.0), "enclose no volume"),
                (lambda: shapes.from_planes(wedge[1:], k=0.1), "enclose no volume"),
                (lambda: shapes.from_planes(BOX[:5]), "enclose no volume"),
                (lambda: shapes.from_planes([(1, 0, 0, -1), (-1, 0, 0, -1)] + BOX[2:]), "no point lies inside")]:
            with self.assertRaisesRegex(ValueError, sentence):
                make()

    def test_lengths_of_normals_do_not_matter(self):
        for length in (1e200, 1e-200):
            rows = [(length * a, length * b, length * c, length) for a, b, c, _ in BOX]
            self.assertAlmostEqual(shapes.from_planes(rows, rounding=1e-4, k=0).volume, 8, delta=1e-3)

    def test_a_mesh_is_closed_and_near_the_surface(self):
        particle = shapes.cuboid((2, 1, 0.5), rounding=0.1).particle
        mesh = particle.mesh(1e-3)
        edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())
        self.assertLess(max(abs(particle.potential(vertex)) for vertex in mesh.vertices[:100]), 1e-9)
        self.assertLess(mesh.error, 1e-3 * particle.bounding_radius)


class InPlane(unittest.TestCase):
    def test_discs_and_squares(self):
        disc = pp.Particle.in_plane([], r=0, k=1, R=1)
        poses = pp.Pose.in_plane((0, 0)), pp.Pose.in_plane((1.2, 0), 0.3)
        contact = pp.detect(disc, poses[0], disc, poses[1])
        self.assertAlmostEqual(contact.overlap, 0.8, delta=1e-12)
        self.assertAlmostEqual(pp.contact_area(disc, poses[0], disc, poses[1], contact), 1.6, delta=1e-12)
        # Of two squares face on face that overlap by d: 0.8 wide.
        square = pp.Particle.polygon([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)], 1e-4)
        places = pp.Pose.in_plane((0, 0)), pp.Pose.in_plane((0.2, 1 - 1e-6))
        contact = pp.detect(square, places[0], square, places[1])
        patch = pp.patch_of_contact(square, places[0], square, places[1], contact, energy=True, stiffness=True)
        self.assertAlmostEqual(patch.force[1] / 0.8e-6, 1.0, delta=1e-3)
        self.assertAlmostEqual(patch.energy / 0.4e-12, 1.0, delta=1e-3)
        self.assertAlmostEqual(patch.stiffness[1, 1] / 0.8, 1.0, delta=2e-2)
        self.assertAlmostEqual(patch.points[:, 3].sum(), patch.area, delta=1e-12)
        self.assertAlmostEqual(square.mass_properties().volume, 1, delta=1e-6)
        self.assertTrue(square.is_in_plane and square.mesh().vertices[:, 2].max() == 0)
        flat = pp.contact_with_plane(square, places[0], pp.Wall((0, -0.4, 0), (0, 1, 0)))
        self.assertAlmostEqual(flat.overlap, 0.1, delta=1e-9)
        with self.assertRaisesRegex(ValueError, "make both by in_plane"):
            pp.detect(square, places[0], pp.Particle.sphere(1), places[1])
        with self.assertRaisesRegex(ValueError, "it turns about z alone"):
            pp.detect(square, places[0], square, pp.Pose((0, 1, 0), (1, 0.1, 0, 0)))
        for one in (square, disc, *poses):
            self.assertEqual(pickle.loads(pickle.dumps(one)), one)
        self.assertNotEqual(square, pp.Particle.in_plane([], r=0, k=1, R=1))


class Package(unittest.TestCase):
    def test_stubs_name_what_is_there(self):
        folder = Path(pp.__file__).parent
        self.assertTrue((folder / "py.typed").is_file())
        shared = {}
        for name, module in (("_core", pp._core), ("equilibrium", equilibrium)):
            tree = ast.parse((folder / f"{name}.pyi").read_text())
            told = {}
            for node in tree.body:
                if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                    told[node.name] = node
                elif isinstance(node, ast.AnnAssign):
                    told[node.target.id] = node
            there = {one for one in getattr(module, "__all__", dir(module)) if not one.startswith("_")}
            shared.update((one, told.pop(one)) for one in list(told) if one.startswith("_"))
            self.assertEqual(set(told), there, name)
            for one, node in told.items():
                if isinstance(node, ast.ClassDef) and one != "ContactError":
                    items = node.body + [item for base in node.bases for item in shared[base.id].body]
                    members = {item.name if isinstance(item, ast.FunctionDef) else item.target.id for item in items
                               if isinstance(item, (ast.FunctionDef, ast.AnnAssign))}
                    found = {member for member in dir(getattr(module, one)) if not member.startswith("_")}
                    self.assertEqual({member
                                      for member in members if not member.startswith("_")}, found, f"{name}.{one}")

    def test_what_is_public_says_what_it_does(self):
        for module in (pp, shapes, packing, rock, equilibrium):
            for name in module.__all__:
                thing = getattr(module, name)
                if callable(thing):
                    self.assertTrue((thing.__doc__ or "").strip(), f"{module.__name__}.{name}")

    def test_demo(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "contact.png")
            done = subprocess.run([sys.executable, "-m", "potential_particles", "demo",
                                   str(file)], capture_output=True, text=True)
            self.assertIn("overlap", done.stdout)
            if done.returncode == 0:
                self.assertGreater(file.stat().st_size, 10_000)
            else:
                self.assertIn("pip install matplotlib", done.stderr)


if __name__ == "__main__":
    unittest.main()
