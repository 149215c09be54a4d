# SPDX-License-Identifier: MIT OR Apache-2.0
"""The wedges that are looked at: joints, blocks, material, and how near the answer should come."""

from dataclasses import dataclass, replace

from block_scene import soft_overlap
from joint_planes import Plane

# Critical friction angles of the paper's wedge found by others, degrees.
PAPER_ANGLE, THREE_DEC_ANGLE = 33.49, 33.19

FLAT_TARGET, ROUNDED_TARGET = 0.01, 0.05  # error of the angle, degrees
WIDEST_BRACKET = 0.01  # degrees
DIRECTION_TARGET = 0.1  # of the direction of sliding, degrees
FORCE_TARGET = 1e-3  # of both normal forces, relative

LEAST_OVERLAP = 1e-4  # of the size


@dataclass(frozen=True)
class Case:
    """A wedge. Lengths relative to the size unless in m."""

    name: str
    plane_a: Plane
    plane_b: Plane
    group: str
    size: float = 1.0  # height from toe to top, m
    rounding: float = 0.02  # radius of edges and corners, r
    sphericity: float = 0.0  # k
    density: float = 2600.0  # kg/m^3
    weight_over_stiffness: float = None  # of the normal spring of one joint; None: see `overlap`
    shear_ratio: float = 0.5  # shear over normal stiffness

    @property
    def overlap(self):
        """Weight over normal stiffness."""
        if self.weight_over_stiffness is not None:
            return self.weight_over_stiffness
        return soft_overlap(LEAST_OVERLAP, self.sphericity, self.rounding)

    @property
    def target(self):
        """Error of the angle to stay within, degrees."""
        return FLAT_TARGET if self.sphericity == 0.0 else ROUNDED_TARGET


PAPER = Case("the paper's wedge", Plane(40, 130), Plane(60, 220), "flat")
NEAR_POLYHEDRAL = replace(PAPER, name="near-polyhedral, k = 0.01", sphericity=0.01, group="rounded")

VARIED = [
    replace(PAPER, name="50 times as large", size=50.0, group="varied"),
    replace(PAPER, name="10 times as stiff", weight_over_stiffness=1e-5, group="varied"),
    replace(PAPER, name="shear stiffness 0.2 of normal", shear_ratio=0.2, group="varied"),
    replace(PAPER, name="a third as dense", density=2600.0 / 3.0, weight_over_stiffness=1e-4 / 3.0, group="varied"),
]

OTHERS = [
    Case("Hoek & Bray, friction only", Plane(40, 165), Plane(70, 285), "others"),
    Case("Hoek & Bray, worked example", Plane(45, 105), Plane(70, 235), "others"),
    Case("symmetric", Plane(50, 135), Plane(50, 225), "others"),
    Case("nearly planar", Plane(40, 160), Plane(42, 200), "others"),
    Case("deep and narrow", Plane(65, 100), Plane(60, 250), "others"),
]

SWEEP = [
    replace(PAPER, name=f"k = {k:g}, r = {r:g}", sphericity=k, rounding=r, group="sweep")
    for k, r in (
        (0.1, 0.05), (0.03, 0.05), (0.01, 0.05), (0.003, 0.05),
        (0.03, 0.02), (0.03, 0.01), (0.003, 0.01), (0.001, 0.005),
    )
]  # fmt: skip

ALL = [PAPER, NEAR_POLYHEDRAL, *VARIED, *OTHERS, *SWEEP]
