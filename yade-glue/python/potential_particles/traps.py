# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a scene goes wrong in silence, or ends YADE, because of how it is set up: part of what check() finds."""
from yade.wrapper import ConicPotentialParticle

from .bodies import is_free


def functors_of_yade(ours, dispatchers):
    """YADE's own contact functor on our shapes solves other equations, and answers with numbers that are none."""
    conic = next((body.shape for body in ours if isinstance(body.shape, ConicPotentialParticle)), None)
    for dispatcher in dispatchers if conic is not None else ():
        found = dispatcher.dispFunctor(conic, conic)
        if type(found).__name__ == "Ig2_PP_PP_ScGeom":
            yield ("Ig2_PP_PP_ScGeom of YADE serves ConicPotentialParticle, for which it finds no contact or none that is a "
                   "number", "put Ig2_ConicPP_ConicPP_ScGeom() in its place (Ig2_PP_PP_ScGeom_Conic() serves plain shapes too)")


def turning_boxes(scene, moving):
    """With verletDist > 0 the collider asks whether a body has moved, not whether it has turned."""
    watched = any(type(engine).__name__ == "BoundWatch" and not engine.dead for engine in scene.engines)
    for engine in scene.engines if not watched else ():
        far = getattr(engine, "verletDist", 0.0)
        if not far > 0.0 or engine.dead:
            continue
        # Of those that turn, how much their box can grow on one side.
        turning = [body.id for body in moving if not set("XYZ") <= set(body.state.blockedDOFs)
                   and isinstance(body.shape, ConicPotentialParticle)
                   and body.shape.boundingRadius - min(body.shape.minAabb.minCoeff(), body.shape.maxAabb.minCoeff()) > far]
        if turning:
            yield (f"{type(engine).__name__}(verletDist={far:g}) makes boxes anew when a body has moved, not when it has "
                   f"turned, and {len(turning)} bodies are longer than that",
                   "add BoundWatch() before the collider with Bo1_ConicPP_Aabb(), or give it verletDist=0")


def materials_without_law(scene, ours, geometry, physics):
    """Pairs of materials for which YADE would end the run at the first contact."""
    laws = [law for engine in scene.engines for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ())]
    if not physics or not laws:
        return
    kinds = {}
    for body in scene.bodies:
        if body.mat is not None and body.shape is not None and not body.isClump:
            kinds.setdefault((type(body.mat).__name__, type(body.shape).__name__), body)
    seen = set()
    for one in {(type(body.mat), type(body.shape)): body for body in ours if body.mat}.values():
        for other in kinds.values():
            pair = tuple(sorted({type(one.mat).__name__, type(other.mat).__name__}))
            if (pair in seen or not (is_free(one) or is_free(other))
                    or not any(dispatcher.dispFunctor(one.shape, other.shape) for dispatcher in geometry)):
                continue
            seen.add(pair)
            found = [functor for dispatcher in physics for functor in [dispatcher.dispFunctor(one.mat, other.mat)] if functor]
            names = " and ".join(pair) if len(pair) > 1 else f"two {pair[0]}"
            if not found:
                yield (f"no Ip2 functor serves {names}, and YADE ends the run at their first contact",
                       "give all bodies one material, as by use_joints(), or add the functor to the contact loop")
            elif not any(_serves(law, functor) for law in laws for functor in found):
                yield (f"no law serves what {type(found[0]).__name__} makes of {names}, and YADE ends the run at their first "
                       "contact", "add the law that belongs to it to the contact loop")


def _serves(law, functor):
    import yade
    asked = law.bases[1]
    made = type(functor).__name__.rsplit("_", 1)[-1]
    made = {"Block": "KnKsPhys"}.get(made, made)
    kind, base = getattr(yade.wrapper, made, None), getattr(yade.wrapper, asked, None)
    return made == asked or kind is None or base is None or issubclass(kind, base)


def lost_spins(scene, moving):
    """NewtonIntegrator takes the spin of aspherical bodies from their angular momentum, which ranks do not exchange.

    So does Fincham's way of turning them, the only one before YADE 2025; the others take the spin itself.
    """
    if getattr(scene, "splittedOnce", False):
        return
    if not any(engine.exactAsphericalRot and str(getattr(engine, "rotAlgorithm", "Fincham1992")) == "Fincham1992"
               for engine in scene.engines if type(engine).__name__ == "NewtonIntegrator" and not engine.dead):
        return
    lost = [body.id for body in moving if body.aspherical and body.state.angVel.norm() > 0.0
            and body.state.angMom.norm() == 0.0 and not set("XYZ") <= set(body.state.blockedDOFs)]
    if lost:
        yield (f"body {', '.join(map(str, lost[:3]))}: angVel is set and angMom is not, so that it stands still after one step",
               "set state.angMom, too: state.ori * (inertia times state.ori.conjugate() * state.angVel)")


def small_cells(scene, ours):
    """YADE ends a run whose periodic cell is smaller than two bodies."""
    if not scene.periodic:
        return
    least = min(scene.cell.size)
    for body in ours:
        width = max(body.shape.minAabb[i] + body.shape.maxAabb[i] for i in range(3))
        if least < 2.0 * width:
            yield (f"the periodic cell is {least:g} wide, less than two bodies (body {body.id} is {width:g} long), and YADE "
                   "ends the run or lets a body meet itself", "make the cell larger, or the bodies smaller")
            return
