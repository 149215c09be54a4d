// SPDX-License-Identifier: GPL-3.0-or-later
//
// A contact patch as triangles, for Python.
#pragma once

#include "abi/scgeom.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"

#include <boost/python/tuple.hpp>

namespace potential_particles {

// The patch that a functor with patch=True left in the geometry of two bodies, in its mean plane: corners of triangles
// (9 doubles a row, world axes, in the image of body 1; counter-clockwise about the normal) and the depth at them,
// pressure over stiffness per area (3 doubles a row), each as bytes; none without a patch. shift2: of the periodic
// image of body 2, world axes.
boost::python::tuple patchSurface(const yade::ScGeom& geometry, const boost::shared_ptr<yade::Shape>& shape1,
                                  const yade::State& state1, const boost::shared_ptr<yade::Shape>& shape2,
                                  const yade::State& state2, const yade::Vector3r& shift2);

} // namespace potential_particles
