// SPDX-License-Identifier: GPL-3.0-or-later
//
// The particles that YADE's spheres and boxes are.
#pragma once

#include "abi/primitives.hpp"
#include "particle.hpp"

namespace potential_particles {

// Edges and corners of a box are rounded by this share of its least half size: as little as makes no difference to any
// contact, and over a thousand times what the contact area needs (pp_contact_area). The faces stay where they are.
constexpr double boxRounding = 1e-6;

// k = 1: the shadow sphere alone.
Definition definitionOf(const yade::Sphere& sphere);
// k = 0: six planes.
Definition definitionOf(const yade::Box& box);

// Whether the particle of the shape has this definition, bit for bit, without making it anew.
bool describes(const Definition& definition, const yade::Sphere& sphere);
bool describes(const Definition& definition, const yade::Box& box);

} // namespace potential_particles
