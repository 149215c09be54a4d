// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A contact that begins is solved cold.
#pragma once

#include <potential_particles.h>

namespace potential_particles {

// The memory of a pair that does not touch is neither saved nor sent to another process: with it, a run that is loaded
// or divided would differ in the last digits. status, found: what ask() has answered; touched: whether it touched
// before; state: of the library, or null.
template <class Found, class Ask>
pp_status fromNothingIfNew(pp_status status, Found& found, bool touched, pp_pair_state* state, Ask&& ask)
{
    if (status != PP_OK || found.kind != PP_OVERLAPPING || touched || !state)
        return status;
    *state = {};
    return ask();
}

} // namespace potential_particles
