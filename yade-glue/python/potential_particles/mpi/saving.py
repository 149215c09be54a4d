# SPDX-License-Identifier: GPL-3.0-or-later
"""One file with the whole scene, as if one process had computed it."""
import os
import time

import yade

from ..saves import save as save_scene
from .ranks import mpy, rank, ranks

O = yade.O

# From these on, saving or loading takes more than some four seconds. YADE reports no progress and lets no other Python
# run meanwhile, so that a line before and one after is all that can be said.
MANY_BODIES, LARGE_FILE = 20_000, 50e6


def save(path):
    """Brings all bodies and contacts to rank 0 and saves the scene there. Collective.

    The file is an ordinary one: O.load on rank 0, then `divide`, and the run goes on, with any number of ranks. It is
    written whole or not at all, as by potential_particles.save; all ranks raise the error where it could not be.
    """
    path, failed = os.fspath(path), None
    merged = ranks() > 1 and O.splittedOnce
    if merged:
        mpy.mergeScene()
    if rank() == 0:
        try:
            (_save_merged if merged else _save)(path)
        except Exception as error:
            failed = error
    # Also the end of the wait of the others.
    failed = mpy.comm.bcast(failed, root=0)
    if failed:
        raise failed


def load(path):
    """O.load(path), with a line before and one after where it takes long. On rank 0, before `divide`."""
    path = os.fspath(path)
    size = os.path.getsize(path)
    begin = time.perf_counter()
    if size >= LARGE_FILE:
        print(f"loading {path}, {1e-6 * size:.0f} MB", flush=True)
    O.load(path)
    if size >= LARGE_FILE:
        print(f"loaded {len(O.bodies):,} bodies in {time.perf_counter() - begin:.0f} s", flush=True)


def _save(path):
    many, begin = len(O.bodies) >= MANY_BODIES, time.perf_counter()
    if many:
        print(f"saving {len(O.bodies):,} bodies to {path}", flush=True)
    save_scene(path)
    if many:
        print(f"saved in {time.perf_counter() - begin:.0f} s, {1e-6 * os.path.getsize(path):.0f} MB", flush=True)


def _save_merged(path):
    """What mpy added to the scene is taken out for the file, and put back for the next steps."""
    dispatcher = yade.utils.typedEngine("InsertionSortCollider").boundDispatcher
    functors = dispatcher.functors
    # An erased body forgets its number.
    domains = {body.id: body for body in O.bodies if body.isSubdomain}
    owners = {body.id: body.subdomain for body in O.bodies if not body.isSubdomain}
    dispatcher.functors = [functor for functor in functors if not isinstance(functor, yade.Bo1_Subdomain_Aabb)]
    for number in domains:
        O.bodies.erase(number)
    # YADE moves only bodies of the rank that it runs on.
    for number in owners:
        O.bodies[number].subdomain = 0
    try:
        _save(path)
    finally:
        for number, owner in owners.items():
            O.bodies[number].subdomain = owner
        for number, body in domains.items():
            O.bodies.insertAtId(body, number)
        dispatcher.functors = functors
