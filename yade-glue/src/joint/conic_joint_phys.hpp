// SPDX-License-Identifier: GPL-3.0-or-later
//
// The physics of a joint between potential particles.
#pragma once

#include "abi/archive.hpp"
#include "abi/knksphys.hpp"
#include "bond.hpp"

#include <boost/serialization/access.hpp>

namespace potential_particles {

// kn and ks of its bases are those of the whole patch, N/m; normalForce and shearForce act on body 2.
class ConicJointPhys final : public yade::FrictPhys, public Bond {
public:
    ConicJointPhys();
    ~ConicJointPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    double normalStiffness = 0;
    double shearStiffness = 0;
    double dampingRatio = 0;
    yade::Vector3r shearDisplacement = yade::Vector3r::Zero();
    double twist = 0;
    double twistStiffness = 0;
    double twistMoment = 0;
    double couple = 0;
    bool isSliding = false;
    double cohesion = 0;
    double residualCohesion = 0;
    double tangensOfResidualFrictionAngle = 0;
    double tensileStrength = 0;
    double softening = 0;
    bool broken = false;

    // Of the springs along the joint, with this displacement and turn.
    double springEnergy(const yade::Vector3r& displacement, double turn) const
    {
        return 0.5 * (ks * displacement.squaredNorm() + twistStiffness * turn * turn);
    }

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        using P = ConicJointPhys;
        visit("normalStiffness", &P::normalStiffness, "Normal stiffness per area, N/m^3.");
        visit("shearStiffness", &P::shearStiffness, "Shear stiffness per area, N/m^3.");
        visit("dampingRatio", &P::dampingRatio, "Dashpot over the critical one, from the restitution of the materials.");
        visit("shearDisplacement", &P::shearDisplacement,
              "Elastic part of the displacement of body 2 against body 1 along the joint, world axes, m.");
        visit("twist", &P::twist, "Elastic part of the turn of body 2 against body 1 about the normal, radians.");
        visit("twistStiffness", &P::twistStiffness, "Stiffness against it, N m: shear stiffness per area times the polar moment.");
        visit("twistMoment", &P::twistMoment, "Moment of friction on body 2 about the normal, N m.");
        visit("couple", &P::couple, "Moment of the pressure on body 2 about the normal, N m.");
        visit("isSliding", &P::isSliding, "Whether friction was at its limit in the last step.");
        visit("cohesion", &P::cohesion, "Shear strength without pressure, Pa.", 1);
        visit("residualCohesion", &P::residualCohesion, "The same once the joint has broken, Pa.", 1);
        visit("tangensOfResidualFrictionAngle", &P::tangensOfResidualFrictionAngle, "Tangent of the friction angle once it has broken.", 1);
        visit("tensileStrength", &P::tensileStrength, "Tensile strength of the bond, Pa.", 1);
        visit("softening", &P::softening, "Opening or slip over which the stress in the bond falls to 0, m; 0: brittle.", 1);
        visit("broken", &P::broken, "Whether the joint has the residual values: it has slipped, opened, or was made later.", 1);
        Bond::eachAttribute(visit);
    }

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);
};

} // namespace potential_particles
