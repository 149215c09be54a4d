# SPDX-License-Identifier: MIT OR Apache-2.0
"""Particles of the plane: lines a x + b y <= d, angles in radians, anticlockwise."""
from ._core import _planar

Particle = _planar.Particle
AreaProperties = _planar.AreaProperties
Pose = _planar.Pose
Contact = _planar.Contact
Patch = _planar.Patch
detect = _planar.detect
contact_length = _planar.contact_length
patch_of_contact = _planar.patch_of_contact

__all__ = ["AreaProperties", "Contact", "Particle", "Patch", "Pose", "contact_length", "detect", "patch_of_contact"]
