// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the running YADE is laid out as ../abi declares it.
#pragma once

#include <string>
#include <vector>

namespace potential_particles {

// Every difference found, as a sentence; empty when there is none. Needs a started YADE.
std::vector<std::string> differencesOfLayout();

} // namespace potential_particles
