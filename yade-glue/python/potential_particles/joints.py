# SPDX-License-Identifier: GPL-3.0-or-later
"""What the law of joints needs, looked at before a scene steps."""

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
