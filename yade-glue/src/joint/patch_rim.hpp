// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a contact patch covers in its plane.
#pragma once

#include "abi/shape.hpp"
#include "abi/state.hpp"
#include "pair/contact_patch.hpp"
#include "pair/kept_apart.hpp"
#include "particle/particle.hpp"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace potential_particles {

// Where a patch lies: the centre of its pressure, and its normal.
struct PatchPlace {
    const yade::Vector3r& point;
    const yade::Vector3r& normal;
};

// A body of a contact: a particle, a wall or a facet.
class PosedShape {
public:
    // shift: of its periodic image, world axes. Throws std::invalid_argument for a shape of another kind; one that is
    // refused as a particle is taken for a wall.
    PosedShape(const boost::shared_ptr<yade::Shape>& shape, const yade::State& state, const yade::Vector3r& shift);

    // length (1 - s) of a particle, its part of the depth of a patch there, and its gradient; 0 of a boundary.
    double depth(const yade::Vector3r& point, yade::Vector3r* gradient = nullptr) const;

    // No point of a particle is farther; 0 of a boundary.
    double reach(const yade::Vector3r& point) const;

    // Where a ray leaves something, and the direction outwards there.
    struct Exit {
        double length;
        yade::Vector3r outward;
    };
    // Over the edges of a facet; never, of others.
    Exit exitOfFacet(const yade::Vector3r& point, const yade::Vector3r& direction) const;

private:
    bool isFacet;
    pp_pose pose;
    BoundaryPoints vertices;
    const Particle* particle = nullptr;
    std::shared_ptr<const Particle> keeper;
    double depthLength = 0;
};

// Principal axes of the area of a patch in the plane across its normal.
struct PatchFrame {
    PatchFrame(const ContactPatch& patch, const PatchPlace& place);

    yade::Vector3r centroid; // world
    Eigen::Matrix3d axes; // columns: normal, y and z
    double alongY, alongZ; // the integrals of y^2 and z^2 over the area

    yade::Vector3r at(const Eigen::Vector2d& point) const { return centroid + axes.col(1) * point.x() + axes.col(2) * point.y(); }
};

// The corners of a patch, y and z of its frame, counter-clockwise about the normal: where the depths of both bodies add up to 0, which does
// not depend on how far off its plane one looks. An ellipse of the same moments where the patch is a disc in the
// place of one, or leaves its plane so far that what lies in it has another area.
std::vector<Eigen::Vector2d> rimOf(const ContactPatch& patch, const PatchFrame& frame, const PosedShape& one, const PosedShape& other);

} // namespace potential_particles
