# SPDX-License-Identifier: GPL-3.0-or-later
# Shapes from planes, points and names of solids: where their faces are, mass against closed forms, bad input.
import math
import warnings

import numpy as np

import potential_particles
import yade
from harness import *
from potential_particles import shapes

check = Checks()


def surface(shape, directions):
    """Points of the surface in the builder's frame."""
    particle = potential_particles.conic_particle(shape)
    directions = np.asarray(directions, float)
    lengths = np.array(particle.surfaceDistance([Vector3(*one) for one in directions]))
    points = directions / np.linalg.norm(directions, axis=1)[:, None] * lengths[:, None]
    return points @ rotation(shape).T + shape.centroid


def rotation(shape):
    matrix = Quaternion(*shape.orientation).toRotationMatrix()
    return np.array([[matrix[i, j] for j in range(3)] for i in range(3)])


random = np.random.default_rng(3)
everywhere = random.normal(size=(4000, 3))


def reach(shape, direction):
    """How far the surface goes along a direction of the builder's frame: by Newton's method on its normal, from many
    points.
    """
    normals = rotation(shape).T @ (np.asarray(direction, float) / np.linalg.norm(direction))
    planes = np.array(shape.planes).reshape(-1, 4)
    # Maximise n.x subject to S(x) = 1: by scipy, an independent way.
    from scipy.optimize import minimize

    def s(x):
        beyond = np.maximum(planes[:, :3] @ x - planes[:, 3], 0.0)
        return (1 - shape.k) / shape.r**2 * (beyond**2).sum() + shape.k / shape.R**2 * (x @ x)

    def slope(x):
        beyond = np.maximum(planes[:, :3] @ x - planes[:, 3], 0.0)
        return 2 * (1 - shape.k) / shape.r**2 * (beyond @ planes[:, :3]) + 2 * shape.k / shape.R**2 * x
    start = normals * potential_particles.conic_particle(shape).surfaceDistance([Vector3(*normals)])[0]
    found = minimize(lambda x: -normals @ x, start, jac=lambda x: -normals, method="SLSQP",
                     options={"ftol": 1e-12, "maxiter": 500},
                     constraints={"type": "ineq", "fun": lambda x: 1 - s(x), "jac": lambda x: -slope(x)})
    return -found.fun + np.dot(shape.centroid, direction) / np.linalg.norm(direction)


# Where faces are. A skew body far from the origin: five planes of a wedge, normals of any length.
planes = [(0, 0, -2, -2 * 9.0), (0, 3, 0, 3 * 6.0), (0, -1, 0, -4.5), (2, 0, 1, 2 * 5 + 11), (-1, 0, 1, -4 + 10.5)]
for r, k in [(0.02, 0.0), (0.1, 0.02), (0.2, 0.3)]:
    shape = shapes.from_planes(planes, rounding=r, k=k)
    points = surface(shape, everywhere)
    unit = np.array([np.array(p) / np.linalg.norm(p[:3]) for p in planes])
    excess = (points @ unit[:, :3].T - unit[:, 3]).max()
    check.true(excess < 1e-9, f"r={r}, k={k}: no part lies outside the planes, {excess:g}")
    # At the foot of the perpendicular from the centre, but where another plane counts there, too.
    feet = -(unit[:, :3] @ shape.centroid - unit[:, 3])
    touching = surface(shape, (unit[:, :3]) @ rotation(shape))
    apart = np.abs((touching * unit[:, :3]).sum(1) - unit[:, 3])
    check.true(np.sort(apart)[1] < 1e-9 * feet.max(), f"r={r}, k={k}: faces are where the planes are: {apart}")
    own = np.array(shape.planes)
    check.true(abs(np.linalg.norm(own[:, :3], axis=1) - 1).max() < 1e-12, "normals are unit vectors")
    # The frame: its own centroid and principal axes.
    volume, centroid, inertia, error = potential_particles.conic_particle(shape).massProperties(1e-7)
    off_axes = max(abs(inertia[i, j]) for i, j in ((0, 1), (1, 2), (0, 2)))
    check.true(centroid.norm() < 1e-5 * shape.bounding_radius and off_axes < 3e-5 * inertia[0, 0],
               f"r={r}, k={k}: principal frame: {centroid}, {off_axes / inertia[0, 0]:g}")
    check.close(shape.volume / volume, 1.0, 1e-6, "volume")
    check.true(error <= 1e-7 and shape.error <= 1e-6, "errors as asked for")

# Sharp limits: volume and inertia of solids in closed form; with k = 0 and r -> 0 the body is the solid.
sharp = {"rounding": 1e-5, "k": 0.0}
a, b, c = 1.0, 2.0, 0.5
box = shapes.cuboid((a, b, c), **sharp)
check.close(box.volume, a * b * c, 1e-6, "volume of a cuboid")
for found, expected in zip(box.inertia, [(b * b + c * c) / 12, (a * a + c * c) / 12, (a * a + b * b) / 12]):
    check.close(found, expected * a * b * c, 2e-6, "inertia of a cuboid")
check.equal((box.orientation, box.centroid), ((1, 0, 0, 0), (0, 0, 0)), "frame of a cuboid")
ball = shapes.sphere(2.0)
check.close(ball.volume / (4 / 3 * math.pi * 8), 1.0, 1e-6, "volume of a sphere")
check.close(ball.inertia[0] / (0.4 * 4 * ball.volume), 1.0, 1e-6, "inertia of a sphere")
check.close(ball.equivalent_diameter, 4.0, 1e-5, "its diameter")
for sides in (3, 6, 7):
    area = sides * 0.25 * math.tan(math.pi / sides)
    check.close(
        shapes.prism(sides, 0.5, 2.0, **sharp).volume / (2 * area), 1.0, 1e-5, f"volume of a prism of {sides} sides")
cylinder = shapes.cylinder(0.5, 2.0, 48, **sharp)
check.close(cylinder.volume / (math.pi / 2), 1.0, 1e-4, "volume of a cylinder")
# Round bodies have the size that is asked for, by default and with more sides.
for name, made, volume in [("cylinder", shapes.cylinder(0.05, 0.1), math.pi * 0.05**2 * 0.1),
                           ("cylinder of 256 sides", shapes.cylinder(0.05, 0.1, 256), math.pi * 0.05**2 * 0.1),
                           ("cone", shapes.cone(0.5, 1.0), math.pi / 12),
                           ("ellipsoid", shapes.ellipsoid((1, 0.7, 0.5)), 1.4 / 3 * math.pi),
                           ("capsule", shapes.capsule(0.5, 1.0), math.pi * (0.25 + 1 / 6)),
                           ("superquadric", shapes.superquadric((1, 0.7, 0.5), (1, 1)), 1.4 / 3 * math.pi)]:
    check.close(made.volume / volume, 1.0, 5e-3, f"volume of a {name}")
    check.close(made.sharp_volume / volume, 1.0, 1e-9, "and that of what was asked for")
    check.close(potential_particles.conic_particle(made).massProperties(1e-5)[0] / made.volume, 1.0, 1e-5, "as YADE has it")
    check.close(made.scaled(2.0).sharp_volume / volume, 8.0, 1e-8, "twice as large")
check.raises(ValueError, lambda: shapes.cuboid(k=1), "k = 1 has no faces", "sphere(R)")
pyramid = shapes.prism(4, 0.5, 1.0, top_radius=0.0, **sharp)
check.close(pyramid.volume * 3, 1.0, 1e-5, "volume of a pyramid")
check.close(pyramid.centroid[2], -0.25, 1e-5, "centroid of a pyramid: a quarter of its height above the base")
volumes = {
    4: 1 / (6 * math.sqrt(2)), 6: 1.0, 8: math.sqrt(2) / 3, 12: (15 + 7 * math.sqrt(5)) / 4, 20: 5 *
                                                                                                 (3 + math.sqrt(5)) / 12
}
for faces, volume in volumes.items():
    solid = shapes.platonic_solid(faces, edge=2.0, **sharp)
    check.close(solid.volume / (8 * volume), 1.0, 1e-5, f"volume of the regular solid of {faces} faces")
    check.equal(len(solid.planes), faces, "its faces: coplanar triangles are one")
    check.close(max(solid.inertia) / min(solid.inertia), 1.0, 1e-5, "its inertia is the same about all axes")

# Points of a cuboid on a turned frame far away: principal axes lie along its edges, and the centroid is its centre.
turn = turned((1, 2, 3), 0.7)
corners = [turn * Vector3(x, 2 * y, 4 * z) + Vector3(100, 50, -20) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
inside = [turn * Vector3(*one) + Vector3(100, 50, -20) for one in random.uniform(-1, 1, (20, 3))]
shape = shapes.from_vertices(corners + inside, **sharp)
check.equal(len(shape.planes), 6, "faces of the hull of a cuboid")
check.close(shape.volume / 64, 1.0, 1e-5, "its volume")
check.close(Vector3(*shape.centroid), Vector3(100, 50, -20), 1e-4, "its centroid")
axes = np.abs(rotation(shape).T @ np.array([[*(turn * Vector3(*one))] for one in np.eye(3)]).T)
check.true(np.abs(np.sort(axes, axis=0)[2] - 1).max() < 1e-5, f"its principal axes: {axes}")

# Scaling.
small, large = shapes.random_rock(5), shapes.random_rock(5).scaled(1000.0)
again = potential_particles.conic_particle(large).massProperties()
check.close(again[0] / large.volume, 1.0, 3e-6, "volume of a scaled shape")
check.close(again[2][1, 1] / large.inertia[1], 1.0, 3e-6, "its inertia")
check.close(large.bounding_radius / small.bounding_radius, 1000.0, 1e-6, "its bounding radius")

# Rocks: extents as asked for, the same for the same seed.
for seed, elongation, flatness in [(1, 1.0, 1.0), (2, 0.5, 0.7), (3, 0.9, 0.3)]:
    rock = shapes.random_rock(seed, 2.0, elongation, flatness, faces=30)
    extents = [reach(rock, axis) + reach(rock, -axis) for axis in np.eye(3)]
    for found, expected in zip(extents, (2.0 / elongation, 2.0, 2.0 * flatness)):
        check.close(found / expected, 1.0, 2e-3, f"extents of rock {seed}: {extents}")
    check.equal(shapes.random_rock(seed, 2.0, elongation, flatness, faces=30), rock, "the same rock again")
check.true(shapes.random_rock(8) != shapes.random_rock(9), "another seed is another rock")

# A shape never changes, and a cube stays one as k grows: only rounder.
check.raises(AttributeError, lambda: setattr(rock, "r", 1.0), "a shape is immutable")
last = math.inf
for k in (0.0, 0.02, 0.2, 0.6):
    cube = shapes.cuboid(rounding=0.1, k=k)
    check.equal(cube.centroid, (0, 0, 0), "centre of a cube")
    check.true(cube.volume < 1.0, "it lies inside the sharp cube")

# r and R are lengths, as of a particle, and rounding a share of the size; scripts of before are told so, once.
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    small = shapes.cuboid((0.4, 0.2, 0.3), r=0.01, k=0.0)
    check.equal(small.r, 0.01, "r is a length")
    share = shapes.cuboid((0.4, 0.2, 0.3), rounding=0.05, k=0.0)
    check.close(share.r, 0.01, 1e-15, "and a share of the size by another keyword")
    check.equal(shapes.cuboid((0.4, 0.2, 0.3), 0.05, 0.0), share, "which is the one without a name, as before")
    check.close(shapes.cuboid((4, 2, 3), R=3.0).R, 3.0, 1e-12, "R is a length")
    check.raises(ValueError, lambda: shapes.cuboid((0.04, 0.02, 0.03), r=0.05), "r of before",
                 "r=0.05 is a length and must lie between 0 and 0.01, half")
check.equal([one.category for one in said], [FutureWarning], "once a process")
check.true("r=0.05 of then is rounding=0.05" in str(said[0].message), f"{said[0].message}")

# Bad input: a sentence that names the value.
nan = float("nan")
for action, words in [(lambda: shapes.sphere(-1), "radius=-1"), (lambda: shapes.sphere(nan), "radius=nan"),
                      (lambda: shapes.sphere("a"), "is no number"), (lambda: shapes.cuboid((1, 1, 0)), "above 0"),
                      (lambda: shapes.cuboid(
                          (1, 1)), "has 2 numbers"), (lambda: shapes.cuboid(rounding=0), "rounding=0"),
                      (lambda: shapes.cuboid(rounding=0.5), "between 0 and 0.5"),
                      (lambda: shapes.cuboid(k=-0.1), "k=-0.1"), (lambda: shapes.cuboid(k=1.5), "k=1.5"),
                      (lambda: shapes.cuboid(k=nan), "k=nan"), (lambda: shapes.cuboid(k=0.1, R=0), "R=0"),
                      (lambda: shapes.prism(2), "sides"), (lambda: shapes.prism(6, 0.5, -1), "height=-1"),
                      (lambda: shapes.cylinder(0), "radius=0"), (lambda: shapes.platonic_solid(5), "faces=5"),
                      (lambda: shapes.platonic_solid(8, edge=nan), "edge=nan"),
                      (lambda: shapes.random_rock(-1), "seed"),
                      (lambda: shapes.cuboid(rounding=0.1, r=0.1), "rounding=0.1 and r=0.1 both give"),
                      (lambda: shapes.random_rock(1, elongation=0), "elongation=0"),
                      (lambda: shapes.random_rock(1, flatness=2), "flatness=2"),
                      (lambda: shapes.random_rock(1, faces=4), "faces"),
                      (lambda: shapes.from_planes([]), "planes is empty"),
                      (lambda: shapes.from_planes([(1, 0, 0)]), "row 0 has 3 numbers"),
                      (lambda: shapes.from_planes([(1, 0, 0, nan)]), "row 0"),
                      (lambda: shapes.from_planes([(0, 0, 0, 1)] + planes), "plane 0 is none"),
                      (lambda: shapes.from_planes(planes[:4], k=0.0), "enclose no volume"),
                      (lambda: shapes.from_planes(planes[1:], k=0.1), "enclose no volume"),
                      (lambda: shapes.from_planes([(1, 0, 0, 1), (-1, 0, 0, 1)]), "enclose no volume"),
                      (lambda: shapes.from_planes([(1, 0, 0, -1), (-1, 0, 0, -1), (0, 1, 0, 1), (0, -1, 0, 1),
                                                   (0, 0, 1, 1), (0, 0, -1, 1)]), "no point lies inside"),
                      (lambda: shapes.from_vertices([]), "0 points"),
                      (lambda: shapes.from_vertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (2, 1, 0)]), "flat"),
                      (lambda: shapes.from_vertices([(0, 0, 0)] * 9), "flat"),
                      (lambda: shapes.from_vertices([(0, 0, 0), (1, 0, 0), (0, 1, 0), (nan, 1, 1)]), "row 3"),
                      (lambda: ball.scaled(0), "factor=0")]:
    check.raises(ValueError, action, f"bad input: {words}", words)
check.equal(len(O.bodies), 0, "nothing was put into the scene")
# Printed, a shape is a line, and so is a place in a packing.
rock = shapes.random_rock(1, size=0.1)
check.true("\n" not in repr(rock) and len(repr(rock)) < 140 and "24 planes" in repr(rock) and rock.name in repr(rock),
           f"printed: {rock}")
place = potential_particles.pack(potential_particles.packing.Box((0, 0, 0), (1, 1, 1)), rock, number=1,
                                 progress=False)[0]
check.true(len(repr(place)) < 400 and repr(rock) in repr(place), f"printed: {place}")


# Numbers that nothing can be made of, and loops that would not end: a sentence before any work.
for name, make, words in [
    ("a small sphere", lambda: shapes.sphere(1e-110), "radius=1e-110 must be at least 1e-50"),
    ("a large sphere", lambda: shapes.sphere(1e300), "radius=1e+300"),
    ("R", lambda: shapes.cuboid(R=1e-110), "R=1e-110"),
    ("a small cuboid", lambda: shapes.cuboid((1e-60, 1e-60, 1e-60)), "edges=1e-60 must be at least"),
    ("points", lambda: shapes.from_vertices([(1e200, 0, 0), (0, 1, 0), (0, 0, 1),
                                             (0, 0, 0)]), "points 0=(1e+200, 0, 0)"),
    ("scaled", lambda: shapes.sphere(1e-30).scaled(1e-30), "bounding radius"),
    ("sides of a prism", lambda: shapes.prism(10**9), "sides=1000000000"),
    ("sides of a cylinder", lambda: shapes.cylinder(sides=10**12), "sides=1000000000000"),
    ("faces", lambda: shapes.random_rock(1, faces=10**9), "faces=1000000000"),
    ("planes", lambda: shapes.from_vertices(np.eye(3).tolist() + [(0, 0, 0)], planes=10**9), "planes=1000000000"),
]:
    check.raises(ValueError, make, name, words)
for length in (1e200, 1e-200):
    rows_of_cube = [(length * a, length * b, length * c, length)
                    for a, b, c in [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]]
    check.close(
        shapes.from_planes(rows_of_cube, rounding=1e-4, k=0.0).volume, 8.0, 1e-3, f"normals of length {length:g}")
# What R does to a shape is told.
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    shapes.cuboid(R=0.1)
check.true(any("R=0.1: a sphere of radius" in str(one.message) for one in caught), "a shadow sphere that cuts is told")
check.finish()
