# SPDX-License-Identifier: GPL-3.0-or-later
# What YADE does in silence: each of its engines and laws serves these bodies, or check() says that it does not.
import inspect
import warnings

from harness import *
import potential_particles
from potential_particles import shapes, tools
import yade
import yade.system

check = Checks()


def said():
    return [str(one) for one in potential_particles.check()]


def scene(verlet=0.0, **keywords):
    fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), yade.Ip2_FrictMat_FrictMat_FrictPhys(),
                yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False), dt=1e-6, **keywords)
    O.engines[1].verletDist = verlet
    return [add(cube(), Vector3(3 * i, 0, 0)) for i in range(8)]


def finds(text, what):
    found = [one for one in said() if text in one]
    check.equal(len(found), 1, f"{what}: {found}")


# --- every class of YADE's registry -----------------------------------------------------------------------------

# Not in every YADE: of 2025.2 alone, and those that Debian's 2025.2 is built without.
NOT_EVERYWHERE = frozenset("""CapillarityEngine FlowEngine FlowEngineT FlowEngine_PeriodicInfo MicroMacroAnalyser
PartialSatClayEngine PartialSatClayEngineT PeriodicFlowEngine PolyhedraSplitter SplitPolyMohrCoulomb SplitPolyTauMax
TesselationWrapper ThermalEngine TimeAverager TwoPhaseFlowEngine TwoPhaseFlowEngineT UnsaturatedEngine
VESupportEngine""".split())
listed = tools.SERVE | tools.DRAW | set(tools.SILENT)
engines = {name for base in ("PartialEngine", "GlobalEngine", "Dispatcher") for name in yade.system.childClasses(base)}
check.equal(engines - listed, set(), "every engine of YADE is in the list")
check.equal(listed - engines - NOT_EVERYWHERE, set(), "and no other")
check.equal(tools.SERVE & set(tools.SILENT), set(), "each once")
laws = yade.system.childClasses("LawFunctor")
check.true(tools.TRIED_LAWS <= set(laws), "the laws that were tried are there")

# Functors of YADE that take our shapes for their base.
based = {name for kind in ("BoundFunctor", "IGeomFunctor") for name in yade.system.childClasses(kind)
         if "Conic" not in name and "PotentialParticle" in getattr(yade.wrapper, name)().bases}
check.equal(based, {"PotentialParticle2AABB", "Ig2_PP_PP_ScGeom"}, "one serves, and check() names the other")

scene()
check.equal(said(), [], "a scene that is right")
for name in sorted(tools.SILENT):
    if name.endswith("T") and name[:-1] in tools.SILENT:
        continue  # templates of YADE, which no script makes
    scene()
    try:
        engine = getattr(yade.wrapper, name)()
    except (AttributeError, RuntimeError, TypeError) as error:
        print(f"not tried: {name}: {error}")
        continue
    if hasattr(engine, "ids"):
        engine.ids = [0]
    if not isinstance(engine, yade.wrapper.Engine):
        continue
    O.engines = O.engines + [engine]
    found = [one for one in said() if one.startswith(name + " ")]
    check.true(len(found) >= 1, f"check() names {name}: {found}")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        engine.dead = True
        check.equal([one for one in said() if one.startswith(name + " ")], [], f"{name} that is dead does nothing")

# Of those that serve, forces and motions by ids, tried one by one.
for name, attributes in (("ForceEngine", {"force": Vector3(0, 0, 1e3)}), ("RadialForceEngine", {"fNorm": 1e3, "axisDir": Vector3(0, 0, 1)}),
                         ("HarmonicForceEngine", {"A": Vector3(1e3, 0, 0), "f": Vector3(1e3, 1, 1)}),
                         ("TranslationEngine", {"velocity": 1.0, "translationAxis": Vector3(1, 0, 0)}),
                         ("TorqueEngine", {"moment": Vector3(0, 0, 1e3)}),
                         ("RotationEngine", {"angularVelocity": 1.0, "rotationAxis": Vector3(0, 0, 1)})):
    scene()
    engine = getattr(yade, name)(ids=[3], **attributes)
    if name == "RotationEngine":  # of a free body, NewtonIntegrator takes the spin from the angular momentum
        O.bodies[3].state.blockedDOFs = "xyzXYZ"
    O.engines = O.engines[:3] + [engine] + O.engines[3:]
    run(5)
    state = O.bodies[3].state
    check.true(state.vel.norm() + state.angVel.norm() > 0.0, f"{name} moves a body of ours")
    check.true(not any(one.startswith(name) for one in said()), f"check() does not name {name}")
for name, attributes in (("GravityEngine", {"gravity": Vector3(0, 0, -9.81)}),
                         ("CentralConstantAccelerationEngine", {"centralBody": 0, "accel": 1.0}),
                         ("AxialGravityEngine", {"axisPoint": Vector3(0, 5, 0), "axisDirection": Vector3(0, 0, 1),
                                                 "acceleration": 1.0})):
    scene()
    O.engines = O.engines[:3] + [getattr(yade, name)(**attributes)] + O.engines[3:]
    run(3)
    check.true(O.bodies[3].state.vel.norm() > 0.0, f"{name} moves a body of ours")

# --- controllers whose walls are rocks -----------------------------------------------------------------------------

scene()
O.engines = O.engines + [yade.TriaxialStressController(internalCompaction=False)]
finds("for its walls, and drives them", "rocks as walls")

# --- functors, materials, boxes, spins, cells ------------------------------------------------------------------------

scene()
O.engines[2].geomDispatcher.functors = [yade.Ig2_PP_PP_ScGeom()]
finds("Ig2_PP_PP_ScGeom of YADE", "YADE's own functor")

scene(verlet=0.01)
finds("not when it has turned", "verletDist without BoundWatch")
O.engines = [O.engines[0], yade.BoundWatch()] + O.engines[1:]
check.true(not any("turned" in one for one in said()), "and with it")

scene()
O.materials.append(yade.ConicJointMat(density=2000.0))
O.bodies[2].mat = O.materials[-1]
O.engines[2].physDispatcher.functors = [yade.Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()]
O.engines[2].lawDispatcher.functors = [yade.Law2_ScGeomConicPP_ConicJointPhys()]
O.engines[2].geomDispatcher.functors[0].patch = True
check.equal(sorted(one.split(",")[0] for one in said() if "no Ip2 functor serves" in one),
            ["no Ip2 functor serves ConicJointMat and FrictMat", "no Ip2 functor serves two FrictMat"],
            "materials without Ip2")
scene()
O.engines[2].physDispatcher.functors = [yade.Ip2_FrictMat_FrictMat_MindlinPhys()]
O.engines[2].lawDispatcher.functors = [yade.Law2_SCG_KnKsPhys_KnKsLaw()]
finds("no law serves", "materials without law")
scene()
O.engines[2].physDispatcher.functors = [yade.Ip2_FrictMat_FrictMat_ViscoFrictPhys()]
O.engines[2].lawDispatcher.functors = [yade.Law2_ScGeom_ViscoFrictPhys_CundallStrack()]
finds("has not been tried", "a law that nobody tried")

scene()
O.bodies[1].state.angVel = Vector3(0, 0, 1)
if hasattr(O.engines[-1], "rotAlgorithm"):
    check.equal(said(), [], "a spin that this integrator takes")
    O.engines[-1].rotAlgorithm = "Fincham1992"
finds("angMom is not", "a spin without angular momentum")
run(1)
check.equal(O.bodies[1].state.angVel.norm(), 0.0, "which YADE takes away")

fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-6, periodic=True)
O.cell.setBox(1.5, 9, 9)
add(cube(), Vector3(0.5, 0, 0))
finds("less than two bodies", "a cell smaller than two bodies")

# --- overlaps beyond r in the midst of a run --------------------------------------------------------------------------

scene()
functor = O.engines[2].geomDispatcher.functors[0]
O.bodies[1].state.pos = Vector3(1.2, 0, 0)
O.bodies[1].state.vel = Vector3(-1e4, 0, 0)
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    run(40)
    O.step()
check.true(functor.deepOverlaps > 0, f"{functor.deepOverlaps} overlaps beyond r")
check.true(any("of the rounding radius" in str(one.message) for one in caught) or functor.deepOverlaps > 0, "said")
functor.resetCounters()
check.equal(functor.deepOverlaps, 0, "counters begin anew")

# --- pictures of periodic cells, and what is mistyped ---------------------------------------------------------------

import tempfile
from potential_particles.output import vtk_files

fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-9, periodic=True)
O.cell.setBox(3, 3, 3)
one = add(cube(), Vector3(6.9, 0.9, -1.1))
run(1)
with tempfile.TemporaryDirectory() as folder:
    potential_particles.Recorder(folder + "/cell")()
    bodies = vtk_files.read(f"{folder}/cell.bodies.{O.iter:07d}.vtp")
    cell = vtk_files.read(f"{folder}/cell.cell.{O.iter:07d}.vtp")
    middle = Vector3(*(0.5 * (bodies["points"].min(0) + bodies["points"].max(0)).astype(float)))
    check.close(middle, Vector3(0.9, 0.9, 1.9), 1e-3, "a body is drawn in the cell")
    points = cell["points"]
    check.equal((len(points), points.min(), points.max()), (24, 0.0, 3.0), "and the twelve edges of the cell")
lower, upper = potential_particles.extrema([O.bodies[one]])
check.close(0.5 * (lower + upper), O.bodies[one].state.pos, 1e-9, "extrema takes bodies, too")
stone = shapes.cuboid((1, 1, 1), rounding=0.05)
check.raises(ValueError, lambda: potential_particles.body(stone, postion=(0, 0, 0)), "mistyped", "did you mean position?")
check.raises(TypeError, lambda: O.bodies.append(stone), "a shape is no body", "potential_particles.body(shape")
check.raises(TypeError, lambda: O.bodies.append(3), "nor is a number", "did not match C++ signature")
check.finish()
