// SPDX-License-Identifier: GPL-2.0-or-later
//
// Free rotation of a rigid body over a step, by rotations about its principal axes (Dullweber, Leimkuhler & McLachlan 1997): symplectic,
// reversible, of second order; the angular momentum keeps its value and the orientation its length to rounding.
#pragma once

#include <Eigen/Geometry>

namespace potential_particles {

// The part of the kinetic energy that belongs to one principal axis, for a time h: a turn about it at constant rate.
inline void turnAbout(int axis, double h, const Eigen::Vector3d& moments, Eigen::Quaterniond& q, Eigen::Vector3d& bodyMomentum)
{
    const double angle = h * bodyMomentum[axis] / moments[axis];
    Eigen::Quaterniond turn(std::cos(0.5 * angle), 0, 0, 0);
    turn.vec()[axis] = std::sin(0.5 * angle);
    q = q * turn;
    bodyMomentum = turn.conjugate() * bodyMomentum;
}

// q: local to world. momentum: angular, world axes, about the centre of mass; it does not change.
inline void rotateFreely(double dt, const Eigen::Vector3d& moments, const Eigen::Vector3d& momentum, Eigen::Quaterniond& q)
{
    Eigen::Vector3d inBody = q.conjugate() * momentum;
    turnAbout(0, 0.5 * dt, moments, q, inBody);
    turnAbout(1, 0.5 * dt, moments, q, inBody);
    turnAbout(2, dt, moments, q, inBody);
    turnAbout(1, 0.5 * dt, moments, q, inBody);
    turnAbout(0, 0.5 * dt, moments, q, inBody);
    q.normalize();
}

inline Eigen::Vector3d momentumOf(const Eigen::Quaterniond& q, const Eigen::Vector3d& moments, const Eigen::Vector3d& angularVelocity)
{
    return q * moments.cwiseProduct(q.conjugate() * angularVelocity);
}

inline Eigen::Vector3d angularVelocityOf(const Eigen::Quaterniond& q, const Eigen::Vector3d& moments, const Eigen::Vector3d& momentum)
{
    return q * (q.conjugate() * momentum).cwiseQuotient(moments);
}

} // namespace potential_particles
