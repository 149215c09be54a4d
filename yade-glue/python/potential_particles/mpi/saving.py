# SPDX-License-Identifier: GPL-3.0-or-later
"""One file with the whole scene, as if one process had computed it."""
import os

import yade

from .ranks import mpy, rank, ranks

O = yade.O


def save(path):
    """Brings all bodies and contacts to rank 0 and saves the scene there. Collective.

    The file is an ordinary one: O.load on rank 0, then `divide`, and the run goes on, with any number of ranks. It gets its
    name when it is whole, so that a run that ends while it saves leaves the file that was there before.
    """
    path = os.fspath(path)
    if ranks() > 1 and O.splittedOnce:
        mpy.mergeScene()
        if rank() == 0:
            _save_merged(path)
    elif rank() == 0:
        _save(path)
    mpy.comm.Barrier()


def _save(path):
    folder, file = os.path.split(path)
    # In front: YADE tells the format by the end of the name.
    unfinished = os.path.join(folder, "unfinished." + file)
    O.save(unfinished)
    os.replace(unfinished, path)


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
