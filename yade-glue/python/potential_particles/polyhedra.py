# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's Polyhedra of a scene as potential particles, in place."""
import dataclasses

import numpy as np

from . import fitting
from .arguments import warn
from .bodies import conic_particle
from .polyhedron import Polyhedron, rotation
from .rounding import SPHERICITY, Rounding


def replace_polyhedra(rounding=None, k=SPHERICITY, *, r=None):
    """Gives each Polyhedra body of the scene the shape of a potential particle with its faces; their ids.

    rounding, k, r: as of shapes.from_mesh; without rounding and r a body loses no more than 1 % of its volume. Number,
    position, orientation, velocities, mass, inertia, material, colour, mask, clump and what holds the body stay. Their
    contacts are taken out. A SceneWarning says how many bodies there were, and what volume rounding took. Engines stay:
    the scene then needs functors and a law for potential particles, whose overlap is a length, not a volume.
    ValueError for a polyhedron that makes no particle; no body has changed then.
    """
    import yade
    found, made = [one for one in yade.O.bodies if type(one.shape).__name__ == "Polyhedra"], {}
    lost, before, worst = 0.0, 0.0, (0.0, None)
    for body in found:
        corners = np.array(body.shape.v, float).reshape(-1, 3)
        key = corners.tobytes()
        if key not in made:
            try:
                hull = Polyhedron.of_points(corners, 0.0)
                made[key] = hull.volume, _in_its_frame(fitting.of_surface(
                    hull, corners, hull.volume, Rounding(rounding, k, r), f"polyhedron {body.id}", "all"))
            except ValueError as error:
                raise ValueError(f"body {body.id}: {error}") from None
        volume, shape = made[key]
        before, lost = before + volume, lost + volume - shape.volume
        worst = max(worst, (1.0 - shape.volume / volume, body.id), key=lambda one: one[0])
    for body in found:
        # Their geometry is that of polyhedra.
        for contact in list(yade.O.interactions.withBody(body.id)):
            yade.O.interactions.erase(contact.id1, contact.id2)
        old = body.shape
        body.shape = conic_particle(made[np.array(old.v, float).tobytes()][1], color=old.color, wire=old.wire,
                                    highlight=old.highlight)
        body.bound = None
        body.aspherical = True
    if found:
        warn(f"replaced {len(found)} Polyhedra: rounding took {100.0 * lost / before:.3g} % of their volume, "
             f"{100.0 * worst[0]:.3g} % at most (body {worst[1]}); mass and inertia are those of before")
    return [body.id for body in found]


def _in_its_frame(shape):
    """The shape about the origin of the frame that it was built in, the body's own, whose mass properties stay."""
    planes = np.array(shape.planes)
    normals = planes[:, :3] @ rotation(shape.orientation).T
    offsets = planes[:, 3] + normals @ np.array(shape.centroid)
    return dataclasses.replace(shape, planes=tuple(map(tuple, np.column_stack([normals, offsets]).tolist())),
                               centroid=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0))
