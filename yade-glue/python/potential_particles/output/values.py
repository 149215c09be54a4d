# SPDX-License-Identifier: GPL-3.0-or-later
"""A number for each body, by which pictures and files colour it."""
from collections.abc import Mapping

import numpy as np
import yade

from ..measures import body_stresses

#: By name: what is drawn, its unit, and the function of the bodies.
NAMES = {
    "velocity": ("speed", "m/s", lambda bodies: [body.state.vel.norm() for body in bodies]),
    "displacement": ("displacement", "m", lambda bodies: [body.state.displ().norm() for body in bodies]),
    "generation": ("generation", "", lambda bodies: [generations().get(body.id, 0) for body in bodies]),
    "stress": ("mean stress, pressure above 0", "Pa", lambda bodies: mean_pressures(bodies)),
}


def generations():
    """{id: how often what a body was part of has broken}, of all engines Breakage; of others nothing."""
    found = {}
    for engine in yade.O.engines:
        if isinstance(engine, yade.Breakage):
            found.update(engine.generations)
    return found


def mean_pressures(bodies):
    """Minus a third of the trace of the mean stress within each body (body_stresses), Pa; 0 for what does not move."""
    stresses = body_stresses()
    return [-stresses[body.id].trace() / 3 if body.id in stresses else 0.0 for body in bodies]


def of_bodies(colour, bodies):
    """(values, one of each body; name; unit) of the argument `colour` of plot."""
    if isinstance(colour, str):
        if colour not in NAMES:
            raise ValueError(f"colour={colour!r}: there are {', '.join(NAMES)}; others as {{id: number}} or an array")
        name, unit, function = NAMES[colour]
        return np.array(function(bodies), float), name, unit
    if isinstance(colour, Mapping):
        if missing := [body.id for body in bodies if body.id not in colour]:
            raise ValueError(f"colour: there is no number for body {missing[0]}")
        colour = [colour[body.id] for body in bodies]
    values = np.asarray(colour, float)
    if values.shape != (len(bodies),):
        raise ValueError(f"colour of the shape {values.shape}: give a number for each of the {len(bodies)} bodies that "
                         "are drawn and no boundaries, in the order of their ids, or {id: number}")
    if not np.isfinite(values).all():
        raise ValueError(f"colour: {values[~np.isfinite(values)][0]} must be finite")
    return values, "", ""
