// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a particle was off a flat boundary, and whether the two can have met since.
#pragma once

#include "particle/particle.hpp"
#include "turn_bound.hpp"

#include <algorithm>
#include <array>

namespace potential_particles {

// A boundary as the particle sees it: points in world axes from the particle's centre. A triangle is given by its vertices,
// a plane by the foot of the perpendicular, three times. Each point of the boundary is a mean of these (or moves with
// them, along a plane's axis), so none moves further than the one that moves furthest.
using BoundaryPoints = std::array<yade::Vector3r, 3>;

// As KeptApart, of which this is the part for boundaries: the answer rests on it, so nothing here comes from a file.
class KeptOff {
public:
    // They are `distance` or more apart where they are now.
    void note(const Particle& particle, const yade::Quaternionr& turn, const BoundaryPoints& points, double distance)
    {
        limit = 0;
        const double size = particle.boundingRadius() + largest(points, BoundaryPoints { Zero(), Zero(), Zero() });
        // The rounding of poses and vertices, over ten times of it.
        const double room = distance - 1e-14 * size;
        if (!(room > 0) || !isUnit(turn))
            return;
        serial = particle.serial;
        from = turn;
        fromPoints = points;
        limit = room * (1 - 1e-9);
    }

    void forget() { limit = 0; }

    bool holds(const Particle& particle, const yade::Quaternionr& turn, const BoundaryPoints& points) const
    {
        return limit > 0 && serial == particle.serial
            && largest(points, fromPoints) + particle.boundingRadius() * wayOfTurn(from, turn) < limit;
    }

private:
    static yade::Vector3r Zero() { return yade::Vector3r::Zero(); }

    static double largest(const BoundaryPoints& points, const BoundaryPoints& others)
    {
        double most = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double way = (points[i] - others[i]).norm();
            most = way <= most ? most : way; // not a number where one is not
        }
        return most;
    }

    std::uint64_t serial = 0;
    yade::Quaternionr from;
    BoundaryPoints fromPoints;
    double limit = 0; // 0: nothing is known
};

} // namespace potential_particles
