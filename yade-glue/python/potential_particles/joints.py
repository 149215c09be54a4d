# SPDX-License-Identifier: GPL-3.0-or-later
"""Bonds of joints, and what the law of joints needs before a scene steps."""

LAW = "Law2_ScGeomConicPP_ConicJointPhys"


def require_patches(engines):
    """ValueError where a contact loop with the law of joints has contact functors that do not find the patch: no joint would have a force."""
    for engine in engines:
        laws = [type(law).__name__ for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ())]
        if LAW not in laws:
            continue
        ours = [functor for functor in engine.geomDispatcher.functors if hasattr(functor, "patch")]
        without = [type(functor).__name__ for functor in ours if not functor.patch]
        # Beside another law a functor may serve that one.
        if without and (len(laws) == 1 or len(without) == len(ours)):
            raise ValueError(f"{LAW} needs the contact patch: give {', '.join(without)} the keyword patch=True")


def bond_contacts(bodies=None):
    """Bonds the joints that there are, all or those between bodies with these ids, as they are in the next step; returns their number.

    Joints are contacts with ConicJointPhys. Those that have broken are whole again. For joints that are made later see `bonds` of
    Ip2_ConicJointMat_ConicJointMat_ConicJointPhys.
    """
    import yade
    chosen = None if bodies is None else {int(one) for one in bodies}
    joints = [contact.phys for contact in yade.O.interactions
              if contact.isReal and isinstance(contact.phys, yade.ConicJointPhys)
              and (chosen is None or {contact.id1, contact.id2} <= chosen)]
    for joint in joints:
        joint.bonded = True
    return len(joints)
