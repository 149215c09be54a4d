// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a ray that starts inside a particle leaves it.
#pragma once

#include "abi/base.hpp"
#include "particle.hpp"

namespace potential_particles {

// Distance from `point` (world, inside) to the surface along the unit vector `direction`; 0 when
// the point lies on the surface or, by rounding, outside.
double distanceToSurface(const Particle& particle, const pp_pose& pose, const yade::Vector3r& point,
                         const yade::Vector3r& direction);

} // namespace potential_particles
