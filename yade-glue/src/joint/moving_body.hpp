// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the two bodies of a joint: how it moves, and what pushes it.
#pragma once

#include "abi/scene.hpp"
#include "abi/state.hpp"
#include "patch_rim.hpp"

namespace potential_particles {

// What a joint does to one of its bodies; torque about the body's position.
struct BodyPush {
    yade::Vector3r force, torque;
    bool any = false;
};

// A member of a clump moves as the clump does: YADE keeps its velocities up to date, its mass is the clump's.
class MovingBody {
public:
    // shift: of its periodic image, world axes. `into`: where the push of the body is added, if not to the forces of the scene.
    MovingBody(yade::Scene& scene, int id, const yade::Vector3r& shift, BodyPush* into)
        : scene(scene)
        , into(into)
        , body(*scene.bodies->body[static_cast<std::size_t>(id)])
        , position(body.state->se3.position + shift)
        , shift(shift)
    {
    }

    yade::Vector3r velocityAt(const yade::Vector3r& point) const
    {
        return body.state->vel + body.state->angVel.cross(point - position);
    }
    const yade::Vector3r& centre() const { return position; }
    const yade::Quaternionr& turn() const { return body.state->se3.orientation; }
    PosedShape posed() const { return { body.shape, *body.state, shift }; }
    const yade::Vector3r& spin() const { return body.state->angVel; }

    // Velocity in that direction of the point for a unit impulse there in that direction, 1/kg: 0 of a body that is held.
    double mobility(const yade::Vector3r& point, const yade::Vector3r& direction) const
    {
        const bool inClump = body.clumpId >= 0 && body.clumpId != body.id;
        const yade::State& state = inClump ? *scene.bodies->body[static_cast<std::size_t>(body.clumpId)]->state : *body.state;
        double sum = 0;
        if (state.mass > 0)
            for (int i = 0; i < 3; ++i)
                if (!(state.blockedDOFs >> i & 1))
                    sum += direction[i] * direction[i] / state.mass;
        constexpr unsigned allTurns = 8 + 16 + 32;
        if ((state.blockedDOFs & allTurns) != allTurns) {
            const yade::Vector3r lever
                = state.se3.orientation.conjugate() * (point - state.se3.position - shift).cross(direction);
            for (int i = 0; i < 3; ++i)
                if (state.inertia[i] > 0)
                    sum += lever[i] * lever[i] / state.inertia[i];
        }
        return sum;
    }

    void push(const yade::Vector3r& point, const yade::Vector3r& force, const yade::Vector3r& moment) const
    {
        const yade::Vector3r torque = (point - position).cross(force) + moment;
        if (into) {
            into->force = force;
            into->torque = torque;
            into->any = true;
            return;
        }
        scene.forces().addForce(body.id, force);
        scene.forces().addTorque(body.id, torque);
    }

private:
    yade::Scene& scene;
    BodyPush* const into;
    const yade::Body& body;
    yade::Vector3r position;
    yade::Vector3r shift;
};

} // namespace potential_particles
