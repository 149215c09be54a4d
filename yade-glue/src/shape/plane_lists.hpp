// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lists of a shape: how scripts set them while a step in another thread may read them.
#pragma once

#include "abi/shape.hpp"

#include <string>
#include <vector>

#include <boost/python/object.hpp>

namespace potential_particles {

// Sets the vertices, which YADE's bounds functor reads without any lock: its loop must find, whenever
// it looks, memory that is still there.
void setVertices(yade::PotentialParticle& shape, std::vector<yade::Vector3r> vertices);

// Sets one of a, b, c, d, which contact functors read through the ParticleStore: under its lock.
void setList(yade::PotentialParticle& shape, std::vector<double> yade::PotentialParticle::*list,
             std::vector<double> values);

// Either, by name, from a Python sequence. False when the name is none of them.
bool setList(yade::PotentialParticle& shape, const std::string& name, const boost::python::object& value);

} // namespace potential_particles
