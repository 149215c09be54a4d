// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact patch of a pair, for laws that know it.
#pragma once

#include "abi/base.hpp"

#include <potential_particles.h>

#include <cmath>

namespace potential_particles {

// World axes. What is proportional to the stiffness per area is given over it. The direction of the force is ScGeom::normal, the
// point on its axis ScGeom::contactPoint.
struct ContactPatch {
    double area = 0; // 0: there is none
    double force = 0; // length^3
    double couple = 0; // on body 2 about the normal through contactPoint, length^4
    double twistLever = 0; // of friction against twist, length
    double polarMoment = 0; // about the normal through contactPoint, length^4
    double largestDepth = 0; // length
    double energy = 0; // length^4; of scenes that track energy
    yade::Vector3r centroid = yade::Vector3r::Zero(); // from contactPoint
    Eigen::Matrix3d secondMoment = Eigen::Matrix3d::Zero(); // about the centroid, length^4
    bool ofPoint = false; // a disc in the place of a patch that was not found

    static ContactPatch of(const pp_patch& found)
    {
        ContactPatch patch;
        patch.area = found.area;
        patch.force = yade::Vector3r(found.force).norm();
        patch.couple = found.couple;
        patch.twistLever = found.twist_lever;
        patch.polarMoment = found.polar_moment;
        patch.largestDepth = found.largest_depth;
        patch.energy = std::isnan(found.energy) ? 0.0 : found.energy;
        patch.centroid = yade::Vector3r(found.centroid);
        const auto& [xx, yy, zz, xy, yz, zx] = found.second_moment;
        patch.secondMoment << xx, xy, zx, xy, yy, yz, zx, yz, zz;
        return patch;
    }

    // An even pressure on a disc of that area.
    static ContactPatch disc(double area, double depth, const yade::Vector3r& normal)
    {
        ContactPatch patch;
        patch.area = area;
        patch.force = area * depth;
        patch.twistLever = 2.0 / 3.0 * std::sqrt(area / M_PI);
        patch.polarMoment = area * area / (2.0 * M_PI);
        patch.largestDepth = depth;
        patch.energy = 0.5 * area * depth * depth;
        patch.secondMoment = 0.5 * patch.polarMoment * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
        patch.ofPoint = true;
        return patch;
    }
};

} // namespace potential_particles
