// SPDX-License-Identifier: GPL-2.0-or-later
//
// Numbers, files and what a command says of a contact, as they enter: checked once, here, on all ranks alike.
#pragma once

#include "plugin-common/joint.hpp"
#include "plugin-common/point_law.hpp"

#include "lammps.h"
#include "pointers.h"

#include <string>

namespace potential_particles {

// No number of a command is larger, nor is one that must be above 0 smaller than its inverse: products of three are
// finite.
constexpr double bearable = 1e100;

// The number in `text`; ends LAMMPS, in the name of `command`, where it is no number or outside [low, high]. With
// `orZero`, 0 is valid too.
double numberIn(LAMMPS_NS::LAMMPS* lmp, const std::string& command, const std::string& what, const char* text,
                double low = -bearable, double high = bearable, bool orZero = false);

// Of a file, whatever the locale; NaN where the whole word is no number.
double numberOf(const std::string& word);

// Called by all ranks: where one has a reason, all end with that of the lowest. (An error of one rank alone ends the
// others before they, and maybe it, have said so.)
void endWhereAny(LAMMPS_NS::LAMMPS* lmp, const std::string& why);

// Bytes of a file that rank 0 reads for all; ends LAMMPS on all ranks where it cannot be read.
std::string fileForAll(LAMMPS_NS::LAMMPS* lmp, const std::string& path);

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
