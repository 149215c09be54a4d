// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a command says of a contact: KN KS FRICTION RESTITUTION, and of contacts by patch their strength.
#pragma once

#include "plugin-common/point_law.hpp"
#include "plugin-common/joint.hpp"

#include "pointers.h"

namespace potential_particles {

constexpr double lowestRestitution = 0.01;
constexpr const char* strengthWords = "cohesion C, tension T, residual FRICTION COHESION, softening W";

// From arguments[at] on: four numbers. Ends LAMMPS, in the name of `command`, where one is no number or invalid.
LawParameters readLaw(LAMMPS_NS::LAMMPS* lmp, const char* command, char** arguments, int at);

// The same numbers, with stiffnesses per area, and no strength.
JointParameters jointOf(const LawParameters& law);

// `patch TOL`.
double readPatchTolerance(LAMMPS_NS::LAMMPS* lmp, const char* command, const char* text);

// Takes a word of strength with its numbers, if there is one at `at`: how many arguments it was, or 0.
int readStrength(LAMMPS_NS::LAMMPS* lmp, const char* command, char** arguments, int at, int count,
                 JointParameters& joint);

} // namespace potential_particles
