// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "conic_joint.hpp"

#include "plugin-common/restitution.hpp"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace potential_particles {

using Ip2 = Ip2_ConicJointMat_ConicJointMat_ConicJointPhys;

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
    for (const auto& [name, value] : { std::pair { "cohesion", cohesion },
                                       { "tensileStrength", tensileStrength },
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

namespace {

    double harmonicMean(double left, double right) { return left + right > 0 ? 2 * left * right / (left + right) : 0; }

    // Per area, of a body with that bounding radius.
    double normalStiffness(const ConicJointMat& material, double radius)
    {
        return material.normalStiffness > 0 ? material.normalStiffness : material.young / (2 * radius);
    }

    double shearStiffness(const ConicJointMat& material, double radius)
    {
        return material.shearStiffness > 0 ? material.shearStiffness
                                           : material.poisson * normalStiffness(material, radius);
    }

    double residualFrictionAngle(const ConicJointMat& material)
    {
        return material.residualFrictionAngle >= 0 ? material.residualFrictionAngle : material.frictionAngle;
    }

} // namespace

Ip2::~Ip2_ConicJointMat_ConicJointMat_ConicJointPhys() = default;
PP_FUNCTOR_2D_DEFINITIONS(Ip2_ConicJointMat_ConicJointMat_ConicJointPhys)
PP_ATTRIBUTE_DEFINITIONS(Ip2_ConicJointMat_ConicJointMat_ConicJointPhys, IPhysFunctor)
void Ip2::callPostLoad() { IPhysFunctor::callPostLoad(); }

void Ip2::go(const boost::shared_ptr<yade::Material>& material1, const boost::shared_ptr<yade::Material>& material2,
             const boost::shared_ptr<yade::Interaction>& interaction)
{
    if (interaction->phys)
        return;
    const auto& one = static_cast<const ConicJointMat&>(*material1);
    const auto& other = static_cast<const ConicJointMat&>(*material2);
    const auto* const geom = dynamic_cast<const yade::ScGeom*>(interaction->geom.get());
    const double radius1 = geom ? geom->refR1 : 1, radius2 = geom ? geom->refR2 : 1;

    const auto phys = boost::make_shared<ConicJointPhys>();
    phys->normalStiffness = harmonicMean(normalStiffness(one, radius1), normalStiffness(other, radius2));
    phys->shearStiffness = harmonicMean(shearStiffness(one, radius1), shearStiffness(other, radius2));
    phys->tangensOfFrictionAngle = std::tan(std::min(one.frictionAngle, other.frictionAngle));
    phys->dampingRatio = dampingRatioOf(std::min(one.restitution, other.restitution));
    phys->cohesion = std::min(one.cohesion, other.cohesion);
    phys->tensileStrength = std::min(one.tensileStrength, other.tensileStrength);
    phys->residualCohesion = std::min(one.residualCohesion, other.residualCohesion);
    phys->tangensOfResidualFrictionAngle = std::tan(std::min(residualFrictionAngle(one), residualFrictionAngle(other)));
    phys->softening = std::min(one.softening, other.softening);
    phys->broken = scene && scene->iter >= cohesiveTresholdIteration;
    phys->bonded = bonds && !phys->broken;
    interaction->phys = phys;
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicJointMat)
BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::ConicJointPhys)
BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ip2_ConicJointMat_ConicJointMat_ConicJointPhys)
