// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a packing of bodies asks a scene for.
#pragma once

#include "abi/shape.hpp"
#include "registration/python_class.hpp"

namespace potential_particles {

// Ids of the bodies with a shape that may reach into a box, by their bounds where these hold, as they do in a step, and
// by the balls about our particles; all others among them.
py::list bodiesNear(const yade::Vector3r& lower, const yade::Vector3r& upper, bool boundsHold);

// (planes (a, b, c, d), r, k, R) of a shape that is a particle, local axes; None for others.
py::object definitionOf(const yade::Shape& shape);

} // namespace potential_particles
