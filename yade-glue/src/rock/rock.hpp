// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's rock masses for Python; the package potential_particles.rock says what the arguments are. Arrays come
// and go as bytes, for numpy, in the structs of potential_particles.h.
#pragma once

#include "abi/base.hpp"

#include <boost/python/dict.hpp>
#include <boost/python/list.hpp>

namespace potential_particles {

// The joint (pp_joint) that is a polygon of these corners, rows of three numbers.
boost::python::object jointFromCorners(const boost::python::object& corners);

// The joints (pp_joint) of a set within reach of a point; `set` holds the fields of pp_joint_set.
boost::python::object jointsOfSet(const boost::python::dict& set, const boost::python::object& centre, double reach);

// Cuts a domain, rows of four numbers, by joints (pp_joint), polygons among them with the corners of all and a list of
// how many belong to each joint, and regions, rows of all of them and a list of how many belong to each. `settings`
// holds the fields of pp_slice_settings; `progress` is None, or called with the numbers of joints and of blocks, and
// ends the cuts where it returns false. A dict of arrays: blocks, faces, corners, partners, missing; and the numbers
// joints, too_small, unclosed.
boost::python::dict sliceRock(const boost::python::object& domain, const boost::python::object& joints,
                              const boost::python::object& outlines, const boost::python::list& outlineCounts,
                              const boost::python::object& regionPlanes, const boost::python::list& regionCounts,
                              const boost::python::dict& settings, const boost::python::object& progress);

} // namespace potential_particles
