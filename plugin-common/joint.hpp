// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A joint between two bodies: what it is made of, what it remembers, how its bodies move, and what it does to them. Any
// unit system; vectors in world axes; body 2 against body 1, and forces on body 2, unless said otherwise.
#pragma once

#include "bond.hpp"
#include "joint_sides.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace potential_particles {

struct JointParameters {
    double normalStiffness = 0, shearStiffness = 0; // per area
    double friction = 0; // coefficient
    double dampingRatio = 0; // of dashpots to the critical ones (restitution.hpp)
    double cohesion = 0, tensileStrength = 0; // stresses
    double residualFriction = 0, residualCohesion = 0; // once the joint has broken
    double softening = 0; // opening or slip over which the stress in a bond falls to 0; 0: brittle
};

struct JointMemory : Bond, JointLoad {
    Eigen::Vector3d shearDisplacement = Eigen::Vector3d::Zero(); // elastic part, along the joint
    double twist = 0; // elastic part of the turn about the normal
    double energyAlong = 0; // of both in the last step
    bool broken = false; // it has slipped, opened, or was made without strength: residual values hold
};

// How a body opposes impulses.
struct JointMass {
    Eigen::Vector3d overMasses { 0, 0, 0 }; // 1/m along world axes; 0 where it cannot move
    Eigen::Vector3d overMoments { 0, 0, 0 }; // of inertia, along its axes
    Eigen::Vector3d centre { 0, 0, 0 };
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();

    bool isHeld() const { return !((overMasses.array() > 0).any() || (overMoments.array() > 0).any()); }
};

struct JointBody {
    Eigen::Vector3d centre;
    Eigen::Quaterniond turn; // local to world
    Eigen::Vector3d velocity, spin;
    JointMass mass; // its own, or that of the assembly it belongs to

    Eigen::Vector3d velocityAt(const Eigen::Vector3d& point) const { return velocity + spin.cross(point - centre); }

    // Velocity in that direction of the point for a unit impulse there in that direction: 0 of a body that is held.
    double mobility(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const
    {
        const Eigen::Vector3d lever = mass.turn.conjugate() * (point - mass.centre).cross(direction);
        return direction.cwiseAbs2().dot(mass.overMasses) + lever.cwiseAbs2().dot(mass.overMoments);
    }
};

// Where a contact is, and what has happened there in this step.
struct JointMotion {
    Eigen::Vector3d point; // centre of pressure
    Eigen::Vector3d normal; // unit, from body 1 to body 2
    Eigen::Vector3d shearIncrement; // of the point, along the joint
    Eigen::Vector3d rolled; // normal of the last step times the present one
    Eigen::Vector3d twisted; // mean turn of both bodies about the normal of the last step

    // To first order, a vector along the joint of the last step.
    void carry(Eigen::Vector3d& tangent) const
    {
        tangent -= tangent.cross(rolled).eval();
        tangent -= tangent.cross(twisted).eval();
    }

    // lastNormal: 0 for a contact that is new.
    static JointMotion of(const JointBody& one, const JointBody& other, const Eigen::Vector3d& point,
                          const Eigen::Vector3d& normal, const Eigen::Vector3d& lastNormal, double dt)
    {
        const Eigen::Vector3d velocity = other.velocityAt(point) - one.velocityAt(point);
        return { point, normal, dt * (velocity - normal.dot(velocity) * normal), lastNormal.cross(normal),
                 0.5 * dt * lastNormal.dot(one.spin + other.spin) * lastNormal };
    }
};

// elastic: what the joint holds now. The others: what this step took from it.
struct JointEnergies {
    double elastic = 0, friction = 0, viscous = 0, area = 0, breaking = 0;
};

struct JointForces {
    struct Push {
        Eigen::Vector3d force { 0, 0, 0 }, torque { 0, 0, 0 }; // torque about the centre
    };
    Push onOne, onOther;
    Eigen::Vector3d point { 0, 0, 0 }, normal { 0, 0, 0 }; // where the joint is
    Eigen::Vector3d normalForce { 0, 0, 0 }, shearForce { 0, 0, 0 };
    double twistMoment = 0, couple = 0; // about the normal: of friction, of the pressure
    Eigen::Vector3d bendingMoment { 0, 0, 0 }; // of a bond, across the normal
    double normalStiffness = 0, shearStiffness = 0, twistStiffness = 0; // of the whole joint: force/length, moment
    bool slides = false;
    Wrench damping; // what of all this dashpots do, about `point`
    JointEnergies energies;
};

} // namespace potential_particles
