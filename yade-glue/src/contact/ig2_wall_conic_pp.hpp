// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functor between YADE's walls and potential particles.
#pragma once

#include "ig2_flat_conic_pp.hpp"

namespace potential_particles {

class Ig2_Wall_ConicPP_ScGeom final : public Ig2_Flat_ConicPP {
public:
    ~Ig2_Wall_ConicPP_ScGeom() override;
    PP_FUNCTOR_2D_OVERRIDES

protected:
    BoundaryPoints pointsOf(const FlatPair& pair) const override;
    pp_status detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found) override;
    pp_status findPatch(const FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found,
                        pp_patch& patch) const override;

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);
};

} // namespace potential_particles
