# SPDX-License-Identifier: MIT OR Apache-2.0
"""Surfaces from files: .stl in both forms, .obj and .gts give the same body; what is no convex surface is refused with
its place, and no damage of a file does more than that.
"""
import os
import re
import struct

import numpy as np
import pytest
from potential_particles import shapes

KINDS = ("stl binary", "stl", "obj", "gts")
# A hexagonal prism far from the origin, its sides as triangles; a cube.
ANGLES = np.arange(6) * np.pi / 3
AREA = 1.5 * 3**0.5
PRISM = np.array([(np.cos(a), np.sin(a), z) for z in (0, 2) for a in ANGLES]) + (40, 30, 20)
SIDES = [t for i in range(6) for t in ((i, (i + 1) % 6, i + 6), ((i + 1) % 6, (i + 1) % 6 + 6, i + 6))]
CAPS = [t for i in range(1, 5) for t in ((0, i + 1, i), (6, 6 + i, 7 + i))]
CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
FACES = [(0, 1, 3), (0, 3, 2), (4, 7, 5), (4, 6, 7), (0, 5, 1), (0, 4, 5), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
         (1, 5, 7), (1, 7, 3)]
SHARP = dict(rounding=1e-4, k=0.0)


def content(kind, points, triangles):
    if kind == "stl binary":
        return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(
            struct.pack("<12fH", 0, 0, 0, *points[list(three)].ravel(), 0) for three in triangles)
    if kind == "stl":
        facets = ("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.9g %.9g %.9g\n" % tuple(points[i])
                                                               for i in three) + "endloop\nendfacet\n"
                  for three in triangles)
        return ("solid mesh\n" + "".join(facets) + "endsolid mesh\n").encode()
    if kind == "obj":
        return ("".join("v %.9g %.9g %.9g\n" % tuple(p) for p in points)
                + "".join("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)).encode()
    edges = sorted({tuple(sorted(e)) for a, b, c in triangles for e in ((a, b), (b, c), (c, a))})
    number = {edge: i + 1 for i, edge in enumerate(edges)}
    return (f"{len(points)} {len(edges)} {len(triangles)} GtsSurface GtsFace GtsEdge GtsVertex\n"
            + "".join("%.9g %.9g %.9g\n" % tuple(p) for p in points)
            + "".join("%d %d\n" % (a + 1, b + 1) for a, b in edges)
            + "".join("%d %d %d\n" % tuple(number[tuple(sorted(e))] for e in ((a, b), (b, c), (c, a)))
                      for a, b, c in triangles)).encode()


def write(folder, kind, points, triangles, name="mesh"):
    path = folder / f"{name}.{kind.split()[0]}"
    path.write_bytes(content(kind, np.asarray(points, float), triangles))
    return path


def refused(path, words, **how):
    with pytest.raises(ValueError, match=re.escape(words)):
        shapes.from_mesh(path, **how)


@pytest.mark.parametrize("kind", KINDS)
def test_kinds_of_files(tmp_path, kind):
    shape = shapes.from_mesh(write(tmp_path, kind, PRISM, SIDES + CAPS), **SHARP)
    assert shape.volume == pytest.approx(2 * AREA, rel=1e-4)
    assert (len(shape.particle.planes), shape.name) == (8, "mesh")
    assert shape.centroid == pytest.approx((40, 30, 21), abs=1e-4)
    small = shapes.from_mesh(write(tmp_path, kind, PRISM, SIDES + CAPS), scale=0.001, **SHARP)
    assert small.volume * 1e9 == pytest.approx(shape.volume, rel=1e-5)


@pytest.mark.parametrize("tilt", (0.0, 1e-12, 1e-7))
def test_faces_given_twice_are_one(tilt):
    planes = [(*sign * axis, 0.5) for axis in np.eye(3) for sign in (1.0, -1.0)] + [(np.cos(tilt), np.sin(tilt), 0, 0.5)]
    shape = shapes.from_planes(planes, rounding=0.05, k=0.0)
    assert len(shape.particle.planes) == 6
    assert shape.volume == pytest.approx(shapes.cuboid(rounding=0.05, k=0.0).volume, abs=1e-6)


def test_surfaces_that_are_not_closed_or_convex(tmp_path):
    opened = write(tmp_path, "stl", PRISM, (SIDES + CAPS)[1:], "open")
    refused(opened, "open: 3 edges belong to one triangle alone, the first from (")
    dented = np.vstack([PRISM, [(40, 30, 21.5)]])
    below = [t for t in CAPS if max(t) < 6]
    dent = write(tmp_path, "obj", dented, SIDES + below + [(6 + i, 6 + (i + 1) % 6, 12) for i in range(6)], "dented")
    refused(dent, "not convex, or crosses itself: the point at (40, 30, 21.5) lies 0.5 inside")
    for path in (opened, dent):
        assert shapes.from_mesh(path, hull=True, **SHARP).volume == pytest.approx(2 * AREA, rel=1e-4)
    # Every point on the hull, but two triangles inside it.
    second = [tuple(i + 8 for i in t) for t in FACES]
    refused(write(tmp_path, "stl", np.vstack([CUBE, CUBE + (3, 0, 0)]), FACES + second, "apart"),
            "not convex, or crosses itself: the triangle at (")
    refused(write(tmp_path, "gts", np.vstack([CUBE, CUBE]), FACES + second, "doubled"), "cover its convex hull 2 times")
    flat = write(tmp_path, "stl", PRISM * (1, 1, 0), SIDES + CAPS, "flat")
    for hull in (False, True):
        refused(flat, "points are flat: all lie in one plane", hull=hull)


TETRAHEDRON = {
    kind: content(kind, np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float), [(0, 2, 1), (0, 1, 3), (1, 2, 3),
                                                                                         (0, 3, 2)]) for kind in KINDS
}


@pytest.mark.parametrize("name, text, words", [
    ("mesh.step", b"x", "files that can be read"), ("empty.stl", b"", "empty.stl"), ("empty.gts", b"", "empty.gts"),
    ("words.gts", b"these are no triangles", "words.gts"),
    ("huge.stl", bytes(80) + struct.pack("<I", 2**32 - 1), "huge.stl")])
def test_files_that_cannot_be_read(tmp_path, name, text, words):
    (tmp_path / name).write_bytes(text)
    refused(tmp_path / name, words)


def test_folders_are_no_files(tmp_path):
    refused(tmp_path, "no such file")


@pytest.mark.parametrize("name, kind, old, new, words", [
    ("zero.obj", "obj", b"f 1 3 2", b"f 0 3 2", "names v 0"),
    ("behind.obj", "obj", b"f 1 3 2", b"f -5 3 2", "names v -5"),
    ("normal.obj", "obj", b"f 1 3 2", b"f 1//1 3//2 2//9", "names vn 1, and there are 0"),
    ("claims.stl", "stl binary", struct.pack("<I", 4), struct.pack("<I", 10**9),
     "states 1000000000 triangles, and its 284 bytes hold 4"),
    ("fewer.stl", "stl binary", struct.pack("<I", 4), struct.pack("<I", 3), "states 3 triangles"),
    ("corner.stl", "stl", b"endloop", b"vertex 1 2 3\nendloop", "4 facets have 13 vertices"),
    ("negative.gts", "gts", b"4 6 4", b"4 6 -3", "4 vertices, 6 edges and -3 faces"),
    ("many.gts", "gts", b"4 6 4", b"4 1000000000 4", "1000000000 edges"),
    ("edge.gts", "gts", b"\n1 2\n", b"\n1 7\n", "vertex 7 is named, and there are 4")])
def test_numbers_that_do_not_fit_each_other(tmp_path, name, kind, old, new, words):
    assert old in TETRAHEDRON[kind]
    (tmp_path / name).write_bytes(TETRAHEDRON[kind].replace(old, new, 1))
    refused(tmp_path / name, words)


def test_scales_that_are_none(tmp_path):
    path = write(tmp_path, "stl", PRISM, SIDES + CAPS)
    for scale in (0, 1e300, 1e-300, float("nan")):
        refused(path, f"scale={scale:g}", scale=scale)
    refused(write(tmp_path, "obj", 1e30 * PRISM, SIDES + CAPS), "times scale=1e+40: point 0=", scale=1e40)
    refused(write(tmp_path, "obj", 1e60 * PRISM, SIDES + CAPS), "must lie between")


def damaged(random, whole):
    whole = bytearray(whole)
    for _ in range(random.integers(1, 4)):
        where, way = int(random.integers(len(whole))), random.integers(5)
        if way == 0:
            whole[where] = random.integers(256)
        elif way == 1:
            del whole[where:where + int(random.integers(1, 20))]
        elif way == 2:
            whole[where:where] = whole[where:where + int(random.integers(1, 60))]
        elif way == 3:
            whole[where:where] = str(random.choice([-1, 0, 7, 2**31, -2**31, 2**63, "1e308", "nan", "/", " "])).encode()
        else:
            whole[80:84] = struct.pack("<I", random.integers(2**32))
        whole = whole or bytearray(b" ")
    return bytes(whole)


@pytest.mark.parametrize("kind", KINDS)
def test_files_with_random_damage(tmp_path, kind):
    """A shape, or an error of one sentence. PP_MESH_FILES (make fuzz): how many, of a seed that is drawn."""
    seed = int.from_bytes(os.urandom(4), "little") if "PP_MESH_FILES" in os.environ else 1
    random, count = np.random.default_rng(seed), 0
    path = tmp_path / ("damaged." + kind.split()[0])
    for i in range(int(os.environ.get("PP_MESH_FILES", 150))):
        path.write_bytes(damaged(random, TETRAHEDRON[kind]))
        try:
            shapes.from_mesh(path, hull=bool(i % 2), planes=12 if i % 4 == 3 else None)
        except ValueError as error:
            count += 1
            assert "damaged" in str(error), f"seed {seed}, file {i}: the error names no file"
        except Exception as error:
            raise AssertionError(f"seed {seed}, file {i}") from error
    assert count > 20, f"seed {seed}: of damaged files so few are refused"
