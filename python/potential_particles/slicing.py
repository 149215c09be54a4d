# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rock masses: a convex domain cut into blocks by its joints (Boon, Houlsby & Utili 2015). Axes: x east, y north, z up;
angles in degrees.
"""
from ._core import _slicing

Joint = _slicing.Joint
joint_set = _slicing.joint_set
Block = _slicing.Block
RockMass = _slicing.RockMass
slice = _slicing.slice

__all__ = ["Block", "Joint", "RockMass", "joint_set", "slice"]
