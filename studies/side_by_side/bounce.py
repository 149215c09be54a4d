# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two bodies that bounce for ever: no gravity, friction or damping, so that energy must stay.

Head-on: two cubes face to face on one line, between two fixed ones. With linear springs a contact
lasts pi sqrt(m/2k) whatever the speed, and nothing ever turns or leaves the line.
Free: a cube and a pyramid meet off-centre and spinning; momentum and angular momentum must stay.
"""

import time
from dataclasses import dataclass, field

import numpy as np
from yade import Matrix3, O, Vector3, utils

from cases import Springs, loop
from contact_functor import ContactFunctor
from particles import block, half_height, material, plain_body
from pyramid import pyramid

STIFFNESS = 1e4  # N/m, or N/m^3 on faces of about 1 m^2
SPEED = 1.0  # m/s
GAP = 0.1  # between a cube and its wall, and half of that between both, m
TWIST = 0.15  # half the angle's tangent by which faces are turned against each other
BOUNCES = 50
FREE_STEP = 1e-4  # s; the free collision lasts some 200 of them


@dataclass
class Bounce:
    """What was seen of two bodies that bounce."""

    ideal_duration: float  # of a contact of both bodies, s
    steps: int = 0
    energies: list = field(default_factory=list)  # J, in free flight: at the start and after each bounce
    durations: list = field(default_factory=list)  # of contacts of both bodies, s
    spin: float = 0.0  # rad/s at the end
    microseconds: float = 0.0  # a step of all engines

    @property
    def bounces(self):
        return len(self.energies) - 1

    @property
    def drift(self):
        """Largest change of the energy, relative."""
        return max(abs(energy / self.energies[0] - 1.0) for energy in self.energies)

    def summary(self):
        times = self.durations
        return {"bounces": self.bounces, "drift": self.drift, "spin": self.spin,
                "microseconds_a_step": self.microseconds,
                "contact_time_over_ideal": sum(times) / len(times) / self.ideal_duration if times else None}


class HeadOn:
    """The same line of cubes for every functor, and for exact springs."""

    def __init__(self, steps_per_contact, keep=False, bounces=BOUNCES):
        """keep: the law's neverErase, which spares it the step without force at the start of a contact."""
        self.cube = block(0.5, 0.1, 0.1)
        self.half = half_height(self.cube)
        self.inner, self.outer = self.half + GAP, 3.0 * self.half + 2.0 * GAP
        self.ideal = np.pi * np.sqrt(0.5 * self.cube.volume / STIFFNESS)
        self.step = self.ideal / steps_per_contact
        self.keep, self.bounces = keep, bounces
        self.exact = self._exact_springs()

    def run(self, kind, area=False, most_seconds=np.inf):
        """Ends early after `most_seconds`, or when it takes much longer than with exact springs."""
        contact = ContactFunctor(kind, area=area)
        O.reset()
        stuff = material(0.0, 1.0)
        pair = []
        for side in (-1, 1):
            cube = plain_body(self.cube, stuff, (side * self.inner, 0.0, 0.0), (1.0, side * TWIST, 0.0, 0.0))
            cube.state.vel = Vector3(-side * SPEED, 0.0, 0.0)
            pair.append(O.bodies.append(cube))
        for side in (-1, 1):
            O.bodies.append(plain_body(self.cube, stuff, (side * self.outer, 0.0, 0.0), fixed=True))
        springs = Springs(STIFFNESS, STIFFNESS, self.step)
        O.engines = loop(contact.functor, springs, gravity=0.0, never_erase=self.keep)
        O.dt = self.step
        O.timingEnabled = True
        contact.prepare()
        return self._watch(*pair, most_seconds)

    def _watch(self, first, second, most_seconds):
        result = Bounce(self.ideal, energies=[utils.kineticEnergy()])
        began, most_steps = time.monotonic(), 1.2 * self.exact.steps
        since = None  # the first cube touches; the other one, or its wall
        while (
            result.bounces < self.bounces
            and O.iter < most_steps
            and time.monotonic() - began < most_seconds
        ):
            O.step()
            touching = [i for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0.0]
            mine = [i for i in touching if first in (i.id1, i.id2)]
            if mine and since is None:
                since = O.time, second in (mine[0].id1, mine[0].id2)
            # Only in free flight is all energy kinetic: the other cube must be clear, too.
            elif not touching and since is not None:
                if since[1]:
                    result.durations.append(O.time - since[0])
                result.energies.append(utils.kineticEnergy())
                since = None
        result.steps = O.iter
        result.spin = max(O.bodies[i].state.angVel.norm() for i in (first, second))
        result.microseconds = sum(engine.execTime for engine in O.engines) / 1e3 / max(O.iter, 1)
        return result

    def _exact_springs(self):
        """The same line in exact arithmetic of springs: no geometry, only YADE's way to step."""
        place, speed, mass, step = -self.inner, SPEED, self.cube.volume, self.step
        result = Bounce(self.ideal, energies=[mass * speed**2])
        known = [False, False]  # by neighbour (other cube, wall): the law has its physics
        touched = False
        while result.bounces < self.bounces:
            overlaps = (2.0 * (self.half + place), 2.0 * self.half - self.outer - place)
            force = 0.0
            for i, (overlap, sense) in enumerate(zip(overlaps, (-1.0, 1.0))):
                if overlap > 0.0:
                    # In the first step there is no physics yet, and no force.
                    force += sense * STIFFNESS * overlap if known[i] else 0.0
                    known[i] = True
                elif not self.keep:
                    known[i] = False
            touching = max(overlaps) > 0.0
            speed += force / mass * step
            place += speed * step
            result.steps += 1
            if touched and not touching:
                result.energies.append(mass * speed**2)
            touched = touching
        return result


def momentum_change(kind, area):
    """Relative change of momentum and of angular momentum in one oblique, spinning collision."""
    contact = ContactFunctor(kind, area=area)
    O.reset()
    stuff = material(30.0, 1.0)
    start = [
        (block(0.5, 0.1, 0.1), (-0.8, 0.1, 0.05), (0.9, 0.1, -0.3, 0.2), (1.0, 0.1, 0.0), (0.3, -0.2, 0.5)),
        (pyramid(1.0, 0.1, 0.1), (0.8, -0.1, 0.1), (0.2, 0.7, 0.4, -0.5), (-1.0, 0.0, 0.1), (-0.4, 0.6, 0.1)),
    ]
    for particle, position, orientation, velocity, spin in start:
        body = plain_body(particle, stuff, position, orientation)
        body.state.vel, body.state.angVel = Vector3(*velocity), Vector3(*spin)
        body.state.angMom = world_inertia(body.state) * body.state.angVel
        O.bodies.append(body)
    O.engines = loop(contact.functor, Springs(STIFFNESS, STIFFNESS, FREE_STEP), gravity=0.0)
    O.dt = FREE_STEP
    contact.prepare()
    before, scale = _momenta(), _scales()
    met = False
    while O.time < 0.5:
        O.step()
        touching = any(i.isReal and i.geom.penetrationDepth > 0.0 for i in O.interactions)
        if met and not touching:
            break
        met = met or touching
    if not met:
        raise RuntimeError(f"{contact.name}: the two bodies of the free collision have missed each other")
    return tuple(float(np.linalg.norm(after - then) / size) for after, then, size in zip(_momenta(), before, scale))


def world_inertia(state):
    turn = state.ori.toRotationMatrix()
    i = state.inertia
    return turn * Matrix3(i[0], 0, 0, 0, i[1], 0, 0, 0, i[2]) * turn.transpose()


def _momenta():
    """Linear, kg m/s, and angular about the origin, kg m^2/s."""
    states = [body.state for body in O.bodies]
    linear = sum(np.array(state.mass * state.vel) for state in states)
    angular = sum(np.array(state.angMom + state.mass * state.pos.cross(state.vel)) for state in states)
    return linear, angular


def _scales():
    states = [body.state for body in O.bodies]
    linear = sum(state.mass * state.vel.norm() for state in states)
    angular = sum(state.angMom.norm() + state.mass * state.pos.cross(state.vel).norm() for state in states)
    return linear, angular
