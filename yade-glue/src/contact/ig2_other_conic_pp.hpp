// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functors between YADE's own shapes and potential particles: what is common to them, and those for shapes
// that are particles themselves.
#pragma once

#include "ig2_conic_pp.hpp"

namespace potential_particles {

// Body 1 has YADE's shape, body 2 the potential particle, YADE's own or ours. An interaction that has them the other
// way round is swapped, as by YADE's functors of two kinds of shapes.
class Ig2_Other_ConicPP : public Ig2_ConicPP_ConicPP_ScGeom {
public:
    bool goReverse(const boost::shared_ptr<yade::Shape>& shape1, const boost::shared_ptr<yade::Shape>& shape2,
                   const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2,
                   const bool& force, const boost::shared_ptr<yade::Interaction>& interaction) noexcept override;
};

// A class for each PP_STAND_IN of the class table. They differ in what the table says of them.
#define PP_STAND_IN(Shape, Version, Doc)                                                                               \
    class Ig2_##Shape##_ConicPP_ScGeom final : public Ig2_Other_ConicPP {                                              \
    public:                                                                                                            \
        ~Ig2_##Shape##_ConicPP_ScGeom() override;                                                                      \
        PP_FUNCTOR_2D_OVERRIDES                                                                                        \
                                                                                                                       \
    private:                                                                                                           \
        PP_ARCHIVED                                                                                                    \
    };
#include "registration/class_table.inc"

} // namespace potential_particles
