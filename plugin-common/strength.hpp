// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a joint bears: Mohr-Coulomb with cohesion, a tensile strength, and residual values once it has broken. Slip
// and twist together: Coulomb's friction at points spread over the patch, so that a patch cut into parts bears the
// same.
#pragma once

#include "contact_patch.hpp"
#include "joint.hpp"

#include <algorithm>
#include <cmath>

namespace potential_particles {

struct FrictionForce {
    double shear, twist; // sizes of the tangential force and of the moment about the normal
};

// By how much a force must be scaled to be within the ellipse of both limits, which encloses what the patch bears;
// 1 for one that is.
inline double allowedShare(const FrictionForce& force, const FrictionForce& limit)
{
    const auto over = [](double part, double whole) { return part > 0 ? part / whole : 0; };
    const double shear = over(force.shear, limit.shear), twist = over(force.twist, limit.twist);
    const double squared = shear * shear + twist * twist;
    return squared > 1 ? 1 / std::sqrt(squared) : 1;
}

// Where on a patch friction acts: on 16 points of two ellipses about the centre of pressure, with the shape of the
// second moments of the patch, so that the mean of |y| is the lever of the twist and that of |y|^2 is J/A. Lengths
// in levers, axes along the slip and across it.
class FrictionPoints {
public:
    FrictionPoints(const ContactPatch& patch, const Eigen::Vector3d& slip, double lever)
    {
        const double whole = patch.secondMoment.trace(), length = slip.norm();
        double along = 0.5, both = 0; // of the matrix of second moments, of trace 1
        if (whole > 0 && length > 0) {
            const Eigen::Vector3d moved = patch.secondMoment * slip / (whole * length);
            along = moved.dot(slip) / length;
            // Its sign does not count: the points come in pairs.
            both = std::sqrt(std::max(0.0, moved.squaredNorm() - along * along));
        }
        const double across = 1 - along, root = std::sqrt(std::max(0.0, along * across - both * both));
        double mean = 0;
        for (int i = 0; i < count; ++i) {
            x[i] = (along + root) * cosines[i] + both * sines[i];
            y[i] = both * cosines[i] + (across + root) * sines[i];
            mean += std::hypot(x[i], y[i]) / count;
        }
        // The matrix's root is (it + root)/size; size is 1 for points whose mean |y|^2 is 1/2.
        const double size = std::sqrt(1 + 2 * root), middle = 1 / mean;
        const double square = patch.polarMoment / (patch.area * lever * lever) * 2 / (size * size);
        const double off = std::sqrt(std::max(0.0, square - middle * middle));
        rings[0] = middle - off;
        rings[1] = middle + off;
    }

    // Force over the largest one and moment over the largest one while the patch slips by v and turns by w. Its limit
    // surface: these are the derivatives of the work, which is convex.
    FrictionForce at(double v, double w) const
    {
        FrictionForce sum { 0, 0 };
        for (const double ring : rings)
            for (int i = 0; i < count; ++i)
                for (const double sign : { ring, -ring }) {
                    const double px = sign * x[i], py = sign * y[i], vx = v - w * py, vy = w * px;
                    const double speed = std::sqrt(vx * vx + vy * vy);
                    if (!(speed > 0))
                        continue;
                    sum.shear += vx / speed;
                    sum.twist += (px * vy - py * vx) / speed;
                }
        return { sum.shear / (4 * count), sum.twist / (4 * count) };
    }

private:
    static constexpr int count = 4; // on half an ellipse, at odd multiples of 22.5 degrees
    static constexpr double cosines[count]
        = { 0.92387953251128674, 0.38268343236508977, -0.38268343236508977, -0.92387953251128674 };
    static constexpr double sines[count]
        = { 0.38268343236508977, 0.92387953251128674, 0.92387953251128674, 0.38268343236508977 };
    double x[count], y[count], rings[2];
};

// The admissible force nearest to the trial in the energy of the springs, F^2/shearStiffness + M^2/twistStiffness:
// slip is then normal to the limit surface, and its work is never negative. A trial within the limit is returned as
// it is.
inline FrictionForce returned(const FrictionForce& trial, const FrictionForce& limit, const ContactPatch& patch,
                              const Eigen::Vector3d& slip, double shearStiffness, double twistStiffness)
{
    if (!(limit.shear > 0))
        return { 0, 0 };
    if (!(limit.twist > 0 && twistStiffness > 0))
        return { std::min(trial.shear, limit.shear), 0 };
    const double f = trial.shear / limit.shear, m = trial.twist / limit.twist;
    if (f + m <= 1) // the limit is convex
        return trial;
    if (!(f > 0 && m > 0))
        return { std::min(trial.shear, limit.shear), std::min(trial.twist, limit.twist) };
    // Of the slip, v = lever sin(a), w = cos(a), across what the force must lose: falls through 0 once, at the
    // answer.
    const double lever = limit.twist / limit.shear, ratio = lever * lever * shearStiffness / twistStiffness;
    const FrictionPoints points(patch, slip, lever);
    FrictionForce on {};
    const auto across = [&](double a) {
        on = points.at(std::sin(a), std::cos(a));
        return std::cos(a) * (f - on.shear) - std::sin(a) * ratio * (m - on.twist);
    };
    double low = 0, high = 0.5 * M_PI, atLow = f, atHigh = -ratio * m, a = std::atan2(f, m);
    constexpr double enough = 1e-6; // of the direction; the force is on the limit whatever it is
    int side = 0;
    for (int i = 0; i < 20; ++i) {
        const double found = across(a);
        if (std::abs(found) < enough * (f + ratio * m) || high - low < enough)
            break;
        // Regula falsi; an end that stays a second time counts half.
        const int now = found > 0 ? 1 : -1;
        (now > 0 ? low : high) = a;
        (now > 0 ? atLow : atHigh) = found;
        if (now == side)
            (now > 0 ? atHigh : atLow) *= 0.5;
        side = now;
        a = (low * atHigh - high * atLow) / (atHigh - atLow);
    }
    const double beyond = std::sin(a) * (f - on.shear) + std::cos(a) * (m - on.twist);
    return beyond > 0 ? FrictionForce { on.shear * limit.shear, on.twist * limit.twist } : trial;
}

// Largest shear force and twist of a patch that is pressed by that force: c A + mu N, and c L + mu N lambda. L, the
// integral of the distance from the axis over the area, is at most sqrt(A J), J the polar moment; it is that times 2
// sqrt(2)/3 on a disc, which is taken for all shapes.
inline FrictionForce limitOf(const JointParameters& joint, bool broken, const ContactPatch& patch, double pressing)
{
    const double cohesion = broken ? joint.residualCohesion : joint.cohesion;
    const double friction = pressing * (broken ? joint.residualFriction : joint.friction);
    const double lever = cohesion > 0 ? 2 * M_SQRT2 / 3 * std::sqrt(patch.area * patch.polarMoment) : 0;
    return { cohesion * patch.area + friction, cohesion * lever + friction * patch.twistLever };
}

// The damage due to the largest stress, which is at a corner of the bonded area: 0 below the strength, 1 where the
// bond breaks. With the load f, the stress over the strength as long as nothing is damaged, a linear fall of the
// stress to 0 over the opening or slip `softening` is (1 - D) f = 1 - (f - 1)/g, g = softening * stiffness /
// strength.
inline double damageOf(const JointParameters& joint, const Bond& bond, const BondStrain& strain)
{
    const auto damage = [&](double stress, double strength, double stiffness) {
        if (stress <= 0 || stress < strength)
            return 0.0;
        const double load = stress / strength, room = joint.softening * stiffness / strength;
        return room > 0 && std::isfinite(load) && std::isfinite(room)
            ? std::min(1.0, (load - 1) / load * (1 + 1 / room))
            : 1.0;
    };
    double most = 0;
    for (std::size_t i = 0; i + 1 < bond.bondRim.size(); i += 2) {
        const BondStrain::Gap gap = strain.gap(bond.bondRim[i], bond.bondRim[i + 1]);
        const double tension = joint.normalStiffness * gap.opening;
        const double shear = joint.shearStiffness * gap.slip + joint.friction * tension;
        most = std::max({ most, damage(tension, joint.tensileStrength, joint.normalStiffness),
                          damage(shear, joint.cohesion, joint.shearStiffness) });
    }
    return most;
}

} // namespace potential_particles
