// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functors between YADE's shapes that are particles themselves and potential particles: a class for each
// PP_STAND_IN of the class table. They differ in what the table says of them.
#pragma once

#include "ig2_other_conic_pp.hpp"

namespace potential_particles {

#define PP_STAND_IN(Shape, Version, Doc)                                                           \
    class Ig2_##Shape##_ConicPP_ScGeom final : public Ig2_Other_ConicPP {                          \
    public:                                                                                        \
        ~Ig2_##Shape##_ConicPP_ScGeom() override;                                                  \
        PP_FUNCTOR_2D_OVERRIDES                                                                    \
                                                                                                   \
    private:                                                                                       \
        friend class boost::serialization::access;                                                 \
        template <class Archive> void serialize(Archive& archive, unsigned);                       \
    };
#include "registration/class_table.inc"

} // namespace potential_particles
