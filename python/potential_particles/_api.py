# SPDX-License-Identifier: MIT OR Apache-2.0
"""The names of the package: what the compiled module has, and its parts as modules."""
from . import builders, planar, slicing
from ._core import (
    FAILED, OVERLAPPING, SEPARATED, Batch, ClosestPoint, Contact, ContactError, FlatContact, MassProperties, PairState, Particle, Patch, Pose,
    Settings, SurfaceMesh, Triangle, Wall, closest_point, contact_area, contact_type, contact_with_plane, contact_with_triangle, detect,
    detect_batch, patch_of_contact, patch_on_plane, patch_on_triangle, pose_type,
)

__all__ = [
    "FAILED", "OVERLAPPING", "SEPARATED", "Batch", "ClosestPoint", "Contact", "ContactError", "FlatContact", "MassProperties", "PairState",
    "Particle", "Patch", "Pose", "Settings", "SurfaceMesh", "Triangle", "Wall", "builders", "closest_point", "contact_area", "contact_type",
    "contact_with_plane", "contact_with_triangle", "detect", "detect_batch", "patch_of_contact", "patch_on_plane", "patch_on_triangle",
    "planar", "pose_type", "slicing",
]
