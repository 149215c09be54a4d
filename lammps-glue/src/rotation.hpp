// SPDX-License-Identifier: GPL-2.0-or-later
//
// Free rotation of a rigid body over a step, by rotations about its principal axes (Dullweber, Leimkuhler & McLachlan
// 1997): symplectic, reversible, of second order; the angular momentum keeps its value and the orientation its length
// to rounding.
#pragma once

#include <Eigen/Geometry>

#include <cmath>

namespace potential_particles {

// The part of the kinetic energy that belongs to one principal axis, for a time h: a turn about it at constant rate.
template <int axis>
void turnAbout(double h, const Eigen::Vector3d& moments, Eigen::Quaterniond& q, Eigen::Vector3d& bodyMomentum)
{
    constexpr int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double half = 0.5 * h * bodyMomentum[axis] / moments[axis], c = std::cos(half), s = std::sin(half);
    // q times (c, s along the axis), and the momentum turned back by it.
    const double w = q.w();
    const Eigen::Vector3d v = q.vec();
    q.w() = c * w - s * v[axis];
    q.vec()[axis] = c * v[axis] + s * w;
    q.vec()[next] = c * v[next] + s * v[last];
    q.vec()[last] = c * v[last] - s * v[next];
    const double cosine = c * c - s * s, sine = 2 * c * s, p = bodyMomentum[next], r = bodyMomentum[last];
    bodyMomentum[next] = cosine * p + sine * r;
    bodyMomentum[last] = cosine * r - sine * p;
}

// q: local to world. momentum: angular, world axes, about the centre of mass; it does not change.
inline void rotateFreely(double dt, const Eigen::Vector3d& moments, const Eigen::Vector3d& momentum,
                         Eigen::Quaterniond& q)
{
    Eigen::Vector3d inBody = q.conjugate() * momentum;
    turnAbout<0>(0.5 * dt, moments, q, inBody);
    turnAbout<1>(0.5 * dt, moments, q, inBody);
    turnAbout<2>(dt, moments, q, inBody);
    turnAbout<1>(0.5 * dt, moments, q, inBody);
    turnAbout<0>(0.5 * dt, moments, q, inBody);
    q.normalize();
}

// turn: q as a matrix.
inline Eigen::Vector3d momentumOf(const Eigen::Matrix3d& turn, const Eigen::Vector3d& moments,
                                  const Eigen::Vector3d& angularVelocity)
{
    return turn * moments.cwiseProduct(turn.transpose() * angularVelocity);
}

inline Eigen::Vector3d angularVelocityOf(const Eigen::Matrix3d& turn, const Eigen::Vector3d& moments,
                                         const Eigen::Vector3d& momentum)
{
    return turn * (turn.transpose() * momentum).cwiseQuotient(moments);
}

} // namespace potential_particles
