# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps on all ranks, and what can go wrong in them."""
import os
import re

import yade

from ..bodies import is_free
from .balance import balance
from .ranks import gather, mpy, rank, ranks, share
from .splitting import split

O = yade.O

_told = set()


def run(steps, reallocate=10):
    """Makes `steps` steps on all ranks; with 0, only divides the scene. Collective.

    reallocate: after so many runs of the collider, bodies at the borders may move to another worker, so that all have
    as many; 0: never.

    The scene of rank 0 is divided at the first call. RuntimeError if a rank stops before its last step; ValueError if a
    worker has no body.
    """
    # YADE takes 0 for a run without end.
    if steps < 0:
        raise ValueError(f"{steps} steps: must be at least 0")
    stop = share(O.iter) + steps
    if ranks() > 1:
        _settings(reallocate)
        if not O.splittedOnce:
            if rank() == 0:
                _check_division()
            split()
            _name_files_by_rank()
        if steps:
            mpy.mpirun(steps)
    elif steps:
        O.run(steps, True)
    if O.iter != stop:
        raise RuntimeError(f"YADE stopped at step {O.iter:,} of {stop:,}; its message stands above")
    _check_workers()


def _settings(reallocate):
    """Of mpy, at every call: a script may have changed them."""
    # Bodies are divided by `divide`.
    mpy.DOMAIN_DECOMPOSITION = False
    # In C++ the exchange aborts for a worker whose box meets no other worker's.
    mpy.USE_CPP_INTERS = False
    balance(reallocate)
    # `save` needs contacts, and shapes keep their colours.
    mpy.MERGE_W_INTERACTIONS = True
    mpy.AUTO_COLOR = False


def _check_division():
    owners = {body.subdomain for body in O.bodies}
    missing = sorted(set(range(1, ranks())) - owners)
    if missing:
        raise ValueError(f"workers {missing} have no bodies: call mpi.divide on rank 0, or start fewer ranks")
    if max(owners) >= ranks():
        raise ValueError(f"a body belongs to worker {max(owners)} of {ranks() - 1}: call mpi.divide on rank 0")
    for body in O.bodies:
        if body.subdomain == 0 and body.dynamic and is_free(body):
            raise ValueError(
                f"body {body.id} is free to move and on rank 0, from which workers get no positions: let mpi.divide give it to one"
            )


def _name_files_by_rank():
    """Gives the files of YADE's recorders a name for each rank, since all would write to the same.

    Bodies at a border are known on both sides of it, and stand in the files of both.
    """
    for engine in O.engines:
        name = getattr(engine, "fileName", "")
        if name:
            folder, file = os.path.split(name)
            engine.fileName = os.path.join(folder, f"rank{rank()}." + re.sub(r"^rank\d+\.", "", file))


def _check_workers():
    """Says once of each worker that it meets no other, and refuses to go on with one that has no bodies left."""
    others = _neighbours()
    counts = gather((len(O.subD.ids) if rank() else None, others))
    if rank() == 0:
        for worker, (count, met) in enumerate(counts):
            if worker == 0:
                continue
            if count == 0:
                raise ValueError(f"worker {worker} has no bodies left: start fewer ranks, or run with reallocate=0")
            if not met and ranks() > 2 and worker not in _told:
                _told.add(worker)
                print(
                    f"worker {worker} meets no other worker: it keeps its {count:,} bodies, however unevenly they are divided",
                    flush=True)


def _neighbours():
    if ranks() == 1 or rank() == 0:
        return []
    return [other for other in O.subD.intersections[rank()] if other != 0]
