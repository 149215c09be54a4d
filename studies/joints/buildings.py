# SPDX-License-Identifier: GPL-3.0-or-later
"""Buildings of blocks that are pushed sideways: below their limit they come to rest, above it they fall."""
import math

import numpy as np
import potential_particles
from potential_particles import shapes
from scene import O, fastest, fresh, run
from yade import Vector3

FRICTION, GRAVITY = 0.7, 9.81
ROUNDING = 2e-3  # of the edges, m
# Stiffness per area, N/m^3: so stiff that a block on its edge does not tilt by as much as the limit would see; a row
# may have a stiffer one.
K = 1e11
STEP = 5e-6  # s, of joints of K, a fifth of the limit of the joints that there are
RESTS, FALLS = 1e-6, 0.05  # m/s; m


class Building:
    """Stones as convex hulls of corners, fixed ones, and the direction of the push."""

    def __init__(self, stones, fixed, direction):
        self.stones, self.fixed, self.direction = stones, fixed, direction

    @staticmethod
    def shape(corners):
        size = potential_particles.polyhedron.Polyhedron.of_points(corners).size
        return shapes.from_vertices(corners, rounding=ROUNDING / size, k=0)

    def rest(self, stiffness=K):
        """The stones, once they have come to rest under their weight."""
        fresh(damping=0.5, normalStiffness=stiffness, shearStiffness=stiffness / 2, frictionAngle=math.atan(FRICTION),
              restitution=0.3)
        stones = [O.bodies[O.bodies.append(potential_particles.body(self.shape(one)))] for one in self.stones]
        for one in self.fixed:
            O.bodies.append(potential_particles.body(self.shape(one), fixed=True))
        O.dt = STEP * math.sqrt(K / stiffness)
        O.engines[-1].gravity = Vector3(0, 0, 0)
        run(2 * O.dt)
        for part in range(1, 21):
            O.engines[-1].gravity = Vector3(0, 0, -GRAVITY * part / 20)
            run(0.02)
        run(0.3)
        return stones

    def limit(self):
        """The acceleration in `direction`, over gravity, at which it falls, by limit analysis of the building at rest.
        """
        return potential_particles.limit_analysis("load", push=self.direction).factor

    def pushed(self, stones, acceleration, seconds=2.0):
        """How far stones are off after the acceleration has come up slowly and stayed until they rest or have fallen,
        or for a time, m, and the fastest one, m/s.
        """
        begin = [Vector3(stone.state.pos) for stone in stones]

        def moved():
            return max((stone.state.pos - place).norm() for stone, place in zip(stones, begin))

        for part in range(1, 101):
            O.engines[-1].gravity = GRAVITY * (acceleration * part / 100 * Vector3(*self.direction) - Vector3(0, 0, 1))
            run(0.015)
        end = O.time + seconds
        while O.time < end and fastest() > RESTS and moved() < FALLS:
            run(0.02)
        return moved(), fastest()


def brick(x, z, length=0.4, width=0.2, height=0.2, y=0.0):
    """The corners of a brick whose lowest corner is at x, z, about y = 0."""
    return np.array([(x + i * length, y + (j - 0.5) * width, z + k * height) for i in (0, 1) for j in (0, 1)
                     for k in (0, 1)])


def wall():
    """3 bricks wide and 8 courses high, with open head joints."""
    gap, stones = 0.004, []
    for course in range(8):
        ends = (0, 0.4, 0.8, 1.2) if course % 2 == 0 else (0, 0.2, 0.6, 1.0, 1.2)
        stones += [brick(a + gap / 2, 0.2 * course, b - a - gap) for a, b in zip(ends, ends[1:])]
    fixed = [brick(-0.2, -0.2, 1.6, width=0.4)]
    return Building(stones, fixed, (1, 0, 0))


def portal():
    """A beam on two pillars of four blocks."""
    stones = [brick(x, 0.2 * course, 0.15) for x in (0, 0.65)
              for course in range(4)] + [brick(-0.05, 0.8, 0.9, height=0.12)]
    fixed = [brick(-0.2, -0.2, 1.2, width=0.4)]
    return Building(stones, fixed, (1, 0, 0))


def tower():
    """Bricks laid crosswise."""
    stones = [
        brick(0, 0.1 * course, 0.3, 0.2, 0.1) if course % 2 == 0 else brick(0.05, 0.1 * course, 0.2, 0.3, 0.1)
        for course in range(8)
    ]
    fixed = [brick(-0.2, -0.2, 0.7, width=0.7)]
    return Building(stones, fixed, (1, 0, 0))


def arch(stones=12, thickness=1.3 * 0.1075, depth=0.14, radius=1.0):
    """A round arch of 1.3 times its least thickness, pushed out of its plane."""
    inner, outer = radius - thickness / 2, radius + thickness / 2
    angles = np.pi * np.arange(stones + 1) / stones

    def point(distance, angle, side):
        return distance * math.cos(angle), side * depth / 2, distance * math.sin(angle)

    blocks = [[point(d, a, s) for d in (inner, outer) for a in angles[i:i + 2] for s in (-1, 1)] for i in range(stones)]
    fixed = [brick(side - thickness, -0.2, 2 * thickness, width=2 * depth) for side in (-radius, radius)]
    return Building(blocks, fixed, (0, 1, 0))


def _row(building, below=None, stiffness=K):
    """Pushed by `below`, by default 2 % less than the limit, and by 2 % more; accelerations over gravity."""
    stones = building.rest(stiffness)
    limit = building.limit()
    stands = building.pushed(stones, 0.98 * limit if below is None else below)
    falls = building.pushed(building.rest(stiffness), 1.02 * limit)
    return {"value": stands[1], "target": RESTS, "limit": limit, "moved_standing": stands[0], "moved_falling": falls[0],
            "falls": stands[0] < FALLS / 2 and falls[0] > FALLS}


def pushed_wall():
    """A wall of 3 x 8 bricks 2 % below and above the limit of a push along it: speed below, m/s."""
    return _row(wall())


def pushed_portal():
    """A beam on two pillars."""
    return _row(portal(), stiffness=3e12)


def pushed_tower():
    """Bricks laid crosswise."""
    return _row(tower(), stiffness=1e12)


def pushed_arch():
    """A round arch of 1.3 times its least thickness under 0.02 g across it: speed, m/s; and 2 % above its limit."""
    return _row(arch(), below=0.02)


def running_bond(courses=6, bricks=4):
    """Bricks in a running bond with closed head joints, under their own weight: of the bed joints of a course the sum
    of the vertical forces over the weight above, the worst course; and the speed, m/s.
    """
    fresh(damping=0.5, normalStiffness=K, shearStiffness=K / 2, frictionAngle=math.atan(FRICTION), restitution=0.3)
    courses_of = {O.bodies.append(
        potential_particles.body(Building.shape(brick(-0.2, -0.2, 0.4 * bricks + 0.4, width=0.4)), fixed=True)): -1}
    for course in range(courses):
        ends = np.unique(np.clip(0.4 * np.arange(bricks + 2) - 0.2 * (course % 2), 0, 0.4 * bricks))
        for x, end in zip(ends, ends[1:]):
            stone = potential_particles.body(Building.shape(brick(x, 0.2 * course, end - x)), color=(0.7, 0.45, 0.35))
            courses_of[O.bodies.append(stone)] = course
    O.dt = STEP
    run(1.0)
    beds, weights = np.zeros(courses), np.zeros(courses)
    for contact in O.interactions:
        below, above = sorted((contact.id1, contact.id2), key=courses_of.get)
        if contact.isReal and courses_of[below] < courses_of[above]:
            force = (contact.phys.normalForce + contact.phys.shearForce)[2]
            beds[courses_of[above]] += force if contact.id2 == above else -force
    for body, course in courses_of.items():  # the ground is course -1, and adds to none
        weights[:course + 1] += O.bodies[body].state.mass * GRAVITY
    return {"value": float(np.abs(beds / weights - 1).max()), "target": 1e-6, "speed": fastest(), "speed_target": RESTS,
            "beds": list(beds), "weights": list(weights)}


ROWS = {row.__name__: row for row in (running_bond, pushed_wall, pushed_portal, pushed_tower, pushed_arch)}
