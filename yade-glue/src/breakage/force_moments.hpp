// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the contacts of each body make of its mean stress (Love-Weber).
#pragma once

#include "abi/scene.hpp"

#include <vector>

namespace potential_particles {

using Tensor = Eigen::Matrix3d;

// Of each body the sum over its contacts of f (x_c - x)^T, N m, into `sums` by id: f the force on it at the contact
// point x_c, x its centre of mass, of a member of a clump the clump's. Over the volume that is its mean stress, tension
// positive. Contacts count that overlap or are bonded; they are added up in the order of ids.
void sumForceMoments(const yade::Scene& scene, std::vector<Tensor>& sums);

// The volume of a body by its mass; 0 where that is not known.
double volumeByMass(const yade::Body& body);

} // namespace potential_particles
