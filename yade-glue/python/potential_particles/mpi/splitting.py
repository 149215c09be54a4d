# SPDX-License-Identifier: GPL-3.0-or-later
"""The first division of a scene, which may have contacts already.

Each worker starts from the whole scene, erases the bodies of others, and receives those near its own again. mpy loses
the contacts between bodies of different ranks in doing so, and with them their shear forces: a loaded scene would
continue differently.
"""
import yade

from .joints import exchange
from .ranks import mpy, share

O = yade.O

_yades_check = mpy.checkAndCollide


def split():
    """Divides the scene of rank 0 between all ranks. Collective."""
    if O.engines:
        _label_collider()
    contacts = share(_contacts_across())
    mpy.splitScene()
    for first, second, geometry, physics in contacts:
        if _here(first) and _here(second):
            _make(first, second, geometry, physics)
    _at_the_end_of_steps()
    exchange(O.iter)


def _at_the_end_of_steps():
    """Boxes are those of balls until BoundWatch has run once, and would stay so until a body leaves one."""
    first = True

    def check():
        nonlocal first
        again = mpy.parallelCollide() if first else _yades_check()
        first = False
        exchange(O.iter + 1)
        return again

    mpy.checkAndCollide = check


def _label_collider():
    """mpy finds the collider by this label alone; without it, it would run one that is in no engine list, and miss
    contacts.
    """
    yade.utils.typedEngine("InsertionSortCollider").label = "collider"
    # Labels become names where engines are set.
    O.engines = O.engines


def _contacts_across():
    """Contacts between bodies of different ranks, in the scene as it is before the division."""
    bodies = O.bodies
    return [
        (contact.id1, contact.id2, contact.geom.dict(), contact.phys.dict())
        for contact in O.interactions
        if contact.isReal and bodies[contact.id1].subdomain != bodies[contact.id2].subdomain
    ]


def _make(first, second, geometry, physics):
    """A contact by YADE's own functors, with these attributes: an object made by Python must not be left to a step to
    destroy.
    """
    if O.interactions.has(first, second):
        O.interactions.erase(first, second)
    pair = yade.utils.createInteraction(first, second)
    pair.geom.updateAttrs(geometry)
    pair.phys.updateAttrs(physics)


def _here(number):
    return number < len(O.bodies) and O.bodies[number] is not None
