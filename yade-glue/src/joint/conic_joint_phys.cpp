// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "conic_joint_phys.hpp"

namespace potential_particles {

ConicJointPhys::ConicJointPhys() { takeClassIndex(*this); }
ConicJointPhys::~ConicJointPhys() = default;

PP_CLASS_DEFINITIONS(ConicJointPhys)
PP_INDEX_DEFINITIONS(ConicJointPhys, yade::FrictPhys)
PP_ATTRIBUTE_DEFINITIONS(ConicJointPhys, FrictPhys)

void ConicJointPhys::callPostLoad()
{
    yade::FrictPhys::callPostLoad();
    // YADE's own stands for "not given"; Ip2 gives it with the stiffness.
    if (normalStiffness > 0)
        requireFinite<ConicJointPhys>("tangensOfFrictionAngle", tangensOfFrictionAngle);
    if (bondRim.size() % 2 != 0)
        throw std::invalid_argument("ConicJointPhys: bondRim has " + std::to_string(bondRim.size())
                                    + " numbers: give y and z of each corner");
}

void ConicJointPhys::take(const JointForces& forces)
{
    kn = forces.normalStiffness;
    ks = forces.shearStiffness;
    twistStiffness = forces.twistStiffness;
    normalForce = forces.normalForce;
    shearForce = forces.shearForce;
    twistMoment = forces.twistMoment;
    couple = forces.couple;
    isSliding = forces.slides;
    bendingMoment = bondArea > 0 ? forces.bendingMoment : yade::Vector3r(yade::Vector3r::Zero());
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicJointPhys)
