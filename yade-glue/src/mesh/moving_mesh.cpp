// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/state.hpp"
#include "moving_mesh.hpp"

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>

namespace potential_particles {

using yade::Vector3r;

MovingMesh::~MovingMesh() = default;
PP_CLASS_DEFINITIONS(MovingMesh)
PP_ATTRIBUTE_DEFINITIONS(MovingMesh, GlobalEngine)

namespace {

    void require(bool holds, const char* name, const std::string& value, const char* remedy)
    {
        if (!holds)
            throw std::invalid_argument("MovingMesh: " + std::string(name) + " = " + value + remedy);
    }

    yade::State* stateOf(const yade::Scene& scene, int id)
    {
        const auto& bodies = scene.bodies->body;
        const bool known = id >= 0 && static_cast<std::size_t>(id) < bodies.size();
        return known && bodies[static_cast<std::size_t>(id)] ? bodies[static_cast<std::size_t>(id)]->state.get()
                                                             : nullptr;
    }

} // namespace

void MovingMesh::callPostLoad()
{
    yade::GlobalEngine::callPostLoad();
    const bool axes = std::all_of(free.begin(), free.end(), [this](char axis) {
        return std::string("xyz").find(axis) != std::string::npos && std::count(free.begin(), free.end(), axis) == 1;
    });
    require(axes, "free", '"' + free + '"', " must be some of \"xyz\", each once");
    require(mass >= 0, "mass", text(mass), " must be 0 or more");
    require(mass > 0 || free.empty(), "mass", text(mass), " must be above 0 where axes are free: give mass first");
    require(area >= 0, "area", text(area), " must be 0 or more");
    require(area > 0 || stress.isZero(), "area", text(area),
            " must be above 0 where there is a stress: give area first");
    require(damping >= 0 && damping < 1, "damping", text(damping), " must lie in [0, 1)");
    require(greatestSpeed >= 0, "greatestSpeed", text(greatestSpeed), " must be 0, for none, or more");
}

void MovingMesh::action()
{
    sumContacts();
    const Vector3r before = velocity;
    moveFreeAxes();
    // Of the step, with the mean of the velocities before and after it: what leapfrog's kinetic energy changes by.
    const double work
        = contactForce.dot(0.5 * (before + velocity)) * scene->dt + contactTorque.dot(angularVelocity) * scene->dt;
    contactWork += work;
    if (scene->trackEnergy)
        scene->energy->add(-work, "meshWork", placeOfEnergy, false);
    setVelocities();
}

void MovingMesh::sumContacts()
{
    contactForce = contactTorque = Vector3r::Zero();
    yade::ForceContainer& forces = scene->forces();
    forces.sync();
    for (const int id : ids) {
        const yade::State* const state = stateOf(*scene, id);
        if (!state)
            continue;
        const Vector3r& push = forces.getForce(id);
        contactForce += push;
        contactTorque += forces.getTorque(id) + (state->pos - centre).cross(push);
    }
}

void MovingMesh::moveFreeAxes()
{
    const double dt = scene->dt;
    kineticEnergy = 0;
    for (const char letter : free) {
        const int axis = letter - 'x';
        const double before = velocity[axis];
        const double applied = force[axis] + stress[axis] * area + mass * gravity[axis];
        const double whole = applied + contactForce[axis];
        // YADE's damping: less of what speeds up, more of what slows down.
        const double along = whole * (before + 0.5 * dt * whole / mass);
        double damped = whole * (1 - damping * (along > 0 ? 1.0 : along < 0 ? -1.0 : 0.0));
        double after = before + dt * damped / mass;
        if (greatestSpeed > 0)
            after = std::clamp(after, -greatestSpeed, greatestSpeed);
        damped = mass * (after - before) / dt;
        const double way = 0.5 * (before + after) * dt;
        appliedWork += applied * way;
        dissipated += (whole - damped) * way;
        velocity[axis] = after;
        kineticEnergy += 0.5 * mass * after * after;
    }
}

// Chords of the circles on which the bodies turn, so that they stay on these circles.
void MovingMesh::setVelocities()
{
    const double dt = scene->dt, angle = angularVelocity.norm() * dt;
    const Eigen::Matrix3d turn = angle > 0 ? Eigen::AngleAxisd(angle, angularVelocity.normalized()).toRotationMatrix()
                                           : Eigen::Matrix3d::Identity();
    for (const int id : ids) {
        yade::State* const state = stateOf(*scene, id);
        if (!state)
            continue;
        state->vel = velocity;
        state->angVel = angularVelocity;
        if (angle > 0) {
            const Vector3r arm = state->pos - centre;
            state->vel += (turn * arm - arm) / dt;
        }
    }
    displacement += velocity * dt;
    centre += velocity * dt;
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::MovingMesh)
