# SPDX-License-Identifier: MIT OR Apache-2.0
"""The four blocks of a wedge in a slope, as polyhedra: two joint planes cut the rock into four.

The wedge lies above both joints; under it lie the block of joint A (below A, above B), that of
joint B, and the base (below both), which meets the wedge along the line of intersection only. The
slope face passes through the toe, where the line comes out of the rock, and the level top lies
`size` above it. The toe is the origin.
"""

import numpy as np

from potential_particles.polyhedron import Polyhedron

from joint_planes import Plane, sliding

FACE_DIP = 70.0  # of the slope face, where none is given, degrees
MARGIN = 0.5  # of rock beyond the wedge, relative to the size
UP = np.array([0.0, 0.0, 1.0])


class WedgeBlocks:
    """Polyhedra `wedge`, `block_a`, `block_b`, `base` for joints A and B and a slope face.

    ValueError if the joints and the face leave no wedge that is bounded and free to come out.
    """

    def __init__(self, plane_a, plane_b, size=1.0, face=None):
        if not size > 0.0:
            raise ValueError(f"size {size:g} is no length: give the height of the wedge, more than 0 m")
        self.plane_a, self.plane_b, self.size = plane_a, plane_b, size
        self.limit = sliding(plane_a, plane_b)
        self.face = face or Plane(FACE_DIP, self.limit.trend)
        a, b, slope = plane_a.normal, plane_b.normal, self.face.normal
        self._check_removable(-a, -b, slope)
        # Outward normal and offset of each half space; the joints and the face pass through the toe.
        above_a, above_b, below_a, below_b = (-a, 0.0), (-b, 0.0), (a, 0.0), (b, 0.0)
        outside = [(slope, 0.0), (UP, size)]
        self.wedge = _polyhedron([above_a, above_b, *outside])
        rock = [*outside, *self._box()]
        self.block_a = _polyhedron([below_a, above_b, *rock])
        self.block_b = _polyhedron([above_a, below_b, *rock])
        self.base = _polyhedron([below_a, below_b, *rock])
        self._check_support()

    def support(self):
        """Where the faces must carry the wedge at the limit of equilibrium: two lines of points, world frame.

        Weight and both reactions balance in moments only if they meet in one point on the vertical
        through the centroid. Each such point gives one point on A and one on B; returned are
        (ends on A, ends on B), (2, 3) each, of those that lie on the faces, or None if there are none.
        """
        centroid, tangent = self.wedge.centroid, np.tan(np.radians(self.limit.friction_angle))
        lines = []
        for normal in (self.plane_a.normal, self.plane_b.normal):
            pull = normal - tangent * self.limit.line  # along the reaction
            # Where the reaction leaves the wedge that passes through the centroid, and through the point one
            # unit above; the joint passes through the origin.
            lines.append([p - pull * (normal @ p) / (normal @ pull) for p in (centroid, centroid + UP)])
        low, high = -np.inf, np.inf
        for joint, (at, above) in enumerate(lines):
            for other, (normal, offset) in enumerate(zip(self.wedge.normals, self.wedge.offsets)):
                if other == joint:
                    continue
                room, slope = offset - normal @ at, normal @ (above - at)
                if slope > 0.0:
                    high = min(high, room / slope)
                elif slope < 0.0:
                    low = max(low, room / slope)
                elif room < 0.0:
                    return None
        if not low < high:
            return None
        return tuple(np.array([at + h * (above - at) for h in (low, high)]) for at, above in lines)

    def _check_support(self):
        if self.support() is None:
            raise ValueError(
                f"the wedge of {self._what()} would turn over before it slides: no two points of its faces balance "
                "its weight in moments; take a flatter slope face, or one that faces along the line"
            )

    def _what(self):
        return f"joints {self.plane_a} and {self.plane_b} with slope face {self.face}"

    def _check_removable(self, below_a, below_b, slope):
        """The four outward normals of a bounded tetrahedron surround the origin."""
        if not self.limit.line @ slope > 0.0:
            raise ValueError(
                f"{self._what()} form no removable wedge: the line of intersection, which plunges "
                f"{self.limit.plunge:.1f} degrees, does not come out of the slope face; take a steeper face, or one "
                "that faces along the line"
            )
        weights = np.linalg.solve(np.column_stack([below_a, below_b, slope]), -UP)
        if not (weights > 0.0).all():
            name = ("joint A", "joint B", "the slope face")[int(np.argmin(weights))]
            raise ValueError(
                f"{self._what()} form no removable wedge: the rock between joints, face and a level top has no end "
                f"({name} does not close it); turn or tilt the slope face"
            )

    def _box(self):
        """Half spaces that bound the fixed rock behind, below and on both sides of the wedge."""
        along = np.array([self.limit.line[0], self.limit.line[1], 0.0])
        along /= np.linalg.norm(along)
        corners = self.wedge.corners
        margin = MARGIN * self.size
        across = np.cross(UP, along)
        return [
            (direction, (corners @ direction).max() + margin) for direction in (-along, -UP, across, -across)
        ]


def _polyhedron(half_spaces):
    normals, offsets = zip(*half_spaces)
    return Polyhedron.of_planes(np.array(normals), np.array(offsets))
