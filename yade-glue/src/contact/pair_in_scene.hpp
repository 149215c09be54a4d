// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every contact functor of ours knows about one call, and the interaction's geometry.
#pragma once

#include "abi/interaction.hpp"
#include "abi/registry.hpp"
#include "abi/scgeom.hpp"

#include "contact_settings.hpp"
#include "counters.hpp"
#include "ig2_conic_pp.hpp"
#include "particle/particle.hpp"
#include "pair/sc_geom_conic_pp.hpp"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace potential_particles {

// penetrationDepth of a pair that does not touch. Laws ask for its sign only: the width of the gap is not computed.
constexpr double apart = -1.0;

// dynamic_cast is slow; nearly always the object is of one known class.
template <class Usual, class Wanted, class Object> Wanted* castTo(Object* object)
{
    if (object && typeid(*object) == typeid(Usual))
        return static_cast<Usual*>(object);
    return dynamic_cast<Wanted*>(object);
}

inline void copyTo(double (&array)[3], const yade::Vector3r& vector) { std::copy_n(vector.data(), 3, array); }

inline bool isUnit(const yade::Vector3r& vector) { return std::abs(vector.squaredNorm() - 1) < 1e-6; }

// Of a finite length, else the x axis.
inline yade::Vector3r directionOf(const yade::Vector3r& vector)
{
    const double length = vector.norm();
    return length > 0 && std::isfinite(length) ? yade::Vector3r(vector / length)
                                               : yade::Vector3r(yade::Vector3r::UnitX());
}

struct PairInScene {
    const yade::State& state1;
    const yade::State& state2;
    const yade::Vector3r& shift2;
    const bool force;
    const boost::shared_ptr<yade::Interaction>& interaction;
    Counters::Row& counts;
    const AcceptedSettings& settings;
    // Both functors have run before: the pair has a history, which must not be dropped.
    const bool real;

    yade::ScGeom* geom = nullptr;
    ScGeomConicPP* own = nullptr; // geom, if it is one with memory

    // An ScGeom6D of YADE.
    static boost::shared_ptr<yade::IGeom> withRotations()
    {
        return boost::static_pointer_cast<yade::IGeom>(
            Singleton<yade::ClassFactory>::instance().createShared("ScGeom6D"));
    }

    // What the library keeps of the pair, if its geometry has a place for that.
    pp_pair_state* state() const { return own ? &own->state : nullptr; }

    pp_patch_state* lastPatch() const { return own ? own->lastPatch() : nullptr; }

    // Most pairs are answered without.
    pp_pose pose1() const { return poseOf(state1, yade::Vector3r::Zero()); }
    pp_pose pose2() const { return poseOf(state2, shift2); }

    yade::Vector3r branch() const { return state2.se3.position + shift2 - state1.se3.position; }

    // Finds or makes the geometry. False when another functor left one that is no ScGeom.
    bool findGeom()
    {
        if (geom)
            return true;
        geom = castTo<ScGeomConicPP, yade::ScGeom>(interaction->geom.get());
        if (geom && typeid(*geom) == typeid(ScGeomConicPP)) {
            own = static_cast<ScGeomConicPP*>(geom);
            own->dropIfSaved();
            return true;
        }
        if (real)
            return geom != nullptr; // of another functor or file, or with rotations: served without memory
        if (settings.given.rotations) {
            interaction->geom = withRotations();
            geom = static_cast<yade::ScGeom*>(interaction->geom.get());
            begin(*geom);
            return true;
        }
        const auto made = boost::make_shared<ScGeomConicPP>();
        begin(*made);
        interaction->geom = made;
        geom = own = made.get();
        return true;
    }

    // No contact is sought for such a pair.
    bool isHeldByBond() { return real && findGeom() && own && own->isHeldByBond(); }

    // Ends the step for this pair. The stored normal must still be that of the last step.
    void precompute(const yade::Vector3r& normal, const yade::Scene* scene)
    {
        geom->precompute(state1, state2, scene, interaction, normal, !real, shift2, false);
        if (!own && settings.given.rotations)
            if (auto* const turning = dynamic_cast<yade::ScGeom6D*>(geom))
                turning->precomputeRotations(state1, state2, !real, false);
    }

    // What holds of a pair that has not been solved.
    void begin(yade::ScGeom& made) const
    {
        made.normal = directionOf(branch());
        made.contactPoint = state1.se3.position + 0.5 * branch();
        made.penetrationDepth = apart;
    }

    // The normal of the last step, or the line of centres (a law may have zeroed the former).
    yade::Vector3r lastNormal() const { return isUnit(geom->normal) ? geom->normal : directionOf(branch()); }
};

template <class Answer>
bool Ig2_ConicPP_ConicPP_ScGeom::served(const yade::State& state1, const yade::State& state2,
                                        const yade::Vector3r& shift2, bool force,
                                        const boost::shared_ptr<yade::Interaction>& interaction, Counters::Row* counts,
                                        Answer answer) noexcept
{
    const bool real = interaction->hasGeomAndPhys();
    try {
        const AcceptedSettings& settings = *accepted.get();
        Counters::Row& row = counts ? *counts : counters.ofThisThread();
        const Stopwatch stopwatch(row, settings.given.measureTime);
        return answer(PairInScene { state1, state2, shift2, force, interaction, row, settings, real });
    } catch (const std::exception& error) {
        fail(*interaction, state1, state2, shift2, error.what());
    } catch (...) {
        fail(*interaction, state1, state2, shift2, "unknown error");
    }
    return real || (force && interaction->geom);
}

} // namespace potential_particles
