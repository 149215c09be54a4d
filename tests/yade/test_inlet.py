# SPDX-License-Identifier: GPL-3.0-or-later
# Inlets: rate, no overlap at birth, until full, resumed after O.load with the same bodies; packings among what is
# there.
import math
import os
import tempfile

import potential_particles
import yade
from mixed import *
from potential_particles import Inlet, add_packing, boundaries, pack, packing, shapes
from potential_particles.packing import obstacles_of

check = Checks()
rocks = [shapes.random_rock(seed, elongation=0.8, flatness=0.75) for seed in range(4)]
SIZE, G = 0.1, 9.81
MASK = 3  # of facets: the collider leaves out their pairs


def scene(inlet):
    """A hopper of facets with a closed outlet, fed by an inlet that is made by a function."""
    mixed_scene(dt=1e-4, gravity=(0, 0, -G), young=2e6, friction=0.4, damping=0.2, verlet=0.005,
                loop=yade.ConicInteractionLoop)
    O.engines[1].avoidSelfInteractionMask = 2
    walls = boundaries.funnel(0.1, 0.5, 0.4, material=0, sides=12, mask=MASK)
    O.bodies.append(walls + boundaries.plate((-0.2, -0.2, 0), (0.4, 0, 0), (0, 0.4, 0), 0, mask=MASK))
    made = inlet()
    O.engines = O.engines[:1] + [made.engine, yade.BoundWatch()] + O.engines[1:]
    overlaps.clear()
    return made


def born():
    return [b for b in O.bodies if isinstance(b.shape, yade.ConicPotentialParticle)]


# Overlap at birth with all that is there, over the size; found where bodies are born, before anything moves.
overlaps = []
original = Inlet.look


def looked(self):
    new = original(self)
    everything = [(b.id, one) for b in O.bodies for one in obstacles_of([b])]
    for number, (particle, pose) in [entry for entry in everything if entry[0] in new]:
        for other, thing in everything:
            if other == number:
                continue
            contact = (potential_particles.contact_with_triangle(particle, pose, thing)
                       if isinstance(thing, potential_particles.Triangle)
                       else potential_particles.detect(particle, pose, *thing))
            overlaps.append(contact.overlap / SIZE if contact.overlapping else 0.0)
    return new


Inlet.look = looked

# --- rate, grading and no overlap ------------------------------------------------------------------------------
column = packing.Cylinder((0, 0, 0.4), 0.4, 0.3)
made = scene(lambda: Inlet(column, rocks, sizes=[(0.06, 0.5), (0.1, 0.5)], rate=400.0, number=90, seed=3,
                           velocity=(0, 0, -1.0), period=0.02, color=(1, 0, 0)))
run(1000)
check.true(made.born > 30 and len(overlaps) > 1000 and max(overlaps) == 0, "no overlap at birth")
expected = math.floor(400 * O.time) + 1
check.true(abs(made.born - expected) <= 400 * 0.02 + 1, f"{made.born} bodies after {O.time:g} s, {expected} by rate")
while not made.finished:
    run(100)
check.equal((made.born, len(born()), made.finished), (90, 90, "number: 90 bodies"), "its end")
check.close(O.bodies[born()[-1].id].timeBorn, 89 / 400, 0.021, "the last one's time")
check.close(made.born_mass, sum(b.state.mass for b in born()), 1e-12, "their mass")
sizes = sorted((6 / math.pi * b.state.mass / 2000.0) ** (1 / 3) for b in born())
check.true(abs(sum(one < 0.08 for one in sizes) - 45) <= 1, "half of them small")
check.equal(born()[0].shape.color, Vector3(1, 0, 0), "further keywords are those of bodies")

# --- mass per second, and an end by mass and by time -------------------------------------------------------------
one = rocks[0].volume * (SIZE / rocks[0].equivalent_diameter) ** 3 * 2000.0
made = scene(lambda: Inlet(column, rocks[0], sizes=SIZE, mass_rate=100 * one, mass=12.2 * one, period=0.01,
                           velocity=(0, 0, -2)))
while not made.finished:
    run(100)
check.equal(made.born, 12, "twelve bodies come nearest to this mass")
check.true(0.105 <= O.time <= 0.14, f"in their time: {O.time:g}")
made = scene(lambda: Inlet(column, rocks[0], sizes=SIZE, rate=100.0, time=0.055, period=0.01, velocity=(0, 0, -2)))
while not made.finished:
    run(100)
check.equal((made.born, made.finished[:5]), (6, "time:"), "an end by time")

# --- until full: nothing more fits, and all lies where it belongs ---------------------------------------------
made = scene(lambda: Inlet(packing.Cylinder((0, 0, 0.25), 0.25, 0.15), rocks, sizes=0.12, seed=5, period=0.05,
                           trials=500))
while not made.finished and O.iter < 40000:
    run(200)
check.true(made.finished.startswith("full: no place for 0.2 s"), made.finished)
check.equal(max(overlaps), 0, "no overlap at birth among those that lie there")
check.true(made.born > 15, f"{made.born} bodies")
check.true(all(z > 0 and math.hypot(x, y) < 0.1 + z for x, y, z in (tuple(b.state.pos) for b in born())),
           "all are in the hopper")


# --- a run that is saved in the midst goes on with the same bodies ---------------------------------------------
def inlet_of(region):
    return lambda: Inlet(region, rocks, sizes=[(0.05, 0.0), (0.1, 1.0)], shares="passing", rate=500.0, number=60,
                         seed=9, velocity=(0, 0, -1.0), period=0.02)


def go_on():
    run(700)
    return state_numbers(), [b.state.mass for b in born()]


prism = packing.Prism([(-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (0, 0.1), (-0.3, 0.3)], 0.4, 0.7)
ball_of = packing.Region((-0.3, -0.3, 0.4), (0.3, 0.3, 0.9), lambda x, y, z: x * x + y * y + (z - 0.65)**2 < 0.0625)
for region in (column, prism, ball_of):
    made = scene(inlet_of(region))
    run(400)
    saved = os.path.join(tempfile.mkdtemp(), "inlet.yade.gz")
    before = made.born
    check.true(0 < before < 60, f"saved in the midst: {before}")
    O.save(saved)
    expected = go_on()
    check.true(made.born > before, "bodies have come since")
    O.reset()
    # As in another process, which knows nothing of it.
    potential_particles.inlets._known.clear()
    O.load(saved)
    potential_particles.prepare()
    if region is ball_of:
        check.raises(ValueError, Inlet.of, "a region by a function", "make the Inlet again")
        inlet_of(region)()
    check.equal(Inlet.of().born, before, "its count is loaded")
    found = go_on()
    check.equal(found[1], expected[1], "the same bodies")
    check.equal(len(found[0]), len(expected[0]), "as many")
    check.true(max(abs(x - y) for x, y in zip(found[0], expected[0])) <= (0 if O.numThreads == 1 else 1e-6),
               "and in the same places")

# --- a packing among bodies, walls and meshes --------------------------------------------------------------------
mixed_scene(young=1e6)
O.bodies.append(utils.sphere((1, 1, 1), 0.4, material=0))
add(sharp_cube(0.3, 0.01), Vector3(2.2, 1.0, 1.0), turned((1, 2, 3), 0.5), fixed=True)
place(yade.Box(extents=Vector3(0.2, 0.3, 0.4)), Vector3(1.2, 2.4, 1.2), turned((1, 0, 1), 0.4))
place(yade.Cylinder(radius=0.15, length=0.8, segment=Vector3(0, 0, 0.8)), Vector3(2.4, 2.4, 0.5))
place(yade.Wall(axis=0, sense=1), Vector3(0.4, 0, 0))
facets([[(0, 0, 0.4), (3, 0, 0.4), (1.5, 3, 2.4)]])
run(1)
before = len(touching())  # of the facet and what it passes through
space = packing.Box((0, 0, 0), (3, 3, 2.5))
for how in dict(dense=True, number=60), dict(trials=500):
    placed = pack(space, rocks, sizes=0.3, seed=2, obstacles=O.bodies, progress=False, **how)
    check.true(len(placed) >= 60, f"{len(placed)} find a place")
    ids = add_packing(placed, 0)
    run(1)
    check.equal((len(touching()), failures()), (before, 0), f"no overlaps with anything: {how}")
    check.true(min(b.state.pos[0] for b in O.bodies if b.id in set(ids)) > 0.4, "before the wall")
    for i in ids:
        O.bodies.erase(i)
blind = pack(space, rocks, sizes=0.3, number=40, seed=2, progress=False)
check.raises(ValueError, lambda: add_packing(blind, 0), "bodies onto what is there", "obstacles=O.bodies")
again = pack(space, rocks, sizes=0.3, number=40, seed=2, progress=False, obstacles=[*placed, *O.bodies])
check.true(len(again) < 40, f"beside what is packed only {len(again)} more")

# --- refusals -----------------------------------------------------------------------------------------------------
for keywords, says in [(dict(rate=1.0, mass_rate=1.0), "give one of them"), (dict(rate=-1), "rate=-1"),
                       (dict(number=0), "number=0"), (dict(mass=0), "mass=0"), (dict(period=0), "period=0"),
                       (dict(trials=0), "trials=0"), (dict(velocity=(0, 0)), "velocity"),
                       (dict(material="none"), "material='none'"), (dict(shares="weight"), "shares='weight'")]:
    check.raises(ValueError, lambda: Inlet(column, rocks, name="refused", **keywords), f"{keywords}", says)
check.equal([tag for tag in O.tags.keys() if "refused" in tag], [], "and nothing of them stays")
check.finish()
