// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a joint bears: Mohr-Coulomb with cohesion, a tensile strength, and residual values once it has broken. Slip and
// twist together: the ellipse (F/F_max)^2 + (M/(f M_max))^2 <= 1, where f makes the work of the slip that of Coulomb's
// friction at each point of the patch.
#pragma once

#include "contact_patch.hpp"
#include "joint.hpp"

#include <algorithm>
#include <cmath>

namespace potential_particles {

struct FrictionForce {
    double shear, twist; // sizes of the tangential force and of the moment about the normal
};

// By how much a force must be scaled to be within the ellipse; 1 for one that is.
inline double allowedShare(const FrictionForce& force, const FrictionForce& limit)
{
    const auto over = [](double part, double whole) { return part > 0 ? part / whole : 0; };
    const double size = std::hypot(over(force.shear, limit.shear), over(force.twist, limit.twist));
    return size > 1 ? 1 / size : 1;
}

// The admissible force nearest to the trial in the energy of the springs, F^2/shearStiffness + M^2/twistStiffness: slip
// is then normal to the ellipse, and its work is never negative. A trial within the ellipse is returned as it is.
inline FrictionForce returned(const FrictionForce& trial, const FrictionForce& limit, double shearStiffness,
                              double twistStiffness)
{
    if (!(limit.shear > 0))
        return { 0, 0 };
    if (!(limit.twist > 0 && twistStiffness > 0))
        return { std::min(trial.shear, limit.shear), 0 };
    const double x = trial.shear / limit.shear, y = trial.twist / limit.twist;
    if (x * x + y * y <= 1)
        return trial;
    // In x and y: minimise a (x' - x)^2 + b (y' - y)^2 on the unit circle. x' = x/(1 + t/a), y' = y/(1 + t/b); the left
    // side of x'^2 + y'^2 = 1 falls with t and is convex, so that Newton's method from t = 0 stays below the root and
    // converges.
    const double a = limit.shear * limit.shear / shearStiffness, b = limit.twist * limit.twist / twistStiffness;
    double t = 0, p = x, q = y;
    for (int i = 0; i < 60; ++i) {
        p = x / (1 + t / a);
        q = y / (1 + t / b);
        const double excess = p * p + q * q - 1;
        if (excess <= 1e-15)
            break;
        t += excess / (2 * (p * p / (a + t) + q * q / (b + t)));
    }
    const double size = std::hypot(p, q);
    return { p / size * limit.shear, q / size * limit.twist };
}

// f of the ellipse. Where the patch slips by v and turns by w, friction takes the mean of |v + w x y| over its points y
// about the centre of pressure; the ellipse takes sqrt(v^2 + (f l w)^2), l the twist lever, which is right with f = 1
// where it turns in place. The points: two ellipses with the shape of the second moments, so that the mean of |y| is l
// and that of |y|^2 is J/A. v and w follow from the trial, normal to the ellipse with f. shear: its direction.
inline double shareOfTwist(const FrictionForce& trial, const FrictionForce& limit, const ContactPatch& patch,
                           const Eigen::Vector3d& shear)
{
    const double f = trial.shear / limit.shear, m = trial.twist / limit.twist, lever = patch.twistLever;
    // A convex limit through both axes holds this.
    if (!(f > 0 && m > 0 && f + m > 1 && lever > 0 && std::isfinite(f) && std::isfinite(m)))
        return 1;
    // Axes along the slip and across it.
    const Eigen::Vector3d along = shear.normalized();
    const double whole = patch.secondMoment.trace(), a = along.dot(patch.secondMoment * along) / whole, c = 1 - a;
    if (!(whole > 0))
        return 1;
    // The sign of the product of inertia does not matter: the rings are symmetric.
    const double square = (patch.secondMoment * along).squaredNorm() / (whole * whole) - a * a;
    const double b = std::sqrt(std::max(0.0, square)), root = std::sqrt(std::max(0.0, a * c - b * b));
    const double size = std::sqrt(1 + 2 * root) / M_SQRT2; // of the root of twice the matrix (a, b; b, c)
    const double xx = (a + root) / size, xy = b / size, yy = (c + root) / size;
    constexpr int points = 4; // of half a ring, at odd multiples of 22.5 degrees
    constexpr double cosines[points] = { 0.92387953251128674, 0.38268343236508977, -0.38268343236508977,
                                         -0.92387953251128674 };
    constexpr double sines[points] = { 0.38268343236508977, 0.92387953251128674, 0.92387953251128674,
                                       0.38268343236508977 };
    double x[points], y[points], mean = 0;
    for (int i = 0; i < points; ++i) {
        x[i] = xx * cosines[i] + xy * sines[i];
        y[i] = xy * cosines[i] + yy * sines[i];
        mean += std::hypot(x[i], y[i]) / points;
    }
    const double middle = 1 / mean; // of both rings, in levers
    const double off = std::sqrt(std::max(0.0, patch.polarMoment / (patch.area * lever * lever) - middle * middle));
    double share = 1;
    for (int turn = 0; turn < 3; ++turn) {
        const double v = std::min(30.0, f / m * share * share); // in levers times w
        double work = 0;
        for (const double ring : { middle - off, middle + off })
            for (int i = 0; i < points; ++i) {
                const double across = ring * x[i], turned = ring * y[i];
                work += std::sqrt((v - turned) * (v - turned) + across * across)
                    + std::sqrt((v + turned) * (v + turned) + across * across);
            }
        work /= 4 * points;
        share = std::sqrt(std::clamp(work * work - v * v, 0.0, 1.0));
    }
    return share;
}

// Largest shear force and twist of a patch that is pressed by that force: c A + mu N, and c L + mu N lambda. L, the
// integral of the distance from the axis over the area, is at most sqrt(A J), J the polar moment; it is that times 2
// sqrt(2)/3 on a disc, which is taken for all shapes.
inline FrictionForce limitOf(const JointParameters& joint, bool broken, const ContactPatch& patch, double pressing)
{
    const double cohesion = broken ? joint.residualCohesion : joint.cohesion;
    const double friction = pressing * (broken ? joint.residualFriction : joint.friction);
    const double lever = 2 * M_SQRT2 / 3 * std::sqrt(patch.area * patch.polarMoment);
    return { cohesion * patch.area + friction, cohesion * lever + friction * patch.twistLever };
}

// The damage due to the largest stress, which is at a corner of the bonded area: 0 below the strength, 1 where the bond
// breaks. With the load f, the stress over the strength as long as nothing is damaged, a linear fall of the stress to 0
// over the opening or slip `softening` is (1 - D) f = 1 - (f - 1)/g, g = softening * stiffness / strength.
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
