// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a particle was off another one or off a flat boundary, and whether the two can have met since.
#pragma once

#include "abi/state.hpp"
#include "particle/particle.hpp"

#include "plugin-common/motion_bound.hpp"
#include "plugin-common/seam.hpp"

#include <algorithm>
#include <cstdint>

namespace potential_particles {

// A boundary as the particle sees it: points in world axes from the particle's centre. A triangle is given by its
// vertices, a plane by the foot of the perpendicular, three times. Each point of the boundary is a mean of these (or
// moves with them, along a plane's axis), so none moves further than the one that moves furthest.
using BoundaryPoints = Triangle;

// Nothing here comes from a file or a script: it is no hint, the answer rests on it.
class KeptApart {
public:
    // A particle, and how it is turned.
    struct Turned {
        const Particle& particle;
        const yade::Quaternionr& turn;
    };

    // The particles are `distance` or more apart where they are now. `branch`: from body 1 to body 2. Returns the part
    // of it that is certain; 0 if unknown.
    double note(const Turned& one, const Turned& other, const yade::Vector3r& branch, double distance)
    {
        forget();
        if (!isUnit(one.turn))
            return 0;
        serial1 = one.particle.serial;
        from1 = one.turn;
        from[0] = branch;
        return keep(other, distance, one.particle.boundingRadius() + branch.norm());
    }

    // As for two particles, of which the first is a boundary.
    double note(const BoundaryPoints& points, const Turned& particle, double distance)
    {
        forget();
        serial1 = 0; // no particle has 0
        from = points;
        return keep(particle, distance, std::max({ points[0].norm(), points[1].norm(), points[2].norm() }));
    }

    void forget() { limit = 0; }
    // Whether anything is known.
    bool isKnown() const { return limit > 0; }

    // The distance that is still certain; 0 when nothing is known. No point of a particle moves further than its centre
    // does, and by its turn on the ball around it.
    double left(const Turned& one, const Turned& other, const yade::Vector3r& branch) const
    {
        if (!(limit > 0) || serial1 != one.particle.serial)
            return 0;
        return left(other, (branch - from[0]).norm() + one.particle.boundingRadius() * wayOfTurn(from1, one.turn));
    }

    double left(const BoundaryPoints& points, const Turned& particle) const
    {
        if (!(limit > 0) || serial1 != 0)
            return 0;
        double most = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double way = (points[i] - from[i]).norm();
            most = way <= most ? most : way; // not a number where one is not
        }
        return left(particle, most);
    }

private:
    // `others`: the lengths besides the size of the particle.
    double keep(const Turned& particle, double distance, double others)
    {
        // The rounding of poses and points, over ten times of it; lengths of quaternions are taken for 1 below.
        const double room = distance - 1e-14 * (particle.particle.boundingRadius() + others);
        if (!(room > 0) || !isUnit(particle.turn))
            return 0;
        serial2 = particle.particle.serial;
        from2 = particle.turn;
        return limit = room * (1 - 1e-9);
    }

    double left(const Turned& particle, double way) const
    {
        if (serial2 != particle.particle.serial)
            return 0;
        const double moved = way + particle.particle.boundingRadius() * wayOfTurn(from2, particle.turn);
        // Not a number where a pose is not.
        return moved < limit ? limit - moved : 0;
    }

    double limit = 0; // 0: nothing is known
    std::uint64_t serial1 = 0, serial2 = 0;
    yade::Quaternionr from1, from2;
    BoundaryPoints from;
};

} // namespace potential_particles
