// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the virtual tables of our classes have the shape of those of their bases: a slot that a class of ours does
// not override must hold the same function.
#pragma once

#include <string>
#include <vector>

namespace potential_particles {

// Adds each difference as a sentence. Needs a started YADE.
void checkTables(std::vector<std::string>& found);

} // namespace potential_particles
