// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a contact patch covers in its plane.
#pragma once

#include "contact_patch.hpp"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace potential_particles {

// Where a patch lies: the centre of its pressure, and its normal.
struct PatchPlace {
    const Eigen::Vector3d& point;
    const Eigen::Vector3d& normal;
};

// A body of a contact: a particle, or a boundary.
struct PosedShape {
    const pp_particle* particle = nullptr; // none: a boundary
    pp_pose pose {};
    double boundingRadius = 0, depthLength = 0; // of the particle; pp_particle_depth_length
    std::optional<std::array<Eigen::Vector3d, 3>> triangle; // of a boundary that has edges

    // length (1 - s) of a particle, its part of the depth of a patch there, and its gradient; 0 of a boundary.
    double depth(const Eigen::Vector3d& point, Eigen::Vector3d* gradient = nullptr) const;

    // No point of a particle is farther; 0 of a boundary.
    double reach(const Eigen::Vector3d& point) const;

    // Where a ray leaves something, and the direction outwards there.
    struct Exit {
        double length;
        Eigen::Vector3d outward;
    };
    // Over the edges of a triangle; never, of others.
    Exit exitOfTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
};

// Principal axes of the area of a patch in the plane across its normal.
struct PatchFrame {
    PatchFrame(const ContactPatch& patch, const PatchPlace& place);

    Eigen::Vector3d centroid; // world
    Eigen::Matrix3d axes; // columns: normal, y and z
    double alongY, alongZ; // the integrals of y^2 and z^2 over the area

    Eigen::Vector3d at(const Eigen::Vector2d& point) const
    {
        return centroid + axes.col(1) * point.x() + axes.col(2) * point.y();
    }
};

// The corners of a patch, y and z of its frame, counter-clockwise about the normal: where the depths of both bodies add
// up to 0, which does not depend on the distance from its plane. An ellipse of the same moments where a disc replaces
// the patch, or it leaves its plane so far that the area within it differs. Throws std::runtime_error where the library
// refuses a pose.
std::vector<Eigen::Vector2d> rimOf(const ContactPatch& patch, const PatchFrame& frame, const PosedShape& one,
                                   const PosedShape& other);

} // namespace potential_particles
