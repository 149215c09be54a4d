# SPDX-License-Identifier: GPL-3.0-or-later
"""What bodies hold by all their joints, on which dashpots depend: a worker knows all joints of its own bodies, and gets
those of bodies across its borders from their workers.
"""
import numpy as np
import yade

from .. import _glue
from .ranks import mpy, rank, ranks

O = yade.O

_TAG = 1964  # of none of mpy's messages


def exchange(step):
    """To be called between two steps, with the number of the next. Collective."""
    if ranks() == 1 or not _has_joints():
        return
    _glue.refresh_joints(step)
    others = [other for other in O.subD.intersections[rank()] if other not in (0, rank())] if rank() else []
    here, there = O.subD.intersections, O.subD.mirrorIntersections
    sent = [mpy.comm.isend(_glue.give_joints(_bytes(here[other])), dest=other, tag=_TAG) for other in others]
    for other in others:
        _glue.take_joints(_bytes(there[other]), mpy.comm.recv(source=other, tag=_TAG))
    for request in sent:
        request.wait()


def _bytes(ids):
    return np.array(ids, np.int32).tobytes()


def _has_joints():
    """The same on all ranks."""
    return any(
        isinstance(functor, yade.Law2_ScGeomConicPP_ConicJointPhys) for engine in O.engines
        if isinstance(engine, yade.wrapper.InteractionLoop) for functor in engine.lawDispatcher.functors)
