// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "bonded_area.hpp"
#include "conic_joint_phys.hpp"
#include "law2_conic_joint.hpp"
#include "moving_body.hpp"
#include "pair/sc_geom_conic_pp.hpp"
#include "strength.hpp"

#include <algorithm>

namespace potential_particles {

using Law = Law2_ScGeomConicPP_ConicJointPhys;
using yade::Vector3r;

Law::~Law2_ScGeomConicPP_ConicJointPhys() = default;
PP_FUNCTOR_2D_DEFINITIONS(Law2_ScGeomConicPP_ConicJointPhys)
PP_ATTRIBUTE_DEFINITIONS(Law2_ScGeomConicPP_ConicJointPhys, LawFunctor)
void Law::callPostLoad() { yade::LawFunctor::callPostLoad(); }

// elastic: what the joint holds now. The others: what this step took from it.
struct Law::Energies {
    double elastic = 0, friction = 0, viscous = 0, area = 0, breaking = 0;
};

struct Law::Joint {
    yade::ScGeom& geom;
    ConicJointPhys& phys;
    const MovingBody one, other;
};

namespace {

    // Of dashpots beside springs of this stiffness, per area: 2 z sqrt(m K/A), m = 1/mobility the mass that the centre of pressure
    // moves; 0 where it moves none.
    double dashpotPerArea(const ConicJointPhys& phys, double stiffness, double mobility, double area)
    {
        return mobility > 0 ? 2 * phys.dampingRatio * std::sqrt(stiffness / (mobility * area)) : 0;
    }

    // The resistance of dashpots to the approach of the bodies, at the centre of pressure. Half of them stand at either edge of the
    // patch, not spread over it, so that what lands on a face is pushed at the edge that comes down, as Housner has it. The edges: of the
    // direction g in which the approach changes, sqrt(3) times the radius of gyration from the centroid, those of a rectangle along a side of it,
    //
    //     y = -+ sqrt(3) I g / sqrt(A g.I g),
    //
    // with I the second moments of the area A. Neither edge is pulled more than the springs push there: what springs and dashpots do
    // together lies within the patch.
    Wrench dashpot(const ConicJointPhys& phys, const yade::ScGeom& geom, const ContactPatch& patch, const MovingBody& one,
                   const MovingBody& other)
    {
        const Vector3r& n = geom.normal;
        const double mobility = one.mobility(geom.contactPoint, n) + other.mobility(geom.contactPoint, n);
        if (!(mobility > 0))
            return { Vector3r::Zero(), Vector3r::Zero() };
        const double half = 0.5 * dashpotPerArea(phys, phys.normalStiffness, mobility, patch.area) * patch.area;
        const Vector3r centre = geom.contactPoint + patch.centroid;
        const double opening = (other.velocityAt(centre) - one.velocityAt(centre)).dot(n);
        const Vector3r gradient = n.cross(other.spin() - one.spin()), moved = patch.secondMoment * gradient;
        const double spread = patch.area * gradient.dot(moved);
        const Vector3r edge = spread > 0 ? Vector3r(std::sqrt(3 / spread) * moved) : Vector3r::Zero();
        const double reach = edge.squaredNorm();
        const double off = reach > 0 ? std::clamp(-patch.centroid.dot(edge) / reach, -1.0, 1.0) : 0;
        const double spring = 0.5 * phys.normalStiffness * patch.force, tilting = gradient.dot(edge);
        const double above = std::max(-half * (opening + tilting), -spring * (1 + off));
        const double below = std::max(-half * (opening - tilting), -spring * (1 - off));
        const Vector3r force = (above + below) * n;
        return { force, (above - below) * edge.cross(n) + patch.centroid.cross(force) };
    }

} // namespace

bool Law::go(boost::shared_ptr<yade::IGeom>& geometry, boost::shared_ptr<yade::IPhys>& physics, yade::Interaction* interaction)
{
    return act(*geometry, *physics, *interaction, nullptr, nullptr);
}

bool Law::act(yade::IGeom& geometry, yade::IPhys& physics, const yade::Interaction& interaction, BodyPush* onFirst, BodyPush* onSecond)
{
    const Vector3r shift = scene->isPeriodic ? Vector3r(scene->cell->hSize * interaction.cellDist.cast<double>()) : Vector3r::Zero();
    Joint joint { static_cast<yade::ScGeom&>(geometry), static_cast<ConicJointPhys&>(physics),
                  MovingBody(*scene, interaction.id1, Vector3r::Zero(), onFirst), MovingBody(*scene, interaction.id2, shift, onSecond) };
    Energies energies;
    const bool wasBonded = joint.phys.bondArea > 0;
    bool lasts = true;
    if (!wasBonded || !holdsAsBond(joint, energies)) {
        const auto* const own = dynamic_cast<const ScGeomConicPP*>(&joint.geom);
        const bool apart = joint.geom.penetrationDepth < 0;
        if (apart || !own || !(own->patch().area > 0)) {
            open(joint, wasBonded, energies);
            lasts = neverErase || !apart;
        } else {
            holdAsPatch(joint, own->patch(), wasBonded, energies);
        }
    }
    if (scene->trackEnergy)
        track(energies);
    return lasts;
}

// The springs along the patch go with it. broken: the bond has in this step, and its energy is counted.
void Law::open(const Joint& joint, bool broken, Energies& energies) const
{
    ConicJointPhys& phys = joint.phys;
    if (!broken)
        energies.area = phys.springEnergy(phys.shearDisplacement, phys.twist);
    phys.normalForce = phys.shearForce = phys.shearDisplacement = Vector3r::Zero();
    phys.kn = phys.ks = phys.twist = phys.twistStiffness = phys.twistMoment = phys.couple = 0;
    phys.isSliding = false;
    phys.broken = true;
}

// A bond that reaches its strength holds for this step, since the contact was not looked for, and is ended in the next one, as if a
// script had done so. False when it is ended: what it held along the joint is left to the springs of the patch, and energies.breaking
// is all of its energy.
bool Law::holdsAsBond(const Joint& joint, Energies& energies) const
{
    ConicJointPhys& phys = joint.phys;
    yade::ScGeom& geom = joint.geom;
    const BondStrain strain(phys, { joint.one.centre(), joint.one.turn() }, { joint.other.centre(), joint.other.turn() });
    const BondStiffness stiffness { phys.normalStiffness, phys.shearStiffness };
    const double before = strain.energy(stiffness, phys.damage), left = 1 - phys.damage;
    auto* const own = dynamic_cast<ScGeomConicPP*>(&geom);
    if (!phys.bonded && !(own && own->isHeldByBond())) {
        phys.shearDisplacement = left * strain.slip();
        phys.twist = left * strain.twist();
        phys.endBond();
        phys.broken = true;
        energies.breaking = before;
        return false;
    }
    const double damage = phys.bonded ? damageOf(phys, strain) : 0;
    if (damage >= 1)
        phys.bonded = false;
    else
        phys.damage = std::max(phys.damage, damage);
    if (own)
        own->setHeldByBond(phys.bonded);
    energies.elastic = strain.energy(stiffness, phys.damage);
    energies.breaking = before - energies.elastic;

    const Vector3r n = strain.normal();
    const BondStrain::Reaction reaction = strain.reaction(stiffness);
    phys.kn = phys.normalStiffness * phys.bondArea;
    phys.ks = phys.shearStiffness * phys.bondArea;
    phys.twistStiffness = phys.shearStiffness * phys.bondMoments.x();
    phys.couple = 0;
    phys.isSliding = false;
    Wrench damping { Vector3r::Zero(), Vector3r::Zero() };
    const Vector3r middle = strain.middle();
    if (phys.dampingRatio > 0) {
        const auto perArea = [&](const Vector3r& direction, double springs) {
            const double mobility = joint.one.mobility(middle, direction) + joint.other.mobility(middle, direction);
            return dashpotPerArea(phys, springs, mobility, phys.bondArea);
        };
        const Vector3r velocity = joint.other.velocityAt(middle) - joint.one.velocityAt(middle);
        const Vector3r spin = joint.other.spin() - joint.one.spin();
        damping = strain.dashpot({ perArea(n, stiffness.normal), perArea(n.unitOrthogonal(), stiffness.shear) }, velocity, spin);
        energies.viscous = -scene->dt * (damping.force.dot(velocity) + damping.moment.dot(spin));
    }
    const Vector3r force = reaction.force + damping.force, moment = reaction.torque2 + damping.moment;
    phys.normalForce = force.dot(n) * n;
    phys.shearForce = force - phys.normalForce;
    phys.twistMoment = moment.dot(n);
    phys.bendingMoment = moment - phys.twistMoment * n;
    // Where no contact was found or sought, it is where the bond is.
    if (geom.penetrationDepth < 0) {
        geom.contactPoint = middle;
        geom.normal = n;
    }
    // One force a body: in which order threads add up more of them is left to chance.
    joint.one.push(strain.point1(), -force, reaction.torque1 - damping.moment - (middle - strain.point1()).cross(damping.force));
    joint.other.push(strain.point2(), force, reaction.torque2 + damping.moment + (middle - strain.point2()).cross(damping.force));
    return true;
}

// The springs along the joint: how far they are drawn, and turned about the normal.
struct Law::Springs {
    Vector3r shear;
    double twist;
};

// broken: the bond has in this step; its springs along the joint are now those of the patch.
void Law::holdAsPatch(const Joint& joint, const ContactPatch& patch, bool broken, Energies& energies) const
{
    const yade::ScGeom& geom = joint.geom;
    ConicJointPhys& phys = joint.phys;
    const MovingBody &one = joint.one, &other = joint.other;
    const Vector3r& n = geom.normal;

    Wrench damping { Vector3r::Zero(), Vector3r::Zero() };
    if (phys.dampingRatio > 0)
        damping = dashpot(phys, geom, patch, one, other);
    const double pressing = phys.normalStiffness * patch.force + damping.force.dot(n), pressure = phys.normalStiffness * patch.energy;
    if (broken)
        energies.breaking -= pressure;
    Springs springs = springsAlong(joint, patch, broken, energies);
    const FrictionForce limit = slip(phys, patch, pressing, springs, energies);
    phys.shearDisplacement = springs.shear;
    phys.twist = springs.twist;
    phys.normalForce = pressing * n;
    phys.shearForce = -phys.ks * springs.shear;
    phys.twistMoment = -phys.twistStiffness * springs.twist;
    phys.couple = phys.normalStiffness * patch.couple;
    energies.elastic = pressure + phys.springEnergy(springs.shear, springs.twist);
    const Wrench ofSprings { phys.normalStiffness * patch.force * n + phys.shearForce, (phys.couple + phys.twistMoment) * n };

    if (phys.dampingRatio > 0) {
        energies.viscous = -scene->dt * (damping.force.dot(other.velocityAt(geom.contactPoint) - one.velocityAt(geom.contactPoint))
                                         + damping.moment.dot(other.spin() - one.spin()));
        if (!phys.isSliding)
            dampAlong(joint, patch, limit.shear, energies);
    }

    const Vector3r force = phys.normalForce + phys.shearForce;
    const Vector3r moment = (phys.couple + phys.twistMoment) * n + damping.moment;
    one.push(geom.contactPoint, -force, -moment);
    other.push(geom.contactPoint, force, moment);

    if (phys.bonded) {
        bondPatch(phys, patch, { geom.contactPoint, n }, ofSprings, one, other);
        phys.shearDisplacement = Vector3r::Zero();
        phys.twist = 0;
        const double energy = BondStrain(phys, { one.centre(), one.turn() }, { other.centre(), other.turn() })
                                  .energy({ phys.normalStiffness, phys.shearStiffness }, 0);
        energies.area += energies.elastic - energy;
        energies.elastic = energy;
    }
}

// The springs of the joint take along what they hold, and are drawn by the motion of this step; where the patch grows or shrinks, springs
// join and leave.
Law::Springs Law::springsAlong(const Joint& joint, const ContactPatch& patch, bool broken, Energies& energies) const
{
    yade::ScGeom& geom = joint.geom;
    ConicJointPhys& phys = joint.phys;
    const Vector3r& n = geom.normal;
    const double formerEnergy = phys.springEnergy(phys.shearDisplacement, phys.twist);
    Springs springs { phys.shearDisplacement, phys.twist };
    if (const double length = springs.shear.norm(); length > 0) {
        if (!broken)
            geom.rotate(springs.shear);
        springs.shear -= springs.shear.dot(n) * n;
        if (const double left = springs.shear.norm(); left > 0)
            springs.shear *= length / left;
    }
    phys.kn = phys.normalStiffness * patch.area;
    phys.ks = phys.shearStiffness * patch.area;
    phys.twistStiffness = phys.shearStiffness * patch.polarMoment;
    const double energyWithArea = phys.springEnergy(springs.shear, springs.twist);
    if (broken) {
        energies.breaking -= energyWithArea;
    } else {
        energies.area = formerEnergy - energyWithArea;
        springs.shear += geom.shearInc;
        springs.twist += (joint.other.spin() - joint.one.spin()).dot(n) * scene->dt;
    }
    return springs;
}

// Lets the springs slip where they hold more than friction and cohesion can; a joint that slips for the first time breaks. Returns what
// these can hold after that.
FrictionForce Law::slip(ConicJointPhys& phys, const ContactPatch& patch, double pressing, Springs& springs, Energies& energies)
{
    auto& [shear, twist] = springs;
    const FrictionForce trial { phys.ks * shear.norm(), phys.twistStiffness * std::abs(twist) };
    const double trialEnergy = phys.springEnergy(shear, twist);
    FrictionForce limit = limitOf(phys, patch, pressing), held = returned(trial, limit, phys.ks, phys.twistStiffness);
    phys.isSliding = held.shear < trial.shear || held.twist < trial.twist;
    if (!phys.isSliding)
        return limit;
    const bool breaks = !phys.broken;
    if (breaks) {
        phys.broken = true;
        limit = limitOf(phys, patch, pressing);
        held = returned(trial, limit, phys.ks, phys.twistStiffness);
    }
    const double shearLeft = trial.shear > 0 ? held.shear / trial.shear : 0, twistLeft = trial.twist > 0 ? held.twist / trial.twist : 0;
    energies.friction = held.shear * (1 - shearLeft) * shear.norm() + held.twist * (1 - twistLeft) * std::abs(twist);
    shear *= shearLeft;
    twist *= twistLeft;
    // What the strength was above the residual one is lost at once; friction does work over the slip.
    if (breaks)
        energies.breaking += trialEnergy - phys.springEnergy(shear, twist) - energies.friction;
    return limit;
}

// While it sticks, the joint is damped along its plane as it is across it; spring and dashpot together hold no more than the limit.
void Law::dampAlong(const Joint& joint, const ContactPatch& patch, double limit, Energies& energies) const
{
    const yade::ScGeom& geom = joint.geom;
    ConicJointPhys& phys = joint.phys;
    const MovingBody &one = joint.one, &other = joint.other;
    const double spin = (other.spin() - one.spin()).dot(geom.normal);
    const Vector3r direction = geom.shearInc.norm() > 0 ? Vector3r(geom.shearInc.normalized()) : geom.normal.unitOrthogonal();
    const double mobility = one.mobility(geom.contactPoint, direction) + other.mobility(geom.contactPoint, direction);
    const double perArea = dashpotPerArea(phys, phys.shearStiffness, mobility, patch.area);
    Vector3r total = phys.shearForce - perArea * patch.area / scene->dt * geom.shearInc;
    if (total.norm() > limit)
        total *= limit / total.norm();
    const double moment = -perArea * patch.polarMoment * spin;
    energies.viscous -= (total - phys.shearForce).dot(geom.shearInc) + moment * spin * scene->dt;
    phys.shearForce = total;
    phys.twistMoment += moment;
}

void Law::track(const Energies& energies)
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
