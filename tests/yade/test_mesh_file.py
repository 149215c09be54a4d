# SPDX-License-Identifier: GPL-3.0-or-later
# Shapes from files: .stl in both forms, .obj and .gts give the same body; what is no convex surface is refused with its
# place.
import os
import struct
import tempfile

import numpy as np
from scipy.spatial import ConvexHull

import potential_particles
from harness import *
from potential_particles import shapes

check = Checks()
folder = tempfile.mkdtemp()


def outward(points, triangles):
    """Triangles of a convex surface, turned so that their normals point outwards."""
    middle = points.mean(0)
    return [(a, b, c) if np.dot(np.cross(points[b] - points[a], points[c] - points[a]), points[a] - middle) > 0 else
            (a, c, b) for a, b, c in triangles]


def write(kind, points, triangles, name="mesh"):
    path = os.path.join(folder, name + "." + kind.split()[0])
    if kind == "stl binary":
        with open(path, "wb") as file:
            file.write(b"\0" * 80 + struct.pack("<I", len(triangles)))
            for triangle in triangles:
                file.write(struct.pack("<12fH", 0, 0, 0, *points[list(triangle)].ravel(), 0))
    elif kind == "stl":
        with open(path, "w") as file:
            file.write("solid mesh\n")
            for triangle in triangles:
                file.write("facet normal 0 0 0\nouter loop\n")
                file.writelines("vertex %.9g %.9g %.9g\n" % tuple(points[i]) for i in triangle)
                file.write("endloop\nendfacet\n")
            file.write("endsolid mesh\n")
    elif kind == "obj":
        with open(path, "w") as file:
            file.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in points)
            file.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)
    else:
        edges = sorted({tuple(sorted(e)) for a, b, c in triangles for e in ((a, b), (b, c), (c, a))})
        number = {edge: i + 1 for i, edge in enumerate(edges)}
        with open(path, "w") as file:
            file.write(f"{len(points)} {len(edges)} {len(triangles)} GtsSurface GtsFace GtsEdge GtsVertex\n")
            file.writelines("%.9g %.9g %.9g\n" % tuple(p) for p in points)
            file.writelines("%d %d\n" % (a + 1, b + 1) for a, b in edges)
            file.writelines("%d %d %d\n" % tuple(number[tuple(sorted(e))] for e in ((a, b), (b, c), (c, a)))
                            for a, b, c in triangles)
    return path


def text(name, content, mode="w"):
    path = os.path.join(folder, name)
    with open(path, mode) as file:
        file.write(content)
    return path


# A hexagonal prism far from the origin, its sides as triangles.
angles = np.arange(6) * np.pi / 3
ring = np.column_stack([np.cos(angles), np.sin(angles)])
points = np.array([(x, y, z) for z in (0, 2) for x, y in ring]) + (40, 30, 20)
hull = ConvexHull(points)
triangles = outward(points, hull.simplices)
area = 1.5 * 3**0.5
for kind in ("stl binary", "stl", "obj", "gts"):
    shape = shapes.from_mesh(write(kind, points, triangles), rounding=1e-4, k=0.0)
    check.close(shape.volume / (2 * area), 1.0, 1e-4, f".{kind}: volume")
    check.equal(len(shape.planes), 8, f".{kind}: coplanar triangles are one face")
    check.close(Vector3(*shape.centroid), Vector3(40, 30, 21), 1e-4, f".{kind}: stands as in the file")
check.equal(shape.name, "mesh", "named by its file")
large = shapes.from_mesh(write("stl", points, triangles), rounding=1e-4, k=0.0, scale=0.001)
check.close(large.volume * 1e9 / shape.volume, 1.0, 1e-5, "scaled")

# A fine sphere: many faces.
random = np.random.default_rng(0)
ball = random.normal(size=(100, 3))
ball /= np.linalg.norm(ball, axis=1)[:, None]
fine = ConvexHull(ball)
shape = shapes.from_mesh(write("stl binary", ball, outward(ball, fine.simplices), "ball"), rounding=0.002, k=0.0,
                         planes="all")
check.true(len(shape.planes) > 150 and 0.99 < shape.volume / fine.volume < 1.0, f"a ball of {len(shape.planes)} faces")

# A turned brick far from the origin of its file, whose numbers have seven digits.
w = np.random.default_rng(7)
brick, sides = np.array([(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 3)], float), [(0, 1, 3), (0, 3, 2),
                                                                                              (4, 7, 5), (4, 6, 7),
                                                                                              (0, 5, 1), (0, 4, 5),
                                                                                              (2, 3, 7), (2, 7, 6),
                                                                                              (0, 2, 6), (0, 6, 4),
                                                                                              (1, 5, 7), (1, 7, 3)]
for number in range(20):
    turn = np.linalg.qr(w.normal(size=(3, 3)))[0]
    at = [[float("%.7g" % one) for one in point] for point in brick @ turn.T + w.uniform(100, 900, 3)]
    shape = shapes.from_mesh(write("stl", np.array(at), sides, "digits"), scale=0.1, rounding=0.05, k=0.0)
    check.equal(len(shape.planes), 6, f"planes of brick {number}")
    check.close(shape.volume,
                shapes.cuboid((0.1, 0.2, 0.3), rounding=0.05, k=0.0).volume, 3e-3 * shape.volume,
                f"volume of brick {number}")

# Faces that are given twice, turned by next to nothing, are one.
for tilt in 0.0, 1e-12, 1e-7:
    planes = [(*sign * axis, 0.5) for axis in np.eye(3)
              for sign in (1.0, -1.0)] + [(np.cos(tilt), np.sin(tilt), 0, 0.5)]
    shape = shapes.from_planes(planes, rounding=0.05, k=0.0)
    check.equal(len(shape.planes), 6, f"planes with a face turned by {tilt:g}")
    check.close(shape.volume,
                shapes.cuboid(rounding=0.05, k=0.0).volume, 1e-6, f"volume with a face turned by {tilt:g}")

# What is no convex closed surface: what and where.
opened = write("stl", points, triangles[1:], "open")
check.raises(ValueError, lambda: shapes.from_mesh(opened), "open",
             "open: 3 edges belong to one triangle alone, the first from (")
check.close(
    shapes.from_mesh(opened, rounding=1e-4, k=0.0, hull=True).volume / (2 * area), 1.0, 1e-4,
    "hull=True takes the hull")
dented = np.vstack([points, [(40, 30, 21.5)]])
top = [t for t in triangles if all(points[i][2] == 22 for i in t)]
sides = [t for t in triangles if t not in top]
rim = [6 + i for i in range(6)]
cone = [(rim[i], rim[(i + 1) % 6], 12) for i in range(6)]
check.raises(ValueError, lambda: shapes.from_mesh(write("obj", dented, sides + cone, "dented")), "a dent",
             "not convex, or crosses itself: the point at (40, 30, 21.5) lies 0.5 inside")
check.close(
    shapes.from_mesh(write("obj", dented, sides + cone, "dented"), rounding=1e-4, k=0.0, hull=True).volume / (2 * area),
    1.0, 1e-4, "its hull")
# Every point on the hull, but two triangles inside it: an edge that is turned.
cube = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
bent = np.vstack([cube, cube + (3, 0, 0)])
two = [tuple(int(i) for i in t) for t in ConvexHull(cube).simplices]
apart = outward(cube, two) + [tuple(i + 8 for i in t) for t in outward(cube, two)]
check.raises(ValueError, lambda: shapes.from_mesh(write("stl", bent, apart, "apart")), "two bodies",
             "not convex, or crosses itself: the triangle at (")
doubled = write("gts", np.vstack([cube, cube * (1, 1, 1)]),
                outward(cube, two) + [tuple(i + 8 for i in t) for t in outward(cube, two)], "doubled")
check.raises(ValueError, lambda: shapes.from_mesh(doubled), "a surface given twice", "cover its convex hull 2 times")
flat = write("stl", points * (1, 1, 0), triangles, "flat")
for hull_too in (False, True):
    check.raises(ValueError, lambda: shapes.from_mesh(flat, hull=hull_too), "flat",
                 "points are flat: all lie in one plane")

# What cannot be read.
for path, words in [(os.path.join(folder, "none.stl"), "no such file"), (folder, "no such file"),
                    (text("mesh.step", "x"), "files that can be read"), (text("empty.stl", ""), "empty.stl"),
                    (text("empty.obj", ""), "empty.obj"), (text("empty.gts", ""), "empty.gts"),
                    (text("words.stl", "these are no triangles"), "words.stl"),
                    (text("words.gts", "these are no triangles"), "words.gts"),
                    (text("short.stl", b"\0" * 80 + struct.pack("<I", 100) + b"\0" * 60, "wb"), "short.stl"),
                    (text("huge.stl", b"\0" * 80 + struct.pack("<I", 2**32 - 1), "wb"), "huge.stl"),
                    (text("nan.obj",
                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan nan 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n"), "nan.obj")]:
    check.raises(ValueError, lambda: shapes.from_mesh(path), f"unreadable: {words}", words)
# Numbers that do not fit each other, which would end the process in a reader.
corners, sides = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float), [(0, 2, 1), (0, 1, 3), (1, 2, 3),
                                                                                 (0, 3, 2)]
tetrahedron = {
    kind: open(write(kind, corners, sides, "tetrahedron"), "rb").read()
    for kind in ("stl binary", "stl", "obj", "gts")
}
for name, kind, old, new, words in [
    ("index.obj", "obj", b"f 1 3 2", b"f 1 3 99999999", "names v 99999999, and there are 4"),
    ("zero.obj", "obj", b"f 1 3 2", b"f 0 3 2", "names v 0"),
    ("behind.obj", "obj", b"f 1 3 2", b"f -5 3 2", "names v -5"),
    ("normal.obj", "obj", b"f 1 3 2", b"f 1//1 3//2 2//9", "names vn 1, and there are 0"),
    ("claims.stl", "stl binary", struct.pack("<I", 4), struct.pack("<I", 10**9),
     "states 1000000000 triangles, and its 284 bytes hold 4"),
    ("fewer.stl", "stl binary", struct.pack("<I", 4), struct.pack("<I", 3), "states 3 triangles"),
    ("corner.stl", "stl", b"endloop", b"vertex 1 2 3\nendloop", "4 facets have 13 vertices"),
    ("negative.gts", "gts", b"4 6 4", b"4 6 -3", "4 vertices, 6 edges and -3 faces"),
    ("many.gts", "gts", b"4 6 4", b"4 1000000000 4", "1000000000 edges"),
    ("edge.gts", "gts", b"\n1 2\n", b"\n1 7\n", "vertex 7 is named, and there are 4"),
]:
    broken = text(name, tetrahedron[kind].replace(old, new, 1), "wb")
    check.raises(ValueError, lambda: shapes.from_mesh(broken), name, words)

# Files with random damage: a shape, or an error of one sentence. PP_MESH_FILES (make fuzz) sets how many of each kind,
# of a seed that is drawn.
seed = int.from_bytes(os.urandom(4), "little") if "PP_MESH_FILES" in os.environ else 1
random = np.random.default_rng(seed)


def damaged(content):
    content = bytearray(content)
    for _ in range(random.integers(1, 4)):
        where, way = int(random.integers(len(content))), random.integers(5)
        if way == 0:
            content[where] = random.integers(256)
        elif way == 1:
            del content[where:where + int(random.integers(1, 20))]
        elif way == 2:
            content[where:where] = content[where:where + int(random.integers(1, 60))]
        elif way == 3:
            content[where:where] = str(random.choice([-1, 0, 7, 2**31, -2**31, 2**63, "1e308", "nan", "/",
                                                      " "])).encode()
        else:
            content[80:84] = struct.pack("<I", random.integers(2**32))
        content = content or bytearray(b" ")
    return bytes(content)


refused = {}
for kind, content in tetrahedron.items():
    for i in range(int(os.environ.get("PP_MESH_FILES", 150))):
        broken = text("damaged." + kind.split()[0], damaged(content), "wb")
        try:
            shapes.from_mesh(broken, hull=bool(i % 2), planes=12 if i % 4 == 3 else None)
        except ValueError as error:
            refused[kind] = refused.get(kind, 0) + 1
            if "damaged" not in str(error):
                check.true(False, f"seed {seed}, {kind}, file {i}: the error names no file: {error}")
        except Exception as error:
            check.true(False, f"seed {seed}, {kind}, file {i}: {error!r}")
check.true(min(refused.get(kind, 0) for kind in tetrahedron) > 20, f"damaged files are refused, seed {seed}: {refused}")
check.raises(ValueError, lambda: shapes.from_mesh(write("stl", points, triangles), scale=0), "scale", "scale=0")
for scale in (1e300, 1e-300, float("nan")):
    check.raises(ValueError, lambda: shapes.from_mesh(write("stl", points, triangles), scale=scale), "scale",
                 f"scale={scale:g}")
check.raises(ValueError, lambda: shapes.from_mesh(write("obj", 1e30 * points, triangles), scale=1e40),
             "points times scale", "times scale=1e+40: point 0=")
check.raises(ValueError, lambda: shapes.from_mesh(write("obj", 1e60 * points, triangles)), "points", "must lie between")
check.finish()
