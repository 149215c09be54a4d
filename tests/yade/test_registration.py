# SPDX-License-Identifier: GPL-3.0-or-later
# The classes stand beside YADE's own: names, keywords, docstrings, dict, copies, dispatch.
import builtins
import copy
import os
import pickle
import re
import tempfile
from pathlib import Path

import harness
import potential_particles
import yade
import yade.system
import yade.wrapper
from harness import *

check = Checks()
# Those that the reference promises.
REFERENCE = Path(harness.__file__).resolve().parents[2] / "docs/python.md"
NAMES = re.findall(r"autoclass:: yade\.wrapper\.(\w+)", REFERENCE.read_text())
# YADE's own shapes that a potential particle touches.
OTHERS = [
    name.split("_")[1] for name in NAMES if name.startswith("Ig2_") and name.split("_")[1] not in ("ConicPP", "PP")
]

check.equal(sorted(NAMES), sorted(potential_particles._glue.class_names), "every class is in the reference")
check.true(len(OTHERS) >= 4, f"functors of YADE's shapes: {OTHERS}")

for name in NAMES:
    cls = getattr(yade.wrapper, name)
    for place in (yade, builtins, potential_particles):
        check.true(getattr(place, name, None) is cls, f"{name} in {place.__name__}")
    check.true(globals().get(name, None) is cls or eval(name) is cls, f"{name} usable without a prefix")
    check.true(name in yade.system._allSerializables, f"{name} in _allSerializables")
    check.true(len(cls.__doc__ or "") > 40, f"{name} has a docstring")
    check.equal(cls().__class__.__name__, name, "made without arguments")
    check.raises(AttributeError, lambda: cls(noSuchThing=1), f"{name}: unknown keyword", "noSuchThing")
    if not issubclass(cls, yade.InteractionLoop):  # which takes lists of functors so
        check.raises(RuntimeError, lambda: cls(1), f"{name}: argument without keyword", "keyword")
check.true(potential_particles.library_version().count(".") == 2, "library version")
check.true(potential_particles.__version__.count(".") == 2, "module version")

for name, base in [("ConicPotentialParticle", "PotentialParticle"), ("ConicPotentialParticle", "Shape"),
                   ("ScGeomConicPP", "ScGeom"), ("Ig2_ConicPP_ConicPP_ScGeom", "IGeomFunctor"),
                   ("Ig2_PP_PP_ScGeom_Conic", "IGeomFunctor"), ("Bo1_ConicPP_Aabb", "BoundFunctor"),
                   ("Bo1_PP_Aabb_Conic", "BoundFunctor"), ("BoundWatch", "GlobalEngine"),
                   ("ConicInteractionLoop", "InteractionLoop"), ("Ig2_Sphere_ConicPP_ScGeom", "IGeomFunctor"),
                   ("Ig2_Facet_ConicPP_ScGeom", "Ig2_ConicPP_ConicPP_ScGeom"),
                   ("Gl1_PotentialParticle_Conic", "GlShapeFunctor")]:
    check.true(name in yade.system.childClasses(base), f"childClasses({base}) has {name}")
    check.true(issubclass(getattr(yade, name), getattr(yade, base)), f"{name} is a {base}")

# Shape: attributes by keyword, dict, updateAttrs, copies.
shape = pyramid(color=(0.1, 0.2, 0.3), id=7)
check.equal(shape.color, Vector3(0.1, 0.2, 0.3), "inherited attribute by keyword")
check.equal((shape.id, shape.r, shape.k, shape.R), (7, 0.05, 0.05, 0.7), "own attributes by keyword")
check.equal(shape.planes, [tuple(map(float, row)) for row in pyramid_planes()], "planes come back as given")
check.equal(shape.a, [row[0] for row in shape.planes], "planes and a, b, c, d are one thing")
check.raises(TypeError, lambda: cube(r="wide"), "wrong type")
check.equal(shape.dispHierarchy(), ["ConicPotentialParticle", "PotentialParticle", "Shape"], "dispHierarchy")
for name in ("a", "k", "planes", "automaticBox", "volume", "vertices"):
    check.true(getattr(yade.ConicPotentialParticle, name).__doc__, f"docstring of shape.{name}")


def same(one, other, text):
    mine, theirs = one.dict(), other.dict()
    check.equal(sorted(mine), sorted(theirs), f"{text}: attributes")
    for key in mine:
        alike = mine[key] == theirs[key] or (mine[key] != mine[key] and theirs[key] != theirs[key])  # NaN is NaN
        check.true(alike, f"{text}: {key} is {theirs[key]!r}, was {mine[key]!r}")


same(shape, copy.copy(shape), "copy of a shape")
same(shape, copy.deepcopy(shape), "deep copy of a shape")
same(shape, pickle.loads(pickle.dumps(shape)), "pickled shape")
other = yade.ConicPotentialParticle()
other.updateAttrs(shape.dict())
same(shape, other, "updateAttrs from dict")
copied = copy.copy(shape)
copied.r = 0.06
check.true(shape.r == 0.05 and copied.vertices != shape.vertices, "a copy is a thing of its own, box included")
from_plain = yade.ConicPotentialParticle(**plain(cube_planes(), r=0.05, k=0.05, R=0.9).dict())
check.equal(from_plain.planes, cube().planes, "from the dict of a plain shape")
check.equal(from_plain.vertices, cube().vertices, "which gets a box, having had none")

# Functor and geometry.
keywords = dict(formulation="closest", backEnd="cone_program", tolerance=1e-9, flatRegularisation=1e-4,
                carryTolerance=1e-8, calContactArea=False, areaTolerance=1e-5, twoDimension=True, twoDdir=Vector3(
                    0, 0, 1), unitWidth2D=2.0, areaStep=3, accuracyTol=1e-6, measureTime=True, label="contacts")
functor_ = yade.Ig2_ConicPP_ConicPP_ScGeom(**keywords)
for key, value in keywords.items():
    check.equal(getattr(functor_, key), value, f"functor keyword {key}")
    check.equal(functor_.dict()[key], value, f"{key} in the functor's dict")
same(functor_, copy.copy(functor_), "copy of a functor")
same(functor_, pickle.loads(pickle.dumps(functor_)), "pickled functor")
check.equal(functor_.bases, ["ConicPotentialParticle"] * 2, "functor.bases")
for bounds, shape_name in (yade.Bo1_ConicPP_Aabb(label="boxes"), "ConicPotentialParticle"), (yade.Bo1_PP_Aabb_Conic(),
                                                                                             "PotentialParticle"):
    same(bounds, pickle.loads(pickle.dumps(bounds)), "pickled bounds functor")
    check.equal(bounds.bases, [shape_name], "its bases")
watching = yade.BoundWatch(label="watch", dead=True)
same(watching, pickle.loads(pickle.dumps(watching)), "pickled engine")
check.equal((watching.requests, watching.label, watching.dead), (0, "watch", True), "engine: attributes")
check.raises(AttributeError, lambda: setattr(watching, "requests", 1), "a count is read only")
loop = yade.ConicInteractionLoop([functor_], [yade.Ip2_FrictMat_FrictMat_KnKsPhys()],
                                 [yade.Law2_SCG_KnKsPhys_KnKsLaw()], label="loop")
for one in loop, pickle.loads(pickle.dumps(loop)):
    check.equal((one.label, [type(part).__name__ for part in one.geomDispatcher.functors]),
                ("loop", ["Ig2_ConicPP_ConicPP_ScGeom"]), "the loop with its functors, and pickled")
builtin = yade.Ig2_PP_PP_ScGeom(areaStep=9, twoDimension=True, unitWidth2D=0.5)
drop_in = yade.Ig2_PP_PP_ScGeom_Conic(**builtin.dict())
check.equal({key: drop_in.dict()[key] for key in builtin.dict()}, builtin.dict(), "keywords of the built-in functor")
for keyword, value in [("formulation", "nearest"), ("backEnd", "mosek"), ("tolerance", -1.0),
                       ("tolerance", float("nan")), ("flatRegularisation", 2.0), ("carryTolerance", -1.0),
                       ("areaTolerance", 0.0), ("unitWidth2D", 0.0), ("twoDdir", (0, 0, 0))]:
    check.raises(ValueError, lambda: yade.Ig2_ConicPP_ConicPP_ScGeom(**{keyword: value}), f"{keyword}={value}", keyword)
    before = getattr(functor_, keyword)
    check.raises(ValueError, lambda: setattr(functor_, keyword, value), f"{keyword} set to {value}", keyword)
    check.equal(getattr(functor_, keyword), before, f"{keyword} after a refused value")
check.raises(ValueError, lambda: yade.Ig2_ConicPP_ConicPP_ScGeom(backEnd="conic"), "the former name of a back end",
             "'cone_program'")
geometry = yade.ScGeomConicPP(memory="0123456789abcdef" * 8, normal=(0, 0, 1), contactPoint=(1, 2, 3))
same(geometry, copy.copy(geometry), "copy of a geometry")
check.raises(ValueError, lambda: yade.ScGeomConicPP(memory="xy"), "memory of wrong length", "128")
check.equal(yade.ScGeomConicPP(memory="0123456789abcdef" * 16).memory, "0123456789abcdef" * 8,
            "a memory of the size that it had before")
check.equal(geometry.dispHierarchy(), ["ScGeom", "GenericSpheresContact", "IGeom"], "the geometry dispatches as ScGeom")

# Dispatch.
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom())
matrix = O.engines[2].geomDispatcher.dispMatrix()
check.equal(matrix, {("ConicPotentialParticle", "ConicPotentialParticle"): "Ig2_ConicPP_ConicPP_ScGeom"}, "dispMatrix")
check.equal(list(O.engines[2].lawDispatcher.dispMatrix()), [("ScGeom", "KnKsPhys")], "dispMatrix of the law")
O.engines[2].geomDispatcher.functors = [yade.Ig2_ConicPP_ConicPP_ScGeom(), yade.Ig2_PP_PP_ScGeom_Conic(),
                                        yade.Ig2_Sphere_Sphere_ScGeom()]
find = O.engines[2].geomDispatcher.dispFunctor
round_one, flat_one = yade.PotentialParticle(), yade.ConicPotentialParticle()
check.equal(type(find(flat_one, flat_one)).__name__, "Ig2_ConicPP_ConicPP_ScGeom", "two of ours")
check.equal(type(find(round_one, flat_one)).__name__, "Ig2_PP_PP_ScGeom_Conic", "plain and ours")
check.equal(type(find(round_one, round_one)).__name__, "Ig2_PP_PP_ScGeom_Conic", "two plain ones")
check.true(find(flat_one, yade.Sphere()) is None, "no functor for ours and a sphere")
O.engines[2].geomDispatcher.functors = [getattr(yade, f"Ig2_{name}_ConicPP_ScGeom")() for name in OTHERS]
potential_particles.prepare()
find = O.engines[2].geomDispatcher.dispFunctor
for other in [getattr(yade, name)() for name in OTHERS]:
    name = f"Ig2_{type(other).__name__}_ConicPP_ScGeom"
    for one in round_one, flat_one:
        check.equal([type(find(*two)).__name__ for two in ((one, other), (other, one))], [name, name],
                    "either order of the shapes")
    check.equal(getattr(yade, name)().bases, [type(other).__name__, "PotentialParticle"], "its bases")
    same(
        getattr(yade, name)(tolerance=1e-9, label="contacts"),
        pickle.loads(pickle.dumps(getattr(yade, name)(tolerance=1e-9, label="contacts"))), name)
check.true(find(flat_one, flat_one) is None, "which do not serve two of ours")
O.engines[2].geomDispatcher.functors = [yade.Ig2_PP_PP_ScGeom_Conic()]
add(cube(), Vector3(0, 0, 0))
potential_particles.prepare()
entered = O.engines[1].boundDispatcher.dispMatrix()
check.equal(entered.get(("ConicPotentialParticle",)), "PotentialParticle2AABB", "prepare() entered the bounds functor")
dispatcher = O.engines[1].boundDispatcher
dispatcher.functors = [yade.Bo1_PP_Aabb_Conic(), yade.Bo1_ConicPP_Aabb(), yade.Bo1_Sphere_Aabb()]
for one, name in (flat_one, "Bo1_ConicPP_Aabb"), (round_one, "Bo1_PP_Aabb_Conic"), (yade.Sphere(), "Bo1_Sphere_Aabb"):
    check.equal(type(dispatcher.dispFunctor(one)).__name__, name, "bounds functor of each shape")
dispatcher.functors = [yade.PotentialParticle2AABB()]

# YADE's recorder of potential particles takes ours.
with tempfile.TemporaryDirectory() as folder:
    recorder = yade.PotentialParticleVTKRecorder(fileName=folder + "/particle", iterPeriod=1, sampleX=20, sampleY=20,
                                                 sampleZ=20, maxDimension=10)
    O.engines = O.engines + [recorder]
    run(3)
    files = [os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(".vtp")]
    check.true(any(os.path.getsize(name) > 2000 for name in files), f"files of the recorder: {os.listdir(folder)}")

check.finish()
