// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's builders of shapes for Python; the package's solids.py says what they are.
#pragma once

#include "abi/base.hpp"

#include <boost/python/dict.hpp>

namespace potential_particles {

// The particle whose faces are these planes, rows of four doubles as bytes, or that is the hull of these points, rows of three, about its
// centroid along its principal axes. r and R are shares of the size, R = 0 for the distance of the farthest corner. A dict of the fields of a Shape.
boost::python::dict shapeOfFaces(const boost::python::object& planes, double r, double k, double R);
boost::python::dict shapeOfPoints(const boost::python::object& points, double r, double k, double R);

} // namespace potential_particles
