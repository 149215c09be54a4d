# SPDX-License-Identifier: MIT OR Apache-2.0
"""Time of a step of 1,000 rounded cubes that settle in a box of some 5,000 facets.

    scripts/yade.sh -j1 benches/yade/walls.py [SETTLE_STEPS [BODIES]]

Prints the contacts, the time of each engine of a step, and of the facets' functor alone; the fastest of some blocks of
steps.
"""

import random
import sys
import time

import potential_particles
import yade
from yade import O, Quaternion, Vector3, utils

SETTLE = int(sys.argv[1]) if len(sys.argv) > 1 else 6000
BODIES = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
SIZE, WIDTH, HEIGHT, CELLS = 0.1, 2.0, 1.0, 32
BLOCKS, BLOCK_STEPS = 20, 25


def grid(origin, along, up, columns, rows):
    """Triangles of a rectangle."""
    def at(i, j):
        return origin + along * (i / columns) + up * (j / rows)

    for i in range(columns):
        for j in range(rows):
            yield at(i, j), at(i + 1, j), at(i + 1, j + 1)
            yield at(i, j), at(i + 1, j + 1), at(i, j + 1)


def box():
    x, y, z = Vector3(WIDTH, 0, 0), Vector3(0, WIDTH, 0), Vector3(0, 0, HEIGHT)
    low = Vector3(-WIDTH / 2, -WIDTH / 2, 0)
    for origin, along, up, rows in (low, x, y, CELLS), (low, x, z, 12), (low + y, x, z, 12), (low, y, z,
                                                                                              12), (low + x, y, z, 12):
        yield from grid(origin, along, up, CELLS, rows)


def rocks():
    draw = random.Random(1)
    half, r = SIZE / 2, 0.1 * SIZE
    planes = [(*(s * (i == j) for j in range(3)), half - r) for i in range(3) for s in (1, -1)]
    per_row = 11
    for n in range(BODIES):
        shape = yade.ConicPotentialParticle(planes=planes, r=r, k=0.05, R=SIZE)
        body = yade.Body()
        body.shape, body.aspherical = shape, True
        place = Vector3(n % per_row - per_row / 2 + 0.5, n // per_row % per_row - per_row / 2 + 0.5,
                        n // per_row**2 + 0.6) * 1.75 * SIZE
        utils._commonBodySetup(body, shape.volume, shape.inertia.diagonal(), material=-1, pos=place)
        body.state.mass, body.state.inertia = 2000 * shape.volume, 2000 * shape.inertia.diagonal()
        body.state.ori = Quaternion(Vector3([draw.gauss(0, 1) for _ in range(3)]).normalized(), draw.uniform(0, 3))
        yield body


O.materials.append(yade.FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2000))
O.bodies.append([utils.facet(vertices, fixed=True, material=-1) for vertices in box()])
facets = len(O.bodies)
for body in O.bodies:
    body.mask = 3
O.bodies.append(list(rocks()))
O.engines = [
    yade.ForceResetter(),
    potential_particles.BoundWatch(),
    # Facets are not paired with facets: bit 2 of their masks.
    yade.InsertionSortCollider([potential_particles.Bo1_ConicPP_Aabb(), yade.Bo1_Facet_Aabb()], verletDist=0.05 * SIZE,
                               avoidSelfInteractionMask=2),
    potential_particles.ConicInteractionLoop(
        [potential_particles.Ig2_ConicPP_ConicPP_ScGeom(), potential_particles.Ig2_Facet_ConicPP_ScGeom()],
        [yade.Ip2_FrictMat_FrictMat_FrictPhys()], [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    yade.NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.3, exactAsphericalRot=True),
]
O.dt = 1e-4


def advance(steps):
    O.run(steps)
    while O.running:
        time.sleep(0.0005)


advance(SETTLE)
pairs, walls = O.engines[3].geomDispatcher.functors
touching = [i for i in O.interactions if i.isReal]
at_walls = sum(1 for i in touching if isinstance(O.bodies[i.id1].shape, yade.Facet))
walls.measureTime = pairs.measureTime = True
walls.resetCounters(), pairs.resetCounters()
O.timingEnabled = True
best = None
for _ in range(BLOCKS):
    for engine in O.engines:
        engine.execTime = 0
    begin = walls.seconds, pairs.seconds
    advance(BLOCK_STEPS)
    times = [engine.execTime * 1e-6 / BLOCK_STEPS for engine in O.engines]
    row = (sum(times), times, (walls.seconds - begin[0]) * 1e3 / BLOCK_STEPS,
           (pairs.seconds - begin[1]) * 1e3 / BLOCK_STEPS)
    best = min(best, row) if best else row
total, times, of_walls, of_pairs = best
low = min(O.bodies[n].state.pos[2] for n in range(facets, len(O.bodies)))
print(
    f"{facets:,} facets, {BODIES:,} bodies, lowest centre at {low:.3f} m, {O.numThreads} threads; {len(O.interactions):,} pairs, "
    f"{len(touching):,} contacts, {at_walls:,} with facets; failures {walls.failures}")
print(f"a step {total:.2f} ms: " + ", ".join(f"{type(engine).__name__} {ms:.2f}"
                                             for engine, ms in zip(O.engines, times)))
print(
    f"functors, summed over threads: facets {of_walls:.2f} ms ({walls.calls / BLOCKS / BLOCK_STEPS:.0f} calls a step), "
    f"pairs {of_pairs:.2f} ms; facets answered by {walls.answers}")
sys.exit(0)
