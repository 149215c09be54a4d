// SPDX-License-Identifier: GPL-2.0-or-later
//
// What the library remembers of the patch of a contact.
#pragma once

#include <potential_particles.h>

#include <memory>

namespace potential_particles {

// The energy of a patch takes ten times as long as its force. It has a memory of its own and is sought only where it is
// output, so that no force depends on how often that is.
struct KeptPatch {
    pp_patch_state ofForce = {};
    std::unique_ptr<pp_patch_state> ofEnergy;

    // find(with_energy, state, patch): a call of the library. 0 where it fails.
    template <class Find> double energy(Find&& find)
    {
        if (!ofEnergy)
            ofEnergy = std::make_unique<pp_patch_state>();
        pp_patch patch;
        return find(1, ofEnergy.get(), &patch) == PP_OK && patch.energy > 0 ? patch.energy : 0.0;
    }

    double bytes() const { return sizeof(*this) + (ofEnergy ? sizeof(*ofEnergy) : 0); }
};

} // namespace potential_particles
