// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A contact that begins is solved from nothing.
#pragma once

#include <potential_particles.h>

namespace potential_particles {

// What a pair that does not touch remembers is in no file and goes to no other process: with it, a run that is loaded
// or shared out would be another one, by the last digits. status, found: what ask() has answered; touched: whether it
// touched before; state: of the library, or null.
template <class Found, class Ask>
pp_status fromNothingIfNew(pp_status status, Found& found, bool touched, pp_pair_state* state, Ask&& ask)
{
    if (status != PP_OK || found.kind != PP_OVERLAPPING || touched || !state)
        return status;
    *state = {};
    return ask();
}

} // namespace potential_particles
