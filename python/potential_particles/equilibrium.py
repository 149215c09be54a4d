# SPDX-License-Identifier: MIT OR Apache-2.0
"""Whether a scene of rigid blocks stands, and by how much: limit analysis on elastic joints."""
from ._core import _equilibrium

Scene = _equilibrium.Scene
Equilibrium = _equilibrium.Equilibrium

__all__ = ["Equilibrium", "Scene"]
