// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The law of a contact at a point: a linear spring along the normal, Coulomb friction with a tangential spring (Cundall
// & Strack 1979), and dashpots beside both. With restitution 1 it is YADE's Law2_ScGeom_FrictPhys_CundallStrack,
// formula by formula.
#pragma once

#include "restitution.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace potential_particles {

struct LawParameters {
    double normalStiffness = 0, shearStiffness = 0; // force/length
    double friction = 0; // coefficient
    double dampingRatio = 0; // of the dashpots to the critical ones of the two masses

    double stiffest() const { return std::max(normalStiffness, shearStiffness); }
};

// What a contact carries from step to step. Vectors in world axes, forces on B.
struct ContactHistory {
    Eigen::Vector3d shear = Eigen::Vector3d::Zero(); // of the tangential spring
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); // of the last step
    Eigen::Vector3d damping = Eigen::Vector3d::Zero(); // of the dashpots in the last step
    bool touching = false;
};

struct ContactMotion {
    double overlap;
    Eigen::Vector3d normal; // unit, from A to B
    Eigen::Vector3d velocity; // of B against A at the contact point
    double spin; // of both about the normal, their mean
    double mass; // effective
};

struct ContactForce {
    Eigen::Vector3d onB;
    double elastic; // energy of both springs
    double slid, damped; // energy that friction and dashpots took in this step
};

// One step of `dt`. Where the step only repeats the last one (`advance` false, at the start of a run), the history is
// kept, so that an interrupted run continues as if it had not been interrupted.
inline ContactForce contactForce(const LawParameters& law, const ContactMotion& motion, double dt, bool advance,
                                 ContactHistory& history)
{
    using Eigen::Vector3d;
    const Vector3d& n = motion.normal;
    const double along = n.dot(motion.velocity), spring = law.normalStiffness * motion.overlap;
    const Vector3d across = motion.velocity - along * n;
    const bool known = history.touching;
    ContactForce force { Vector3d::Zero(), 0, 0, 0 };
    if (!known)
        history = { Vector3d::Zero(), n, Vector3d::Zero(), true };
    if (advance || !known) {
        const double normalDashpot = 2 * law.dampingRatio * std::sqrt(law.normalStiffness * motion.mass),
                     shearDashpot = 2 * law.dampingRatio * std::sqrt(law.shearStiffness * motion.mass);
        // No force pulls.
        const double damping = std::max(-normalDashpot * along, -spring);
        Vector3d shearDamping = -shearDashpot * across;
        if (advance) {
            // With the normal, and with the bodies about it, to first order.
            Vector3d& shear = history.shear;
            shear -= shear.cross(history.normal.cross(n)).eval();
            shear -= shear.cross((dt * motion.spin) * n).eval();
            const Vector3d trial = shear - law.shearStiffness * dt * across;
            const double most = law.friction * (spring + damping), size = trial.norm();
            shear = trial;
            if (size > most) {
                shear *= most / size;
                force.slid = (trial - shear).dot(shear) / law.shearStiffness;
                shearDamping.setZero();
            } else if (const double both = (shear + shearDamping).norm(); both > most)
                shearDamping = (shear + shearDamping) * (most / both) - shear;
        } else
            shearDamping.setZero();
        // The velocity is that of half a step ago: the work takes the mean of this force and that of the last step.
        const Vector3d before = history.damping;
        history.damping = damping * n + shearDamping;
        history.normal = n;
        if (advance)
            force.damped = -0.5 * dt * (before + history.damping).dot(motion.velocity);
    }
    force.onB = spring * n + history.shear + history.damping;
    force.elastic = 0.5 * spring * motion.overlap
        + (law.shearStiffness > 0 ? 0.5 * history.shear.squaredNorm() / law.shearStiffness : 0);
    return force;
}

} // namespace potential_particles
