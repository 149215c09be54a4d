// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "conic_joint_phys.hpp"
#include "law2_conic_joint.hpp"
#include "limit_surface.hpp"
#include "moving_body.hpp"
#include "pair/sc_geom_conic_pp.hpp"

namespace potential_particles {

using Law = Law2_ScGeomConicPP_ConicJointPhys;
using yade::Vector3r;

Law::~Law2_ScGeomConicPP_ConicJointPhys() = default;
PP_FUNCTOR_2D_DEFINITIONS(Law2_ScGeomConicPP_ConicJointPhys)
PP_ATTRIBUTE_DEFINITIONS(Law2_ScGeomConicPP_ConicJointPhys, LawFunctor)
void Law::callPostLoad() { yade::LawFunctor::callPostLoad(); }

struct Law::Energies {
    double elastic, friction, viscous, area;
};

namespace {

    // On body 2, at the centre of pressure.
    struct Wrench {
        Vector3r force, moment;
    };

    // Of dashpots beside springs of this stiffness, per area: 2 z sqrt(m K/A), m = 1/mobility the mass that the centre of pressure
    // moves; 0 where it moves none.
    double dashpotPerArea(const ConicJointPhys& phys, double stiffness, double mobility, double area)
    {
        return mobility > 0 ? 2 * phys.dampingRatio * std::sqrt(stiffness / (mobility * area)) : 0;
    }

    // The resistance of a bed of dashpots to the approach of the bodies. It pulls nowhere more than the springs push.
    Wrench dashpot(const ConicJointPhys& phys, const yade::ScGeom& geom, const ContactPatch& patch, const MovingBody& one,
                   const MovingBody& other)
    {
        const Vector3r& n = geom.normal;
        const double mobility = one.mobility(geom.contactPoint, n) + other.mobility(geom.contactPoint, n);
        if (!(mobility > 0))
            return { Vector3r::Zero(), Vector3r::Zero() };
        const double perArea = dashpotPerArea(phys, phys.normalStiffness, mobility, patch.area);
        const Vector3r centre = geom.contactPoint + patch.centroid;
        const double opening = (other.velocityAt(centre) - one.velocityAt(centre)).dot(n);
        const Vector3r tilting = n.cross(other.spin() - one.spin());
        const double spring = phys.normalStiffness * patch.force;
        double force = -perArea * patch.area * opening;
        Vector3r moment = -perArea * (patch.secondMoment * tilting).cross(n);
        if (force < -spring) {
            moment *= spring / -force;
            force = -spring;
        }
        return { force * n, moment + patch.centroid.cross(force * n) };
    }

} // namespace

bool Law::go(boost::shared_ptr<yade::IGeom>& geometry, boost::shared_ptr<yade::IPhys>& physics, yade::Interaction* interaction)
{
    auto& geom = static_cast<yade::ScGeom&>(*geometry);
    auto& phys = static_cast<ConicJointPhys&>(*physics);
    const auto* const own = dynamic_cast<const ScGeomConicPP*>(&geom);
    const bool apart = geom.penetrationDepth < 0;
    if (apart || !own || !(own->patch.area > 0)) {
        if (scene->trackEnergy)
            track({ 0, 0, 0, phys.springEnergy(phys.shearDisplacement, phys.twist) });
        phys.normalForce = phys.shearForce = phys.shearDisplacement = Vector3r::Zero();
        phys.kn = phys.ks = phys.twist = phys.twistStiffness = phys.twistMoment = phys.couple = 0;
        phys.isSliding = false;
        return neverErase || !apart;
    }
    const ContactPatch& patch = own->patch;
    const Vector3r shift = scene->isPeriodic ? Vector3r(scene->cell->hSize * interaction->cellDist.cast<double>()) : Vector3r::Zero();
    const MovingBody one(*scene, interaction->id1, Vector3r::Zero()), other(*scene, interaction->id2, shift);
    const Vector3r& n = geom.normal;

    Wrench damping { Vector3r::Zero(), Vector3r::Zero() };
    if (phys.dampingRatio > 0)
        damping = dashpot(phys, geom, patch, one, other);
    const double pressing = phys.normalStiffness * patch.force + damping.force.dot(n);

    // The springs of the joint take along what they hold; where the patch grows or shrinks, springs join and leave.
    const double formerEnergy = phys.springEnergy(phys.shearDisplacement, phys.twist);
    Vector3r shear = phys.shearDisplacement;
    if (const double length = shear.norm(); length > 0) {
        geom.rotate(shear);
        shear -= shear.dot(n) * n;
        if (const double left = shear.norm(); left > 0)
            shear *= length / left;
    }
    phys.kn = phys.normalStiffness * patch.area;
    phys.ks = phys.shearStiffness * patch.area;
    phys.twistStiffness = phys.shearStiffness * patch.polarMoment;
    const double energyWithArea = phys.springEnergy(shear, phys.twist);
    const double spin = (other.spin() - one.spin()).dot(n);
    shear += geom.shearInc;
    double twist = phys.twist + spin * scene->dt;

    const FrictionForce trial { phys.ks * shear.norm(), phys.twistStiffness * std::abs(twist) };
    const double most = phys.tangensOfFrictionAngle * pressing;
    const FrictionForce held = returned(trial, { most, most * patch.twistLever }, phys.ks, phys.twistStiffness);
    phys.isSliding = held.shear < trial.shear || held.twist < trial.twist;
    double friction = 0;
    if (phys.isSliding) {
        const double shearLeft = trial.shear > 0 ? held.shear / trial.shear : 0, twistLeft = trial.twist > 0 ? held.twist / trial.twist : 0;
        friction = held.shear * (1 - shearLeft) * shear.norm() + held.twist * (1 - twistLeft) * std::abs(twist);
        shear *= shearLeft;
        twist *= twistLeft;
    }
    phys.shearDisplacement = shear;
    phys.twist = twist;
    phys.normalForce = pressing * n;
    phys.shearForce = -phys.ks * shear;
    phys.twistMoment = -phys.twistStiffness * twist;
    phys.couple = phys.normalStiffness * patch.couple;

    // While it sticks, the joint is damped along its plane as it is across it.
    double viscous = 0;
    if (phys.dampingRatio > 0) {
        viscous -= scene->dt * (damping.force.dot(other.velocityAt(geom.contactPoint) - one.velocityAt(geom.contactPoint))
                                + damping.moment.dot(other.spin() - one.spin()));
        if (!phys.isSliding) {
            const Vector3r direction = geom.shearInc.norm() > 0 ? Vector3r(geom.shearInc.normalized()) : n.unitOrthogonal();
            const double mobility = one.mobility(geom.contactPoint, direction) + other.mobility(geom.contactPoint, direction);
            const double perArea = dashpotPerArea(phys, phys.shearStiffness, mobility, patch.area);
            Vector3r total = phys.shearForce - perArea * patch.area / scene->dt * geom.shearInc;
            if (total.norm() > most)
                total *= most / total.norm();
            const double moment = -perArea * patch.polarMoment * spin;
            viscous -= (total - phys.shearForce).dot(geom.shearInc) + moment * spin * scene->dt;
            phys.shearForce = total;
            phys.twistMoment += moment;
        }
    }
    if (scene->trackEnergy) {
        const double elastic = phys.normalStiffness * patch.energy + phys.springEnergy(shear, twist);
        track({ elastic, friction, viscous, formerEnergy - energyWithArea });
    }

    const Vector3r force = phys.normalForce + phys.shearForce;
    const Vector3r moment = (phys.couple + phys.twistMoment) * n + damping.moment;
    one.push(geom.contactPoint, -force, -moment);
    other.push(geom.contactPoint, force, moment);
    return true;
}

void Law::track(const Energies& energies)
{
    yade::EnergyTracker& tracker = *scene->energy;
    tracker.add(energies.elastic, "elastPotential", elasticNumber, true);
    tracker.add(energies.friction, "plastDissip", frictionNumber, false);
    tracker.add(energies.viscous, "viscDissip", viscousNumber, false);
    tracker.add(energies.area, "patchChange", areaNumber, false);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Law2_ScGeomConicPP_ConicJointPhys)
