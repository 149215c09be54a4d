# SPDX-License-Identifier: GPL-3.0-or-later
"""The bodies of YADE's scene as triangles to draw: one mesh for each shape, put where its bodies are."""
import warnings
from dataclasses import dataclass, fields

import numpy as np
import yade

from ..bodies import into_cell
from .mesh import mesh, rotation_matrix

# A point's normal that differs from its triangle's by more is an edge, not a bend.
EDGE_ANGLE = np.radians(25.0)
_told = set()


class Rows:
    """Arrays with a row for each of many things, the fields of a dataclass with `none()`."""

    @classmethod
    def together(cls, parts):
        """Of many one; none makes an empty one."""
        if not parts:
            return cls.none()
        return cls(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(cls)))


@dataclass
class Triangles(Rows):
    """Triangles in the world frame: corners and normals at them (n, 3, 3); colours (n, 3), 0 to 1; bodies: whose, (n,).
    """

    corners: np.ndarray
    normals: np.ndarray
    colours: np.ndarray
    bodies: np.ndarray

    @classmethod
    def none(cls):
        return cls(np.zeros((0, 3, 3)), np.zeros((0, 3, 3)), np.zeros((0, 3)), np.zeros(0, int))

    def where(self, chosen):
        """Those of a mask or of indices."""
        return Triangles(self.corners[chosen], self.normals[chosen], self.colours[chosen], self.bodies[chosen])

    def turned(self, turn):
        """By a rotation (3, 3) about the origin."""
        return Triangles(self.corners @ turn.T, self.normals @ turn.T, self.colours, self.bodies)


class ShapeMeshes:
    """Corners and normals of the triangles of shapes, (n, 3, 3) each, local frame; made once for equal shapes."""

    def __init__(self, tolerance):
        self.tolerance, self._known = tolerance, {}

    def of(self, shape):
        """(corners, normals), or None for a shape that is not drawn."""
        if isinstance(shape, yade.PotentialParticle):
            key = (shape.r, shape.k, shape.R, *shape.a, *shape.b, *shape.c, *shape.d)
            if key not in self._known:
                self._known[key] = corners_of(mesh(shape, self.tolerance))
            return self._known[key]
        # Not GridNode, which is derived from it.
        if type(shape) is yade.Sphere:
            if "sphere" not in self._known:
                ball = yade.ConicPotentialParticle(k=1, R=1)
                self._known["sphere"] = corners_of(mesh(ball, self.tolerance))
            corners, normals = self._known["sphere"]
            return shape.radius * corners, normals
        if isinstance(shape, yade.Box):
            return _flat(np.array(shape.extents) * _cube())
        if isinstance(shape, yade.Facet):
            # It is seen from both sides.
            facet = np.array([shape.vertices])
            return _flat(np.concatenate([facet, facet[:, ::-1]]))
        return None


def drawn(bodies, meshes):
    """Triangles of bodies, and those of boundaries: Box, Facet, Wall and shapes with isBoundary. (of bodies, of
    boundaries)

    Says once of each kind of shape that it draws none.
    """
    parts, boundaries, walls = [], [], []
    for body in bodies:
        shape = body.shape
        local = meshes.of(shape)
        if isinstance(shape, yade.Wall):
            walls.append(body)
        elif local is not None:
            placed = copies(local, [body.state.pos + into_cell(body)], [rotation_matrix(body.state.ori)], [shape.color], [body.id])
            (boundaries if is_boundary(shape) else parts).append(placed)
        elif shape is not None and not body.isClump:
            _tell(type(shape).__name__)
    of_bodies, of_boundaries = Triangles.together(parts), Triangles.together(boundaries)
    points = np.concatenate([of_bodies.corners.reshape(-1, 3), of_boundaries.corners.reshape(-1, 3)])
    across = (points.min(0), points.max(0)) if len(points) else (-np.ones(3), np.ones(3))
    return of_bodies, Triangles.together([of_boundaries, *(_wall(wall, *across) for wall in walls)])


def copies(local, positions, rotations, colours, bodies):
    """Triangles of many bodies of one shape: local (of ShapeMeshes), positions (n, 3), rotations (n, 3, 3) local to
    world, colours (n, 3), bodies (n,), their ids.
    """
    corners, normals = (np.einsum("bij,tcj->btci", np.asarray(rotations, float), array) for array in local)
    corners += np.asarray(positions, float)[:, None, None]
    count = len(local[0])
    return Triangles(corners.reshape(-1, 3, 3), normals.reshape(-1, 3, 3),
                     np.repeat(np.asarray(colours, float), count, axis=0), np.repeat(bodies, count))


def edges(triangles):
    """Edges of bodies, (n, 2, 3): sides between two triangles of a body that meet at more than EDGE_ANGLE."""
    points, normals = triangles.corners.reshape(-1, 3), _flat(triangles.corners)[1][:, 0]
    if not len(points):
        return np.zeros((0, 2, 3))
    # What is equal to 1e-6 of the scene is one point of a body.
    keys = np.column_stack(
        [np.repeat(triangles.bodies, 3),
         np.round((points - points.min(0)) / (1e-6 * np.ptp(points, axis=0).max()))])
    first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)[1:]
    number = number.reshape(-1, 3)
    sides = np.sort(np.concatenate([number[:, [0, 1]], number[:, [1, 2]], number[:, [2, 0]]]), axis=1)
    order = np.lexsort(sides.T)
    sides, normals = sides[order], np.tile(normals, (3, 1))[order]
    pairs = np.flatnonzero((sides[1:] == sides[:-1]).all(1))
    sharp = pairs[(normals[pairs] * normals[pairs + 1]).sum(1) < np.cos(EDGE_ANGLE)]
    return points[first[sides[sharp]]]


def floor(height, half_width, middle=(0.0, 0.0)):
    """A square floor at this height as a boundary."""
    corners, normals = _flat(half_width * _cube()[:2] + (*middle, height - half_width))
    return Triangles(corners, normals, np.ones((2, 3)), np.full(2, -1))


def is_boundary(shape):
    """Whether a shape bounds the scene, so that those in front of the bodies hide them."""
    return isinstance(shape, (yade.Box, yade.Facet, yade.Wall)) or getattr(shape, "isBoundary", False)


def _tell(kind):
    if kind not in _told:
        _told.add(kind)
        warnings.warn(f"bodies of shape {kind} are not drawn: no mesh is known for it")


def corners_of(made):
    """A mesh as corners of triangles, with the normal of the triangle itself where a point lies on an edge.

    A surface whose normal at a corner is turned by t against a triangle of the circumradius c stands off it by about
    c t / 2, if it bends all the way. Where that is more than the error of the mesh the triangle is flat, and the normal
    turns at its rim alone.
    """
    corners, normals = made.points[made.triangles], made.normals[made.triangles]
    own = _flat(corners)[1]
    turn = np.arccos(np.clip((normals * own).sum(-1), -1.0, 1.0))
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).max(1, keepdims=True)
    bends = (turn <= EDGE_ANGLE) & (0.5 * turn * longest / np.sqrt(3.0) <= made.error)
    return corners, np.where(bends[:, :, None], normals, own)


def _flat(corners):
    """Corners of triangles with the normals of the triangles."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = normal / np.where(length > 0.0, length, 1.0)
    return corners, np.repeat(normal[:, None], 3, axis=1)


def _cube():
    """The twelve triangles of the cube from -1 to 1."""
    square = np.array([[[-1, -1, 1], [1, -1, 1], [1, 1, 1]], [[-1, -1, 1], [1, 1, 1], [-1, 1, 1]]], float)
    faces = [np.roll(square, axis, axis=2) for axis in range(3)]
    return np.concatenate(faces + [-face[:, ::-1] for face in faces])


def _wall(body, low, high):
    """A wall of YADE is endless: as far as the rest of the scene reaches, and as far again."""
    axis, middle = body.shape.axis, 0.5 * (low + high)
    reach = np.full(3, 1.5 * (high - low).max())
    reach[axis], middle[axis] = 0.0, body.state.pos[axis]
    # Two triangles, from both sides.
    square = np.concatenate(
        [np.roll(_cube()[:2], axis + 1 - 3, axis=2),
         np.roll(_cube()[:2], axis + 1 - 3, axis=2)[:, ::-1]])
    corners, normals = _flat(middle + reach * square)
    return Triangles(corners, normals, np.broadcast_to(np.array(body.shape.color), (4, 3)), np.full(4, body.id))
