// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far two particles were apart, and whether they can have met since.
#pragma once

#include "abi/state.hpp"
#include "particle/particle.hpp"
#include "turn_bound.hpp"

#include <cstdint>

namespace potential_particles {

// Nothing here comes from a file or a script: it is no hint, the answer rests on it.
class KeptApart {
public:
    // The particles are `distance` or more apart where they are now. `branch`: from body 1 to body 2. By how much they are
    // so for sure; 0 when that cannot be known.
    double note(const Particle& particle1, const Particle& particle2, const yade::Quaternionr& turn1,
                const yade::Quaternionr& turn2, const yade::Vector3r& branch, double distance)
    {
        forget();
        // The rounding of poses, over ten times of it; lengths of quaternions are taken for 1 below.
        const double lengths = particle1.boundingRadius() + particle2.boundingRadius() + branch.norm();
        const double room = distance - 1e-14 * lengths;
        if (!(room > 0) || !isUnit(turn1) || !isUnit(turn2))
            return 0;
        serial1 = particle1.serial;
        serial2 = particle2.serial;
        from1 = turn1;
        from2 = turn2;
        fromBranch = branch;
        return limit = room * (1 - 1e-9);
    }

    void forget() { limit = 0; }

    // By how much the particles are still apart for sure; 0 when nothing is known. No point of a particle moves further
    // than its centre does, and by its turn on the ball around it.
    double left(const Particle& particle1, const Particle& particle2, const yade::Quaternionr& turn1,
                const yade::Quaternionr& turn2, const yade::Vector3r& branch) const
    {
        if (!(limit > 0) || serial1 != particle1.serial || serial2 != particle2.serial)
            return 0;
        const double moved = (branch - fromBranch).norm() + particle1.boundingRadius() * wayOfTurn(from1, turn1)
            + particle2.boundingRadius() * wayOfTurn(from2, turn2);
        // Not a number where a pose is not.
        return moved < limit ? limit - moved : 0;
    }

private:
    std::uint64_t serial1 = 0, serial2 = 0;
    yade::Quaternionr from1, from2;
    yade::Vector3r fromBranch;
    double limit = 0; // 0: nothing is known
};

} // namespace potential_particles
