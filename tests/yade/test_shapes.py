# SPDX-License-Identifier: GPL-3.0-or-later
# Shapes from planes, points and names of solids: where their faces are, their frames and their mass in YADE. What needs
# no YADE: python/tests/test_shapes.py.
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

# Round bodies have the size that is asked for in YADE, too.
for name, made in [("cylinder", shapes.cylinder(0.05, 0.1)), ("cone", shapes.cone(0.5, 1.0)),
                   ("ellipsoid", shapes.ellipsoid((1, 0.7, 0.5))), ("capsule", shapes.capsule(0.5, 1.0)),
                   ("superquadric", shapes.superquadric((1, 0.7, 0.5), (1, 1)))]:
    check.close(potential_particles.conic_particle(made).massProperties(1e-5)[0] / made.volume, 1.0, 1e-5, f"volume of a {name}")
    check.close(made.scaled(2.0).sharp_volume / made.sharp_volume, 8.0, 1e-8, "twice as large")

# Points of a cuboid on a turned frame far away: principal axes lie along its edges, and the centroid is its centre.
turn = turned((1, 2, 3), 0.7)
corners = [turn * Vector3(x, 2 * y, 4 * z) + Vector3(100, 50, -20) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
inside = [turn * Vector3(*one) + Vector3(100, 50, -20) for one in random.uniform(-1, 1, (20, 3))]
shape = shapes.from_vertices(corners + inside, rounding=1e-5, k=0.0)
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

check.raises(AttributeError, lambda: setattr(rock, "r", 1.0), "a shape is immutable")
check.equal(len(O.bodies), 0, "nothing was put into the scene")
# Printed, a shape is a line, and so is a place in a packing.
rock = shapes.random_rock(1, size=0.1)
check.true("\n" not in repr(rock) and len(repr(rock)) < 140 and "24 planes" in repr(rock) and rock.name in repr(rock),
           f"printed: {rock}")
place = potential_particles.pack(potential_particles.packing.Box((0, 0, 0), (1, 1, 1)), rock, number=1,
                                 progress=False)[0]
check.true(len(repr(place)) < 400 and repr(rock) in repr(place), f"printed: {place}")

check.finish()
