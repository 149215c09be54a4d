# SPDX-License-Identifier: GPL-3.0-or-later
"""One warning, at the first step, where potential particles would pass through other bodies in silence.

YADE leaves alone a pair of bodies for whose shapes its contact loop has no functor. That is right for two facets, and
mostly a mistake for a particle and its floor.
"""
import warnings

from yade.wrapper import PotentialParticle

from . import _glue

# Which functor serves potential particles and this shape; others have none.
REMEDIES = {first: name for name, (first, second) in _glue.served_pairs.items() if second == "PotentialParticle" != first}
# Of bodies that stand for a part of the scene, as on several ranks.
_IMMATERIAL = ("Subdomain", "FluidDomainBbox")


class UnservedShapes(UserWarning):
    """The scene has bodies that no functor of its contact loop lets touch the potential particles."""


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
    """Pairs of shapes that may touch and that no dispatcher of geometry serves, with the numbers of their bodies: (pair, remedy)."""
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


def sentence(bodies, dispatchers):
    """What is to be said of these bodies and the dispatchers of geometry, or None."""
    parts = [f"{pair}: {remedy}" for pair, remedy in pairs(bodies, dispatchers)]
    if not parts:
        return None
    return ("bodies pass through each other because the contact loop has no functor for their shapes (number of bodies): "
            + "; ".join(parts))


class Watch:
    """Looks at a scene when it begins, and when its bodies or functors have become others."""

    def __init__(self):
        self.seen = None

    def look(self, scene, dispatchers):
        now = (len(scene.bodies), [type(functor).__name__ for dispatcher in dispatchers for functor in dispatcher.functors])
        if not dispatchers or (scene.iter > 0 and now == self.seen):
            return
        self.seen = now
        text = sentence(scene.bodies, dispatchers)
        if text is not None:
            # Without a place in a source file: the line is about the scene, and stays one line.
            warnings.warn_explicit("potential_particles: " + text, UnservedShapes, "potential_particles", 0)
