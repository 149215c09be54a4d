// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the two bodies of a joint in YADE: how it moves, what pushes it, and its shape.
#pragma once

#include "abi/scene.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"

#include "particle/particle.hpp"

#include "plugin-common/joint.hpp"
#include "plugin-common/patch_rim.hpp"

#include <memory>

namespace potential_particles {

// What a joint does to one of its bodies; torque about the body's position.
struct BodyPush {
    yade::Vector3r force, torque;
    bool any = false;
};

// shift: of its periodic image, world axes. A member of a clump moves as the clump does: YADE keeps its velocities up
// to date, its mass is the clump's.
inline JointBody movingBody(const yade::Scene& scene, int id, const yade::Vector3r& shift)
{
    const auto& bodies = scene.bodies->body;
    const yade::Body& body = *bodies[static_cast<std::size_t>(id)];
    const bool inClump = body.clumpId >= 0 && body.clumpId != body.id;
    const yade::State &own = *body.state,
                      &whole = inClump ? *bodies[static_cast<std::size_t>(body.clumpId)]->state : own;
    JointBody moving { own.se3.position + shift, own.se3.orientation, own.vel, own.angVel, {} };
    JointMass& mass = moving.mass;
    mass.centre = whole.se3.position + shift;
    mass.turn = whole.se3.orientation;
    const double overMass = whole.mass > 0 ? 1 / whole.mass : 0;
    for (int i = 0; i < 3; ++i)
        if (!(whole.blockedDOFs >> i & 1))
            mass.overMasses[i] = overMass;
    constexpr unsigned allTurns = 8 + 16 + 32;
    for (int i = 0; i < 3; ++i)
        if ((whole.blockedDOFs & allTurns) != allTurns && whole.inertia[i] > 0)
            mass.overMoments[i] = 1 / whole.inertia[i];
    return moving;
}

// What a joint does to a body goes there, if anywhere, and else to the forces of the scene.
inline void push(yade::Scene& scene, int id, const JointForces::Push& by, BodyPush* into)
{
    if (into) {
        *into = { by.force, by.torque, true };
        return;
    }
    scene.forces().addForce(id, by.force);
    scene.forces().addTorque(id, by.torque);
}

// shift: of its periodic image, world axes. Throws std::invalid_argument for a shape of another kind; one that is
// refused as a particle is taken for a wall.
class PosedBody : public PosedShape {
public:
    PosedBody(const boost::shared_ptr<yade::Shape>& shape, const yade::State& state, const yade::Vector3r& shift);

private:
    std::shared_ptr<const Particle> keeper;
};

} // namespace potential_particles
