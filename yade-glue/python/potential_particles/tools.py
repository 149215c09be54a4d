# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's engines, functors and laws beside potential particles: which serve them, and what of the others is silent.

The lists name every class of YADE 2023.02a and 2025.2 that is an engine or a law; tests/yade/test_tools.py compares
them with YADE's registry. docs/laboratory.md says the same in words.
"""
from yade.wrapper import PotentialParticle

# Forces and motions of bodies by their ids, integration, collision, output: the shape does not count.
SERVE = frozenset("""AxialGravityEngine BoundDispatcher BoundWatch BoundaryController Breakage
CentralConstantAccelerationEngine Collider CombinedKinematicEngine ConicInteractionLoop FieldApplier FlatGridCollider ForceEngine ForceRecorder
ForceResetter GeneralIntegratorInsertionSortCollider GlobalStiffnessTimeStepper GravityEngine HarmonicForceEngine
HarmonicMotionEngine HarmonicRotationEngine HdapsGravityEngine HelixEngine IGeomDispatcher IPhysDispatcher
InsertionSortCollider Integrator InteractionLoop InterpolatingDirectedForceEngine InterpolatingHelixEngine
KinematicEngine LawDispatcher MovingMesh NewtonIntegrator PeriTriaxController Peri3dController PeriodicEngine
PotentialParticleVTKRecorder PyRunner RadialForceEngine Recorder RotationEngine ServoPIDController SnapshotEngine
SpatialQuickSortCollider StepDisplacer TimeAverager TimeStepper TorqueEngine TorqueRecorder TranslationEngine
TriaxialStressController VESupportEngine""".split())

_SPHERES = "acts on spheres alone, and leaves these bodies as they are"
_OWN_BODIES = "serves bodies of other kinds alone"
# (what it does here, what to do) of those that do not serve.
SILENT = {
    "DragEngine": (_SPHERES, "add the drag of a projected area by a PyRunner: O.forces.addF(id, force)"),
    "LinearDragEngine": (_SPHERES, "add the drag by a PyRunner: O.forces.addF(id, force)"),
    "DomainLimiter": (_SPHERES, "erase bodies by a PyRunner: O.bodies.erase(id)"),
    "HydroForceEngine": ("takes radii of spheres", "add the forces by a PyRunner: O.forces.addF(id, force)"),
    "VTKRecorder": ("writes spheres, facets and boxes, and none of these bodies", "use potential_particles.Recorder"),
    "TriaxialCompressionEngine": ("measures porosity by spheres", "TriaxialStressController(internalCompaction=False)"),
    "ThreeDTriaxialEngine": ("measures porosity by spheres", "TriaxialStressController(internalCompaction=False)"),
    "TriaxialStateRecorder": ("writes a porosity of spheres", "1 - potential_particles.solid_volume() / volume"),
    "PeriIsoCompressor": ("takes the size of the first body for that of a sphere", "PeriTriaxController"),
    "UniaxialStrainer": ("measures the length between centres of spheres", "TranslationEngine and a PyRunner"),
    "TesselationWrapper": ("tessellates spheres", "potential_particles.sampled_porosity, body_stresses"),
    "MicroMacroAnalyser": ("tessellates spheres", "potential_particles.body_stresses"),
    "ResetRandomPosition": ("places spheres", "potential_particles.pack"),
}
SILENT.update({
    name: ("makes or fills pores between spheres", "there is no such engine for these bodies")
    for name in """CapillarityEngine CapillaryStressRecorder FlowEngine FlowEngineT FlowEngine_PeriodicInfo FoamCoupling
    HydrodynamicsLawLBM Law2_ScGeom_CapillaryPhys_Capillarity LubricationPDFEngine MeasureCapStress PDFEngine
    PartialSatClayEngine PartialSatClayEngineT PeriodicFlowEngine ThermalEngine TwoPhaseFlowEngine TwoPhaseFlowEngineT
    UnsaturatedEngine""".split()
})
SILENT.update({
    name: ("makes spheres", "potential_particles.pack and add_packing")
    for name in ("BoxFactory", "CircularFactory", "SpheresFactory")
})
SILENT.update({
    name: (_OWN_BODIES, "leave it out, or give it bodies of its own")
    for name in """BicyclePedalEngine CpmStateUpdater Disp2DPropLoadEngine FEInternalForceEngine FacetTopologyAnalyzer
    InternalForceDispatcher KinemCNDEngine KinemCNLEngine KinemCNSEngine KinemCTDEngine KinemSimpleShearBox LawTester
    TetraVolumetricLaw""".split()
})
SILENT.update({name: (_OWN_BODIES, "use Breakage")
               for name in ("PolyhedraSplitter", "SplitPolyMohrCoulomb", "SplitPolyTauMax")})
SILENT.update({
    name: ("takes contacts of spheres, with their lever arms", "use an InteractionLoop with a law of docs/laws.md")
    for name in ("CohesiveFrictionalContactLaw", "ElasticContactLaw")
})
SILENT["RungeKuttaCashKarp54Integrator"] = ("turns bodies as spheres", "NewtonIntegrator(exactAsphericalRot=True)")
# They draw, and no step depends on them.
DRAW = frozenset("GlBoundDispatcher GlIGeomDispatcher GlIPhysDispatcher GlShapeDispatcher GlStateDispatcher".split())

# Laws on ScGeom that were tried (docs/laws.md), right or said to be wrong; others have arms of spheres or were not.
TRIED_LAWS = frozenset("""Law2_SCG_KnKsPhys_KnKsLaw Law2_ScGeomConicPP_ConicJointPhys
Law2_ScGeom_FrictPhys_CundallStrack Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM
Law2_ScGeom_MindlinPhys_HertzWithLinearShear Law2_ScGeom_MindlinPhys_Mindlin
Law2_ScGeom_MindlinPhys_MindlinDeresiewitz Law2_ScGeom6D_CohFrictPhys_CohesionMoment""".split())


def silent_engines(scene, ours):
    """(what, remedy) of each engine that does nothing, or something else, for the bodies `ours`."""
    numbers = {body.id for body in ours}
    for engine in scene.engines:
        name = type(engine).__name__
        if engine.dead:
            continue
        if name in SILENT and (name not in ("DragEngine", "LinearDragEngine") or numbers & set(engine.ids)):
            what, remedy = SILENT[name]
            if name == "VTKRecorder" and not {"all", "spheres"} & set(engine.recorders):
                continue
            yield f"{name} {what}", remedy
        if hasattr(engine, "wall_bottom_id"):
            walls = [getattr(engine, f"wall_{side}_id") for side in ("bottom", "top", "left", "right", "front", "back")
                     if getattr(engine, f"wall_{side}_activated")]
            moved = [one for one in walls if one < len(scene.bodies) and one in numbers
                     and isinstance(scene.bodies[one].shape, PotentialParticle) and scene.bodies[one].dynamic]
            if moved:
                yield (f"{name} takes bodies {', '.join(map(str, moved))} for its walls, and drives them",
                       "give it the ids of the walls (wall_bottom_id, ...), or add the walls first")


def untried_laws(scene, made):
    """Names of laws that act on contacts of ours with the physics `made`, and that nobody has tried."""
    for engine in scene.engines:
        for law in getattr(getattr(engine, "lawDispatcher", None), "functors", ()):
            name, (geometry, physics) = type(law).__name__, law.bases
            if geometry in ("ScGeom", "ScGeom6D") and name not in TRIED_LAWS and any(
                    one.endswith("_" + physics) for one in made):
                yield name
