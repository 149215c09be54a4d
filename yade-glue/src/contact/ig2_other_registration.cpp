// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names, Python classes and archives of the functors between YADE's own shapes and potential particles. Their attributes are
// those of their base.
#include "registration/archives.hpp"

#include "registration/class_versions.hpp"
#include "ig2_flat_conic_pp.hpp"
#include "ig2_other_conic_pp.hpp"
#include "registration/python_class.hpp"

#include <boost/serialization/base_object.hpp>
#include <boost/serialization/string.hpp>

// The name of the base in archives must be known wherever its part is archived; ig2_conic_pp_python.cpp exports it.
BOOST_CLASS_EXPORT_KEY(potential_particles::Ig2_ConicPP_ConicPP_ScGeom)

namespace potential_particles {

namespace {

    constexpr char sphereDoc[]
        = "Contact of a Sphere and a PotentialParticle, plain or ours: the sphere is a particle with k = 1, and all is as by\n"
          "Ig2_ConicPP_ConicPP_ScGeom. Fills ScGeom; the normal is from the sphere to the particle.";
    constexpr char boxDoc[]
        = "Contact of a Box and a PotentialParticle, plain or ours: the box is a particle with six planes and k = 0, its edges\n"
          "rounded by 1e-6 of its least half size, and all is as by Ig2_ConicPP_ConicPP_ScGeom.";
    constexpr char wallDoc[]
        = "Contact of a Wall and a PotentialParticle, plain or ours. The particle touches where its scale is least on the plane;\n"
          "penetrationDepth is the distance from there to its surface along the axis, contactPoint lies halfway, refR1 and\n"
          "refR2 are the particle's bounding radius. With sense = 0 the wall pushes to the side on which the particle's centre\n"
          "is, else to that of its sense. KnKsPhys.contactArea is the section of the particle. Of the settings, tolerance,\n"
          "flatRegularisation and those of the area count. Particles with isBoundary do not touch walls.";
    constexpr char facetDoc[]
        = "Contact of a Facet and a PotentialParticle, plain or ours. The particle touches where its scale is least on the\n"
          "triangle, from either side; normal, overlap, area and settings are as of Ig2_Wall_ConicPP_ScGeom. Facets that\n"
          "share an edge or a vertex give one contact there: the facet whose least scale is the lower has it.";

    template <class Functor> void registerFunctor(py::object scope, const char* name, const char* doc)
    {
        const py::scope inside(scope);
        const auto style = docstringStyle();
        registerClass<Functor, Ig2_ConicPP_ConicPP_ScGeom>(name, doc);
    }

} // namespace

// The archive's part of the base is ours, so Boost's own way works here.
#define PP_IG2_DEFINITIONS(Shape, doc)                                                             \
    Ig2_##Shape##_ConicPP_ScGeom::~Ig2_##Shape##_ConicPP_ScGeom() = default;                       \
    std::string Ig2_##Shape##_ConicPP_ScGeom::getClassName() const                                 \
    {                                                                                              \
        return "Ig2_" #Shape "_ConicPP_ScGeom";                                                    \
    }                                                                                              \
    std::string Ig2_##Shape##_ConicPP_ScGeom::get2DFunctorType1() const { return #Shape; }         \
    void Ig2_##Shape##_ConicPP_ScGeom::pyRegisterClass(py::object scope)                           \
    {                                                                                              \
        checkPyClassRegistersItself("Ig2_" #Shape "_ConicPP_ScGeom");                              \
        registerFunctor<Ig2_##Shape##_ConicPP_ScGeom>(scope, "Ig2_" #Shape "_ConicPP_ScGeom", doc); \
    }                                                                                              \
    template <class Archive> void Ig2_##Shape##_ConicPP_ScGeom::serialize(Archive& archive, unsigned version) \
    {                                                                                              \
        requireReadable<Ig2_##Shape##_ConicPP_ScGeom>(version);                                    \
        archive& BOOST_SERIALIZATION_BASE_OBJECT_NVP(Ig2_ConicPP_ConicPP_ScGeom);                  \
    }

PP_IG2_DEFINITIONS(Sphere, sphereDoc)
PP_IG2_DEFINITIONS(Box, boxDoc)
PP_IG2_DEFINITIONS(Wall, wallDoc)
PP_IG2_DEFINITIONS(Facet, facetDoc)

} // namespace potential_particles

BOOST_CLASS_EXPORT(potential_particles::Ig2_Sphere_ConicPP_ScGeom)
BOOST_CLASS_EXPORT(potential_particles::Ig2_Box_ConicPP_ScGeom)
BOOST_CLASS_EXPORT(potential_particles::Ig2_Wall_ConicPP_ScGeom)
BOOST_CLASS_EXPORT(potential_particles::Ig2_Facet_ConicPP_ScGeom)
