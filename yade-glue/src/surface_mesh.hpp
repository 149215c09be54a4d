// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh of a shape, for Python.
#pragma once

#include "../abi/shape.hpp"

#include <boost/python/tuple.hpp>

namespace potential_particles {

// Vertices, normals (3 doubles a row), triangles (3 unsigned 32-bit integers a row), each as bytes, and the bound on the distance
// to the surface. Throws std::invalid_argument for a shape or a tolerance that the library refuses.
boost::python::tuple surfaceMesh(const yade::PotentialParticle& shape, double tolerance);

} // namespace potential_particles
