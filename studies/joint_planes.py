# SPDX-License-Identifier: MIT OR Apache-2.0
"""Joint planes by dip and dip direction, and the closed form of a wedge that slides on two of them.

World frame: x east, y north, z up. The dip direction is a compass bearing, clockwise from north.

A rigid wedge that rests on planes A and B can slide along their line of intersection only. At the
limit of equilibrium friction is parallel to that line on both planes (Hoek & Bray 1974; no
cohesion, no water, one friction angle), so that the balance across the line gives both normal
forces by themselves, and the balance along it the friction angle:

    N_A n_A + N_B n_B + W = part along the line,   tan(phi) = W sin(plunge) / (N_A + N_B)
"""

from dataclasses import dataclass

import numpy as np

# Below this angle between two planes their line of intersection means nothing.
LEAST_ANGLE = 0.1  # degrees


@dataclass(frozen=True)
class Plane:
    """dip from 0 (level) to 90 (upright), dip direction from 0 to 360, degrees."""

    dip: float
    dip_direction: float

    def __post_init__(self):
        if not 0.0 <= self.dip <= 90.0:
            raise ValueError(f"dip {self.dip:g} is out of range: give 0 (level) to 90 (upright) degrees")
        if not 0.0 <= self.dip_direction <= 360.0:
            raise ValueError(
                f"dip direction {self.dip_direction:g} is out of range: give a bearing of 0 to 360 degrees"
            )

    @property
    def normal(self):
        """Unit normal, upwards."""
        dip, bearing = np.radians([self.dip, self.dip_direction])
        return np.array([np.sin(dip) * np.sin(bearing), np.sin(dip) * np.cos(bearing), np.cos(dip)])

    def __str__(self):
        return f"{self.dip:g}/{round(self.dip_direction, 1):03g}"


@dataclass(frozen=True)
class Sliding:
    """A wedge at the limit of equilibrium; forces as parts of its weight."""

    line: np.ndarray  # unit vector along the line of intersection, downwards
    friction_angle: float  # critical, degrees
    force_a: float  # normal force on plane A
    force_b: float

    @property
    def plunge(self):
        """Of the line, degrees below the horizontal."""
        return plunge_and_trend(self.line)[0]

    @property
    def trend(self):
        """Of the line, compass bearing in degrees."""
        return plunge_and_trend(self.line)[1]


def plunge_and_trend(direction):
    """Degrees below the horizontal, and compass bearing, of a vector."""
    east, north, up = np.asarray(direction, float) / np.linalg.norm(direction)
    return float(np.degrees(np.arcsin(-up))), float(np.degrees(np.arctan2(east, north)) % 360.0)


def sliding(a, b):
    """The closed form for planes A and B; ValueError if no wedge slides on both."""
    limit = sliding_on(a.normal, b.normal)
    for force, name, other in ((limit.force_a, "A", "B"), (limit.force_b, "B", "A")):
        if force <= 0.0:
            raise ValueError(
                f"no wedge slides on planes {a} and {b} together: it would leave plane {name} and slide on plane "
                f"{other} alone; take planes whose dip directions lie on both sides of the line of intersection "
                f"(trend {limit.trend:.0f})"
            )
    return limit


def sliding_on(normal_a, normal_b):
    """The same for unit normals, which may come from contacts; the forces may be of either sign."""
    line = np.cross(normal_a, normal_b)
    if np.linalg.norm(line) < np.sin(np.radians(LEAST_ANGLE)):
        raise ValueError(
            f"the planes are parallel to {LEAST_ANGLE:g} degrees and form no wedge: take planes that intersect"
        )
    line *= (-1.0 if line[2] > 0.0 else 1.0) / np.linalg.norm(line)
    if -line[2] < np.sin(np.radians(LEAST_ANGLE)):
        raise ValueError(
            "the line of intersection of the planes is level, and nothing slides along it: "
            "take planes whose strikes differ"
        )
    cosine = normal_a @ normal_b
    force_a, force_b = np.linalg.solve([[1.0, cosine], [cosine, 1.0]], [normal_a[2], normal_b[2]])
    angle = np.degrees(np.arctan2(-line[2], force_a + force_b))
    return Sliding(line, float(angle), float(force_a), float(force_b))
