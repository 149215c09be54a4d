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
    bool withoutSolve; // answered apart and no solver was started
};

constexpr AnswerPath answerPaths[] = {
    { Count::motion, "motion", true }, // apart: they have moved less than the distance that was between them
    { Count::spheres, "spheres", true }, // apart: so are the balls around them
    { Count::face, "face", true }, // apart: one lies beyond a face of the other
    { Count::memory, "memory", true }, // apart: what separated them in the last step still does
    { Count::proof, "proof",
      false }, // apart: the solver met a proof on its way, or what it knew of the last step is carried on
    { Count::carried, "carried", false }, // touching: the contact of the last step, carried on
    { Count::warm, "warm", false }, // solved from the remembered point
    { Count::cold, "cold", false }, // solved cold
    { Count::coneProgram, "cone_program", false }, // solved as a cone program
};

inline Count pathOf(const pp_contact& found)
{
    if (found.flags & PP_FLAG_BY_SPHERES)
        return Count::spheres;
    if (found.flags & PP_FLAG_BY_FACE)
        return Count::face;
    if (found.flags & PP_FLAG_BY_MEMORY)
        return Count::memory;
    if (found.back_end == PP_CONE_PROGRAM)
        return Count::coneProgram;
    if (found.flags & PP_FLAG_REJECTED)
        return Count::proof;
    if (found.flags & PP_FLAG_CARRIED)
        return Count::carried;
    return found.flags & PP_FLAG_WARM ? Count::warm : Count::cold;
}

} // namespace potential_particles
