// SPDX-License-Identifier: GPL-3.0-or-later
//
// State: where a body is and how it moves.
#pragma once

#include "indexable.hpp"
#include "serializable.hpp"

#include <mutex>

namespace yade {

// A template, since its name is part of the names of functions.
template <class Number> struct Se3 {
    Vector3r position;
    Quaternionr orientation;
};
using Se3r = Se3<Real>;

class State : public Serializable, public Indexable {
public:
    State();
    ~State() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_TOP_INDEX_OVERRIDES

    Vector3r& pos; // se3.position
    Quaternionr& ori; // se3.orientation
    std::mutex updateMutex;
    Se3r se3;
    Vector3r vel;
    Real mass;
    Vector3r angVel;
    Vector3r angMom;
    Vector3r inertia;
    Vector3r refPos;
    Quaternionr refOri;
    unsigned blockedDOFs;
    bool isDamped;
    Real densityScaling;
};
PP_ABI_SIZE(State, 320);
PP_ABI_OFFSET(State, updateMutex, 48);
PP_ABI_OFFSET(State, se3, 88);
PP_ABI_OFFSET(State, vel, 144);
PP_ABI_OFFSET(State, mass, 168);
PP_ABI_OFFSET(State, angVel, 176);
PP_ABI_OFFSET(State, angMom, 200);
PP_ABI_OFFSET(State, inertia, 224);
PP_ABI_OFFSET(State, refPos, 248);
PP_ABI_OFFSET(State, refOri, 272);
PP_ABI_OFFSET(State, blockedDOFs, 304);
PP_ABI_OFFSET(State, isDamped, 308);
PP_ABI_OFFSET(State, densityScaling, 312);

} // namespace yade
