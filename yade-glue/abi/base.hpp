// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every declaration of a YADE class here builds on.
//
// Debian ships YADE without headers. The files in this folder declare, in our own words, those
// classes of Debian's YADE (amd64) that the glue touches: their virtual functions in vtable order
// and their fields in memory order, no bodies; builds.hpp has the differences between versions. The
// definitions, vtables and type information are those of the installed libraries. Three things keep
// the declarations honest: the assertions on size and offsets beside each class, check_abi.py at
// build time, and load_check.cpp when the module is imported.
#pragma once

#include "builds.hpp"

// Python's header must come before any standard header.
#include <boost/python/detail/wrap_python.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>

// Debian builds YADE without vector instructions. Eigen's own default would align quaternions to
// 16 bytes and shift every field of State behind its mutex.
#ifndef EIGEN_DONT_ALIGN
#error "compile with -DEIGEN_DONT_ALIGN: YADE's classes are laid out without Eigen's alignment"
#endif
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace yade {

using Real = double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Vector3i = Eigen::Matrix<int, 3, 1>;
using Quaternionr = Eigen::Quaternion<Real>;

class Scene;
class Interaction;

static_assert(sizeof(Vector3r) == 24 && alignof(Vector3r) == 8);
static_assert(sizeof(Quaternionr) == 32 && alignof(Quaternionr) == 8);

} // namespace yade

// The classes have virtual functions, so offsetof on them is "conditionally supported"; GCC
// supports it for single inheritance without virtual bases, which is all that occurs here.
#define PP_ABI_ASSERT(condition, what) static_assert(condition, what)
#define PP_ABI_SIZE(Class, bytes)                                                                                      \
    PP_ABI_PROBE(Class)                                                                                                \
    PP_ABI_ASSERT(sizeof(Class) == (bytes), "size of " #Class)
#define PP_ABI_OFFSET(Class, field, bytes)                                                                             \
    PP_ABI_ASSERT(offsetof(Class, field) == (bytes), "offset of " #Class "::" #field)
#ifndef PP_ABI_PROBE // probe.cpp has one
#define PP_ABI_PROBE(Class)
#endif

#pragma GCC diagnostic ignored "-Winvalid-offsetof"
