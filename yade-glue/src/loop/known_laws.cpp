// SPDX-License-Identifier: GPL-3.0-or-later
//
// In both laws the order of the operations is YADE's: with another one the last digits differ.
#include "known_laws.hpp"

#include "abi/knksphys.hpp"
#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "relative_motion.hpp"

#include <algorithm>

namespace potential_particles {

using yade::Vector3r;

namespace {

    // Powers of ten as the C library gives them when YADE runs: not folded by the compiler, which may round otherwise.
    double powerOfTen(int exponent)
    {
        const volatile double ten = 10, power = exponent;
        return std::pow(ten, power);
    }
    const double leastArea = powerOfTen(-15);
    const double leastSlip = powerOfTen(-15);
    const double leastShearForce = powerOfTen(-11);
    const double leastDirection = powerOfTen(-11);

    Push pushAt(const Levers& levers, const Vector3r& force)
    {
        return { force, levers.first.cross(force), -levers.second.cross(force) };
    }

    void track(yade::Scene& scene, double energy, const char* name, int& number, bool ofStep)
    {
        scene.energy->add(energy, name, number, ofStep);
    }

    double elasticEnergy(const yade::FrictPhys& phys)
    {
        return 0.5 * (phys.normalForce.squaredNorm() / phys.kn + phys.shearForce.squaredNorm() / phys.ks);
    }

    double slipEnergy(const yade::FrictPhys& phys, const Vector3r& trial)
    {
        return ((1 / phys.ks) * (trial - phys.shearForce)).dot(phys.shearForce);
    }

    bool boxesApart(const BodyInStep& one, const BodyInStep& other)
    {
        for (int i = 0; i < 3; ++i)
            if (one.lowest[i] >= other.highest[i] + 0.0 || other.lowest[i] + 0.0 >= one.highest[i])
                return true;
        return false;
    }

} // namespace

Done cundallStrack(yade::Law2_ScGeom_FrictPhys_CundallStrack& law, yade::Scene& scene, const yade::ScGeom& geom,
                   yade::FrictPhys& phys, const BodyInStep& one, const BodyInStep& other, Push& push)
{
    if (law.sphericalBodies || law.traceEnergy)
        return Done::notKnown;
    const double depth = geom.penetrationDepth;
    if (depth < 0) {
        if (!law.neverErase)
            return Done::ended;
        phys.shearForce = phys.normalForce = Vector3r::Zero();
    }
    phys.normalForce = phys.kn * std::max(depth, 0.0) * geom.normal;
    Vector3r& shear = phys.shearForce;
    carryAlong(geom, shear);
    shear -= phys.ks * geom.shearInc;
    const double most = phys.normalForce.squaredNorm() * (phys.tangensOfFrictionAngle * phys.tangensOfFrictionAngle);
    if (shear.squaredNorm() > most) {
        const Vector3r trial = shear;
        shear *= std::sqrt(most) / trial.norm();
        if (scene.trackEnergy)
            if (const double lost = slipEnergy(phys, trial); lost > 0)
                track(scene, lost, "plastDissip", law.plastDissipIx, false);
    }
    if (scene.trackEnergy)
        track(scene, elasticEnergy(phys), "elastPotential", law.elastPotentialIx, true);
    push = pushAt(Levers(geom.contactPoint, one, other), -phys.normalForce - shear);
    return Done::pushed;
}

Done knKs(yade::Law2_SCG_KnKsPhys_KnKsLaw& law, yade::Scene& scene, const yade::ScGeom& geom, yade::KnKsPhys& phys,
          const BodyInStep& one, const BodyInStep& other, LastTangent& tangent, Push& push)
{
    const bool known = !law.Talesnick && !law.traceEnergy && law.initialOverlapDistance == 0 && phys.jointType != 3
        && !phys.intactRock && one.hasBox && other.hasBox;
    const double depth = geom.penetrationDepth;
    if (!known || (depth < 0 && law.neverErase))
        return Done::notKnown;
    if (depth < 0)
        return Done::ended;
    Vector3r& shear = phys.shearForce;
    carryAlong(geom, shear);
    if (boxesApart(one, other))
        return Done::ended;

    const Vector3r& normal = geom.normal;
    const double dt = scene.dt;
    const Levers levers(geom.contactPoint, one, other);
    const Vector3r velocity = levers.velocity(one, other);
    const Vector3r opening = normal.dot(velocity) * normal, sliding = velocity - opening;
    {
        // How far it has slid. The velocity of periodic images is added: -0 becomes 0.
        const Vector3r shifted = velocity + Vector3r::Zero();
        const Vector3r slip = (shifted - Vector3r(normal.dot(shifted) * normal)) * dt;
        const double length = slip.norm();
        phys.shearDir = slip;
        phys.shearIncrementForCD += length;
        if (length > leastSlip)
            phys.shearDir.normalize();
        double way = length;
        const bool slides = std::abs(phys.mobilizedShear) > 0.99999;
        bool onwards = true;
        if (phys.initialShearDir.norm() < leastDirection) {
            phys.initialShearDir = phys.shearDir;
        } else {
            const double sense = phys.initialShearDir.dot(phys.shearDir);
            way = ((0 < sense) - (sense < 0)) * length;
            onwards = way > 0;
        }
        if (slides && onwards) {
            phys.u_cumulative += way;
            phys.cumulative_us += way;
        } else {
            phys.u_elastic += way;
        }
    }
    // YADE's functor reads every shape as if it were a PotentialParticle. What it reads from other shapes is undefined;
    // no force depends on these two.
    if (one.isBoundary || other.isBoundary)
        phys.tensionBroken = phys.cohesionBroken = true;

    const double area = std::max(leastArea, phys.contactArea);
    phys.prevSigma = phys.knVol * depth;
    phys.normalForce = phys.prevSigma * area * normal;
    phys.kn = phys.knVol * area;
    const Vector3r slip = sliding * dt;
    shear -= phys.ksVol * slip * area;
    phys.ks = phys.ksVol * area;

    const double mass = one.isHeld && !other.isHeld ? other.mass
        : other.isHeld && !one.isHeld               ? one.mass
                                                    : one.mass * other.mass / (one.mass + other.mass);
    const double dashpot = 2. * std::sqrt(mass * phys.kn) * phys.viscousDamping;
    phys.normalViscous = dashpot * opening;
    phys.normalForce -= phys.normalViscous;
    if (!law.allowViscousAttraction && phys.normalForce.dot(normal) < 0)
        phys.normalForce = Vector3r::Zero();

    phys.effective_phi = phys.phi_b;
    const double friction = tangent.of(phys.phi_b);
    const double most = depth > 0.0 ? std::max(phys.normalForce.norm(), 0.0) * friction : 0.0;
    double length = shear.norm();
    phys.isSliding = length > most;
    phys.shearViscous = Vector3r::Zero();
    if (phys.isSliding) {
        const Vector3r trial = shear;
        shear *= most / length;
        length = shear.norm();
        if (law.allowBreakage)
            phys.cohesionBroken = true;
        if (scene.trackEnergy)
            if (const double lost = slipEnergy(phys, trial); lost > 0)
                track(scene, lost, "plastDissip", law.plastDissipIx, false);
    }
    if (scene.trackEnergy) {
        track(scene, elasticEnergy(phys), "elastPotential", law.elastPotentialIx, true);
        if (phys.viscousDamping > 0.0) {
            const Vector3r opened = opening * dt;
            if (const double lost = phys.normalViscous.dot(opened); lost > 0)
                track(scene, lost, "normDampDissip", law.normDampDissipIx, false);
        }
    }
    phys.mobilizedShear = length < leastShearForce ? 1.0 : length / most;
    push = pushAt(levers, -phys.normalForce - shear);
    phys.prevNormal = normal;
    return Done::pushed;
}

} // namespace potential_particles
