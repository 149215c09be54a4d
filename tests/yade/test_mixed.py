# SPDX-License-Identifier: GPL-3.0-or-later
# Scenes of potential particles among every shape of YADE that they can touch: energy, walls from an STL file, saving,
# and no body lost.
import os
import random
import tempfile

import potential_particles
import yade
from mixed import *
from yade import ymport

check = Checks()
folder = tempfile.mkdtemp()

# --- energy --------------------------------------------------------------------------------- A ball and a rounded cube
# bounce on facets, one on a wall, without friction or damping. The force depends on place alone, so what YADE's steps
# do to the energy stays bounded.
mixed_scene(dt=2e-5, gravity=(0, 0, -9.81), young=1e6)
facets(floor(2, 5))
place(yade.Wall(axis=2), Vector3(0, 0, 0))  # in the plane of the floor, for bodies with another mask
O.bodies[len(O.bodies) - 1].mask = 2
for body in O.bodies:
    body.mask = body.mask if body.mask == 2 else 1
bouncing = [
    add(ball(0.2), Vector3(-1, 0.1, 0.7)),
    add(ball(0.2), Vector3(1, 0.1, 0.7)),
    add(ball(0.2), Vector3(0, 0, 0.7))
]
for number, mask in zip(bouncing, (1, 2, 1)):
    O.bodies[number].mask = mask
O.bodies[bouncing[2]].state.vel = Vector3(0.3, 0.2, 0)


def energy(number):
    """Per mass, at the middle of a step, where YADE's velocities are."""
    state = O.bodies[number].state
    height = state.pos[2] - 0.5 * O.dt * state.vel[2]
    return 0.5 * state.vel.squaredNorm() + 9.81 * height


begun, seen, flying = [energy(n) for n in bouncing], set(), [[] for _ in bouncing]
for _ in range(120):
    run(400)
    touched = {i.id1 if i.id1 in bouncing else i.id2 for i in touching()}
    seen |= touched
    for n, values in zip(bouncing, flying):
        if n not in touched:
            values.append(energy(n))
check.equal(seen, set(bouncing), "all of them bounce")
for text, values, first in zip(("on a facet", "on a wall", "over seams"), flying, begun):
    worst = max(abs(value / first - 1) for value in values)
    check.true(worst < 1e-4, f"energy of a ball {text} changes by {worst:.2g}")
check.close(O.bodies[bouncing[0]].state.pos[2], O.bodies[bouncing[1]].state.pos[2], 1e-9,
            "a facet is as hard as a wall")
check.close(O.bodies[bouncing[2]].state.vel - Vector3(0.3, 0.2, O.bodies[bouncing[2]].state.vel[2]), Vector3.Zero, 1e-9,
            "nothing pushes along the floor")

# --- a box from an STL file -----------------------------------------------------------------
def write_stl(name, triangles):
    with open(name, "w") as file:
        file.write("solid box\n")
        for three in triangles:
            file.write("facet normal 0 0 0\nouter loop\n")
            file.writelines("vertex %.9g %.9g %.9g\n" % tuple(vertex) for vertex in three)
            file.write("endloop\nendfacet\n")
        file.write("endsolid box\n")


def open_box(size, height):
    """A floor and four sides, a few facets each."""
    sides = [((-1, -1), (1, -1)), ((1, -1), (1, 1)), ((1, 1), (-1, 1)), ((-1, 1), (-1, -1))]
    triangles = floor(size, 3)
    for (a, b), (c, d) in sides:
        low, high = [(size * a, size * b, 0), (size * c, size * d, 0)], [(size * a, size * b, height),
                                                                         (size * c, size * d, height)]
        middle = tuple(0.5 * (p + q) for p, q in zip(low[0], high[1]))
        corners = [low[0], low[1], high[1], high[0]]
        triangles += [(corners[i], corners[(i + 1) % 4], middle) for i in range(4)]
    return triangles


stl = os.path.join(folder, "box.stl")
write_stl(stl, open_box(1.0, 3.0))


def heap(loop=None, verlet=0.0):
    """Rocks, balls and plain particles fall into the box, among spheres and a block, against walls behind the box's
    own.
    """
    draw = random.Random(3)
    functors = contacts() + [
        yade.Ig2_Sphere_Sphere_ScGeom(),
        yade.Ig2_Facet_Sphere_ScGeom(),
        yade.Ig2_Wall_Sphere_ScGeom(),
        yade.Ig2_Box_Sphere_ScGeom()
    ]
    mixed_scene(functors, loop=loop, dt=2e-4, gravity=(0, 0, -9.81), friction=0.4, damping=0.3, young=1e6,
                verlet=verlet)
    O.bodies.append(ymport.stl(stl, material=-1))
    place(yade.Box(extents=Vector3(0.3, 0.2, 0.15)), Vector3(0.4, 0.3, 0.15), turned((0, 0, 1), 0.5))
    place(yade.Wall(axis=0, sense=1), Vector3(-0.9, 0, 0))
    place(yade.Wall(axis=1, sense=-1), Vector3(0, 0.95, 0))
    moving = []
    for i in range(36):
        at = Vector3(0.55 * (i % 3) - 0.5, 0.55 * (i // 3 % 3) - 0.55, 0.65 + 0.5 * (i // 9))
        turn = turned([draw.random() for _ in range(3)], draw.uniform(0, 3))
        if i % 4 == 0:
            moving.append(place(yade.Sphere(radius=0.18), at, turn, fixed=False, mass=40.0))
            O.bodies[moving[-1]].state.inertia = Vector3(1, 1, 1) * 0.4 * 40 * 0.18**2
        elif i % 4 == 1:
            moving.append(add(cube(0.03, 0.05, 0.35, 0.17), at, turn))
        elif i % 4 == 2:
            shape = pyramid(0.03, 0.05, 0.32, 0.22)
            planes = pyramid_planes(0.22, 0.03)
            moving.append(
                add(plain(planes, r=0.03, k=0.05, R=0.32), at, turn, volume=shape.volume,
                    inertia=shape.inertia.diagonal()))
        else:
            moving.append(add(ball(0.18), at, turn))
    potential_particles.prepare()
    return moving


def ours():
    return O.engines[2].geomDispatcher.functors[:len(contacts())]


def one_thread():
    for engine in O.engines:
        engine.ompThreads = 1
    if type(O.engines[2]) is yade.InteractionLoop:
        O.engines[2].loopOnSortedInteractions = True  # in the order in which ours adds up forces


for loop in yade.InteractionLoop, yade.ConicInteractionLoop:
    moving = heap(loop)
    run(4000)
    name = loop.__name__
    kinds = {tuple(sorted(type(O.bodies[n].shape).__name__ for n in (i.id1, i.id2))) for i in touching()}
    for other in "Sphere", "Facet":
        check.true(any(other in pair and "ConicPotentialParticle" in pair for pair in kinds),
                   f"{name}: contacts with {other}: {kinds}")
    outside = [
        n for n in moving
        if not all(-1 < O.bodies[n].state.pos[i] < 1 for i in (0, 1)) or not 0 < O.bodies[n].state.pos[2] < 3
    ]
    check.equal(outside, [], f"{name}: no body is lost")
    check.true(min(O.bodies[n].state.pos[0] for n in moving) > -0.9 + 0.1, f"{name}: the walls hold")
    check.equal(failures(), 0, f"{name}: no failure")
    # The block's own contacts: something lies on it or leans on it in the course of the run.
    present = {type(body.shape).__name__ for body in O.bodies}
    served = [f.overlapping for f in ours() if f.bases[0] in present]
    check.true(
        len(served) >= 5 and all(number > 0 for number in served), f"{name}: every functor has had contacts: {served}")

# --- both loops, step by step, and a scene that was saved in between ------------------------
ended = []
for loop in yade.InteractionLoop, yade.ConicInteractionLoop:
    heap(loop)
    one_thread()
    for f in ours():
        f.carryTolerance = 0
    run(1500)
    ended.append(state_numbers())
check.true(ended[0] == ended[1], "both loops give the same numbers")

for ending in ".yade.gz", ".xml.bz2":
    heap()
    one_thread()
    run(2500)
    file = os.path.join(folder, "scene" + ending)
    O.save(file)
    before = {(i.id1, i.id2): (i.geom.penetrationDepth, tuple(i.geom.normal)) for i in touching()}
    O.load(file)
    # (The overlap is not in the file: YADE computes that anew in each step.)
    loaded = {(i.id1, i.id2): tuple(i.geom.normal) for i in O.interactions if i.isReal}
    check.true(all(loaded.get(pair) == normal for pair, (_, normal) in before.items()),
               f"contacts after loading {ending}")
    kinds = [type(f).__name__ for f in ours()]
    check.equal(kinds, [type(f).__name__ for f in contacts()], "functors after loading")
    potential_particles.prepare()
    run(1)
    depths = {(i.id1, i.id2): i.geom.penetrationDepth for i in touching()}
    kept = [pair for pair in before if pair in depths]
    check.true(len(kept) >= 0.9 * len(before) and len(before) > 10, f"{len(kept)} of {len(before)} contacts go on")
    worst = max(abs(depths[pair] - before[pair][0]) for pair in kept)
    check.true(worst < 2e-3, f"their overlaps go on: {worst:.2g}")
    run(500)
    check.equal(failures(), 0, "no failure after loading")

check.finish()
