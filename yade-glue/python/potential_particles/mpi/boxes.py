# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounding boxes that stay right while bodies turn."""
import yade

from .ranks import mpy


def safe_boxes(verlet_distance):
    """Gives every body that can turn the box of its bounding ball, and the collider `verlet_distance`.

    YADE's collider enlarges boxes by the Verlet distance and runs again when a centre has moved by as much. A body that turns
    moves its corners without its centre, and would leave the box of its corners unseen. It cannot leave the box of a ball about
    its centre. Several processes need a Verlet distance: without one, all of them exchange bodies at every step.

    To be called on rank 0, when bodies and engines are in place.
    """
    if not verlet_distance > 0.0:
        raise ValueError(f"verlet_distance = {verlet_distance}: must be above 0, else the ranks exchange bodies at every step")
    collider = yade.utils.typedEngine("InsertionSortCollider")
    bounds = [functor for functor in collider.boundDispatcher.functors if isinstance(functor, yade.PotentialParticle2AABB)]
    if not bounds:
        raise ValueError("the collider has no PotentialParticle2AABB among its bounds functors")
    enlargement = 1.0
    for body in yade.O.bodies:
        if not isinstance(body.shape, yade.PotentialParticle) or _holds_its_turn(body):
            continue
        # Without a box of its own a shape gets a cube of half width R, which is no bound of the particle by itself.
        body.shape.AabbMinMax = False
        enlargement = max(enlargement, _bounding_radius(body.shape) / body.shape.R)
    # It applies to the boxes of the other bodies, too, which only makes them larger.
    bounds[0].aabbEnlargeFactor = enlargement
    collider.verletDist = verlet_distance


def _holds_its_turn(body):
    return not body.dynamic or set("XYZ") <= set(body.state.blockedDOFs)


def _bounding_radius(shape):
    if hasattr(shape, "boundingRadius"):
        return shape.boundingRadius
    return yade.ConicPotentialParticle(
        a=list(shape.a), b=list(shape.b), c=list(shape.c), d=list(shape.d), r=shape.r, k=shape.k, R=shape.R).boundingRadius
