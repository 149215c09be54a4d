# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts between potential particles for YADE, whose names stand in `potential_particles` too, in YADE.

Import either at the top of a YADE script, before O.engines is filled:

    import potential_particles

Then these classes stand beside YADE's own:

    ConicPotentialParticle       a PotentialParticle that is validated when it is made
    Ig2_ConicPP_ConicPP_ScGeom   its contact functor
    Ig2_PP_PP_ScGeom_Conic       the same for plain PotentialParticle shapes too: put it in the
                                 place of Ig2_PP_PP_ScGeom
    Ig2_Sphere_ConicPP_ScGeom, Ig2_Box_ConicPP_ScGeom, Ig2_Wall_ConicPP_ScGeom, Ig2_Facet_ConicPP_ScGeom
                                 contacts of either with YADE's own shapes
    ScGeomConicPP                the ScGeom that they fill
    ConicInteractionLoop         the contact loop that skips pairs which cannot have met
    ConicJointMat, Ip2_ConicJointMat_ConicJointMat_ConicJointPhys, Law2_ScGeomConicPP_ConicJointPhys
                                 joints: stiffness per area, friction against slip and twist, restitution, strength,
                                 bonds (bond_contacts); use_joints gives them to a scene with another law
    MovingMesh                   facets that move together: lids, servo walls, blades
    BoundWatch, Bo1_ConicPP_Aabb, Bo1_PP_Aabb_Conic
                                 boxes for verletDist > 0

potential_particles.shapes makes shapes from planes, points, files and names of solids, and body() a YADE body of one.
pack() fills a container with many, add_packing() makes bodies of them, an Inlet lets them come while the scene runs;
potential_particles.boundaries has walls and funnels.

Before they are registered, the classes of the YADE that runs are compared with what the plugin was compiled for. One
that differs is refused with AbiError, which lists the differences, and nothing is registered; one that fits and was
never tested is taken, with a warning of one line.

Of YADE's own classes the import replaces seven functions, which do as before: O.run and O.step look our functors up
(prepare) and warn of what check() finds, for which Body.shape notices a change, O.load says what to do about a scene of
another YADE, and O.bodies.append, clump and appendClumped what to do with a shape and with facets. The lists of
PotentialParticle are set under a lock, and YADE's 3-D window draws that class by our functor (window). protect_runs() replaces more, for those who ask for it.
"""
import builtins
import functools
import sys

from . import __version__, _core, builds, window
from .bodies import add_packing, body, conic_particle, guard
from .clumps import add_clump, clump
from .inlets import Inlet
from .joints import bond_contacts, use_joints
from .lammps_files import to_lammps
from .limit_analysis import limit_analysis
from .measures import (body_stresses, coordination_number, extrema, fabric_tensor, overlap_ratio, porosity,
                       solid_volume, stress)
from .outside import protect_runs
from .packing import pack
from .polyhedra import replace_polyhedra
from .saves import save
from .simulated import factor_by_simulation
from .specimen import grading_curve, sampled_porosity
from .start import start_from
from .time_step import critical_time_step, time_stepper

#: That of the plugin, and of every file beside this one.
_PLUGIN = "0.2.0"

__all__ = [
    "AbiError", "Inlet", "Mesh", "Recorder", "SceneWarning", "add_clump", "add_packing", "body", "body_stresses",
    "bond_contacts", "check", "clump", "conic_particle", "coordination_number", "critical_time_step", "extrema", "fabric_tensor",
    "factor_by_simulation", "grading_curve", "library_version", "limit_analysis", "mesh", "overlap_ratio", "pack", "plot", "plot_equilibrium",
    "porosity", "prepare", "protect_runs", "replace_polyhedra", "sampled_porosity", "save", "save_mesh", "solid_volume", "start_from",
    "stress", "time_stepper", "to_lammps", "use_joints"
]


class AbiError(ImportError):
    """This YADE is not the one that the plugin was made for. `differences` lists how it differs."""

    def __init__(self, differences, running, built_for):
        self.differences = list(differences)
        super().__init__(
            "potential_particles was built for YADE %s and does not fit this one, %s with Python %s (`make build` builds "
            "it for the YADE that is installed, if it can be):\n  %s" %
            (built_for, running, builds.python_version(), "\n  ".join(self.differences)))


def _import_yade():
    try:
        import yade.system  # noqa: F401 (starts YADE's registry of classes)
        import yade
    except ImportError as error:
        raise ImportError(
            "potential_particles needs YADE (Debian package yade): run `yade script.py`, or add the folder of YADE's Python "
            "package, as in /usr/bin/yade, to sys.path first. " + str(error)) from error
    import yade.config
    return yade, str(getattr(yade.config, "version", "unknown"))


def _import_glue(running):
    try:
        from . import _glue
    except ImportError as error:
        reason = str(error)
        if "undefined symbol: pp_" in reason:
            remedy = "another version of the library was found than the plugin was built for: build both again with `make build`"
        elif "libpotential_particles" in reason:
            remedy = "build the library with `cargo build --release`, in the place that the plugin was linked to"
        elif "undefined symbol" in reason:
            remedy = (
                "the YADE that runs, %s with Python %s, lacks a function that the plugin calls: build the plugin again "
                "with `make build`, which lists the differences" % (running, builds.python_version()))
        elif "libboost_" in reason or "libpython" in reason:
            remedy = (
                "the plugin was built for another Python or Boost than those of YADE %s with Python %s: build it again with "
                "`make build`" % (running, builds.python_version()))
        else:
            remedy = "build the plugin with `cmake -S yade-glue -B yade-glue/build && cmake --build yade-glue/build`"
        raise ImportError("potential_particles cannot load its plugin: %s (%s)" % (reason, remedy)) from error
    return _glue


def _check_core():
    """The package and its _core may be a wheel's, which comes first on the path, and the plugin another installation's."""
    for what, version in (("the package", __version__), ("its module _core", _core.__version__)):
        if version != _PLUGIN:
            raise ImportError(
                "potential_particles: %s in %s is version %s, the plugin for YADE is %s: install both of one version, or "
                "take the wheel away" % (what, _core.__file__, version, _PLUGIN))


def _check_library(glue):
    header = ".".join(map(str, glue.header_version))
    # While the major version is 0, a new minor version is a new interface.
    if glue.library_version().split(".")[:2] != header.split(".")[:2]:
        raise ImportError(
            "potential_particles: the library is version %s, the plugin was built for %s; build the plugin again"
            % (glue.library_version(), header))
    if glue.library_abi() != glue.header_abi:
        raise ImportError(
            "potential_particles: the library has binary interface %d, the plugin was built for %d; build the plugin again"
            % (glue.library_abi(), glue.header_abi))


def _register(yade, glue):
    import yade.wrapper
    glue.register_classes()
    missing = [name for name in glue.class_names if not hasattr(yade.wrapper, name)]
    if missing:
        raise ImportError("potential_particles: YADE did not take the classes %s; its messages above say why"
                          % ", ".join(missing))
    import __main__
    for name in glue.class_names:
        for place in (yade, builtins, __main__):
            setattr(place, name, getattr(yade.wrapper, name))
        globals()[name] = getattr(yade.wrapper, name)
        yade.system._allSerializables.add(name)
    __all__.extend(glue.class_names)


def _dispatchers(yade):
    """Of the present scene: (dispatchers of bounds, of geometry, of physics)."""
    kinds = (yade.wrapper.BoundDispatcher, yade.wrapper.IGeomDispatcher, yade.wrapper.IPhysDispatcher)
    found = [], [], []
    for engine in yade.wrapper.Omega().engines:
        holders = [engine] + [
            getattr(engine, name, None) for name in ("boundDispatcher", "geomDispatcher", "physDispatcher")
        ]
        for kind, group in zip(kinds, found):
            group.extend(holder for holder in holders if isinstance(holder, kind))
    return found


def _resize_dispatchers(yade):
    # Their tables have a row for each class of shape that existed when their functors were added.
    for group in _dispatchers(yade):
        for dispatcher in group:
            dispatcher.functors = dispatcher.functors


def prepare():
    """Looks up, in one thread, every functor that the scene will need.

    YADE copies a functor that serves a derived class (as PotentialParticle2AABB serves
    ConicPotentialParticle) into its table at the first look-up, without a lock, within its parallel
    loops: threads that do so at once may damage the table. O.run and O.step do so by themselves for
    our shapes. Only a script that calls an engine by hand has to call this.
    """
    import yade
    scene = yade.wrapper.Omega()
    bounds, geometry, physics = _dispatchers(yade)
    _prepare_ours(yade)
    shapes = list({type(body.shape): body.shape for body in scene.bodies if body.shape is not None}.values())
    _look_up(bounds, geometry, shapes)
    materials = list({type(material): material for material in scene.materials}.values())
    _look_up([], physics, materials)


def _look_up(single, double, arguments):
    for one in arguments:
        for dispatcher in single:
            dispatcher.dispFunctor(one)
        for other in arguments:
            for dispatcher in double:
                dispatcher.dispFunctor(one, other)


def _prepare_ours(yade):
    """prepare() for our shapes alone, which takes the same few microseconds in a scene of any size.

    YADE's classes of shapes derive from each other, as Cylinder from Sphere: the derived one first. Once the functor of
    the base is entered for our shape, YADE calls that entry and the one of the derived class with our shape's base
    equally near, and raises.
    """
    bounds, geometry, _ = _dispatchers(yade)
    ours = [yade.wrapper.ConicPotentialParticle(), yade.wrapper.PotentialParticle()]
    _look_up(bounds, geometry, ours)
    from .unserved import REMEDIES
    others = sorted((getattr(yade.wrapper, name) for name in REMEDIES), key=lambda kind: -len(kind.__mro__))
    for other in [kind() for kind in others]:
        for one in ours:
            for dispatcher in geometry:
                dispatcher.dispFunctor(one, other)
                dispatcher.dispFunctor(other, one)


def _prepare_before_steps(yade):
    """O.run and O.step, as they are, but for what is looked at before them."""
    from . import joints
    from .check import Watch, notice_shapes
    watch = Watch()
    notice_shapes(yade, watch)

    def preparing(method):
        @functools.wraps(method)
        def prepared(self, *arguments, **keywords):
            if not self.running:
                _prepare_ours(yade)
                joints.require_patches(self.engines)
                joints.require_angles(self)
                watch.look(self)
            done = method(self, *arguments, **keywords)
            if not self.running:
                watch.look(self)
            return done
        return prepared

    omega = yade.wrapper.Omega
    omega.run, omega.step = preparing(omega.run), preparing(omega.step)


def library_version():
    """Version of the Rust library that was loaded."""
    return _glue.library_version()


def _load():
    _check_core()
    yade, running = _import_yade()
    glue = _import_glue(running)
    _check_library(glue)
    differences = list(glue.differences_of_layout())
    if differences:
        raise AbiError(differences, running, glue.built_for_yade)
    builds.warn(running, glue.built_for_yade)
    _register(yade, glue)
    _resize_dispatchers(yade)
    window.serve(yade, glue.window_dispatcher)
    _prepare_before_steps(yade)
    from . import outside, saves
    outside.guard_lists(yade, glue.set_list)
    saves.guard(yade, glue.archive_version, running)
    guard(yade.wrapper.BodyContainer)
    return glue


_glue = _load()
# After the classes that they serve.
from .arguments import SceneWarning  # noqa: E402, F401
from .check import check  # noqa: E402, F401
from .output import Mesh, Recorder, mesh, plot, plot_equilibrium, save_mesh  # noqa: E402, F401
