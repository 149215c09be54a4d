// SPDX-License-Identifier: MIT OR Apache-2.0
#include "bond.hpp"

#include <cmath>

namespace potential_particles {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// With Q1, Q2 the axes of the ends, q = Q1^-1 Q2 = (w, v) of the angle a, H = Q1 sqrt(q) midway, and the bodies' turns
// f1 and f2 in the axes H, the derivatives are
//     dt = G (f2 - f1),  G = (a/2)/sin(a/2) across the axis and 1 along it
//     dH = (f1 + f2)/2 - tan(a/4)/2 axis x (f2 - f1)
BondStrain::BondStrain(const Bond& bond, const BondedBody& one, const BondedBody& other)
    : bond(bond)
    , end1(one.position + one.turn * bond.bondPoint1)
    , end2(other.position + other.turn * bond.bondPoint2)
{
    const Quaterniond axes1 = one.turn * bond.bondTurn1;
    Quaterniond between = axes1.conjugate() * (other.turn * bond.bondTurn2);
    between.normalize();
    if (between.w() < 0)
        between.coeffs() *= -1;
    const double sine = between.vec().norm(), angle = 2 * std::atan2(sine, between.w());
    const Quaterniond half = Quaterniond(1 + between.w(), between.x(), between.y(), between.z()).normalized();
    axes = (axes1.normalized() * half).toRotationMatrix();
    const double stretch = sine > 0 ? 0.5 * angle / sine : 1;
    displacement = axes.transpose() * (end2 - end1) + bond.bondDisplacement;
    rotation = 2 * stretch * between.vec() + bond.bondRotation;
    ofRotation = stretch * Matrix::Identity();
    if (sine > 0)
        ofRotation += (1 - stretch) / (sine * sine) * between.vec() * between.vec().transpose();
    axisPart = axes * (between.vec() / (1 + between.w()));
}

namespace {

    // Under pressure the bond keeps its stiffness across the area, however damaged it is.
    double normalShare(double opening, double damage) { return opening > 0 ? 1 - damage : 1; }

} // namespace

double BondStrain::energy(const BondStiffness& stiffness, double damage) const
{
    const Vector3d& u = displacement;
    const Vector3d& t = rotation;
    const Vector3d& moments = bond.bondMoments;
    const double across = bond.bondArea * normalShare(u.x(), damage) * u.x() * u.x()
        + (1 - damage) * (moments.y() * t.y() * t.y() + moments.z() * t.z() * t.z());
    const double along = bond.bondArea * (u.y() * u.y() + u.z() * u.z()) + moments.x() * t.x() * t.x();
    return 0.5 * (stiffness.normal * across + stiffness.shear * (1 - damage) * along);
}

BondStrain::Reaction BondStrain::reaction(const BondStiffness& stiffness) const
{
    const double left = 1 - bond.damage;
    const double across = stiffness.normal * normalShare(displacement.x(), bond.damage), along = stiffness.shear * left;
    const Vector3d perDisplacement(across, along, along);
    const Vector3d perRotation(along, stiffness.normal * left, stiffness.normal * left);
    const Vector3d force = bond.bondArea * (axes * perDisplacement.cwiseProduct(displacement)); // dW/du
    const Vector3d moment = axes * (ofRotation * perRotation.cwiseProduct(bond.bondMoments).cwiseProduct(rotation));
    // The axes midway turn by half the sum of both bodies' turns, but for what the angle between them adds.
    const Vector3d lever = (end2 - end1).cross(force), added = lever.cross(axisPart);
    return { -force, moment + 0.5 * (lever + added), -moment + 0.5 * (lever - added) };
}

Wrench BondStrain::dashpot(const BondStiffness& perArea, const Vector3d& velocity, const Vector3d& spin) const
{
    const Vector3d v = axes.transpose() * velocity, w = axes.transpose() * spin;
    const Vector3d force
        = bond.bondArea * Vector3d(perArea.normal * v.x(), perArea.shear * v.y(), perArea.shear * v.z());
    const Vector3d moment = bond.bondMoments.cwiseProduct(
        Vector3d(perArea.shear * w.x(), perArea.normal * w.y(), perArea.normal * w.z()));
    return { -(axes * force), -(axes * moment) };
}

} // namespace potential_particles
