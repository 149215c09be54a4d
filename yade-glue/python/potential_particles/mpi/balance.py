# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that change their worker, so that all workers have as many.

mpy decides pair by pair of workers, after a run of the collider, and both of a pair use the filter below. Its own lets
bodies go that have passed into the midst of the other worker's, and no others: a worker with too many keeps them as
long as the border is a clean one.
"""
import numpy as np
import yade

from .ranks import mpy

O = yade.O

_yades_reallocation = mpy.reallocateBodiesToSubdomains


def balance(frequency):
    """Lets bodies change their worker after so many runs of the collider; 0: never."""
    mpy.REALLOCATE_FREQUENCY = frequency
    mpy.REALLOCATE_FILTER = _nearest
    mpy.reallocateBodiesToSubdomains = _reallocate


def _nearest(here, there, surplus):
    """Bodies that go from this worker to another, which has 2 * surplus bodies less: YADE's choice, and those nearest
    to it.
    """
    leaving = list(mpy.medianFilter(here, there, surplus))
    taken = set(leaving)
    bodies = O.bodies
    staying = [i for i in O.subD.intersections[there]
               if i not in taken and bodies[i].subdomain == here and not bodies[i].isSubdomain]
    # Half of those at the border at most: the next ones come when the border has moved.
    wanted = min(surplus - len(leaving), len(staying) // 2)
    if wanted > 0:
        centres = O.subD._centers_of_mass
        axis = np.array(centres[there] - centres[here])
        reach = np.array([tuple(O.bodies[i].state.pos) for i in staying]) @ axis
        leaving += [staying[index] for index in np.argsort(-reach, kind="stable")[:wanted]]
    return leaving


def _reallocate(choose, blocking=True):
    before = set(O.subD.ids)
    _yades_reallocation(choose, blocking)
    # A body that has changed its worker lacks there the neighbours that the worker did not know. In mpy it stays so,
    # and their contacts with it push on one side only, until the collider happens to run again.
    if mpy.comm.allreduce(int(set(O.subD.ids) != before), op=mpy.MPI.MAX):
        mpy.parallelCollide()
