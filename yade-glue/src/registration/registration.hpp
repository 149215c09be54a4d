// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes our classes known to YADE.
#pragma once

namespace potential_particles {

// To YADE's factory, class table and Python module yade.wrapper, in the order of class_table.inc. Throws
// std::runtime_error when a name is taken.
void registerClasses();

} // namespace potential_particles
