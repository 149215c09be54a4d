// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a joint bears: Mohr-Coulomb with cohesion, a tensile strength, and residual values once it has broken.
#pragma once

#include "contact_patch.hpp"
#include "joint.hpp"
#include "limit_surface.hpp"

#include <algorithm>
#include <cmath>

namespace potential_particles {

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
