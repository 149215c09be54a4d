// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "conic_joint.hpp"
#include "law2_conic_joint.hpp"
#include "joint_body.hpp"
#include "joints_in_step.hpp"
#include "pair/sc_geom_conic_pp.hpp"

#include "plugin-common/joint_law.hpp"

#include <typeinfo>

namespace potential_particles {

using Law = Law2_ScGeomConicPP_ConicJointPhys;
using yade::Vector3r;

Law::~Law2_ScGeomConicPP_ConicJointPhys() = default;
PP_FUNCTOR_2D_DEFINITIONS(Law2_ScGeomConicPP_ConicJointPhys)
PP_ATTRIBUTE_DEFINITIONS(Law2_ScGeomConicPP_ConicJointPhys, LawFunctor)
void Law::callPostLoad() { yade::LawFunctor::callPostLoad(); }

bool Law::go(boost::shared_ptr<yade::IGeom>& geometry, boost::shared_ptr<yade::IPhys>& physics,
             yade::Interaction* interaction)
{
    return act(*geometry, *physics, *interaction, nullptr, nullptr);
}

bool Law::act(yade::IGeom& geometry, yade::IPhys& physics, const yade::Interaction& interaction, BodyPush* onFirst,
              BodyPush* onSecond)
{
    const Vector3r shift
        = scene->isPeriodic ? Vector3r(scene->cell->hSize * interaction.cellDist.cast<double>()) : Vector3r::Zero();
    auto& geom = static_cast<yade::ScGeom&>(geometry);
    auto& phys = static_cast<ConicJointPhys&>(physics);
    auto* const own = typeid(geom) == typeid(ScGeomConicPP) ? static_cast<ScGeomConicPP*>(&geom) : nullptr;
    const JointBody one = movingBody(*scene, interaction.id1, Vector3r::Zero()),
                    other = movingBody(*scene, interaction.id2, shift);
    phys.rememberEnergyAlong();
    const JointParameters parameters = phys.parameters();
    JointsInStep& joints = JointsInStep::all();
    joints.refresh(*scene);
    const JointsInStep::Key key = joints.keyOf(*scene, interaction, one.mass.isHeld(), other.mass.isHeld());
    const JointSides sides = parameters.dampingRatio > 0 ? joints.sides(key, phys, shift) : JointSides {};
    JointLaw law(parameters, phys, one, other, sides, scene->dt);

    const bool apart = geom.penetrationDepth < 0, touches = !apart && own && own->patch().area > 0;
    const auto posed = [&](int which) {
        const yade::Body& body
            = *scene->bodies->body[static_cast<std::size_t>(which == 1 ? interaction.id1 : interaction.id2)];
        return PosedBody(body.shape, *body.state, which == 1 ? Vector3r(Vector3r::Zero()) : shift);
    };
    const bool holds = law.step(
        touches ? &own->patch() : nullptr, !(own && own->isHeldByBond()),
        [&] {
            return JointMotion { geom.contactPoint, geom.normal, geom.shearInc, geom.orthonormal_axis,
                                 geom.twist_axis };
        },
        posed);
    if (holds) {
        if (own)
            own->setHeldByBond(phys.bonded);
        // Where no contact was found or sought, it is where the bond is.
        if (apart) {
            geom.contactPoint = law.forces().point;
            geom.normal = law.forces().normal;
        }
    }
    joints.note(static_cast<std::size_t>(interaction.linIx), scene->iter, key, phys, shift);
    phys.take(law.forces());
    // One force a body: in which order threads add up more of them is left to chance.
    if (holds || touches) {
        push(*scene, interaction.id1, law.forces().onOne, onFirst);
        push(*scene, interaction.id2, law.forces().onOther, onSecond);
    }
    if (scene->trackEnergy)
        track(law.forces().energies);
    return holds || touches || neverErase || !apart;
}

void Law::track(const JointEnergies& energies)
{
    yade::EnergyTracker& tracker = *scene->energy;
    tracker.add(energies.elastic, "elastPotential", elasticNumber, true);
    tracker.add(energies.friction, "plastDissip", frictionNumber, false);
    tracker.add(energies.viscous, "viscDissip", viscousNumber, false);
    tracker.add(energies.area, "patchChange", areaNumber, false);
    tracker.add(energies.breaking, "bondBreaking", breakingNumber, false);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Law2_ScGeomConicPP_ConicJointPhys)
