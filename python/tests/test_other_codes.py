# SPDX-License-Identifier: MIT OR Apache-2.0
"""Bodies of other codes: volumes and places against closed forms, what is lost, and what is said of wrong files."""
import math
import re
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
from potential_particles import rock
from potential_particles.other_codes import read_lammps_bodies, read_shp, read_tess
from potential_particles.polyhedron import Polyhedron

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
EDGES = [(a, b) for a in range(8) for b in range(a) if sum(p != q for p, q in zip(CORNERS[a], CORNERS[b])) == 1]


def text(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def block(name, radius, points, faces=(), more=""):
    """One shape of Rockable."""
    return (f"<\nname {name}\nradius {radius}\npreCompDone y\nOBBtreeLevel 2\nnv {len(points)}\n{text(points)}ne 0\n"
            f"nf {len(faces)}\n{text((len(one), *one) for one in faces)}obb.extent 1 1 1\nobb.e1 1 0 0\n{more}>\n\n")


def cube(half, radius, **more):
    """With its faces at `half`."""
    return block("cube", radius, [[(half - radius) * one for one in corner] for corner in CORNERS], FACES, **more)


def sphero_cube(edge, radius):
    """Volume of a cube of this edge and all within the radius of it."""
    return edge**3 + 6 * edge**2 * radius + 3 * math.pi * edge * radius**2 + 4 / 3 * math.pi * radius**3


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, content):
        path = self.folder / name
        path.write_text(content)
        return path

    def refuses(self, read, path, said, **more):
        with self.assertRaisesRegex(ValueError, said):
            read(path, **more)


class Rockable(Files):
    def test_a_cube_has_its_faces_and_volume(self):
        """Volume by Steiner's formula; a quarter turn about z carries it to the place that the file says."""
        turn = f"{math.sqrt(0.5)} 0 0 {math.sqrt(0.5)}"
        more = f"volume 0.98\nposition 5 6 7\norientation {turn}\n"
        path = self.file("cube.shp", "# by hand\n" + cube(0.5, 0.1, more=more))
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # nothing is lost: its edges are square
            bodies = read_shp(path)
        shape = bodies.shapes["cube"]
        self.assertEqual((bodies.ids, shape.r, shape.k), (["cube"], 0.1, 0))
        self.assertAlmostEqual(shape.volume / sphero_cube(0.8, 0.1), 1, delta=1e-6)
        self.assertAlmostEqual(bodies.volumes[0] / sphero_cube(0.8, 0.1), 1, delta=1e-12)
        np.testing.assert_allclose(np.array(shape.planes)[:, 3] + shape.r, 0.5, rtol=1e-9)
        np.testing.assert_allclose(bodies[0].pose.position, (5, 6, 7), atol=1e-9)
        self.assertAlmostEqual(abs(bodies[0].pose.rotation[1, 0]), 1, delta=1e-9)

    def test_round_and_flat_shapes(self):
        """A ball, a capsule along a diagonal, and a plate, off the origin."""
        plate = [(x, y, 4) for x, y in ((0, 0), (3, 0), (3, 2), (0, 2))]
        bodies = read_shp(self.file("round.shp", block("ball", 0.3, [(1, 2, 3)]) + block("rod", 0.2, [
            (1, 1, 1), (2, 2, 2), (3, 3, 3)]) + block("plate", 0.1, plate, [(0, 1, 2, 3)])))
        volumes = [4 / 3 * math.pi * 0.3**3, math.pi * 0.2**2 * (math.sqrt(12) + 4 / 3 * 0.2),
                   2 * 6 * 0.1 + math.pi / 2 * 0.1**2 * 10 + 4 / 3 * math.pi * 0.1**3]
        for one, volume, place in zip(bodies, volumes, [(1, 2, 3), (2, 2, 2), (1.5, 1, 4)]):
            self.assertAlmostEqual(one.shape.volume / volume, 1, delta=2e-4)
            np.testing.assert_allclose(one.pose.position, place, atol=1e-6)
        np.testing.assert_allclose(bodies.volumes, volumes, rtol=1e-12)
        # The rod reaches farthest along its axis.
        local = bodies[1].pose.rotation.T @ np.ones(3) / math.sqrt(3)
        self.assertAlmostEqual(bodies[1].particle.surface_distance(np.zeros(3), local), math.sqrt(3) + 0.2, delta=1e-9)

    def test_what_edges_lose_is_told(self):
        """A regular octahedron, of which Steiner's formula is known; its edges are blunt."""
        points = [tuple(s * one for one in axis) for axis in np.eye(3).tolist() for s in (1, -1)]
        faces = [(i, j, k) for i in (0, 1) for j in (2, 3) for k in (4, 5)]
        with self.assertWarnsRegex(UserWarning, r"less volume than the bodies, eight -[0-9.]+ %: edges"):
            bodies = read_shp(self.file("eight.shp", block("eight", 0.2, points, faces)))
        edge, bend = math.sqrt(2), math.pi - math.acos(-1 / 3)
        volume = 4 / 3 + 2 * math.sqrt(3) * edge**2 * 0.2 + 6 * edge * bend * 0.2**2 + 4 / 3 * math.pi * 0.2**3
        self.assertAlmostEqual(bodies.volumes[0] / volume, 1, delta=1e-12)
        self.assertAlmostEqual(bodies.lost, 1 - bodies[0].shape.volume / volume, delta=1e-12)
        self.assertTrue(0.01 < bodies.lost < 0.1)

    def test_what_is_not_convex(self):
        """A cube with a pyramid out of one face: a sixth of its volume; rods whose volume the file states."""
        dented = [*CORNERS, (0, 0, 0)]
        faces = FACES[:-1] + [(1, 5, 8), (5, 7, 8), (7, 3, 8), (3, 1, 8)]
        path = self.file("dent.shp", block("dent", 0.01, dented, faces))
        self.refuses(read_shp, path, "dent.shp, line 1: dent is not convex: its convex hull has 20 % more.*hull=True")
        with self.assertWarnsRegex(UserWarning, "1 of 1 bodies are not convex and became their hulls, of up to 20 %"):
            self.assertAlmostEqual(read_shp(path, hull=True).volumes[0] / sphero_cube(2, 0.01), 1, delta=1e-9)
        cross = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
        self.refuses(read_shp, self.file("rods.shp", block("rods", 0.1, cross, more="volume 0.2\n")), "more volume")
        self.refuses(read_shp, self.file("rods.shp", block("rods", 0.1, cross)), "its faces are open")

    def test_wrong_files(self):
        good = cube(0.5, 0.1)
        cases = ((good.replace("radius 0.1", "radius -1"), "line 1: radius=-1 must be above 0"),
                 (good.replace("radius 0.1", "radius x"), "line 3: radius has 'x' where 1 number"),
                 (good.replace("radius 0.1\n", ""), "line 1: the shape that begins here has no radius"),
                 (good.replace("4 0 1 3 2", "4 0 1 3 8"), "line 17: point 8 is named, and there are 0"),
                 (good.replace("nv 8", "nv 80"), "line 15: points of nv has 'ne'"),
                 (good.replace("nv 8", "nv -1"), "line 6: nv=-1 must be at least 1"),
                 (good.replace("-0.4 -0.4 -0.4", "nan -0.4 -0.4"), "line 7: points of nv: nan must"),
                 (good.replace(">", ""), "line 1: the shape that begins here has no end"),
                 (good + good, "line 27: name cube stands for two shapes"), ("\n", "holds no shape"),
                 ("cube", "line 1: a shape begins with <"))
        for content, said in cases:
            self.refuses(read_shp, self.file("bad.shp", content), f"bad.shp.*{said}")
        self.refuses(read_shp, self.folder / "none.shp", "none.shp cannot be read: No such file")


def tessellation(seeds):
    """The text of Neper's file of Voronoi cells of the unit cube; two cells share the face between them."""
    box = [(*n, h) for axis in np.eye(3) for n, h in ((axis, 1.0), (-axis, 0.0))]
    points, faces, cells = [], [], []
    known, between = {}, {}

    def number(point):
        return known.setdefault(tuple(np.round(point, 9)), len(known) + 1)

    for i, seed in enumerate(seeds):
        others = [j for j in range(len(seeds)) if j != i]
        planes = [(*(seeds[j] - seed), 0.5 * (seeds[j] @ seeds[j] - seed @ seed)) for j in others]
        planes = np.array([*planes, *box])
        planes /= np.linalg.norm(planes[:, :3], axis=1)[:, None]
        corners, cell = Polyhedron.of_planes(planes[:, :3], planes[:, 3]).corners, []
        for of, plane in zip([*others, *range(-6, 0)], planes):
            on = corners[np.abs(corners @ plane[:3] - plane[3]) < 1e-9]
            if len(on) < 3:
                continue
            if (of, i) in between:
                cell.append(-between[of, i])
                continue
            around = on - on.mean(0)
            turned = np.cross(plane[:3], around[0])
            on = on[np.argsort(np.arctan2(around @ turned, around @ around[0]))]
            # Neper's corners go round the normal either way.
            ring = [number(point) for point in on][::1 if len(faces) % 2 else -1]
            faces.append((len(faces) + 1, len(ring), *ring, len(ring), *range(1, len(ring) + 1), plane[3], *plane[:3],
                          0, 0, 0, 0, 0))
            between[i, of] = len(faces)
            cell.append(len(faces))
        cells.append((i + 1, len(cell), *cell))
    points = [(n, *("%.12f" % one for one in point), 0) for point, n in known.items()]
    return ("***tess\n **format\n   2.0\n **general\n   3 standard\n **cell\n" + f"  {len(seeds)}\n  *id\n   " +
            " ".join(str(10 * (i + 1)) for i in range(len(seeds))) + f"\n **vertex\n  {len(points)}\n{text(points)}"
            f" **edge\n 0\n **face\n {len(faces)}\n{text(faces)} **polyhedron\n {len(cells)}\n{text(cells)}***end\n")


class Neper(Files):
    def test_cells_fill_their_cube(self):
        seeds = np.random.default_rng(41).random((8, 3))
        content = tessellation(seeds)
        with self.assertWarnsRegex(UserWarning, "less volume than the bodies"):
            cells = read_tess(self.file("cube.tess", content), rounding=0.05, scale=2)
        self.assertEqual(cells.ids, [10 * (i + 1) for i in range(8)])
        self.assertAlmostEqual(sum(cells.volumes), 8, delta=1e-8)
        self.assertAlmostEqual(sum(one.shape.sharp_volume for one in cells), 8, delta=1e-8)
        self.assertAlmostEqual(cells.lost, 1 - sum(one.shape.volume for one in cells) / 8, delta=1e-8)
        for i, one in enumerate(cells):
            # All of a cell of Voronoi is nearest to its seed.
            points = one.particle.mesh(0.05).vertices @ one.pose.rotation.T + one.pose.position
            nearest = np.linalg.norm(points[:, None] - 2 * seeds, axis=2).argmin(1)
            self.assertTrue((nearest == i).all())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertTrue(0 < read_tess(self.folder / "cube.tess").lost <= 0.01)

        for old, new, said in (("3 standard", "2 standard", "line 5: the tessellation has 2 dimensions"),
                               ("***tess", "***tesr", "line 1: a tessellation of Neper begins with"),
                               (" **polyhedron\n", " **polyhedra\n", "has no \\*\\*polyhedron"),
                               (content.splitlines()[11], "1 0 0", "vertices, .* has '\\*\\*edge'")):
            self.refuses(read_tess, self.file("bad.tess", content.replace(old, new, 1)), f"bad.tess.*{said}")
        bad = re.sub(r"(\*\*polyhedron\n 8\n1 \d+) -?\d+", r"\1 999", content)
        self.refuses(read_tess, self.file("bad.tess", bad), "face 999 is named, and there are 1 to")


def data_file(bodies, atoms):
    return (f"Bodies and Atoms\n\n{len(atoms)} atoms\n1 atom types\n{len(bodies)} bodies\n-9 9 xlo xhi\n\n"
            f"Atoms # body\n\n{text(atoms)}\nVelocities\n\n{text((a[0], 0, 0, 0, 0, 0, 0) for a in atoms)}\n"
            f"Bodies\n\n{''.join(bodies)}")


def body(atom, points, diameter, faces=(), edges=(), ninteger=3):
    shown = [(*one, -1)[:4] for one in faces]
    doubles = 6 + 3 * len(points) + (2 * len(edges) + 4 * len(faces) if len(points) > 2 else 0) + 1
    return (f"{atom} {ninteger} {doubles}\n{len(points)} {max(1, len(edges))} {max(1, len(faces))}\n1 1 1 0 0 0\n"
            f"{text(points)}{text(edges)}{text(shown)}{diameter}\n")


class Lammps(Files):
    def test_bodies_stand_where_their_atoms_do(self):
        """The three examples of its manual: a cube of edge 2 and diameter 0.5, a rod and a sphere."""
        bodies = [body(7, CORNERS, 0.5, FACES, EDGES), body(3, [(-2, 0, 0), (2, 0, 0)], 0.5), body(1, [(0, 0, 0)], 3.0)]
        atoms = [(1, 1, 1, 1.0, 5, 0, 0), (2, 1, 0, 1.0, 9, 9, 9), (3, 1, 1, 1.0, 0, 5, 0, 0, 0, 0),
                 (7, 1, 1, 1.0, 1, 2, 3)]
        read = read_lammps_bodies(self.file("data.body", data_file(bodies, atoms)))
        self.assertEqual(read.ids, [7, 3, 1])
        volumes = [sphero_cube(2, 0.25), math.pi * 0.25**2 * (4 + 1 / 3), 4 / 3 * math.pi * 1.5**3]
        np.testing.assert_allclose([one.shape.volume for one in read], volumes, rtol=1e-5)
        np.testing.assert_allclose([one.pose.position for one in read], [(1, 2, 3), (0, 5, 0), (5, 0, 0)], atol=1e-9)
        np.testing.assert_allclose(np.array(read[0].shape.planes)[:, 3] + read[0].shape.r, 1.25, rtol=1e-9)

    def test_wrong_files(self):
        atoms, good = [(1, 1, 1, 1.0, 0, 0, 0)], body(1, CORNERS, 0.5, FACES, EDGES)
        square = "1 1 19\n4\n1 1 4 0 0 0\n-1 -1 0\n-1 1 0\n1 1 0\n1 -1 0\n1.0\n"
        cases = [([square], atoms, "line 18: ninteger=1, and only style rounded/polyhedron.*Particle.polygon"),
                 ([good.replace("1 3 79", "1 3 78")], atoms, "line 18: ndouble=78, and 8 vertices.* have 79"),
                 ([good], [(2, *atoms[0][1:])], "line 18: body 1 has no atom whose bodyflag is 1"),
                 ([good], [(1, 1, 0, 1.0, 0, 0, 0)], "line 18: body 1 has no atom whose bodyflag is 1"),
                 ([good], [atoms[0][:6]], "line 10: an atom has 6 numbers, and atom_style body has 7"),
                 ([good.replace("0 1 3 2\n", "0 1 3 9\n")], atoms, "line 41: a face names the vertices"),
                 ([good.replace("0.5", "-1")], atoms, "line 18: radius=-0.5 must be above 0")]
        for bodies, of_atoms, said in cases:
            self.refuses(read_lammps_bodies, self.file("bad.data", data_file(bodies, of_atoms)), f"bad.data, .*{said}")


class Discs(Files):
    def test_names_order_the_columns(self):
        """By any names of the same disc: centre (1, 2, 3), dip 30, dip direction 200, radius 5."""
        expected = [rock.joint((1, 2, 3), 30, 200, 5.0)]
        for content in ("x,y,z,dip direction,dip,radius\n1,2,3,200,30,5\n", "1 2 3 30 200 5\n",
                        "id;set;x [m];y [m];z [m];Dip (deg);Strike (deg);Diameter [m]\nF1;A;1;2;3;30;110;10\n",
                        "dip dip direction radius x y z\n30 200 5 1 2 3\n",
                        "easting northing elevation trend plunge radius p32\n1 2 3 20 60 5 0.1\n"):
            read, = rock.read_dfn(self.file("discs.txt", content))
            np.testing.assert_allclose(read.normal, expected[0].normal, atol=1e-15)
            self.assertEqual((read.point, read.radius), (expected[0].point, 5.0))
        self.refuses(rock.read_dfn, self.file("discs.csv", "x,y,z,dip,radius\n1,2,3,30,5\n"), "lack dip direction")
        self.refuses(rock.read_dfn, self.file("discs.csv", "x,y,z,radius,dip,dipdir\n1,2,3,inf,30,x\n"),
                     "line 2, column 6: 'x' is no finite number")


if __name__ == "__main__":
    unittest.main()
