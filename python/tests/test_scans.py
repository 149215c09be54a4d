# SPDX-License-Identifier: MIT OR Apache-2.0
"""Surfaces of many facets as shapes of few planes: volume, place and the error that is told against those given."""
import warnings

import numpy as np
import pytest
from potential_particles import shapes
from test_mesh_files import CUBE, FACES, refused, write


def told(action):
    """What an action returns, and what it warns of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = action()
    return made, [str(one.message) for one in caught]


def surface_distance(shape, points):
    """How far points lie from the surface of a shape, by bisection along its rays, over the diameter of the ball of its
    volume: never less than the true one.
    """
    local = np.array([shape.pose.to_local(point) for point in points])
    body, low, high = shape.particle, np.zeros(len(points)), np.full(len(points), 10.0)
    for _ in range(60):
        middle = 0.5 * (low + high)
        at = middle[:, None] * local
        s = (1 - body.k) / body.r**2 * (np.maximum(at @ body.planes[:, :3].T - body.planes[:, 3], 0.0)**
                                        2).sum(1) + body.k / body.R**2 * (at**2).sum(1)
        low, high = np.where(s < 1, middle, low), np.where(s < 1, high, middle)
    return np.abs(1 - low) * np.linalg.norm(local, axis=1) / shape.equivalent_diameter


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """(file, points, middles of the triangles, volume) of a smooth scan: an ellipsoid far from the origin."""
    ball = shapes.sphere(1.0).particle.mesh(1e-2)
    points, triangles = ball.vertices * (1.0, 0.8, 0.6), ball.triangles
    assert len(points) > 300
    a, b, c = (points[triangles[:, i]] for i in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    place = np.array((30, -20, 10))
    file = write(tmp_path_factory.mktemp("scan"), "obj", points + place, triangles, "scan")
    return file, points + place, (a + b + c) / 3 + place, volume


def test_few_planes_keep_the_volume(scan):
    file, points, middle, volume = scan
    errors = []
    for planes in 12, 30, 100:
        shape, said = told(lambda: shapes.from_mesh(file, planes=planes))
        assert len(shape.particle.planes) <= planes and not said
        assert shape.particle.mass_properties(1e-6).volume == pytest.approx(volume, rel=1e-5)
        assert shape.fit.volume == pytest.approx(volume, rel=1e-6)
        assert shape.centroid == pytest.approx((30, -20, 10), abs=0.03)
        found = surface_distance(shape, np.concatenate([points, middle]))
        assert 0.5 * found.max() < shape.fit.largest <= found.max() * 1.001
        assert 0.5 < shape.fit.mean / np.sqrt((found**2).mean()) <= 1.001
        assert f"{shape.fit.largest:.2g} of its diameter" in repr(shape) and "\n" not in repr(shape)
        errors.append(shape.fit.mean)
    assert errors[0] > 1.5 * errors[1] > 1.5 * errors[2]
    assert shape.scaled(2.0).fit.volume == pytest.approx(8 * shape.fit.volume, rel=1e-9)


def test_a_given_error(scan):
    file, points, _, volume = scan
    exact = shapes.from_mesh(file, error=0.03)
    assert exact.fit.largest <= 0.03 and len(exact.particle.planes) < 40
    refused(file, "error=1e-07 is not reached", error=1e-7)
    refused(file, "up to 20 planes", error=1e-4, planes=20)
    refused(file, "planes=3", planes=3)
    given = shapes.from_vertices(points, planes=30, rounding=0.05)
    assert given.volume == pytest.approx(volume, rel=1e-4)
    twice = shapes.from_vertices(points, planes=30, rounding=0.1)
    assert given.particle.r / twice.particle.r == pytest.approx(0.5, abs=0.05)


def test_all_faces(scan, tmp_path):
    """r gives way to the volume, and says so where it may not."""
    file, _, _, volume = scan
    shape, said = told(lambda: shapes.from_mesh(file))
    assert len(shape.particle.planes) <= 60 and len(said) == 1
    assert "60 planes in the place of" in said[0] and f"{shape.fit.largest:.2g}" in said[0]
    assert shape.volume == pytest.approx(volume, rel=1e-4)
    for how in ({}, {"rounding": 0.05}):
        shape, said = told(lambda: shapes.from_mesh(file, planes="all", **how))
        assert len(shape.particle.planes) > 1600 and 0.98 < shape.volume / volume < 0.995 and not said
    path = write(tmp_path, "obj", 2 * CUBE, FACES, "cube")
    cube, said = told(lambda: shapes.from_mesh(path))
    assert (len(cube.particle.planes), said) == (6, [])
    # The default r, which costs less than a hundredth.
    assert cube.particle.r == pytest.approx(0.1, abs=1e-9)
    shape, said = told(lambda: shapes.from_mesh(path, rounding=0.2))
    assert len(said) == 1 and "% less volume than the surface" in said[0] and f"{shape.particle.r:.3g}" in said[0]
    few = shapes.from_vertices(2 * CUBE, planes=30)
    assert len(few.particle.planes) == 6 and few.fit.largest < 0.02
