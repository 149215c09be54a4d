// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the running YADE is laid out as ../abi declares it.
#pragma once

#include <string>
#include <vector>

namespace potential_particles {

// Every difference found, as a sentence; empty when there is none. Needs a started YADE.
std::vector<std::string> differencesOfLayout();

// Adds a sentence for each of our virtual tables that has not the shape of its base's: a slot that a class of ours does
// not override must hold the same function. Needs a started YADE.
void checkTables(std::vector<std::string>& found);

} // namespace potential_particles
