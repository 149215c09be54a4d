# SPDX-License-Identifier: MIT OR Apache-2.0
"""Contact detection between potential particles (Houlsby 2009): convex shapes from sphere to polyhedron.

With <t> = max(t, 0) a particle is {x: S(x) <= 1} in its local frame,

    S(x) = (1-k)/r^2 sum <n_i.x - d_i>^2 + k/R^2 |x|^2,    s(x) = sqrt(S(x)).

A Particle is made once for each shape; a body is a particle at a Pose. detect() finds the contact of two bodies, a
Batch those of all pairs of a step on numpy arrays. `builders` makes particles of points, surfaces and names of solids,
`slicing` cuts rock into blocks, `planar` has particles of the plane. Lengths are in the caller's unit, quaternions (w,
x, y, z), vectors in world axes unless said otherwise.
"""
import os
import pkgutil
import sys

from ._api import *  # noqa: F401, F403
from ._api import __all__

__all__ = list(__all__)
__version__ = "0.2.0"


def _plugin():
    """The folder of the package of the same name that extends YADE, if there is one on the path."""
    found = pkgutil.extend_path(list(__path__), __name__)
    return next((folder for folder in found if os.path.isfile(os.path.join(folder, "outside.py"))), None)


def _extend():
    """In YADE, with this package first on the path: the plugin's names and classes, too, by its own first file."""
    folder = _plugin() if "yade" in sys.modules else None
    if folder is not None:
        __path__.insert(0, folder)
        file = os.path.join(folder, "__init__.py")
        with open(file, encoding="utf-8") as opened:
            code = compile(opened.read(), file, "exec")
        exec(code, globals())


_extend()
