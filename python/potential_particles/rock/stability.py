# SPDX-License-Identifier: MIT OR Apache-2.0
"""Limit analysis of a rock mass as it was cut, without a simulation: does it stand, how much more could it bear, how
much weaker could its joints be? With turns and with all blocks at once, which block theory leaves out.
"""
import numpy as np

from ..arguments import positive, vector
from ..limit_state import Body, asked, clipped, scene_of, solved
from .block_theory import by_set, friction_of
from .loads import loads_of
from .mass import LEAST_SHARE, marked


def limit_analysis(mass, held, question="strength", friction=None, cohesion=0.0, tension=0.0, density=2600.0,
                   gravity=(0.0, 0.0, -9.81), removed=(), loads=None, push=None, dilatant=False, degrees=None):
    """Whether the blocks of a RockMass come to rest on their faces, loaded from nothing: an Equilibrium, whose bodies are
    the pieces of the mass, named by their first block.

    held: blocks that are held, numbers or bool (blocks,), as mass.on_domain(Domain.SIDES). removed: blocks that are
    taken out. question: "stands"; "load", the largest multiple of the push that can be borne; "strength", the factor of
    safety on tan phi, cohesion and tension. friction or degrees, density, gravity: as of key_blocks(). cohesion,
    tension: strength of joints, force per area, numbers or dicts by entries of the `joints` of slice(). loads: (blocks,
    6), force and torque of each block about its centroid. push: (3,), a load of each block's weight in this direction,
    in shares of gravity; of "stands" and "strength" it is there once. dilatant: joints open as they slip
    (docs/equilibrium.md).
    """
    asked(question)
    bodies, names, rows, pairs = _parts(mass, held, friction_of(friction, degrees), cohesion, tension, density, gravity,
                                        removed, loads, push)
    return solved(question, dilatant, bodies, names, rows, pairs)


def limit_scene(mass, held, friction=None, cohesion=0.0, tension=0.0, density=2600.0, gravity=(0.0, 0.0, -9.81),
                removed=(), loads=None, push=None, degrees=None):
    """The same blocks and joints as an equilibrium.Scene, for what limit_analysis() does not ask: stress in situ, bolts,
    other live loads. Its bodies are the pieces of the mass, in their order; the push is live there, so that
    stands(live=1) and strength_factor(live=1) have it once.
    """
    bodies, _, rows, _ = _parts(mass, held, friction_of(friction, degrees), cohesion, tension, density, gravity, removed,
                                loads, push)
    return scene_of(bodies, rows)


def _parts(mass, held, friction, cohesion, tension, density, gravity, removed, loads, push):
    """Bodies, their names, contacts as rows of scene_of(), and the names of their bodies."""
    cohesion, tension = by_set(cohesion, "cohesion"), by_set(tension, "tension")
    weight = positive(density, "density") * vector(gravity, "gravity")
    direction = vector((0, 0, 0) if push is None else push, "push")
    held, gone = marked(held, len(mass), "held"), marked(removed, len(mass), "removed")
    pushed = np.zeros((len(mass), 6)) if loads is None else loads_of(loads, len(mass))
    numbers, place = _pieces(mass, gone)
    bodies = [_body(mass, blocks, held, weight, direction, pushed) for blocks in numbers]
    rows, pairs = [], []
    for (first, second), area in mass.partners:
        faces = int(first), int(second)
        of = tuple(place[int(mass.faces["block"][face])] for face in faces)
        apart = -1 not in of and of[0] != of[1] and not (bodies[of[0]].held and bodies[of[1]].held)
        if apart and area > LEAST_SHARE * mass.faces["area"][faces[0]]:
            entry = mass.set_of_face[faces[0]]
            strength = friction(entry), cohesion(entry), tension(entry)
            rows.append((of, mass.faces["plane"][faces[0], :3], strength, _shared(mass, faces), float(area),
                         (1.0, 1.0)))
            pairs.append(tuple(numbers[one][0] for one in of))
    if not rows:
        raise ValueError("no free block of the mass touches another one: hold fewer blocks")
    return bodies, [blocks[0] for blocks in numbers], rows, pairs


def _pieces(mass, gone):
    """Blocks of each piece that is there, and for each block the number of its piece, -1 without one."""
    place, numbers = np.full(len(mass), -1), []
    for blocks in mass.blocks_of_pieces:
        blocks = blocks[~gone[blocks]]
        if len(blocks):
            place[blocks] = len(numbers)
            numbers.append([int(one) for one in blocks])
    return numbers, place


def _body(mass, blocks, held, weight, direction, pushed):
    volumes, centroids = mass.blocks["volume"][blocks], mass.blocks["centroid"][blocks]
    centre = volumes @ centroids / volumes.sum()
    made = Body(held=bool(held[blocks].any()))
    made.centre[:] = centre
    if not made.held:
        dead = weight * volumes.sum()
        made.dead_force[:] = dead + pushed[blocks, :3].sum(0)
        made.dead_torque[:] = (pushed[blocks, 3:] + np.cross(centroids - centre, pushed[blocks, :3])).sum(0)
        made.live_force[:] = np.linalg.norm(dead) * direction
    return made


def _shared(mass, faces):
    """The polygon that two faces have in common: the plane of the first, within the edges of both."""
    normal = mass.faces["plane"][faces[0], :3]
    bounds = []
    for face in faces:
        corners = mass.outline(face)
        along = np.roll(corners, -1, axis=0) - corners
        outwards = np.cross(along, mass.faces["plane"][face, :3])
        lengths = np.linalg.norm(outwards, axis=1)
        rows = zip(outwards, lengths, corners)
        bounds += [(out / length, out @ at / length) for out, length, at in rows if length > 0]
    corners = mass.outline(faces[0])
    middle = corners.mean(axis=0)
    reach = 2.0 * np.linalg.norm(corners - middle, axis=1).max()
    polygon = clipped(normal, middle, bounds, reach)
    return polygon if len(polygon) else middle[None]
