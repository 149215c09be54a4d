# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies, contacts, counters and failures of all workers.

A worker knows, beside its own bodies, those of others that come near: both sides of a border compute its contacts. What
is summed over workers must therefore count a body, or a contact, on one of them only.
"""
import numpy as np
import yade

from .ranks import gather, rank

O = yade.O

_COUNTS = ("calls", "overlapping", "solved", "rejected", "extended", "failures", "seconds")


def owned_bodies():
    """The bodies that this rank moves; on rank 0 those that were not divided."""
    here = rank()
    return [body for body in O.bodies if body.subdomain == here and not body.isSubdomain]


def owned_contacts():
    """The real interactions that this rank has to count: each belongs to one rank, that of its body of higher rank."""
    here = rank()
    bodies = O.bodies
    return [
        contact
        for contact in O.interactions
        if contact.isReal and max(bodies[contact.id1].subdomain, bodies[contact.id2].subdomain) == here
    ]


def states(ids):
    """Of the bodies `ids`, on rank 0, a dictionary of arrays, a row a body: position and velocity of the centre,
    orientation (w, x, y, z), angular velocity, and the rank that moves the body. None elsewhere. Collective.

    ids: on rank 0; KeyError if a body is on no rank.
    """
    rows = [(body.id, *body.state.pos, *body.state.vel, *_wxyz(body.state.ori), *body.state.angVel)
            for body in owned_bodies()]
    gathered = gather(np.array(rows, float).reshape(-1, 14))
    if gathered is None:
        return None
    ranks = np.concatenate([np.full(len(part), number) for number, part in enumerate(gathered)])
    table = np.vstack(gathered)
    place = {int(number): row for row, number in enumerate(table[:, 0])}
    order = [place[i] for i in ids]
    table = table[order]
    return {
        "position": table[:, 1:4],
        "velocity": table[:, 4:7],
        "orientation": table[:, 7:11],
        "angular_velocity": table[:, 11:14],
        "rank": ranks[order],
    }


def counters():
    """What the contact functors of all ranks counted, summed, on rank 0; None elsewhere. Collective.

    A pair across a border is asked on both sides, and counted twice.
    """
    functors = _functors()
    mine = {name: sum(getattr(functor, name) for functor in functors) for name in _COUNTS}
    mine["answers"] = {name: sum(functor.answers[name] for functor in functors) for name in functors[0].answers}
    gathered = gather(mine)
    if gathered is None:
        return None
    total = {name: sum(counts[name] for counts in gathered) for name in _COUNTS}
    total["answers"] = {name: sum(counts["answers"][name] for counts in gathered) for name in mine["answers"]}
    return total


def failures():
    """The failure reports of all ranks on rank 0, each with the rank that wrote it; None elsewhere. Collective."""
    gathered = gather([{**report, "rank": rank()} for functor in _functors() for report in functor.failureReport])
    return None if gathered is None else [report for reports in gathered for report in reports]


def _functors():
    """The contact functors of this rank, those of walls, facets and spheres among them: each rank has its own once the
    scene is divided.
    """
    # By kind, since a ConicInteractionLoop is one.
    loops = [engine for engine in O.engines if isinstance(engine, yade.wrapper.InteractionLoop)]
    found = [functor for loop in loops for functor in loop.geomDispatcher.functors if hasattr(functor, "failureReport")]
    if not found:
        raise ValueError("the InteractionLoop has no contact functor of potential_particles")
    return found


def _wxyz(orientation):
    return orientation[3], orientation[0], orientation[1], orientation[2]
