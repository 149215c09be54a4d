// SPDX-License-Identifier: GPL-3.0-or-later
//
// One call of a functor for a flat boundary and a particle.
#pragma once

#include "pair_in_scene.hpp"
#include "particle/particle.hpp"

namespace potential_particles {

struct FlatPair : PairInScene {
    const yade::Shape& boundary;

    const Particle* particle = nullptr;
    std::shared_ptr<const Particle> keeper = nullptr;

    yade::Vector3r centre() const { return state2.se3.position + shift2; }

    KeptApart::Turned turned() const { return { *particle, state2.se3.orientation }; }

    // With the particle in the origin: far from that of the scene no digits are lost.
    pp_pose turn() const
    {
        const yade::Quaternionr& q = state2.se3.orientation;
        return { { 0, 0, 0 }, { q.w(), q.x(), q.y(), q.z() } };
    }

    bool isKeptApart(const BoundaryPoints& points) const
    {
        return own && own->apart.left(points, turned()) > 0;
    }

    void noteDistance(const BoundaryPoints& points, double distance)
    {
        if (own)
            own->apart.note(points, turned(), distance);
    }

    void noteTouching()
    {
        if (own)
            own->apart.forget();
    }
};

} // namespace potential_particles
