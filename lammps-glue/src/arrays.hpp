// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS's rows of three numbers as vectors.
#pragma once

#include <Eigen/Core>

namespace potential_particles {

inline Eigen::Vector3d vector(const double* x) { return Eigen::Vector3d(x); }

inline void add(double* to, const Eigen::Vector3d& what) { Eigen::Map<Eigen::Vector3d> { to } += what; }

} // namespace potential_particles
