// SPDX-License-Identifier: GPL-3.0-or-later
//
// The dispatchers of an InteractionLoop: which functor serves a pair of classes. Never made here, and no virtual
// function of theirs is called, so that none of their own is declared.
#pragma once

#include "engine.hpp"
#include "functor.hpp"

namespace yade {

// Rows and columns are class indices; no functor where a pair of classes has not been met, or has none.
template <class FunctorType> using FunctorMatrix = std::vector<std::vector<boost::shared_ptr<FunctorType>>>;

class IGeomDispatcher : public Engine {
public:
    IGeomDispatcher() = delete;

    FunctorMatrix<IGeomFunctor> callBacks;
    std::vector<std::vector<int>> callBacksInfo; // 1: for the bodies in the other order
    bool alreadyWarnedNoCollider;
    std::vector<boost::shared_ptr<IGeomFunctor>> functors;
};
PP_ABI_OFFSET(IGeomDispatcher, callBacks, 104);
PP_ABI_OFFSET(IGeomDispatcher, functors, 160);

class IPhysDispatcher : public Engine {
public:
    IPhysDispatcher() = delete;

    FunctorMatrix<IPhysFunctor> callBacks;
    std::vector<std::vector<int>> callBacksInfo;
    std::vector<boost::shared_ptr<IPhysFunctor>> functors;
};
PP_ABI_OFFSET(IPhysDispatcher, functors, 152);

class LawDispatcher : public Engine {
public:
    LawDispatcher() = delete;

    FunctorMatrix<LawFunctor> callBacks;
    std::vector<std::vector<int>> callBacksInfo;
    std::vector<boost::shared_ptr<LawFunctor>> functors;
};
PP_ABI_OFFSET(LawDispatcher, functors, 152);

} // namespace yade
