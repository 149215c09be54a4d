# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounding boxes that stay right while bodies turn."""
import yade

from .ranks import ranks

O = yade.O


def safe_boxes(verlet_distance):
    """Gives bodies boxes that they cannot leave unseen, wider by `verlet_distance`, be it by moving or by turning.

    YADE's collider enlarges boxes by the Verlet distance and runs again when a centre has moved by as much. A body that
    turns moves its corners without its centre, and would leave the box of its corners unseen; the engine BoundWatch
    sees it. Several
    processes need a Verlet distance: without one, all of them exchange bodies at every step.

    To be called on rank 0, when bodies and engines are in place.
    """
    if not verlet_distance > 0.0:
        raise ValueError(
            f"verlet_distance = {verlet_distance}: must be above 0, else the ranks exchange bodies at every step")
    collider = yade.utils.typedEngine("InsertionSortCollider")
    collider.verletDist = verlet_distance
    dispatcher = collider.boundDispatcher
    theirs = (yade.PotentialParticle2AABB, yade.Bo1_ConicPP_Aabb)
    others = [functor for functor in dispatcher.functors if not isinstance(functor, theirs)]
    dispatcher.functors = others + [yade.Bo1_PP_Aabb_Conic()]
    engines = [engine for engine in O.engines if not isinstance(engine, yade.BoundWatch)]
    # mpy asks at the end of a step whether a collider has to run, and then runs those of all ranks. One process asks
    # before the collider.
    place = engines.index(collider) if ranks() == 1 else len(engines)
    O.engines = engines[:place] + [yade.BoundWatch()] + engines[place:]
