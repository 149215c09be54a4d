# SPDX-License-Identifier: GPL-3.0-or-later
# Two rounded cubes bounce head-on, each between the other and a fixed one, without gravity, friction or damping.
# With fixed stiffness this line of cubes is a line of springs, which is stepped here beside YADE.
from harness import *
import potential_particles
import numpy as np
import yade
from potential_particles import shapes

check = Checks()

STIFFNESS, BOUNCES, STEPS_PER_CONTACT = 1e4, 6, 500
GAP, TWIST = 0.1, 0.3


def line(functor_):
    """Ids of the moving cubes, and half the height of a cube. Contacts are kept when they open, so that only
    the first of each pair starts with the step without force that YADE's order of functors costs."""
    fresh_scene(functor_, law=yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=True), stiffness=STIFFNESS)
    half = cube(0.1, 0.1, math.sqrt(0.75)).surfaceDistance([(1, 0, 0)])[0]
    places = [(-half - GAP, False), (half + GAP, False), (-3 * half - 2 * GAP, True), (3 * half + 2 * GAP, True)]
    ids = []
    for number, (x, fixed) in enumerate(places):
        # Faces turned against each other, so that nothing cancels for want of different numbers.
        turn = turned((1, 0, 0), TWIST * number)
        ids.append(add(plain(cube_planes(0.5, 0.1), r=0.1, k=0.1, R=math.sqrt(0.75)), Vector3(x, 0, 0), turn, fixed,
                       density=1.0, volume=1.0, inertia=Vector3(1, 1, 1) / 6))
    for number, speed in zip(ids[:2], (1, -1)):
        O.bodies[number].state.vel = Vector3(speed, 0, 0)
    return ids[0], ids[1], half


def springs(half, step):
    """Kinetic energy in free flight after each bounce, steps and largest overlap: the same steps without geometry."""
    place, speed, energies, overlap, steps = -half - GAP, 1.0, [1.0], 0.0, 0
    known, touched = [False, False], False
    while len(energies) <= BOUNCES:
        depths = (2 * (half + place), -half - 2 * GAP - place)
        for number, (depth, sense) in enumerate(zip(depths, (-1, 1))):
            if depth > 0:
                speed += sense * STIFFNESS * depth * step if known[number] else 0.0
                known[number] = True
        place += speed * step
        steps += 1
        touching = max(depths) > 0
        overlap = max(overlap, *depths)
        if touched and not touching:
            energies.append(speed**2)
        touched = touching
    return energies, steps, overlap


step = math.pi * math.sqrt(0.5 / STIFFNESS) / STEPS_PER_CONTACT
first, second, half = line(yade.Ig2_PP_PP_ScGeom_Conic(calContactArea=False))
O.dt = step
energies, steps, overlap = springs(half, step)
deepest, found, touched = 0.0, [utils.kineticEnergy()], False
for _ in range(steps):
    O.step()
    depths = [i.geom.penetrationDepth for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0]
    deepest = max([deepest, *depths])
    if touched and not depths:
        found.append(utils.kineticEnergy())
    touched = bool(depths)

check.equal(len(found) - 1, BOUNCES, "bounces")
drift = max(abs(energy / found[0] - 1) for energy in found)
check.true(drift < 1e-4, f"energy over {BOUNCES} bounces changes by {drift:g}")
difference = max(abs(a - b) for a, b in zip(found, energies))
check.true(difference < 1e-9, f"energies differ from those of springs by {difference:g}")
check.close(deepest, overlap, 1e-9, "largest overlap")
for body in (first, second):
    state = O.bodies[body].state
    check.true(state.angVel.norm() < 1e-9, f"body {body} turns by {state.angVel.norm():g} rad/s")
    check.true(max(abs(state.pos[1]), abs(state.pos[2])) < 1e-9, f"body {body} has left the line: {state.pos}")
check.close(momentum(), Vector3.Zero, 1e-9, "momentum of the mirrored pair")
check.equal(functor().failures, 0, "failures")

# Force times overlap as a field: what of dF/dx is no gradient, over kn. None between faces; between edges in proportion
# to the overlap over r.
def no_gradient(formulation, share):
    """Of two rocks in eight directions, with that overlap over r."""
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(formulation=formulation, carryTolerance=0.0),
                yade.Ip2_FrictMat_FrictMat_FrictPhys(), yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False),
                dt=1e-12)
    O.engines[1].verletDist = 0.0
    rocks = shapes.random_rock(3, size=1.0), shapes.random_rock(5, size=1.0)
    O.bodies.append([
        potential_particles.body(rocks[0], fixed=True),
        potential_particles.body(rocks[1], fixed=True, orientation=(1, 0.3, 0.2, 0.5))
    ])
    wanted, found = share * rocks[0].r, []

    def force(place):
        O.bodies[1].state.pos = Vector3(*place)
        O.interactions.clear()
        O.step()
        real = [one for one in O.interactions if one.isReal]
        return (np.array(real[0].phys.normalForce), real[0].geom.penetrationDepth,
                real[0].phys.kn) if real else (np.zeros(3), 0.0, 1.0)

    for direction in np.random.default_rng(1).normal(size=(8, 3)):
        direction /= np.linalg.norm(direction)
        near, far = 0.3, 2.0
        for _ in range(40):
            middle = 0.5 * (near + far)
            near, far = (middle, far) if force(middle * direction)[1] > wanted else (near, middle)
        _, depth, stiffness = force(near * direction)
        slopes = [(force(near * direction + h)[0] - force(near * direction - h)[0]) / (2e-3 * depth)
                  for h in 1e-3 * depth * np.eye(3)]
        found.append(np.linalg.norm(np.transpose(slopes) - slopes) / 2 / stiffness)
    return np.sort(found)


for formulation in "midway", "closest":
    little, more = no_gradient(formulation, 0.02), no_gradient(formulation, 0.1)
    check.true(more[0] < 1e-3, f"{formulation}, faces: {more}")
    check.close(more[-1] / little[-1], 5.0, 1.0, f"{formulation}, edges: in proportion to the overlap")
    check.true(0.05 < more[-1] / 0.1 < 0.4, f"{formulation}, edges: {more[-1]} with a tenth of r")

check.finish()
