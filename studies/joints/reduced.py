# SPDX-License-Identifier: GPL-3.0-or-later
"""The factor of safety of a scene two ways: by limit analysis of the scene at rest, and by simulations of it whose
friction is divided by more and more, until it falls.
"""
import math
import os
import time

import numpy as np
import potential_particles
from buildings import GRAVITY, Building, wall
from potential_particles import rock
from scene import O, fresh, run
from yade import Vector3

# Of the factors of limit analysis: where it does not stand or fall at the first, further ones are tried.
BELOW, ABOVE = (0.981, 0.95, 0.9, 0.8, 0.65, 0.5), (1.019, 1.05, 1.1, 1.2, 1.4, 1.7)
DENSITY = 2000.0  # of `fresh`
# That the rock about the tunnel is cut into, about.
BLOCKS = int(os.environ.get("BLOCKS") or 300)


def weaken(factor, before=1.0):
    """Friction of all joints over `factor`, where it was over `before`."""
    for material in O.materials:
        material.frictionAngle = math.atan(math.tan(material.frictionAngle) * before / factor)
    for contact in O.interactions:
        contact.phys.tangensOfFrictionAngle *= before / factor
        contact.phys.tangensOfResidualFrictionAngle *= before / factor


def speed(ids):
    """The largest, m/s, turns by 1 m; members of clumps have that of theirs."""
    states = [O.bodies[one].state for one in ids]
    return max(max(state.vel.norm(), state.angVel.norm()) for state in states)


def stands(ids, factor, rests, falls, patience):
    """Whether all come to rest, from the saved rest at full friction, which is lowered in ten parts; None where
    neither is seen within so many seconds. And how far they moved, m.
    """
    O.loadTmp("rest")
    begin, before = {one: Vector3(O.bodies[one].state.pos) for one in ids}, 1.0
    for part in range(1, 11):
        now = 1.0 + (factor - 1.0) * part / 10
        weaken(now, before)
        before = now
        run(0.01 * patience)
    end, moved = O.time + patience, 0.0
    while O.time < end:
        run(0.02 * patience)
        moved = max((O.bodies[one].state.pos - place).norm() for one, place in begin.items())
        if moved > falls or speed(ids) < rests:
            return moved <= falls, moved
    return None, moved


def factors(ids, rests, falls, patience, clamped=False):
    """The row of a scene at rest: it must stand just below the factor without dilatancy and fall just above it; where
    blocks can be clamped, so that states are not unique, just above the associated one, which nothing bears.
    """
    started = time.perf_counter()
    found = potential_particles.limit_analysis("strength")
    seconds = time.perf_counter() - started
    bound = potential_particles.limit_analysis("strength", dilatant=True).factor
    row = {"blocks": len(ids), "contacts": len(found.contacts), "factor": found.factor, "associated": bound,
           "solves": found.solves, "seconds_of_programs": seconds}
    print(row, flush=True)
    O.saveTmp("rest")
    started, tried = time.perf_counter(), []

    def first(shares, of, wanted):
        for share in shares:
            verdict, moved = stands(ids, share * of, rests, falls, patience)
            tried.append((share * of, verdict, moved))
            print(f"  friction over {share * of:.4f}: stands {verdict}, moved {moved:.2e} m", flush=True)
            if verdict is wanted:
                return share
        return math.inf if wanted is False else 0.0

    upper = bound if clamped else found.factor
    holds, gives = first(BELOW, found.factor, True), first(ABOVE, upper, False)
    return {**row, "value": max(1.0 - holds, gives - 1.0), "target": 0.02, "stands_at": holds * found.factor,
            "falls_at": gives * upper, "tried": tried, "seconds_of_simulation": time.perf_counter() - started}


def reduced_wall():
    """A wall with open head joints under 0.85 of the push along it that it bears."""
    building = wall()
    stones = building.rest(1e11)
    push = 0.85 * building.limit()
    building.pushed(stones, push)
    return {"push_over_weight": push, **factors([one.id for one in stones], 1e-6, 1e-3, 2.0)}


def dome(rings=6, sectors=12, thickness=0.12, radius=2.0, eye=12.0):
    """A hemisphere by meridians and parallels, with an eye, on a fixed ring."""
    heights, turns = np.radians(np.linspace(90, eye, rings + 2)), 2 * np.pi / sectors * np.arange(sectors + 1)
    stones = [[(r * np.sin(t) * np.cos(u), r * np.sin(t) * np.sin(u), r * np.cos(t))
               for r in radius * np.array([1 - thickness / 2, 1 + thickness / 2]) for t in heights[ring:ring + 2]
               for u in turns[sector:sector + 2]] for ring in range(rings + 1) for sector in range(sectors)]
    return Building(stones[sectors:], stones[:sectors], (1, 0, 0))


def reduced_dome():
    """A dome of 72 stones under its own weight."""
    ids = [one.id for one in dome().rest(1e10)]
    return factors(ids, 1e-6, 2e-3, 1.5)


def tunnel(stiffness=2e9, friction=45.0):
    """A tunnel in rock cut by three joint sets, at rest: its mass, which blocks are held as by bolts, as block theory
    has them move, and the ids of those that are free.
    """
    width, depth, height = np.array((24.0, 16.0, 24.0)) * (BLOCKS / 2000) ** (1 / 3)
    domain = rock.Domain.box((0, 0, 0), (width, depth, height))
    start, end = ((width / 2, y, 0.46 * height) for y in (-1, depth + 1))
    drift = rock.Domain.cylinder(start, end, width / 6, sides=10)
    sets = [rock.JointSet(dip, towards, 1.75, fisher=300, seed=seed + 1)
            for seed, (dip, towards) in enumerate(((20, 100), (70, 200), (75, 310)))]
    mass = rock.slice(domain, sets, regions=[drift], least_volume=0.3, least_thickness=0.2)
    inside = mass.inside(0)
    bolted = np.zeros(len(mass), bool)
    bolted[[block for one in rock.key_blocks(mass, free=(), degrees=friction, removed=inside) if one.moves
            for block in one.blocks]] = True
    fresh(damping=0.5, normalStiffness=stiffness, shearStiffness=stiffness / 2,
          frictionAngle=math.radians(friction), restitution=0.3)
    ids = rock.bodies(mass, r=5e-3, fixed=bolted | mass.on_domain(range(6)))
    O.engines[2].avoidSelfInteractionMask = 2
    rock.excavate(ids[inside])
    free = [int(one) for one in ids[~inside] if O.bodies[int(one)].state.blockedDOFs == ""]
    O.dt = 0.1 * math.sqrt(DENSITY * np.cbrt(mass.blocks["volume"].min()) / stiffness)
    for part in range(1, 21):
        O.engines[-1].gravity = Vector3(0, 0, -GRAVITY * part / 20)
        run(0.01)
    run(0.2)
    return mass, bolted, free


def reduced_tunnel():
    """A tunnel in jointed rock."""
    mass, bolted, free = tunnel()
    return {"cut": len(mass), "bolted": int(bolted.sum()), **factors(free, 1e-5, 3e-3, 0.5, clamped=True)}


ROWS = {row.__name__: row for row in (reduced_wall, reduced_dome, reduced_tunnel)}
