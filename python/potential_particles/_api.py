# SPDX-License-Identifier: MIT OR Apache-2.0
"""The names of the package: what the compiled module has, and its parts as modules."""
from . import builders, equilibrium, planar, slicing
from ._core import (
    FAILED, OVERLAPPING, SEPARATED, Batch, ClosestPoint, Contact, ContactDerivatives, ContactError, ContactGradient, FlatContact,
    MassProperties, PairState, Particle, Patch, PatchDerivatives, Pose, Settings, SurfaceMesh, Triangle, Wall, boundary_derivatives,
    boundary_gradient, closest_point, contact_area, contact_derivatives, contact_gradient, contact_type, contact_with_plane,
    contact_with_triangle, detect, detect_batch, patch_derivatives, patch_of_contact, patch_on_plane, patch_on_triangle, pose_type,
)

__all__ = [
    "FAILED", "OVERLAPPING", "SEPARATED", "Batch", "ClosestPoint", "Contact", "ContactDerivatives", "ContactError", "ContactGradient",
    "FlatContact", "MassProperties", "PairState", "Particle", "Patch", "PatchDerivatives", "Pose", "Settings", "SurfaceMesh", "Triangle",
    "Wall", "boundary_derivatives", "boundary_gradient", "builders", "closest_point", "contact_area", "contact_derivatives",
    "contact_gradient", "contact_type", "contact_with_plane", "contact_with_triangle", "detect", "detect_batch", "equilibrium", "patch_derivatives",
    "patch_of_contact", "patch_on_plane", "patch_on_triangle", "planar", "pose_type", "slicing",
]
