# SPDX-License-Identifier: GPL-3.0-or-later
"""Error and time of volume and inertia against the tolerance asked for: the table of docs/shapes.md.

    scripts/yade.sh -j1 benches/mass_properties.py

Cuboids with k = 0 are compared with Steiner's formula, the sphere with its closed form, and the others with the same
quadrature to 1e-9, whose own error is bounded by what it says.
"""
import math
import time

import potential_particles
from potential_particles import shapes

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)


def rounded_cuboid(half, r):
    """Volume, and moments of inertia about the axes, of the Minkowski sum of a box and a ball; `half` reaches the
    faces.
    """
    a = [one - r for one in half]
    volume, second = 0.0, [0.0] * 3
    for outside in range(8):
        free = [axis for axis in range(3) if outside >> axis & 1]
        box = math.prod(2 * a[axis] for axis in range(3) if axis not in free)
        # Volume, and integrals of |s| and s^2 along an axis, of the ball of the dimension that is left.
        ball, first, square = ((1, 0, 0), (2 * r, r**2, 2 / 3 * r**3), (math.pi * r**2, 4 / 3 * r**3,
                                                                        math.pi / 4 * r**4),
                               (4 / 3 * math.pi * r**3, math.pi / 2 * r**4, 4 / 15 * math.pi * r**5))[len(free)]
        volume += box * ball
        for axis in range(3):
            second[axis] += box * (a[axis]**2 * ball + 2 * a[axis] * first + square if axis in free else a[axis]**2 / 3
                                   * ball)
    return volume, [sum(second) - one for one in second]


def measured(particle, tolerance):
    """Volume, moments of inertia about the local axes, estimated error, and the least time of some calls, s."""
    times = []
    while not times or len(times) < 5 and sum(times) < 1.0:
        begin = time.perf_counter()
        volume, _, inertia, error = particle.massProperties(tolerance)
        times.append(time.perf_counter() - begin)
    return volume, [inertia[i, i] for i in range(3)], error, min(times)


def cases():
    """Name, particle, and what is known: (volume, moments of inertia) or None."""
    radius = 1.0
    volume = 4 / 3 * math.pi * radius**3
    yield "sphere", shapes.sphere(radius), (volume, [0.4 * volume * radius**2] * 3)
    for r in (1e-6, 0.01, 0.1):
        shape = shapes.cuboid((1, 1.2, 1.4), rounding=r, k=0.0)
        yield f"cuboid, r = {r:g}, k = 0", shape, rounded_cuboid((0.5, 0.6, 0.7), shape.r)
    yield "cuboid, r = 1e-6, k = 1e-6", shapes.cuboid((1, 1.2, 1.4), rounding=1e-6, k=1e-6), None
    yield "cuboid, r = 0.1, k = 0.3", shapes.cuboid((1, 1.2, 1.4), rounding=0.1, k=0.3), None
    for r, k in ((1e-6, 0.0), (0.05, 0.02)):
        yield f"rock of 24 planes, r = {r:g}, k = {k:g}", shapes.random_rock(1, faces=24, rounding=r, k=k), None


def main():
    print("| shape | tolerance | error of volume | of inertia | estimated | ms |\n|---|---|---|---|---|---|")
    for name, shape, known in cases():
        particle = shape.particle()
        volume, inertia = known or measured(particle, 1e-9)[:2]
        for tolerance in TOLERANCES:
            found, moments, error, seconds = measured(particle, tolerance)
            off = max(abs(one / other - 1.0) for one, other in zip(moments, inertia))
            print(
                f"| {name} | {tolerance:.0e} | {abs(found / volume - 1.0):.0e} | {off:.0e} | {error:.0e} | {1e3 * seconds:.2g} |",
                flush=True)


main()
