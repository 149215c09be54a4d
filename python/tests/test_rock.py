# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rock masses: slicing against sums and closed forms, key blocks and water, files of fractures, what is refused."""
import math
import pickle
import re
import unittest

import numpy as np
import pytest
from potential_particles import rock, shapes
from potential_particles.rock import Domain

BOX = [(1, 0, 0, 5), (-1, 0, 0, 5), (0, 1, 0, 5), (0, -1, 0, 5), (0, 0, 1, 5), (0, 0, -1, 5)]
CUBE = Domain.box((-1, -1, -1), (1, 1, 1))
# A box less the prism before its face.
SLOPE = Domain.box((0, 0, 0), (20, 10, 8)).below((18, 0, 0), 60, 90)
VOLUME = 10 * (20 * 8 - 2 * 8 - 0.5 * 8 * 8 / math.tan(math.radians(60)))
SETS = [
    rock.JointSet(35, 90, 2.0, seed=1),
    rock.JointSet(80, 265, 3.0, exponential=True, fisher=100, seed=2),
    rock.JointSet(85, 0, 2.5, seed=3),
    rock.JointSet(50, 20, 4.0, radius=2.0, seed=4)
]


def cut(domain, joints, **how):
    return rock.slice(domain, joints, progress=False, **how)


def refused(action, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        action()


class Rock(unittest.TestCase):
    def test_arrays_are_the_blocks(self):
        discs = rock.JointSet(50, 120, 2.0, radius=4.0, seed=3)
        square = rock.polygon([(-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)])
        mass = rock.slice(rock.Domain(BOX), [discs, square, rock.joint((0, 0, 0), 0, 0)], progress=False)
        faces, partners = mass.faces, mass.partners
        self.assertEqual(sum(one.radius == 4.0 for one in mass.joints), len(mass.joints) - 2)
        for number, block in enumerate(mass):
            np.testing.assert_array_equal(faces["plane"][block.faces], block.planes)
            self.assertTrue((faces["block"][block.faces] == number).all())
            for face, plane in zip(block.faces, block.planes):
                np.testing.assert_allclose(mass.outline(face) @ plane[:3], plane[3], atol=1e-9)
            self.assertTrue((block.corners @ block.planes[:, :3].T <= block.planes[:, 3] + 1e-9).all())
        # What a face shares with its partners is all of it, but for those of the domain.
        shared = np.zeros(len(faces))
        for side in (0, 1):
            np.add.at(shared, partners["faces"][:, side].astype(int), partners["area"])
        np.testing.assert_allclose(shared, np.where(faces["of"] == 0, 0.0, faces["area"]), atol=1e-9)

    def test_blocks_fill_the_domain(self):
        joints = [rock.JointSet(30, 90, 1.5, exponential=True), rock.JointSet(80, 280, 2.0, fisher=50, seed=1)]
        mass = rock.slice(rock.Domain(BOX), joints)
        self.assertAlmostEqual(mass.volume, 1000, delta=1e-9)
        block = mass[0]
        shape = shapes.from_planes(block.planes, r=1e-4, k=0)
        self.assertAlmostEqual(shape.volume / block.volume, 1, delta=1e-3)
        tunnel = rock.Domain([(0, 0, 1, 1), (0, 0, -1, 1), (1, 0, 0, 1), (-1, 0, 0, 1), (0, 1, 0, 6), (0, -1, 0, 6)])
        with_tunnel = rock.slice(rock.Domain(BOX), joints, regions=[tunnel])
        self.assertAlmostEqual(with_tunnel.blocks["volume"][with_tunnel.inside(0)].sum(), 40, delta=1e-9)
        self.assertTrue((with_tunnel.faces["of"] == 2).any())
        self.assertLess(len(np.unique(with_tunnel.pieces)), len(with_tunnel))
        self.assertEqual(len(pickle.loads(pickle.dumps(mass))), len(mass))
        with self.assertRaisesRegex(ValueError, "dip=95 must lie between 0 and 90"):
            rock.joint((0, 0, 0), 95, 0)

    def test_key_blocks_and_water(self):
        """A wedge on one plane that dips by 40 degrees: tan phi / tan dip, with water as of a closed form."""
        domain = rock.Domain.box((0, 0, 0), (4, 4, 4))
        mass = rock.slice(domain, [rock.joint((2, 2, 2), 40, 90)])
        upper = int(np.argmax([block.centroid[2] for block in mass]))
        friction = 30.0
        expected = math.tan(math.radians(friction)) / math.tan(math.radians(40))
        open_sides = [one for one in range(6) if one != rock.Domain.BOTTOM]
        found = [one for one in rock.key_blocks(mass, open_sides, degrees=friction) if upper in one.blocks][0]
        self.assertEqual((found.mode, round(found.factor / expected, 12)), ("sliding", 1.0))
        answer = rock.limit_analysis(mass, [1 - upper], degrees=friction)
        self.assertAlmostEqual(answer.factor / expected, 1, delta=1e-5)
        scene = rock.limit_scene(mass, [1 - upper], degrees=friction)
        self.assertAlmostEqual(scene.strength_factor().factor / expected, 1, delta=1e-5)
        loads = rock.water_pressure(mass, mass.faces_of([0]), level=4.0, unit_weight=1e4)
        area = 16 / math.cos(math.radians(40))
        self.assertAlmostEqual(np.linalg.norm(loads[upper, :3]) / (area * 2e4), 1, delta=1e-12)

    def test_key_blocks_by_closed_forms(self):
        """tan(phi)/tan(dip) + c A/(W sin(dip)) on a plane; the wedge of Hoek & Bray."""
        bench = Domain.box((0, 0, 0), (4, 2, 3)).below((3.9, 0, 0), 75, 90)
        plane = cut(bench, [rock.joint((3, 0, 1), 35, 90), rock.joint((1, 1, 1), 90, 90)])
        free, dip = (Domain.TOP, Domain.NORTH, Domain.SOUTH, 6), math.radians(35)
        found = rock.key_blocks(plane, free, degrees={0: 30, None: 5}, cohesion={0: 2e3, None: 0})
        slid, = [one for one in found if one.mode == "sliding"]
        weight = 2600 * 9.81 * slid.volume
        exact = (math.tan(math.radians(30)) / math.tan(dip)
                 + 2e3 * plane.faces["area"][slid.faces[0]] / (weight * math.sin(dip)))
        self.assertAlmostEqual(slid.factor, exact, delta=1e-12)
        np.testing.assert_allclose(slid.direction, (math.cos(dip), 0, -math.sin(dip)), atol=1e-12)
        self.assertTrue(slid.removable and slid.color == rock.COLOURS["held" if exact > 1 else "sliding"])
        # Water behind it drives it.
        dry, = [one for one in rock.key_blocks(plane, free, degrees=40) if one.mode == "sliding"]
        loads = rock.water_pressure(plane, plane.faces_of(1), level=3.0)
        wet, = [one for one in rock.key_blocks(plane, free, degrees=40, loads=loads) if one.blocks == dry.blocks]
        self.assertLess(wet.factor, dry.factor)
        joints = [rock.joint((0, 0, 0), 50, 140), rock.joint((0, 0, 0), 60, 230)]
        normals = [np.array(one.normal) for one in joints]
        line = np.cross(*normals)
        line *= -np.sign(line[2]) / np.linalg.norm(line)
        block = Domain.box((-9, -9, -9), (9, 9, 1)).below((0, 0, 0), 80, math.degrees(math.atan2(line[0], line[1])))
        wedge, = [one for one in rock.key_blocks(cut(block, joints), (Domain.TOP, 6), degrees=33) if one.mode == "wedge"]
        cosine = normals[0] @ normals[1]
        forces = np.linalg.solve([[1, cosine], [cosine, 1]], [normals[0][2], normals[1][2]])
        self.assertAlmostEqual(wedge.factor, math.tan(math.radians(33)) * forces.sum() / -line[2], delta=1e-9)
        np.testing.assert_allclose(wedge.direction, line, atol=1e-9)
        self.assertIn("wedge", rock.summary([wedge]))

    def test_what_rests_on_an_excavated_block_falls(self):
        hung = cut(CUBE, [rock.joint((0, 0, 0), 0, 0)], regions=[Domain.box((-2, -2, -2), (2, 2, -0.5))])
        modes = [one.mode for one in rock.key_blocks(hung, (), removed=hung.inside(0))]
        self.assertEqual(sorted(modes), ["falling", "inner"])

    def test_friction_is_a_coefficient_or_an_angle(self):
        by_number, by_angle = (rock.key_blocks(MASS, (), **how)
                               for how in (dict(friction=math.tan(math.radians(25))), dict(degrees=25)))
        self.assertEqual([one.factor for one in by_number], [one.factor for one in by_angle])

    def test_bodies_need_yade(self):
        with self.assertRaisesRegex(AttributeError, "rock.bodies is for bodies of YADE"):
            rock.bodies


def test_a_slope_by_sums():
    mass = cut(SLOPE, SETS)
    assert mass.volume == pytest.approx(VOLUME, rel=1e-12)
    assert len(mass) > 200 and mass.complete and "blocks" in repr(mass)
    assert sum(one.volume for one in mass) == pytest.approx(mass.volume, rel=1e-9)
    of_joints = mass.faces["of"] == 1
    assert set(mass.set_of_face[of_joints]) == {0, 1, 2, 3} and set(mass.set_of_face[~of_joints]) == {-1}
    outer = sum(mass.faces["area"][mass.faces_on(Domain.TOP)])
    assert outer == pytest.approx(10 * (18 - 8 / math.tan(math.radians(60))), abs=1e-9)
    assert len(np.unique(mass.pieces)) == len(mass)
    for threads in (1, 3):
        again = cut(SLOPE, SETS, threads=threads)
        assert again.blocks.tobytes() == mass.blocks.tobytes() and again.faces.tobytes() == mass.faces.tobytes()
    few = cut(SLOPE, SETS[:3], least_volume=2.0, least_thickness=0.1)
    assert few.too_small > 0 and few.blocks["volume"].min() >= 2.0 and few.volume == pytest.approx(VOLUME, rel=1e-12)
    # Water all around a block is buoyancy (Archimedes).
    water = rock.water_pressure(mass, np.ones(len(mass.faces), bool), level=20.0)
    np.testing.assert_allclose(water[:, :3], np.outer(9810 * mass.blocks["volume"], (0, 0, 1)), atol=1e-6 * 9810)
    np.testing.assert_allclose(water[:, 3:], 0.0, atol=1e-6 * 9810)
    load = rock.face_pressure(mass, mass.faces_on(Domain.TOP), 1e4)
    assert load[:, 2].sum() == pytest.approx(-1e4 * outer, abs=1e-6)


def test_water_half_way_up_a_cube():
    one = cut(CUBE, [])
    side = rock.water_pressure(one, one.faces_on(Domain.EAST), level=0.5)
    assert side[0, 0] == pytest.approx(-9810 * 2 * 1.5**2 / 2, abs=1e-9)
    # At a third of the depth.
    assert side[0, 4] == pytest.approx(9810 * 2.25 * 0.5, abs=1e-9)


def test_planes_that_miss_and_parts_that_are_too_thin():
    assert list(cut(CUBE, [rock.joint((0, 0, 0), 0, 0), rock.joint((0, 0, 5), 0, 0)]).missing) == [1]
    for how, blocks in ((dict(least_width=0.11), 1), (dict(largest_aspect=19), 1),
                        (dict(least_width=0.09, largest_aspect=21), 2)):
        assert len(cut(CUBE, [rock.joint((0, 0, 0.9), 0, 0)], **how)) == blocks


def test_rectangles_and_polygons():
    # One that ends before the middle cuts the half of a cube that it reaches, a turned one that reaches over it both.
    halves = rock.joint((0, 0, 0), 90, 90)
    for direction, blocks in ((90, 3), (0, 4)):
        assert len(cut(CUBE, [halves, rock.rectangle((0.5, 0, 0), 0, direction, length=1.2, width=0.9)])) == blocks
    within = cut(CUBE, [rock.rectangle((0.2, 0.1, 0), 30, 90, 0.5, 0.7)]).faces
    np.testing.assert_allclose(np.sort(within["jointed_area"])[-3:], (0, 0.35, 0.35), atol=1e-12)
    ended = rock.rectangle((1, 2, 3), 30, 90, 4, 2)
    down = np.array([math.cos(math.radians(30)), 0, -math.sin(math.radians(30))])
    np.testing.assert_allclose(np.abs((np.array(ended.outline) - (1, 2, 3)) @ down), 1, atol=1e-12)
    assert np.dot(ended.normal, down) == pytest.approx(0.0, abs=1e-12)
    for corners, words in (([(0, 0, 0), (1, 0, 0)], "three or more"),
                           ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.1)], "lie in one plane"),
                           ([(0, 0, 0), (2, 0, 0), (0.5, 0.5, 0), (0, 2, 0)], "convex polygon")):
        refused(lambda: rock.polygon(corners), words)


def test_regions():
    """A tunnel, which is a prism, and what a domain leaves out."""
    tunnel = Domain.cylinder((10, -1, 3), (10, 11, 3), 1.5, sides=8)
    section = 8 * 1.5**2 * math.tan(math.pi / 8)
    dug = cut(SLOPE, SETS, regions=[tunnel])
    assert dug.blocks["volume"][dug.inside(0)].sum() == pytest.approx(10 * section, rel=1e-12)
    assert dug.volume == pytest.approx(VOLUME, rel=1e-12)
    left = cut(SLOPE.without(tunnel), SETS)
    assert left.volume == pytest.approx(VOLUME - 10 * section, rel=1e-12)
    assert len(np.unique(left.pieces)) < len(left) and set(left.blocks["region"]) == {-1}
    halved = cut(CUBE.without(Domain.box((-0.2, -2, -2), (0.2, 2, 2))), [])
    assert len(halved) == 2 and len(set(halved.pieces)) == 2
    notched = cut(CUBE.without(Domain.box((-0.2, -2, 0), (0.2, 2, 2))), [])
    assert len(notched) == 3 and len(set(notched.pieces)) == 1


@pytest.mark.parametrize("seed", range(6))
def test_sets_through_a_point(seed):
    """Where four sets meet in the middle faces have sides of no length: nothing lies open inside all the same."""
    random = np.random.default_rng(seed)
    many = [rock.JointSet(random.uniform(0, 90), random.uniform(0, 360), 0.9) for _ in range(4)]
    found = rock.key_blocks(cut(Domain.box((0, 0, 0), (2, 2, 2)), many), [])
    assert {one.mode for one in found} == {"inner"}


MASS = cut(SLOPE, SETS)
UNIT = Domain.box((0, 0, 0), (1, 1, 1))


@pytest.mark.parametrize("words, action", [
    ("dip=95", lambda: rock.JointSet(95, 0, 1)), ("spacing=0", lambda: rock.JointSet(5, 0, 0)),
    ("fisher=-1", lambda: rock.JointSet(5, 0, 1, fisher=-1)), ("radius=0", lambda: rock.joint((0, 0, 0), 5, 0, 0)),
    ("must be finite", lambda: rock.joint((0, 0, math.nan), 5, 0)),
    ("the domain is open", lambda: cut(Domain([(0, 0, 1, 1)]), SETS)),
    ("the domain is empty", lambda: cut(CUBE.below((0, 0, -5), 0, 0), SETS)),
    ("the domain is empty", lambda: cut(CUBE, [], regions=Domain([(0, 0, 1, 0), (0, 0, -1, -1)]))),
    ("more than most_blocks = 7", lambda: cut(SLOPE, SETS, most_blocks=7)),
    ("not a rock.Domain", lambda: cut([(0, 0, 1, 1)], SETS)), ("joints[0] holds float", lambda: cut(CUBE, [[1.5]])),
    ("joints is NoneType", lambda: cut(CUBE, None)), ("joints[0] is int", lambda: cut(CUBE, [3])),
    ("least_volume=-1", lambda: cut(CUBE, [], least_volume=-1)),
    ("must lie below", lambda: Domain.box((0, 0, 0), (1, 0, 1))),
    ("a region is list", lambda: cut(CUBE, [], regions=[[1]])),
    ("at most 10 million joints", lambda: cut(CUBE, [rock.JointSet(5, 0, 1e-8)])),
    ("friction has no key None", lambda: rock.key_blocks(MASS, (), friction={0: 0.3})),
    ("friction='bedding'", lambda: rock.key_blocks(MASS, (), friction={"bedding": 0.3, None: 0.3})),
    ("hold fewer blocks", lambda: rock.limit_analysis(MASS, range(len(MASS)))),
    ("question='?' is unknown", lambda: rock.limit_analysis(MASS, [0], "?")),
    ("degrees=90", lambda: rock.limit_analysis(MASS, [0], degrees=90)),
    ("give degrees=35", lambda: rock.key_blocks(MASS, (), friction=35)),
    ("free must be numbers of planes", lambda: rock.key_blocks(MASS, [True, False])),
    ("free holds 77", lambda: rock.key_blocks(MASS, [77])),
    ("loads must be", lambda: rock.key_blocks(MASS, (), loads=np.full((len(MASS), 6), math.nan))),
    ("removed must be numbers", lambda: rock.key_blocks(MASS, (), removed=[-1])),
    ("removed must be numbers", lambda: rock.key_blocks(MASS, (), removed=[1.7])),
    ("the domain has the planes 0 to", lambda: MASS.on_domain(99)),
    ("no more than 1000000 are made", lambda: cut(UNIT, [rock.JointSet(30, 90, 1e-6)])),
    ("10 million", lambda: cut(UNIT, [rock.JointSet(30, 90, 1e-3, radius=1e-3)])),
    ("lower=(-1e+150", lambda: Domain.box((-1e150, ) * 3, (1e150, ) * 3)),
    ("extent of the domain = 1", lambda: cut(
        Domain([(*sign * axis, 1e150) for axis in np.eye(3) for sign in (1, -1)]), [])),
    ("sides=1000000000000", lambda: Domain.cylinder((0, 0, 0), (0, 0, 1), 1, sides=10**12))])
def test_what_is_refused(words, action):
    refused(action, words)


@pytest.mark.parametrize("text", [
    "x,y,z,dip,dip direction,radius\n# by hand\n0,0,0,30,90,inf\n\n1, 2, 3, 45, 200, 0.5\n",
    "x y z dip direction radius\n0 0 0 30 90 inf\n 1\t2  3 45 200 0.5 \n", "0 0 0 30 90 inf\n1 2 3 45 200 0.5\n"])
def test_fracture_networks(tmp_path, text):
    (tmp_path / "dfn.csv").write_text(text)
    assert rock.read_dfn(tmp_path / "dfn.csv") == [rock.joint((0, 0, 0), 30, 90), rock.joint((1, 2, 3), 45, 200, 0.5)]


@pytest.mark.parametrize("text, words", [
    (b"0,0,0,30,90,1\n0,0,0,thirty,90,1\n", "bad.csv, line 2, column 4: 'thirty'"),
    (b"0,0,0,30,90,1\n0,0,0,30,90\n", "bad.csv, line 2: 5 numbers, and 6"),
    (b"0,0,0,95,90,1\n", "bad.csv, line 1: dip=95"),
    # A first row with a word in it is no header.
    (b"1,2,3,3O,90,5\n1,2,3,30,90,5\n", "bad.csv, line 1, column 4: '3O'"),
    (b"1,inf,3,30,90,5\n", "bad.csv, line 1, column 2: 'inf' is no finite"),
    (b"1,2,3,30,90,5 # Kluft\xfc\n", "bad.csv is no text in UTF-8"), (b"x,y\n", "no row of numbers")])
def test_fracture_networks_that_are_none(tmp_path, text, words):
    (tmp_path / "bad.csv").write_bytes(text)
    refused(lambda: rock.read_dfn(tmp_path / "bad.csv"), words)


def test_files_of_blockgen(tmp_path):
    """x north, y east, z downwards; a plane that dips to the east descends, with z downwards, along y."""
    file = tmp_path / "joints.csv"
    file.write_text("dip;dipdir;x;y;z;a;b;phi_b;phi_r;\n30;90;1;2;3;4;5;30;25;\n")
    one, = rock.read_blockgen(file, "probabilistic")
    assert np.dot(one.normal, (0, math.cos(math.radians(30)), math.sin(math.radians(30)))) == pytest.approx(0, abs=1e-15)
    np.testing.assert_allclose(one.point, (1, 2, 3), atol=1e-12)
    # With a dip direction of 90 degrees the strike is north, x; the half lengths are those along it and down the dip.
    corners = np.array(one.outline) - (1, 2, 3)
    np.testing.assert_allclose(np.abs(corners[:, 0]), 4, atol=1e-12)
    np.testing.assert_allclose(np.hypot(corners[:, 1], corners[:, 2]), 5, atol=1e-12)
    file.write_text("dip;dipdir;spacing;phi\n0;0;0.5;30;\n")
    planes = rock.read_blockgen(file, "persistent", size=2)
    assert [round(one.point[2], 12) for one in planes] == [-1, -0.5, 0, 0.5, 1]
    assert len(cut(CUBE, planes)) == 4
    refused(lambda: rock.read_blockgen(file, "persistent"), "size is missing")
    for spacing, words in (("1e-9", "spacing=1e-09 over size=10 makes 1e+10 joints"), ("1e-320", "must be at least 1e-50")):
        file.write_text(f"30; 90; {spacing}\n")
        for said in (words, "joints.csv, line 1"):
            refused(lambda: rock.read_blockgen(file, "persistent", size=10), said)
