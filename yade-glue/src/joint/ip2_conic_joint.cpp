// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "conic_joint_mat.hpp"
#include "conic_joint_phys.hpp"
#include "ip2_conic_joint.hpp"

#include "plugin-common/restitution.hpp"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>

namespace potential_particles {

using Ip2 = Ip2_ConicJointMat_ConicJointMat_ConicJointPhys;

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

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ip2_ConicJointMat_ConicJointMat_ConicJointPhys)
