// SPDX-License-Identifier: GPL-2.0-or-later
//
// One step of a contact by its patch, of two bodies or of a body and a wall.
#pragma once

#include "joint_history.hpp"
#include "plugin-common/joint_law.hpp"

#include <optional>

namespace potential_particles {

constexpr double areaTolerance = 1e-6; // of a disc in the place of a patch

// here: none, where the bodies are apart. Where the step only repeats the last one (`advance` false, at the start of a
// run), the history stays as it is. posed(1), posed(2): the shapes, for a patch that becomes a bond.
template <class Posed>
JointForces jointForces(const JointParameters& joint, JointHistory& history, const JointBody& one,
                        const JointBody& other, const std::optional<PatchInStep>& here, double dt, bool advance,
                        Posed&& posed)
{
    JointLaw law(joint, history.memory, one, other, dt);
    const auto motionAt = [&](const PatchInStep& patch) {
        return JointMotion::of(one, other, patch.point, patch.normal, history.normal, dt);
    };
    if (!advance && history.lasts()) {
        if (history.isBond())
            law.repeatAsBond(history.damping);
        else if (here && here->patch.area > 0)
            law.repeatAsPatch(here->patch, motionAt(*here), history.damping);
        return law.forces();
    }
    law.step(here && here->patch.area > 0 ? &here->patch : nullptr, true, [&] { return motionAt(*here); }, posed);
    history.touching = here.has_value();
    if (here)
        history.normal = here->normal;
    history.damping = law.forces().damping;
    return law.forces();
}

} // namespace potential_particles
