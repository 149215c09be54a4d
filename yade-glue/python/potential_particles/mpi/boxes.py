# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounding boxes that stay right while bodies turn."""
import yade

from .ranks import ranks

O = yade.O


def safe_boxes(verlet_distance):
    """Gives bodies boxes that they cannot leave unseen, wider by `verlet_distance`, be it by moving or by turning.

    YADE's collider enlarges boxes by the Verlet distance and runs again when a centre has moved by as much. A body that turns
    moves its corners without its centre, and would leave the box of its corners unseen. Where the plugin has BoundWatch, that
    engine sees it; else each body that can turn gets the box of its bounding ball, which it cannot leave by turning. Several
    processes need a Verlet distance: without one, all of them exchange bodies at every step.

    To be called on rank 0, when bodies and engines are in place.
    """
    if not verlet_distance > 0.0:
        raise ValueError(f"verlet_distance = {verlet_distance}: must be above 0, else the ranks exchange bodies at every step")
    collider = yade.utils.typedEngine("InsertionSortCollider")
    collider.verletDist = verlet_distance
    if hasattr(yade, "BoundWatch"):
        _watch(collider)
    else:
        _balls(collider)


def _watch(collider):
    """The box of the body as it is turned, and an engine that compares the two."""
    dispatcher = collider.boundDispatcher
    theirs = (yade.PotentialParticle2AABB, yade.Bo1_ConicPP_Aabb)
    others = [functor for functor in dispatcher.functors if not isinstance(functor, theirs)]
    dispatcher.functors = others + [yade.Bo1_PP_Aabb_Conic()]
    engines = [engine for engine in O.engines if not isinstance(engine, yade.BoundWatch)]
    # mpy asks at the end of a step whether a collider has to run, and then runs those of all ranks. One process asks before
    # the collider.
    place = engines.index(collider) if ranks() == 1 else len(engines)
    O.engines = engines[:place] + [yade.BoundWatch()] + engines[place:]


def _balls(collider):
    bounds = [functor for functor in collider.boundDispatcher.functors if isinstance(functor, yade.PotentialParticle2AABB)]
    if not bounds:
        raise ValueError("the collider has no PotentialParticle2AABB among its bounds functors")
    enlargement = 1.0
    for body in O.bodies:
        if not isinstance(body.shape, yade.PotentialParticle) or _holds_its_turn(body):
            continue
        # Without a box of its own a shape gets a cube of half width R, which is no bound of the particle by itself.
        body.shape.AabbMinMax = False
        enlargement = max(enlargement, _bounding_radius(body.shape) / body.shape.R)
    # It applies to the boxes of the other bodies, too, which only makes them larger.
    bounds[0].aabbEnlargeFactor = enlargement


def _holds_its_turn(body):
    return not body.dynamic or set("XYZ") <= set(body.state.blockedDOFs)


def _bounding_radius(shape):
    if hasattr(shape, "boundingRadius"):
        return shape.boundingRadius
    return yade.ConicPotentialParticle(
        a=list(shape.a), b=list(shape.b), c=list(shape.c), d=list(shape.d), r=shape.r, k=shape.k, R=shape.R).boundingRadius
