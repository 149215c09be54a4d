// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Slip and twist together: the ellipse (F/F_max)^2 + (M/M_max)^2 <= 1, which encloses the limit surface of an even
// pressure.
#pragma once

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

} // namespace potential_particles
