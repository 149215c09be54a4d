# SPDX-License-Identifier: MIT OR Apache-2.0
"""Contact detection between potential particles (Houlsby 2009): convex shapes from sphere to polyhedron.

With <t> = max(t, 0) a particle is {x: S(x) <= 1} in its local frame,

    S(x) = (1-k)/r^2 sum <n_i.x - d_i>^2 + k/R^2 |x|^2,    s(x) = sqrt(S(x)).

A Particle is made once for each shape; a body is a particle at a Pose. detect() finds the contact of two bodies, a
Batch those of all pairs of a step on numpy arrays. `shapes` makes particles of points, surfaces, scans and names of
solids, `packing` fills containers with them, `rock` cuts rock into blocks, `equilibrium` says whether bodies stand,
`lammps` writes and draws LAMMPS's files, `other_codes` reads bodies of other codes. Particle.in_plane and Pose.in_plane
make bodies of two dimensions. Lengths are in the caller's unit, quaternions (w, x, y, z), vectors in world axes unless
said otherwise.

In YADE, with the plugin, the names of `potential_particles.yade` stand here, too.
"""
import importlib.util
import pkgutil
import sys

__version__ = "0.2.0"
# Parts for YADE may be installed elsewhere than a wheel.
__path__ = pkgutil.extend_path(__path__, __name__)

IN_YADE = "yade" in sys.modules or importlib.util.find_spec("yade") is not None

from . import equilibrium, packing, rock, shapes  # noqa: E402
from ._core import (  # noqa: E402
    FAILED,
    OVERLAPPING,
    SEPARATED,
    Batch,
    ClosestPoint,
    Contact,
    ContactDerivatives,
    ContactError,
    ContactGradient,
    FlatContact,
    MassProperties,
    PairState,
    Particle,
    Patch,
    PatchDerivatives,
    Pose,
    Settings,
    SurfaceMesh,
    Triangle,
    Wall,
    boundary_derivatives,
    boundary_gradient,
    closest_point,
    contact_area,
    contact_derivatives,
    contact_gradient,
    contact_type,
    contact_with_plane,
    contact_with_triangle,
    detect,
    detect_batch,
    patch_derivatives,
    patch_of_contact,
    patch_on_plane,
    patch_on_triangle,
    pose_type,
)
from .materials import MATERIALS, suggest  # noqa: E402
from .movie import movie  # noqa: E402

__all__ = [
    "FAILED",
    "OVERLAPPING",
    "SEPARATED",
    "Batch",
    "ClosestPoint",
    "Contact",
    "ContactDerivatives",
    "ContactError",
    "ContactGradient",
    "FlatContact",
    "MATERIALS",
    "MassProperties",
    "PairState",
    "Particle",
    "Patch",
    "PatchDerivatives",
    "Pose",
    "Settings",
    "SurfaceMesh",
    "Triangle",
    "Wall",
    "boundary_derivatives",
    "boundary_gradient",
    "closest_point",
    "contact_area",
    "contact_derivatives",
    "contact_gradient",
    "contact_type",
    "contact_with_plane",
    "contact_with_triangle",
    "detect",
    "detect_batch",
    "equilibrium",
    "movie",
    "packing",
    "patch_derivatives",
    "patch_of_contact",
    "patch_on_plane",
    "patch_on_triangle",
    "pose_type",
    "rock",
    "shapes",
    "suggest",
]


if IN_YADE and importlib.util.find_spec(".yade", __name__):
    from .yade import *  # noqa: F401, F403
    from .yade import __all__ as _of_yade, _glue  # noqa: F401

    __all__ += _of_yade
