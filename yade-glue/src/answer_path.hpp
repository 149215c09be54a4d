// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ways in which a pair may be answered, cheapest first.
#pragma once

#include "counters.hpp"

#include <potential_particles.h>

namespace potential_particles {

struct AnswerPath {
    Count count;
    const char* name; // in Python
    bool withoutSolve; // no solver was started
};

constexpr AnswerPath answerPaths[] = {
    { Count::balls, "balls", true }, // apart: so are the balls around them
    { Count::bounds, "bounds", true }, // apart, by a face, a direction or whatever else needs no solver
    { Count::proof, "proof", false }, // apart: the solver met a proof on its way
    { Count::warm, "warm", false }, // solved from the remembered point
    { Count::cold, "cold", false }, // solved from nothing
    { Count::conic, "conic", false }, // solved as a cone program
};

// distance: of the centres; radii: of both bounding balls together.
inline Count pathOf(const pp_contact& found, double distance, double radii)
{
    const bool rejected = found.flags & PP_FLAG_REJECTED;
    if (rejected && found.iterations == 0)
        return distance > radii ? Count::balls : Count::bounds;
    if (found.back_end == PP_CONIC)
        return Count::conic;
    if (rejected)
        return Count::proof;
    return found.flags & PP_FLAG_WARM ? Count::warm : Count::cold;
}

} // namespace potential_particles
