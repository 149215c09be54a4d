// SPDX-License-Identifier: GPL-3.0-or-later
#include "ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace potential_particles {

// s = sqrt(S) is a norm of non-negative convex functions, hence convex along the ray, and the ray
// starts where s < 1. Newton's method for s = 1, begun outside the particle, therefore comes down
// to the root from above without ever crossing it: no bracket is needed, and the first step that
// does not lessen t is rounding.
double distanceToSurface(const Particle& particle, const pp_pose& pose, const yade::Vector3r& point,
                         const yade::Vector3r& direction)
{
    const yade::Vector3r centre(pose.position);
    const double outside = (point - centre).norm() + particle.boundingRadius();
    double t = outside;
    for (int step = 0; step < 100; ++step) {
        const yade::Vector3r at = point + t * direction;
        yade::Vector3r gradient;
        double f;
        requireOk(pp_particle_potential(particle.handle(), &pose, at.data(), &f, gradient.data()));
        const double s = std::sqrt(f + 1);
        const double slope = gradient.dot(direction) / (2 * s);
        const double next = t - (s - 1) / slope;
        if (!(next < t) || !(slope > 0))
            break;
        t = std::max(next, 0.0);
        if (t == 0 || (s - 1) / slope < std::numeric_limits<double>::epsilon() * outside)
            break;
    }
    return t;
}

} // namespace potential_particles
