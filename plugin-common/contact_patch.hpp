// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The contact patch of a pair, for laws that know it.
#pragma once

#include <potential_particles.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>

namespace potential_particles {

// World axes. Values proportional to stiffness per area are divided by it. Direction and place of the force, the centre
// of pressure, come with it.
struct ContactPatch {
    double area = 0; // 0: there is none
    double force = 0; // length^3
    double couple = 0; // on body 2 about the normal through the centre of pressure, length^4
    double twistLever = 0; // of friction against twist, length
    double polarMoment = 0; // about the normal through the centre of pressure, length^4
    double largestDepth = 0; // length
    double energy = 0; // length^4, if it was asked for
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero(); // from the centre of pressure
    Eigen::Matrix3d secondMoment = Eigen::Matrix3d::Zero(); // about the centroid, length^4
    bool ofPoint = false; // a disc in the place of a patch that was not found

    static ContactPatch of(const pp_patch& found)
    {
        ContactPatch patch;
        patch.area = found.area;
        patch.force = Eigen::Vector3d(found.force).norm();
        patch.couple = found.couple;
        patch.twistLever = found.twist_lever;
        patch.polarMoment = found.polar_moment;
        patch.largestDepth = found.largest_depth;
        patch.energy = std::isnan(found.energy) ? 0.0 : found.energy;
        patch.centroid = Eigen::Vector3d(found.centroid);
        const auto& [xx, yy, zz, xy, yz, zx] = found.second_moment;
        patch.secondMoment << xx, xy, zx, xy, yy, yz, zx, yz, zz;
        patch.boundLever();
        return patch;
    }

    // An even pressure on a disc of that area.
    static ContactPatch disc(double area, double depth, const Eigen::Vector3d& normal)
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

private:
    // The library sums |y| over the few points at which it has the pressure, and |y| has a kink: on a triangle it is 7
    // % off. Under an even pressure it is 0.976 to 1.02 times that of the ellipse with the same moments, for triangles,
    // rectangles and ellipses of any proportions.
    void boundLever()
    {
        const double trace = secondMoment.trace();
        const double product = 0.5 * (trace * trace - secondMoment.squaredNorm()); // of the two in the plane
        if (!(trace > 0 && area > 0))
            return;
        const double root = 2 * std::sqrt(std::max(0.0, product)), whole = trace + root;
        // Ramanujan's perimeter of an ellipse with the half axes a and b, over pi (a + b); h = ((a - b)/(a + b))^2.
        const double h = (trace - root) / whole, perimeter = 1 + 3 * h / (10 + std::sqrt(4 - 3 * h));
        const double ofEllipse = 2.0 / 3.0 * perimeter * std::sqrt(whole * polarMoment / (trace * area));
        twistLever = std::clamp(twistLever, 0.975 * ofEllipse, 1.02 * ofEllipse);
    }
};

// Where two bodies overlap.
struct PatchInStep {
    ContactPatch patch; // area 0: an overlap of nothing but rounding
    Eigen::Vector3d point, normal; // centre of pressure; direction of the force on the second body

    // The library's patch, in its axes and from its origin; nothing where it is invalid: a disc at the contact's point
    // then replaces it. The pressure nowhere exceeds that of the largest depth: a larger force is invalid.
    static std::optional<PatchInStep> of(pp_status status, const pp_patch& found)
    {
        const Eigen::Vector3d force(found.force);
        const double size = force.norm();
        if (status != PP_OK || (found.flags & PP_PATCH_EMPTY) || !(found.area > 0) || !(size > 0)
            || size > 1.1 * found.area * found.largest_depth)
            return {};
        return PatchInStep { ContactPatch::of(found), Eigen::Vector3d(found.pressure_centre), 1 / size * force };
    }
};

} // namespace potential_particles
