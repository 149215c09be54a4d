# SPDX-License-Identifier: MIT OR Apache-2.0
"""A book thrown into the air: free rotation about nearly the middle axis of inertia, which turns over again and again.

Without torque the angular momentum L and the energy L . I^-1 L / 2 stay what they are (Euler; Poinsot 1834).
"""

import numpy as np
import yade
from potential_particles import body, shapes
from yade import O

from scene import DENSITY, ROUNDING
from stepping import advance

BOOK = (0.24, 0.17, 0.03)  # m
SPIN = 2.0 * np.pi  # about the middle axis, 1/s
NUDGE = 1e-2  # of it, about each other axis
TURNS = 100
STEPS_PER_TURN = (500, 1000, 2000, 4000, 8000)
CHOSEN = 8000
LOOKS = 400


def energy(state):
    """Of rotation, J, of the angular momentum and the orientation that YADE has at the end of a step."""
    local = np.array(state.ori.conjugate() * state.angMom)
    return 0.5 * float(local @ (local / np.array(state.inertia)))


def simulate(steps_per_turn, turns=TURNS):
    """Looks (n, 3): time (s), angular velocity about the middle axis of the book (1/s), energy over that at the start;
    and the largest change of the angular momentum, relative."""
    O.reset()
    O.materials.append(yade.FrictMat(density=DENSITY))
    book = body(shapes.cuboid(BOOK, r=ROUNDING, k=0.0))
    O.bodies.append(book)
    state = book.state
    middle = int(np.argsort(np.array(state.inertia))[1])
    spin = np.full(3, NUDGE * SPIN)
    spin[middle] = SPIN
    inertia = np.array(state.inertia)
    state.angVel = state.ori * yade.Vector3(*map(float, spin))
    state.angMom = start = state.ori * yade.Vector3(*map(float, inertia * spin))
    O.engines = [yade.ForceResetter(), yade.NewtonIntegrator(damping=0.0, exactAsphericalRot=True)]
    O.dt = 2.0 * np.pi / SPIN / steps_per_turn
    first, looks, change = energy(state), [], 0.0
    for look in range(LOOKS + 1):
        if look:
            advance(round(look / LOOKS * turns * steps_per_turn))
        local = np.array(state.ori.conjugate() * state.angMom) / inertia
        looks.append((O.time, local[middle], energy(state) / first))
        change = max(change, (state.angMom - start).norm() / start.norm())
    return np.array(looks), change
