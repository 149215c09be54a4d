# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that would pass through potential particles in silence.

YADE leaves alone a pair of bodies for whose shapes its contact loop has no functor. That is right for two facets, and
mostly a mistake for a particle and its floor.
"""
from yade.wrapper import PotentialParticle

from . import _glue

# Which functor serves potential particles and this shape; others have none.
REMEDIES = {
    first: name
    for name, (first, second) in _glue.served_pairs.items() if second == "PotentialParticle" != first
}
# Of bodies that stand for a part of the scene, as on several ranks.
_IMMATERIAL = ("Subdomain", "FluidDomainBbox")


class _Group:
    """The bodies with one class of shape."""

    def __init__(self, shape):
        self.shape = shape
        self.name = type(shape).__name__
        self.count = self.mask = 0
        self.moves = False

    def add(self, body):
        self.count += 1
        self.mask |= body.mask
        self.moves = self.moves or body.dynamic


def groups(bodies):
    """Bodies by their class of shape, without those that have none."""
    found = {}
    for body in bodies:
        kind = type(body.shape)
        if body.shape is not None and not body.isClump and kind.__name__ not in _IMMATERIAL:
            if kind not in found:
                found[kind] = _Group(body.shape)
            found[kind].add(body)
    return list(found.values())


def _remedy(other):
    if isinstance(other.shape, PotentialParticle):
        return "add Ig2_PP_PP_ScGeom_Conic()"
    return f"add {REMEDIES[other.name]}()" if other.name in REMEDIES else "there is no functor for them"


def pairs(bodies, dispatchers):
    """Pairs of shapes that may touch and that no dispatcher of geometry serves, with the numbers of their bodies:
    (pair, remedy).
    """
    found, present = [], groups(bodies)
    for i, later in enumerate(present):
        for earlier in present[:i + 1]:
            # The particles first, if only one of the two groups has them.
            one, other = sorted((earlier, later), key=lambda group: not isinstance(group.shape, PotentialParticle))
            may_touch = one.mask & other.mask and (one.moves or other.moves) and (one is not other or one.count > 1)
            if not isinstance(one.shape, PotentialParticle) or not may_touch:
                continue
            if not any(dispatcher.dispFunctor(one.shape, other.shape) for dispatcher in dispatchers):
                found.append((f"{one.name} ({one.count}) and {other.name} ({other.count})", _remedy(other)))
    return found
