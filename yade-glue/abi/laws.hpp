// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two laws of YADE, whose attributes a contact loop reads. Never made here.
#pragma once

#include "functor.hpp"

namespace yade {

class Law2_ScGeom_FrictPhys_CundallStrack : public LawFunctor {
public:
    Law2_ScGeom_FrictPhys_CundallStrack() = delete;
    ~Law2_ScGeom_FrictPhys_CundallStrack() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    std::string get2DFunctorType1() const override;
    std::string get2DFunctorType2() const override;
    bool go(boost::shared_ptr<IGeom>& geometry, boost::shared_ptr<IPhys>& physics, Interaction* interaction) override;

    std::byte accumulator[24];
    bool neverErase;
    bool sphericalBodies;
    bool traceEnergy;
    int plastDissipIx;
    int elastPotentialIx;
};
PP_ABI_SIZE(Law2_ScGeom_FrictPhys_CundallStrack, 128);
PP_ABI_OFFSET(Law2_ScGeom_FrictPhys_CundallStrack, neverErase, 112);
PP_ABI_OFFSET(Law2_ScGeom_FrictPhys_CundallStrack, plastDissipIx, 116);

class Law2_SCG_KnKsPhys_KnKsLaw : public LawFunctor {
public:
    Law2_SCG_KnKsPhys_KnKsLaw() = delete;
    ~Law2_SCG_KnKsPhys_KnKsLaw() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    std::string get2DFunctorType1() const override;
    std::string get2DFunctorType2() const override;
    bool go(boost::shared_ptr<IGeom>& geometry, boost::shared_ptr<IPhys>& physics, Interaction* interaction) override;

    std::byte accumulators[72];
    bool neverErase;
    bool preventGranularRatcheting;
    bool traceEnergy;
    bool Talesnick;
    bool allowBreakage;
    Real initialOverlapDistance;
    bool allowViscousAttraction;
    int normDampDissipIx;
    int shearDampDissipIx;
    int plastDissipIx;
    int elastPotentialIx;
};
PP_ABI_SIZE(Law2_SCG_KnKsPhys_KnKsLaw, 200);
PP_ABI_OFFSET(Law2_SCG_KnKsPhys_KnKsLaw, neverErase, 160);
PP_ABI_OFFSET(Law2_SCG_KnKsPhys_KnKsLaw, initialOverlapDistance, 168);
PP_ABI_OFFSET(Law2_SCG_KnKsPhys_KnKsLaw, normDampDissipIx, 180);

} // namespace yade
