# SPDX-License-Identifier: GPL-3.0-or-later
"""Slopes cut at random, and whether the block that block theory frees moves: for test_key_blocks.py and
benches/rock/key_blocks.py.
"""
import numpy as np
import potential_particles
import yade
from potential_particles import rock

from harness import run

DENSITY, GRAVITY, STIFFNESS, ROUNDING = 2600.0, 9.81, 5e9, 0.02  # kg/m^3, m/s^2, N/m^3, share of the thickness
# Block theory is of rigid and sharp blocks: where the simulation differs, the cut is run again so many times nearer to
# that.
NEARER = (10.0, 100.0)
MOVED, STILL = 1e-3, 1e-4  # m
# A block that moves is given time for a millimetre; in the other, one of 0.01 m/s^2 makes a tenth of it.
SECONDS, STILL_SECONDS, DAMPING = 0.4, 0.15, 0.1
# Nearer to 1, a factor of safety is told neither by the length of a run nor by the time in which an elastic block
# settles.
MARGIN = 0.05
FREE = (rock.Domain.TOP, 6)


def cut(seed):
    """(RockMass, friction angle in degrees, random numbers) of a slope that is 8 m high, with four to seven random
    joints.
    """
    random = np.random.default_rng(seed)
    domain = rock.Domain.box((0, 0, 0), (10, 10, 8)).below((9, 5, 0), random.uniform(45, 80), 90)
    joints = [
        rock.joint((random.uniform(4, 8), random.uniform(3, 7), random.uniform(2, 7)),
                   np.degrees(np.arccos(random.uniform())), random.uniform(0, 360))
        for _ in range(random.integers(4, 8))
    ]
    mass = rock.slice(domain, joints, least_volume=0.1, least_thickness=0.1, progress=False)
    return mass, random.uniform(10, 45), random


def chosen(mass, friction, random):
    """A key block of the cut that can be judged, three times out of four one that moves if there is one; None without
    one.
    """
    outer = mass.on_domain(rock.Domain.SIDES)
    found = [one for one in rock.key_blocks(mass, FREE, degrees=friction, density=DENSITY)
             if one.mode != "inner" and not outer[list(one.blocks)].any() and abs(one.factor - 1.0) > MARGIN]
    moving = [one for one in found if one.moves]
    if moving and random.uniform() < 0.75:
        found = moving
    return found[random.integers(len(found))] if found else None


def limit_analysis(mass, one, friction):
    """(how it compares with block theory, factor) of limit analysis of a block among its neighbours, which are held:
    "same" to 1e-4; "turns" where the factor is lower, since the block may turn over; "clamped" where it is higher, by
    forces that faces which open along the motion keep; "no answer".
    """
    held = np.ones(len(mass), bool)
    held[list(one.blocks)] = False
    try:
        found = rock.limit_analysis(mass, held, degrees=friction, density=DENSITY)
        factor = found.factor if found.stands else 0.0
    except ValueError as error:
        if "infinite" not in str(error):
            raise
        factor = np.inf
    except RuntimeError:
        return "no answer", np.nan
    if factor == one.factor or abs(factor - one.factor) <= 1e-4 * one.factor < np.inf:
        return "same", factor
    return "turns" if factor < one.factor else "clamped", factor


def judged(mass, one, friction):
    """moved() and how near to rigid and sharp blocks: again with stiffer joints and sharper edges where that is not
    what block theory says.
    """
    for nearer in (1.0, *NEARER):
        found = moved(mass, one, friction, nearer=nearer)
        if agrees(one, *found):
            break
    return *found, nearer


def moved(mass, one, friction, turns=False, nearer=1.0):
    """(distance, direction) of the centroid of a block among its neighbours, which are fixed, until it has moved by
    MOVED or time is over.

    turns: whether it may turn, too, which block theory leaves out. nearer: joints are so many times stiffer, and edges
        sharper.
    """
    owners = mass.faces["block"].astype(int)[mass.partners["faces"].astype(int)]
    block = one.blocks[0]
    near = np.unique(owners[(owners == block).any(1)])
    yade.O.reset()
    yade.O.materials.append(
        yade.ConicJointMat(normalStiffness=nearer * STIFFNESS, shearStiffness=nearer * STIFFNESS,
                           frictionAngle=np.radians(friction), density=DENSITY))
    kept = np.zeros(len(mass), bool)
    kept[near] = True
    ids = rock.bodies(mass._with(kept), rounding=ROUNDING / nearer, fixed=near != block)
    state = yade.O.bodies[int(ids[list(near).index(block)])].state
    if not turns:
        state.blockedDOFs = "XYZ"
    yade.O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0, avoidSelfInteractionMask=2),
        yade.ConicInteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom(patch=True)],
                                  [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                                  [yade.Law2_ScGeomConicPP_ConicJointPhys()]),
        yade.NewtonIntegrator(damping=DAMPING, gravity=(0, 0, -GRAVITY), exactAsphericalRot=True)
    ]
    yade.O.dt = potential_particles.critical_time_step(safety=0.9)
    begin = np.array(state.pos)
    seconds = SECONDS if one.moves else STILL_SECONDS
    while yade.O.time < seconds:
        run(500)
        way = np.array(state.pos) - begin
        if np.linalg.norm(way) > MOVED:
            break
    length = np.linalg.norm(way)
    return length, way / (length or 1.0)


def agrees(one, distance, direction):
    """Whether the simulation does what block theory says: it moves by 1 mm in that direction, or stays."""
    if one.moves:
        return distance > MOVED and float(np.dot(direction, one.direction)) > 0.99
    return distance < STILL
