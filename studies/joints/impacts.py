# SPDX-License-Identifier: GPL-3.0-or-later
"""Elastic impacts: how far the energy drifts over many of them, at the default step and at an eighth of it."""
import math
import time

import potential_particles
from potential_particles import shapes
from scene import TOLERANCE, O, add, block_shape, fresh, kinetic_energy, wall
from yade import PyRunner, Quaternion, Vector3

IMPACTS, FEW = 200, 50
# Stiffness per area, N/m^3: corners go in by less than half the rounding.
K = 1e11


def _rocks():
    one, other = (O.bodies[O.bodies.append(
        potential_particles.body(shapes.random_rock(seed=seed, size=0.8), position=(place, 0.1 * place, 0)))]
                  for seed, place in ((1, -0.5), (2, 0.5)))
    one.state.vel, other.state.vel = Vector3(1, 0.4, 0.2), Vector3(-1, 0.2, 0.3)
    return [one, other]


def _cubes():
    """Nearly face on."""
    one = add(block_shape((0.6, 0.6, 0.6), r=0.02), (-0.5, 0, 0))
    other = add(block_shape((0.6, 0.6, 0.6), r=0.02), (0.5, 0.02, 0.01), Quaternion((0, 0, 1), 0.01))
    one.state.vel, other.state.vel = Vector3(1, 0, 0), Vector3(-1, 0, 0)
    return [one, other]


def _crossed_edges():
    """Two bars whose edges cross at right angles to the way between them, and go on as they like."""
    shape = block_shape((0.3, 0.3, 0.9), r=0.02)
    quarter = math.pi / 4
    one = add(shape, (-0.4, 0, 0), Quaternion((0, 0, 1), quarter))
    other = add(shape, (0.4, 0.02, 0.03), Quaternion((1, 0, 0), 0.4 * math.pi) * Quaternion((0, 0, 1), quarter))
    one.state.vel, other.state.vel = Vector3(1, 0, 0), Vector3(-1, 0, 0)
    return [one, other]


class Drift:
    """Adds up what impacts change the energy by; looks every 20 default steps, fewer than an impact takes.

    In free flight YADE's integrator changes the energy of bodies that spin about no principal axis, in proportion to
    the
    step: that is kept apart.
    """

    def __init__(self, bodies, impacts):
        self.bodies, self.left, self.touching = bodies, impacts, False
        self.before, self.last = kinetic_energy(bodies), 1.0
        self.by_impacts = self.worst = 0.0

    def look(self):
        now = any(contact.isReal for contact in O.interactions)
        energy = self.last if now else kinetic_energy(self.bodies) / self.before
        if self.touching and not now:
            self.by_impacts += energy - self.last
            self.worst = max(self.worst, abs(self.by_impacts))
            self.left -= 1
            if self.left == 0:
                O.pause()
        self.touching, self.last = now, energy

    def in_flight(self):
        return abs(self.last - 1 - self.by_impacts)


def drift(make, step=1.0, tolerance=TOLERANCE, impacts=IMPACTS):
    """Largest sum of what impacts changed the energy of two bodies in a box of walls by, relative; and what free flight
    did. `step` is a share of the default one.
    """
    global watch
    fresh(tolerance=tolerance, gravity=(0, 0, 0), normalStiffness=K, frictionAngle=0.0)
    for axis in range(3):
        for sign in (-1, 1):
            place = [0.0] * 3
            place[axis] = 1.1 * sign
            wall(place, axis, -sign)
    bodies = make()
    O.dt = step * potential_particles.critical_time_step()
    watch = Drift(bodies, impacts)
    O.engines += [PyRunner(command="impacts.watch.look()", iterPeriod=round(20 / step))]
    O.run()
    while O.running:
        time.sleep(0.01)
    if watch.left:
        raise RuntimeError(
            f"YADE stopped at step {O.iter}, {watch.left} impacts before the end; its message stands above")
    return watch.worst, watch.in_flight()


def _row(make):
    worst, in_flight = drift(make)
    return {"value": worst, "target": 1e-4, "impacts": IMPACTS, "step": O.dt, "in_flight": in_flight,
            # Over fewer impacts, and with a tolerance of the patch that is as much smaller.
            "eighth": drift(make, 0.125, tolerance=1e-7, impacts=FEW)[0], "eighth_target": 1e-6}


def rocks():
    """Drift of the energy of two rocks in a box over 200 elastic impacts."""
    return _row(_rocks)


def cubes():
    """The same of two cubes that meet nearly face on."""
    return _row(_cubes)


def crossed_edges():
    """The same of two bars that meet edge on edge."""
    return _row(_crossed_edges)


ROWS = {row.__name__: row for row in (rocks, cubes, crossed_edges)}
