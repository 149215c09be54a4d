// SPDX-License-Identifier: GPL-3.0-or-later
//
// Raw material for check_abi.py: for each declared class its size, and a class derived from it
// whose virtual table the compiler writes from our declaration. Compiled and examined, never run.
#include "body.hpp"
#include "bound.hpp"
#include "engine.hpp"
#include "functor.hpp"
#include "interaction.hpp"
#include "knksphys.hpp"
#include "primitives.hpp"
#include "scene.hpp"
#include "scgeom.hpp"
#include "serializable.hpp"
#include "shape.hpp"
#include "state.hpp"
#include "window.hpp"

// The destructor, defined here, is what makes the compiler write the table into this file.
#define PROBE(Class)                                                                               \
    namespace abi_probe {                                                                          \
        struct Class : yade::Class {                                                               \
            ~Class() override;                                                                     \
        };                                                                                         \
        Class::~Class() = default;                                                                 \
    }                                                                                              \
    extern "C" __attribute__((visibility("default"))) const unsigned long abi_size_##Class         \
        = sizeof(yade::Class);

PROBE(Factorable)
PROBE(Serializable)
PROBE(Shape)
PROBE(PotentialParticle)
PROBE(Sphere)
PROBE(Box)
PROBE(Wall)
PROBE(Facet)
PROBE(State)
PROBE(IGeom)
PROBE(GenericSpheresContact)
PROBE(ScGeom)
PROBE(IPhys)
PROBE(NormPhys)
PROBE(NormShearPhys)
PROBE(FrictPhys)
PROBE(KnKsPhys)
PROBE(Interaction)
PROBE(Functor)
PROBE(IGeomFunctor)
PROBE(BoundFunctor)
PROBE(GlShapeFunctor)
PROBE(Bound)
PROBE(Aabb)
PROBE(Engine)
PROBE(GlobalEngine)
PROBE(Body)
PROBE(BodyContainer)
PROBE(Cell)
PROBE(Scene)
PROBE(InteractionLoop)
