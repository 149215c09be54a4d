// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pose of a body as the library takes it.
#pragma once

#include "abi/state.hpp"

#include <potential_particles.h>

namespace potential_particles {

// Of local axes.
constexpr pp_pose identity = { { 0, 0, 0 }, { 1, 0, 0, 0 } };

// shift: of the periodic image in which the body is met.
inline pp_pose poseOf(const yade::State& state, const yade::Vector3r& shift)
{
    const yade::Vector3r at = state.se3.position + shift;
    const yade::Quaternionr& turn = state.se3.orientation;
    return { { at.x(), at.y(), at.z() }, { turn.w(), turn.x(), turn.y(), turn.z() } };
}

} // namespace potential_particles
