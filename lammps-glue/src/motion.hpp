// SPDX-License-Identifier: GPL-2.0-or-later
//
// How far the surface of a body can have come between two poses.
#pragma once

#include <potential_particles.h>

#include <Eigen/Core>

namespace potential_particles {

// Bound on the way of any point of a body within `radius` of its centre. Two unit quaternions at a distance c belong to a turn by t with
// c = 2 sin(t/4), and 2 r sin(t/2) <= 2 r c. A quaternion that changes its sign counts as a turn: the bound holds all the more.
inline double wayBetween(const pp_pose& from, const pp_pose& to, double radius)
{
    using Eigen::Map;
    return (Map<const Eigen::Vector3d>(to.position) - Map<const Eigen::Vector3d>(from.position)).norm()
        + 2 * radius * (Map<const Eigen::Vector4d>(to.orientation) - Map<const Eigen::Vector4d>(from.orientation)).norm();
}

// What is further apart than this share of a size sleeps until it can have met; what is nearer would wake too often.
constexpr double farShare = 1e-3;

} // namespace potential_particles
