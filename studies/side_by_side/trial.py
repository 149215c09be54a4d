# SPDX-License-Identifier: MIT OR Apache-2.0
"""One case, one functor: stepping it, looking now and then, and keeping what both are judged by."""

import time
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from yade import O

from cases import GRAVITY
from contact_functor import ContactFunctor
from stepping import advance
from touching import Moment, touching_now
from watch import Watch, unbalanced_force

LOOKS = 150  # along a full run
MOMENTS = 12  # at which touching pairs are compared with the cone programs


class Look(NamedTuple):
    """SI units."""

    step: int
    height: float  # mean z of the free bodies
    kinetic: float
    energy: float  # kinetic, of gravity, elastic
    unbalanced: float
    overlap: float
    contacts: int
    pairs: int  # whose boxes meet
    imbalance: float  # |sum| of all contact forces over the sum of their sizes
    loop_seconds: float  # since the start: contacts, springs
    all_seconds: float  # since the start: all engines
    calls: int  # of the functor, where it counts them
    functor_seconds: float  # likewise


class Record(list):
    """Looks; each of their fields is a column."""

    def __getattr__(self, name):
        if name not in Look._fields:
            raise AttributeError(name)
        return [getattr(one, name) for one in self]

    def until(self, step):
        """The same record, as if the run had ended at `step`."""
        return Record(one for one in self if one.step <= step)


@dataclass
class Trial:
    """What a run left."""

    name: str  # of the functor
    ids: list
    steps: int
    record: Record
    moments: list  # of Moment
    failures: int
    wall_seconds: float


def run_trial(case, area, kind, steps, most_seconds, progress=None):
    """Runs `steps` steps, or as many as fit into `most_seconds`; the last look is always at the end.

    progress: is told the part that is done, by steps or by seconds, whichever is nearer to its end.
    """
    contact = ContactFunctor(kind, area=area)
    ids = case.start(contact, area)
    watch = Watch(ids, GRAVITY)
    record, moments = Record(), []
    stride = max(case.steps(area) // LOOKS, 1)
    between = max(LOOKS // MOMENTS, 1)
    began = time.monotonic()
    looks = 0
    # In the first step of a contact there are no springs yet: energies count from here.
    advance(2)
    record.append(look(watch, contact))
    while O.iter < steps and time.monotonic() - began < most_seconds:
        advance(min(O.iter + stride - 1, steps - 1))
        looks += 1
        # Geometry is that of the poses before a step, so the last step of a stride is taken alone.
        before = Moment.of_scene() if looks % between == 0 else None
        advance(O.iter + 1)
        if before:
            before.touching = touching_now()
            moments.append(before)
        record.append(look(watch, contact))
        if progress:
            progress(min(1.0, max(O.iter / steps, (time.monotonic() - began) / most_seconds)))
    failures = contact.counts()["failures"]
    return Trial(contact.name, ids, O.iter, record, moments, failures, time.monotonic() - began)


def look(watch, contact):
    """The scene as it is."""
    sample, counts = watch.look(), contact.counts()
    forces = np.array([tuple(O.forces.f(body.id)) for body in O.bodies])
    size = np.linalg.norm(forces, axis=1).sum()
    return Look(
        step=O.iter, height=float(np.mean([state.pos[2] for state in watch.states])), kinetic=sample.kinetic,
        energy=sample.energy, unbalanced=unbalanced_force() if sample.contacts else None, overlap=sample.overlap,
        contacts=sample.contacts, pairs=sample.candidates,
        imbalance=float(np.linalg.norm(forces.sum(0)) / size) if size else 0.0,
        loop_seconds=next(engine for engine in O.engines if engine.label == "contacts").execTime / 1e9,
        all_seconds=sum(engine.execTime for engine in O.engines) / 1e9, calls=counts["calls"],
        functor_seconds=counts["seconds"])
