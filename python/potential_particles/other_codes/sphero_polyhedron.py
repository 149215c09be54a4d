# SPDX-License-Identifier: MIT OR Apache-2.0
"""Sphero-polyhedra, all points within a radius of a convex polyhedron, as shapes.

Planes are those of the polyhedron, moved outwards by the radius, which is r, too: faces lie where they are, and so do
edges and corners where faces meet at right angles. Elsewhere r rounds by an ellipse what the radius rounds by a circle:
blunt edges lose, sharp ones gain.
"""
import collections
import dataclasses
import math
import typing

import numpy as np

from .. import shapes
from ..arguments import positive
from ..fitting import WARNED
from ..packing import product
from ..polyhedron import Polyhedron, rounded
from ..shape import Shape

# Points that leave the line or plane of the others by less than this share of their extent lie in it.
FLAT = 1e-6
# A shape has r below half its thickness: that of a plate would be the half.
OF_PLATE = 0.999
WHY = "edges that are not square are rounded by ellipses"


class SpheroPolyhedron(typing.NamedTuple):
    """All points within a radius of the convex hull of points."""

    shape: Shape  #: in the frame of the points
    volume: float  #: exact, length^3
    #: of the volume of the hull over that of the body, a share of that; None where that is unknown
    excess: typing.Optional[float]


def sphero_polyhedron(points, radius, name, faces, stated=None):
    """The SpheroPolyhedron of points (n, 3) and a radius (length).

    faces: lists of indices of points; stated: the volume that the file has. By them a body that is not convex is known.
    A point is a sphere, points on a line are a capsule, points in a plane a plate.
    """
    radius = positive(radius, "radius")
    middle = points.mean(0)
    # By R of QR, which has three rows at most.
    _, extents, axes = np.linalg.svd(np.linalg.qr(points - middle, mode="r"))
    size = max(radius, np.ptp(points, axis=0).max())
    dimension = int((extents > FLAT * size).sum())
    if dimension == 0:
        shape = dataclasses.replace(shapes.sphere(radius, name), centroid=tuple(middle.tolist()))
        return SpheroPolyhedron(shape, shape.volume, 0.0)
    if dimension == 1:
        return SpheroPolyhedron(*_capsule(points, axes[0], radius, name), 0.0)
    if dimension == 2:
        shape, volume, whole = _plate(points, axes[2], radius, name)
        part = sum(abs(area_vector(points[face]) @ axes[2]) for face in faces)
    else:
        hull = Polyhedron.of_points(points, 0.0)
        shape = rounded(Polyhedron.of_planes(hull.normals, hull.offsets + radius), radius, 0.0, None, name)
        volume, whole, part = steiner(hull, radius), hull.volume, enclosed(points, faces)
    if part:
        return SpheroPolyhedron(shape, volume, whole / part - 1.0)
    excess = volume / stated - 1.0 if stated and stated > 0.0 else -1.0
    # More than the hull has is no volume of the body.
    return SpheroPolyhedron(shape, volume, excess if excess > -WARNED else None)


def steiner(hull, radius):
    """Volume of all points within a radius of a Polyhedron: V + r S + r^2 sum(l a)/2 + 4/3 pi r^3, l the length of an
    edge and a the angle between the normals of its faces.
    """
    corners = hull.corners[hull.triangles]
    across = np.array([area_vector(triangle) for triangle in corners])
    areas = np.linalg.norm(across, axis=1)
    normals, edges, bend = across / areas[:, None], {}, 0.0
    for triangle, normal in zip(hull.triangles.tolist(), normals):
        for first, second in zip(triangle, triangle[1:] + triangle[:1]):
            other = edges.pop((second, first), None)
            if other is None:
                edges[first, second] = normal
                continue
            length = np.linalg.norm(hull.corners[first] - hull.corners[second])
            bend += length * math.atan2(np.linalg.norm(np.cross(normal, other)), normal @ other)
    return hull.volume + radius * areas.sum() + 0.5 * radius**2 * bend + 4.0 / 3.0 * math.pi * radius**3


def _capsule(points, axis, radius, name):
    """The capsule, turned to its place, and its volume."""
    along = points @ axis
    ends = points[along.argmin()], points[along.argmax()]
    length = np.ptp(along)
    x, y, z = axis if axis[2] >= 0.0 else -axis
    turn = np.array([1.0 + z, -y, x, 0.0])
    shape = shapes.capsule(radius, length, name)
    orientation = product(tuple((turn / np.linalg.norm(turn)).tolist()), shape.orientation)
    return dataclasses.replace(shape, centroid=tuple((0.5 * (ends[0] + ends[1])).tolist()), orientation=orientation), \
        math.pi * radius**2 * (length + 4.0 / 3.0 * radius)


def _plate(points, normal, radius, name):
    """A flat polygon as a plate of thickness 2 radius, round at its rim, its volume, and the area of the polygon."""
    prism = Polyhedron.of_points(np.concatenate([points + radius * normal, points - radius * normal]), 0.0)
    planes = prism.planes.copy()
    is_side = np.abs(planes[:, :3] @ normal) < 0.5
    planes[is_side, 3] += radius
    made = rounded(Polyhedron.of_planes(planes[:, :3], planes[:, 3]), OF_PLATE * radius, 0.0, None, name)
    across = np.array([area_vector(triangle) for triangle in prism.corners[prism.triangles]])
    ends, faces = np.abs(across @ normal).sum(), np.linalg.norm(across, axis=1).sum()
    rim = (faces - ends) / (2.0 * radius)
    return made, ends * radius + 0.5 * math.pi * radius**2 * rim + 4.0 / 3.0 * math.pi * radius**3, 0.5 * ends


def area_vector(polygon):
    """Its area along its normal, of corners (n, 3)."""
    return 0.5 * np.cross(polygon[1:-1] - polygon[0], polygon[2:] - polygon[0]).sum(0)


def enclosed(points, faces):
    """Volume that polygons, lists of indices of points in either sense, enclose; None where an edge does not join two
    of them.
    """
    at_edge = collections.defaultdict(list)
    for number, face in enumerate(faces):
        for first, second in zip(face, face[1:] + face[:1]):
            at_edge[min(first, second), max(first, second)].append((number, first < second))
    if not faces or any(len(two) != 2 for two in at_edge.values()):
        return None
    beside = collections.defaultdict(list)
    for (one, up), (other, other_up) in at_edge.values():
        beside[one].append((other, up == other_up))
        beside[other].append((one, up == other_up))
    senses, middle, volume = {}, points.mean(0), 0.0
    for start in range(len(faces)):
        if start in senses:
            continue
        senses[start], waiting, part = 1.0, [start], 0.0
        while waiting:
            one = waiting.pop()
            part += senses[one] * cone_volume(points[faces[one]] - middle)
            for other, against in beside[one]:
                sense = -senses[one] if against else senses[one]
                if other not in senses:
                    senses[other] = sense
                    waiting.append(other)
                elif senses[other] != sense:
                    return None
        volume += abs(part)
    return volume


def cone_volume(polygon):
    """Signed volume between the origin and a polygon, its corners (n, 3)."""
    return float(np.einsum("ij,ij->", polygon[:1].repeat(len(polygon) - 2, 0),
                           np.cross(polygon[1:-1], polygon[2:])) / 6.0)
