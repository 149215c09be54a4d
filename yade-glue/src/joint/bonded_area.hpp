// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a contact patch to the bond of its area.
#pragma once

#include "conic_joint_phys.hpp"
#include "moving_body.hpp"
#include "patch_rim.hpp"

namespace potential_particles {

// Bonds the patch as it is. held: what the springs of the joint hold now, on body 2 about the centre of pressure; those of the bond begin
// with the same.
void bondPatch(ConicJointPhys& phys, const ContactPatch& patch, const PatchPlace& place, const Wrench& held, const MovingBody& one,
               const MovingBody& other);

} // namespace potential_particles
