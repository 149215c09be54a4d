// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "ig2_other_conic_pp.hpp"

namespace potential_particles {

bool Ig2_Other_ConicPP::goReverse(const boost::shared_ptr<yade::Shape>& shape1,
                                  const boost::shared_ptr<yade::Shape>& shape2, const yade::State& state1,
                                  const yade::State& state2, const yade::Vector3r& shift2, const bool& force,
                                  const boost::shared_ptr<yade::Interaction>& interaction) noexcept
{
    const bool real = interaction->hasGeomAndPhys();
    try {
        interaction->swapOrder();
    } catch (const std::exception& error) {
        fail(*interaction, state1, state2, shift2, error.what());
        return real;
    }
    return go(shape2, shape1, state2, state1, -shift2, force, interaction);
}

#define PP_STAND_IN(Shape, Version, Doc)                                                                               \
    Ig2_##Shape##_ConicPP_ScGeom::~Ig2_##Shape##_ConicPP_ScGeom() = default;                                           \
    PP_FUNCTOR_2D_DEFINITIONS(Ig2_##Shape##_ConicPP_ScGeom)                                                            \
    PP_PYTHON_AS_BASE(Ig2_##Shape##_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)                                        \
    PP_ARCHIVE_AS_BASE(Ig2_##Shape##_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)
#include "registration/class_table.inc"

} // namespace potential_particles

#define PP_STAND_IN(Shape, Version, Doc) BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_##Shape##_ConicPP_ScGeom)
#include "registration/class_table.inc"
