// SPDX-License-Identifier: GPL-3.0-or-later
//
// One call of a functor for a flat boundary and a particle.
#pragma once

#include "abi/scene.hpp"
#include "loop/in_step.hpp"
#include "loop/relative_motion.hpp"
#include "pair_in_scene.hpp"
#include "particle/particle.hpp"

namespace potential_particles {

struct FlatPair : PairInScene {
    const yade::Shape& boundary;

    // In a loop of our own: the bodies as it has gathered them, and what it knows of the pair, if it may skip it.
    const BodyInStep* const body1 = nullptr;
    const BodyInStep* const body2 = nullptr;
    PairInStep* const known = nullptr;

    const Particle* particle = nullptr;
    std::shared_ptr<const Particle> keeper = nullptr;

    yade::Vector3r centre() const { return state2.se3.position + shift2; }

    KeptApart::Turned turned() const { return { *particle, state2.se3.orientation }; }

    // The particle is at the origin: no digits are lost far from the scene's origin.
    pp_pose turn() const
    {
        const yade::Quaternionr& q = state2.se3.orientation;
        return { { 0, 0, 0 }, { q.w(), q.x(), q.y(), q.z() } };
    }

    void precompute(const yade::Vector3r& normal, const yade::Scene* scene)
    {
        if (body1 && own)
            turnFrame(*geom, *body1, *body2, scene->dt, normal, !real);
        else
            PairInScene::precompute(normal, scene);
    }

    bool isKeptApart(const BoundaryPoints& points)
    {
        const double left = own ? own->apart.left(points, turned()) : 0;
        if (left > 0)
            noteRoom(left);
        return left > 0;
    }

    void noteDistance(const BoundaryPoints& points, double distance)
    {
        if (own)
            noteRoom(own->apart.note(points, turned(), distance));
    }

    void noteTouching()
    {
        if (own)
            own->apart.forget();
        if (known)
            known->wakes = 0;
    }

    // A pair with physics is never skipped: its law runs in each step.
    void noteRoom(double room)
    {
        if (known)
            known->note(interaction, *body1, *body2, real ? 0 : room);
    }
};

} // namespace potential_particles
