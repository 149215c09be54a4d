# SPDX-License-Identifier: MIT OR Apache-2.0
"""A book thrown into the air: free rotation about nearly the middle axis of inertia, which turns over again and again.

Without torque the angular momentum L and the energy L . I^-1 L / 2 stay what they are (Euler; Poinsot 1834).
"""

import math

import numpy as np
import yade
from potential_particles import body, shapes
from yade import O

from report import row, target
from block_scene import DENSITY, ROUNDING
from stepping import advance

TITLE = "a book thrown into the air"
BOOK = (0.24, 0.17, 0.03)  # m
SPIN = 2.0 * np.pi  # about the middle axis, 1/s
NUDGE = 1e-2  # of it, about each other axis
TURNS = 100
STEPS_PER_TURN = (500, 1000, 2000, 4000, 8000)
FINER = 2000  # steps per turn with the other rules
# The only rule of YADE 2023.02a, and that which is the default where there are several.
FINCHAM, DEL_VALLE = "Fincham1992", "delValle2023"
HALF_STEP = "half step"  # HalfStep below
NAMES = {FINCHAM: "YADE's rule", DEL_VALLE: "YADE's rule of 2023", HALF_STEP: "orientation of the half step"}
LOOKS = 400


def energy(state):
    """Of rotation, J, of the angular momentum and the orientation that YADE has at the end of a step."""
    local = np.array(state.ori.conjugate() * state.angMom)
    return 0.5 * float(local @ (local / np.array(state.inertia)))


class HalfStep:
    """Fincham's rule (1992; Allen & Tildesley 1987, 3.3), in which the orientation of the middle of a step turns L into
    the body's axes there. YADE's takes that of its beginning, by which it is of first order.
    """

    def __init__(self, state):
        self.state, self.inertia = state, tuple(state.inertia)
        w, x, y, z = (float(state.ori[i]) for i in (3, 0, 1, 2))
        self.turn = (w, x, y, z)

    def advance(self, steps):
        momentum = tuple(self.state.angMom)
        for _ in range(steps):
            O.step()
            rate = _rate(self.turn, momentum, self.inertia)
            half = _unit(tuple(q + 0.5 * O.dt * v for q, v in zip(self.turn, rate)))
            rate = _rate(half, momentum, self.inertia)
            self.turn = _unit(tuple(q + O.dt * v for q, v in zip(self.turn, rate)))
            self.state.ori = yade.Quaternion(*self.turn)


def _rate(turn, momentum, inertia):
    """dq/dt of the orientation q = (w, x, y, z), local to world, for the angular momentum in the world."""
    w, x, y, z = turn
    a, b, c = momentum
    # I^-1 R(q)^T L
    p = ((1 - 2 * (y * y + z * z)) * a + 2 * (x * y + w * z) * b + 2 * (x * z - w * y) * c) / inertia[0]
    q = (2 * (x * y - w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z + w * x) * c) / inertia[1]
    r = (2 * (x * z + w * y) * a + 2 * (y * z - w * x) * b + (1 - 2 * (x * x + y * y)) * c) / inertia[2]
    return (
        0.5 * (-x * p - y * q - z * r), 0.5 * (w * p + y * r - z * q),
        0.5 * (w * q + z * p - x * r), 0.5 * (w * r + x * q - y * p),
    )  # fmt: skip


def _unit(quaternion):
    length = math.sqrt(sum(value * value for value in quaternion))
    return tuple(value / length for value in quaternion)


def rules(short):
    """(name, steps per turn) of each run."""
    known = [(FINCHAM, steps) for steps in (STEPS_PER_TURN[::4] if short else STEPS_PER_TURN)]
    if hasattr(yade.NewtonIntegrator, "rotAlgorithm"):
        known.append((DEL_VALLE, FINER))
    return [*known, (HALF_STEP, FINER)]


def simulate(steps_per_turn, turns=TURNS, rule=FINCHAM):
    """Looks (n, 3): time (s), angular velocity about the middle axis of the book (1/s), energy over that at the start;
    and the largest change of the angular momentum, relative."""
    O.reset()
    O.materials.append(yade.FrictMat(density=DENSITY))
    book = body(shapes.cuboid(BOOK, rounding=ROUNDING, k=0.0))
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
    if hasattr(O.engines[-1], "rotAlgorithm"):
        O.engines[-1].rotAlgorithm = DEL_VALLE if rule == DEL_VALLE else FINCHAM
    half_step = HalfStep(state)
    first, looks, change = energy(state), [], 0.0
    for look in range(LOOKS + 1):
        if look:
            step = round(look / LOOKS * turns * steps_per_turn)
            if rule == HALF_STEP:
                half_step.advance(step - O.iter)
            else:
                advance(step)
        local = np.array(state.ori.conjugate() * state.angMom) / inertia
        looks.append((O.time, local[middle], energy(state) / first))
        change = max(change, (state.angMom - start).norm() / start.norm())
    return np.array(looks), change


def run(note, short):
    """YADE's rule with five time steps, and finer rules; or a tenth of the turns."""
    turns, rows, drifts, data, momentum = (10 if short else TURNS), [], {}, [], 0.0
    for number, (rule, steps) in enumerate(rules(short), 1):
        looks, change = simulate(steps, turns, rule)
        drifts[rule] = drift = float(np.abs(looks[:, 2] - 1.0).max())
        momentum = max(momentum, change) if rule != DEL_VALLE else momentum
        rows.append(
            row(f"energy over that at the start, {turns} turns, {steps} steps a turn, {NAMES[rule]}", 1.0, 1.0 + drift))
        data.append({"steps": steps, "rule": rule, "turns": (looks[:, 0] * SPIN / (2 * np.pi)).tolist(),
                     "spin": looks[:, 1].tolist(), "energy": looks[:, 2].tolist()})  # fmt: skip
        note(number / len(rules(short)))
    rows.append(row("angular momentum over that at the start", 1.0, 1.0 + momentum))
    aims = [
        target(f"free flight: change of energy, {NAMES[rule]}, {steps} steps a turn", 1e-6, drifts[rule])
        for rule, steps in dict(rules(short)).items()
    ]
    aims.append(target("free flight: change of angular momentum", 1e-6, momentum))
    return {"title": TITLE, "rows": rows, "targets": aims, "data": {"runs": data}}
