// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "conic_joint_mat.hpp"

#include "plugin-common/restitution.hpp"

#include <cmath>
#include <sstream>

namespace potential_particles {

ConicJointMat::ConicJointMat() { takeClassIndex(*this); }
ConicJointMat::~ConicJointMat() = default;

PP_CLASS_DEFINITIONS(ConicJointMat)
PP_INDEX_DEFINITIONS(ConicJointMat, yade::FrictMat)
PP_ATTRIBUTE_DEFINITIONS(ConicJointMat, FrictMat)

void ConicJointMat::callPostLoad()
{
    const auto refuse = [](const char* name, double value, const char* remedy) {
        std::ostringstream text;
        text << "ConicJointMat: " << name << " = " << value << ": " << remedy;
        throw std::invalid_argument(text.str());
    };
    yade::FrictMat::callPostLoad();
    for (const auto& [name, value] :
         { std::pair { "normalStiffness", normalStiffness }, { "shearStiffness", shearStiffness } })
        if (!(std::isfinite(value) && value >= 0))
            refuse(name, value, "give a stiffness per area, N/m^3, or 0 to derive it from young");
    if (!(restitution >= leastRestitution && restitution <= 1))
        refuse("restitution", restitution, "it must lie in [0.01, 1]");
    for (const auto& [name, value] : { std::pair { "cohesion", cohesion }, { "tensileStrength", tensileStrength },
                                       { "residualCohesion", residualCohesion } })
        if (!(std::isfinite(value) && value >= 0))
            refuse(name, value, "give a stress, Pa, or 0 for none");
    if (!(frictionAngle >= 0 && frictionAngle < 0.5 * M_PI))
        refuse("frictionAngle", frictionAngle, "give radians in [0, pi/2)");
    if (!(residualFrictionAngle == -1 || (residualFrictionAngle >= 0 && residualFrictionAngle < 0.5 * M_PI)))
        refuse("residualFrictionAngle", residualFrictionAngle, "give radians in [0, pi/2), or -1 for frictionAngle");
    if (!(std::isfinite(softening) && softening >= 0))
        refuse("softening", softening, "give a length, m, or 0 for a brittle bond");
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicJointMat)
