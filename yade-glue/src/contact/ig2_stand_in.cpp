// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "ig2_stand_in.hpp"

namespace potential_particles {

#define PP_STAND_IN(Shape, Version, Doc)                                                           \
    Ig2_##Shape##_ConicPP_ScGeom::~Ig2_##Shape##_ConicPP_ScGeom() = default;                       \
    PP_FUNCTOR_2D_DEFINITIONS(Ig2_##Shape##_ConicPP_ScGeom)                                        \
    PP_PYTHON_AS_BASE(Ig2_##Shape##_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)                    \
    PP_ARCHIVE_AS_BASE(Ig2_##Shape##_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)
#include "registration/class_table.inc"

} // namespace potential_particles

#define PP_STAND_IN(Shape, Version, Doc) BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_##Shape##_ConicPP_ScGeom)
#include "registration/class_table.inc"
