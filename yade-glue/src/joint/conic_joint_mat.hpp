// SPDX-License-Identifier: GPL-3.0-or-later
//
// The material of joints between potential particles.
#pragma once

#include "abi/archive.hpp"
#include "abi/material.hpp"

#include <boost/serialization/access.hpp>

namespace potential_particles {

class ConicJointMat final : public yade::FrictMat {
public:
    ConicJointMat();
    ~ConicJointMat() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    double normalStiffness = 0;
    double shearStiffness = 0;
    double restitution = 1;
    double cohesion = 0;
    double tensileStrength = 0;
    double residualFrictionAngle = -1;
    double residualCohesion = 0;
    double softening = 0;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using M = ConicJointMat;
        visit("normalStiffness", &M::normalStiffness,
              "Normal stiffness per area, N/m^3; 0: young over twice the bounding radius of the body. A joint takes "
              "the harmonic mean of "
              "its two bodies.");
        visit("shearStiffness", &M::shearStiffness,
              "Shear stiffness per area, N/m^3; 0: poisson times the normal one.");
        visit("restitution", &M::restitution,
              "Coefficient of restitution of a head-on impact, 0.01 to 1; a joint takes the smaller one of its two "
              "bodies. 1: no dashpot.");
        // A joint takes the smaller value of its two bodies, as of frictionAngle.
        visit("cohesion", &M::cohesion, "Shear strength without pressure, Pa.", 1);
        visit("tensileStrength", &M::tensileStrength, "Tensile strength of bonds, Pa.", 1);
        visit("residualFrictionAngle", &M::residualFrictionAngle,
              "Friction angle of a joint that has broken, radians; -1: frictionAngle.", 1);
        visit("residualCohesion", &M::residualCohesion, "Cohesion of a joint that has broken, Pa.", 1);
        visit("softening", &M::softening,
              "Opening or slip, m, over which the stress in a bond falls from the strength to 0; 0: bonds are brittle.",
              1);
    }

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);
};

} // namespace potential_particles
