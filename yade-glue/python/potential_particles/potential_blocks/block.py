# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape that scripts call PotentialBlock.

Given planes a x + b y + c z = d and r, its faces lie at the distance d + r along unit normals. It moves its origin to
the centroid and its axes to principal axes, if they are not there already; `position` and `orientation` say from where:
x_given = position + orientation x.

YADE's potential blocks have sharp edges: r is that of a body within, whose normals they take. Here edges are rounded,
by a share of the thickness: the force on a patch grows up to an overlap of twice the rounding, so that it must not be
too small either. The faces stay where they are.
"""
import numpy as np
from yade.wrapper import ConicPotentialParticle

from ..arguments import positive, rows
from ..polyhedron import Polyhedron, principal_axes
from ..bodies import definition, volumes

#: A centroid, or a product of inertia, that is smaller than this share is 0 up to rounding.
ROUNDING = 1e-6

#: Rounding of edges, over twice the distance of the nearest face from the centroid: as in rock.bodies.
EDGES = 0.05

# What a script may give and YADE computes.
_COMPUTED = ("AabbMinMax", "minAabb", "maxAabb", "minAabbRotated", "maxAabbRotated", "k", "volume", "inertia",
             "position", "orientation", "vertices", "connectivity", "fixedNormal")
# Attributes that blocks carry and no functor here reads.
_CARRIED = {"erase": False, "intactRock": [], "phi_b": [], "phi_r": [], "cohesion": [], "tension": [], "jointType": []}
_LININGS = ("isLining", "isBolt")
_OF_LININGS = ("liningStiffness", "liningFriction", "liningLength", "liningTensionGap", "liningNormalPressure",
               "liningTotalPressure")


class PotentialBlock(ConicPotentialParticle):
    """A convex block of the planes a, b, c, d, whose faces lie at d + r; keyword arguments as in YADE.

    r: length, above 0; d + r is the distance of a face. Edges are rounded by a twentieth of the thickness, and `r` and
    `d` are then those of that block, with the same faces. Volume and inertia are those of the sharp block. R: 0 for
    half of the distance of the farthest corners. k and the boxes (AabbMinMax, minAabb, ...) are computed, and so are
    normals: fixedNormal is accepted and stays False. A plane whose normal points inwards is turned; one that makes no
    face is left out. ValueError for planes that enclose no volume, and for linings and bolts.
    After O.load a block is a ConicPotentialParticle, which knows no position and orientation.
    """

    def __init__(self, **attributes):
        for name in _LININGS:
            if attributes.pop(name, False):
                raise ValueError(f"{name}=True: rock linings and bolts are not served")
        for name in (*_OF_LININGS, *_COMPUTED):
            attributes.pop(name, None)
        carried = {name: attributes.pop(name, default) for name, default in _CARRIED.items()}
        given = [np.atleast_1d(np.asarray(attributes.pop(name, []), float)) for name in "abcd"]
        position, orientation = np.zeros(3), (1.0, 0.0, 0.0, 0.0)
        if any(len(one) for one in given):
            if len({len(one) for one in given}) > 1:
                raise ValueError(
                    f"a, b, c, d have {', '.join(str(len(one)) for one in given)} entries: all must be of one length")
            planes, r, R, position, orientation = _settled(
                rows(np.column_stack(given), 4, "planes", "the four numbers a, b, c, d"),
                positive(attributes.pop("r", 0.0), "r"), attributes.pop("R", 0.0))
            attributes.update(planes=planes, r=r, k=0.0, R=R)
        super().__init__(**attributes)
        if self.planes:
            volumes[definition(self)] = self.volume
        self._frame = tuple(map(float, position)), tuple(map(float, orientation))
        for name, value in carried.items():
            setattr(self, name, value)

    @property
    def vertices(self):
        """Of the sharp block, a list of Vector3, local axes."""
        import yade
        return [yade.Vector3(*corner) for corner in self._sharp().corners.tolist()]

    @property
    def volume(self):
        """Of the sharp block."""
        return self._sharp().volume

    @property
    def inertia(self):
        """Principal moments of the sharp block for density 1, Vector3."""
        import yade
        return yade.Vector3(*np.diag(self._sharp().inertia).tolist())

    @property
    def position(self):
        """Of the centroid in the frame in which a, b, c, d were given."""
        import yade
        return yade.Vector3(*self._frame[0])

    @property
    def orientation(self):
        """Of the principal axes in the frame in which a, b, c, d were given."""
        import yade
        return yade.Quaternion(*self._frame[1])

    def _sharp(self):
        planes = np.array(self.planes)
        return Polyhedron.of_planes(planes[:, :3], planes[:, 3] + self.r)

    @property
    def connectivity(self):
        """For each plane the numbers of its vertices, counter-clockwise from outside."""
        corners, found = self._sharp().corners, []
        size = np.ptp(corners, axis=0).max()
        for a, b, c, d in self.planes:
            normal = np.array([a, b, c])
            on = np.flatnonzero(np.abs(corners @ normal - d - self.r) < ROUNDING * size)
            u = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
            away = corners[on] - corners[on].mean(0)
            found.append([int(one) for one in on[np.argsort(np.arctan2(away @ np.cross(normal, u), away @ u))]])
        return found


def _settled(planes, r, R):
    """Planes of the core in the principal frame, r, R, and where that frame lies."""
    lengths = np.linalg.norm(planes[:, :3], axis=1)
    if not np.all(lengths > 0.0):
        raise ValueError(f"plane {int(np.argmin(lengths))} has a normal of length 0")
    faces = np.column_stack([planes[:, :3], planes[:, 3] + r]) / lengths[:, None]
    faces[faces[:, 3] < 0.0] *= -1.0
    sharp = Polyhedron.of_planes(faces[:, :3], faces[:, 3])
    reach = np.linalg.norm(sharp.corners - sharp.centroid, axis=1).max()
    position = np.where(np.abs(sharp.centroid) > ROUNDING * reach, sharp.centroid, 0.0)
    inertia = sharp.inertia
    orientation, axes = principal_axes(inertia)[:2] if _has_products(inertia) else ((1.0, 0.0, 0.0, 0.0), np.eye(3))
    heights = sharp.offsets - sharp.normals @ position
    r = 2.0 * EDGES * float(heights.min())
    radius = float(R) or 0.5 * max(float(np.linalg.norm(sharp.corners - one, axis=1).max()) for one in sharp.corners)
    turned = np.column_stack([sharp.normals @ axes, heights - r])
    return [tuple(row) for row in turned.tolist()], r, radius, position, orientation


def _has_products(inertia):
    return np.abs(inertia[np.triu_indices(3, 1)]).max() > ROUNDING * np.trace(inertia)
