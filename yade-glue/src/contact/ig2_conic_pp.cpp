// SPDX-License-Identifier: GPL-3.0-or-later
//
// What go() does. The attributes and their way to Python and archives: ig2_conic_pp_python.cpp.
#include "abi/knksphys.hpp"
#include "abi/scene.hpp"
#include "ig2_conic_pp.hpp"
#include "pair_in_scene.hpp"
#include "shape/particle_of.hpp"
#include "loop/relative_motion.hpp"
#include "loop/step.hpp"

#include "plugin-common/new_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace potential_particles {

using yade::Interaction;
using yade::ScGeom;
using yade::Shape;
using yade::State;
using yade::Vector3r;

namespace {

    // A boundary may prescribe the normal (world axes); the second shape has the last word, as in
    // YADE's own functor. False when none does, or when what it prescribes has no direction.
    bool prescribedNormal(const Shape& one, const Shape& other, Vector3r& normal)
    {
        const auto* const shape1 = potentialParticle(one);
        const auto* const shape2 = potentialParticle(other);
        const bool by2 = shape2 && shape2->fixedNormal;
        if (!by2 && !(shape1 && shape1->fixedNormal))
            return false;
        const Vector3r given = by2 ? Vector3r(-shape2->boundaryNormal) : shape1->boundaryNormal;
        if (!(given.norm() > 0 && given.allFinite()))
            return false;
        normal = given.normalized();
        return true;
    }

    // Distance from `point`, outside of a particle, to its surface along a unit vector into it; not a number if it is
    // missed. Found from points within, deeper and deeper, back to where the line leaves it.
    double gapBefore(const Particle& particle, const pp_pose& pose, const Vector3r& point, const Vector3r& inwards)
    {
        for (double way = 1e-3 * particle.boundingRadius(); way < 4 * particle.boundingRadius(); way *= 2) {
            const double back = distanceToSurface(particle, pose, point + way * inwards, -inwards);
            if (back > 0)
                return way - back;
        }
        return std::numeric_limits<double>::quiet_NaN();
    }

} // namespace

struct Ig2_ConicPP_ConicPP_ScGeom::Pair : PairInScene {
    const boost::shared_ptr<Shape>& cm1;
    const boost::shared_ptr<Shape>& cm2;

    // Where a ConicInteractionLoop runs: what it knows already.
    const BodyInStep* const body1;
    const BodyInStep* const body2;
    PairInStep* const known;
    // Whether it is a loop of our own, which has gathered the bodies.
    const bool gathered = false;

    const Particle* particle1 = nullptr;
    const Particle* particle2 = nullptr;
    std::shared_ptr<const Particle> keeper1 = nullptr;
    std::shared_ptr<const Particle> keeper2 = nullptr;

    void findParticles()
    {
        if (known) {
            particle1 = body1->particle;
            particle2 = body2->particle;
        } else {
            particle1 = particleOf(cm1, keeper1);
            particle2 = particleOf(cm2, keeper2);
        }
    }

    pp_pose pose1() const { return gathered ? poseOf(*body1) : PairInScene::pose1(); }
    pp_pose pose2() const { return gathered ? poseOf(*body2) : PairInScene::pose2(); }

    static pp_pose poseOf(const BodyInStep& body)
    {
        const Vector3r& at = body.position;
        const yade::Quaternionr& turn = body.orientation;
        return { { at.x(), at.y(), at.z() }, { turn.w(), turn.x(), turn.y(), turn.z() } };
    }

    void precompute(const Vector3r& normal, const yade::Scene* scene)
    {
        if (gathered && own)
            turnFrame(*geom, *body1, *body2, scene->dt, normal, !real);
        else
            PairInScene::precompute(normal, scene);
    }

    bool areBoundaries() const
    {
        if (gathered)
            return body1->isBoundary && body2->isBoundary;
        const auto* const shape1 = potentialParticle(*cm1);
        const auto* const shape2 = potentialParticle(*cm2);
        return shape1 && shape2 && shape1->isBoundary && shape2->isBoundary;
    }

    bool prescribesNormal(Vector3r& normal) const
    {
        return (!gathered || body1->fixesNormal || body2->fixesNormal) && prescribedNormal(*cm1, *cm2, normal);
    }

    KeptApart::Turned turned1() const { return { *particle1, state1.se3.orientation }; }
    KeptApart::Turned turned2() const { return { *particle2, state2.se3.orientation }; }

    // Whether they were apart, and have not moved by the distance between them since.
    bool isKeptApart()
    {
        const double left = own && own->apart.isKnown() ? own->apart.left(turned1(), turned2(), branch()) : 0;
        if (left > 0)
            noteRoom(left);
        return left > 0;
    }

    void noteApart(double distance)
    {
        if (!own)
            return;
        noteRoom(own->apart.note(turned1(), turned2(), branch(), distance));
    }

    // A pair with physics is never skipped: its law runs in each step.
    void noteRoom(double room)
    {
        if (known)
            known->note(interaction, *body1, *body2, real ? 0 : room);
    }

    void noteTouching()
    {
        if (own)
            own->apart.forget();
        if (!known)
            return;
        if (gathered) { // the loop notes the rest
            known->wakes = 0;
            return;
        }
        known->note(interaction, *body1, *body2, 0);
        Step::current()->noteContact(static_cast<std::size_t>(interaction->linIx), *known, *interaction);
    }
};

bool Ig2_ConicPP_ConicPP_ScGeom::go(const boost::shared_ptr<Shape>& cm1, const boost::shared_ptr<Shape>& cm2,
                                    const State& state1, const State& state2, const Vector3r& shift2, const bool& force,
                                    const boost::shared_ptr<Interaction>& interaction) noexcept
{
    return served(state1, state2, shift2, force, interaction, nullptr, [&](const PairInScene& of) {
        const BodyInStep *body1 = nullptr, *body2 = nullptr;
        PairInStep* known = nullptr;
        // A periodic image moves by itself.
        if (Step* const step = Step::current(); step && shift2.isZero(0)) {
            body1 = step->body(interaction->id1, cm1, state1);
            body2 = step->body(interaction->id2, cm2, state2);
            known = body1 && body2 && body1->particle && body2->particle ? step->pair(*interaction) : nullptr;
            if (known) {
                step->fetchAhead(static_cast<std::size_t>(interaction->linIx));
                if (!of.real && !force && known->isOf(interaction) && known->sleeps(body1->way, body2->way)) {
                    countSleeping(of.counts, 1);
                    return false;
                }
            }
        }
        Pair pair { of, cm1, cm2, body1, body2, known };
        return answer(pair);
    });
}

bool Ig2_ConicPP_ConicPP_ScGeom::goInLoop(Step& step, Counters::Row& counts, BodyInStep& body1, BodyInStep& body2,
                                          PairInStep& pairInStep,
                                          const boost::shared_ptr<Interaction>& interaction) noexcept
{
    const boost::shared_ptr<Shape>&cm1 = *body1.shape, &cm2 = *body2.shape;
    const Vector3r shift2 = Vector3r::Zero();
    return served(*body1.state, *body2.state, shift2, false, interaction, &counts, [&](const PairInScene& of) {
        step.look(body1, cm1, of.state1);
        step.look(body2, cm2, of.state2);
        PairInStep* const known = body1.particle && body2.particle ? &pairInStep : nullptr;
        // The bodies may not have been looked at before.
        if (known && !of.real && known->sleeps(body1.way, body2.way)) {
            countSleeping(counts, 1);
            return false;
        }
        Pair pair { of, cm1, cm2, &body1, &body2, known, true };
        return answer(pair);
    });
}

void Ig2_ConicPP_ConicPP_ScGeom::countSleeping(Counters::Row& counts, std::uint64_t pairs)
{
    counts.add(Count::calls, pairs);
    counts.add(Count::motion, pairs);
}

bool Ig2_ConicPP_ConicPP_ScGeom::answer(Pair& pair)
{
    if (pair.areBoundaries())
        return false;
    if (pair.isHeldByBond())
        return leaveApart(pair);
    pair.counts.add(Count::calls);
    pair.findParticles();
    return contact(pair);
}

void Ig2_ConicPP_ConicPP_ScGeom::lookAtDepth(const Interaction& pair, double rounding, double overlap,
                                             Counters::Row& counts) noexcept
{
    if (!(overlap > rounding))
        return;
    counts.add(Count::deepOverlaps);
    if (!saidDepth.exchange(true, std::memory_order_relaxed))
        std::fprintf(
            stderr,
            "potential_particles: step %ld: bodies %d and %d overlap by %.3g of the rounding radius r: start them "
            "apart (pack), take a stiffer contact, or a larger r (deepOverlaps of the functor counts on)\n",
            scene ? scene->iter : 0L, pair.id1, pair.id2, overlap / rounding);
}

// The pair is solved as it comes, so there is nothing to reverse: both shapes are of one kind, and
// body 1 of the interaction is body 1 of the arguments.
bool Ig2_ConicPP_ConicPP_ScGeom::goReverse(const boost::shared_ptr<Shape>& cm1, const boost::shared_ptr<Shape>& cm2,
                                           const State& state1, const State& state2, const Vector3r& shift2,
                                           const bool& force,
                                           const boost::shared_ptr<Interaction>& interaction) noexcept
{
    return go(cm1, cm2, state1, state2, shift2, force, interaction);
}

bool Ig2_ConicPP_ConicPP_ScGeom::contact(Pair& pair)
{
    if (!pair.findGeom()) {
        fail(pair, "the interaction holds a geometry that is no ScGeom; it is left as it is");
        return true;
    }
    for (const auto* particle : { pair.particle1, pair.particle2 }) {
        if (!particle->handle()) {
            fail(pair,
                 (particle == pair.particle1 ? "shape of the first body: " : "shape of the second body: ")
                     + particle->refusal());
            return keep(pair);
        }
    }

    const ContactSettings& given = pair.settings.given;
    const bool held = pair.real && given.seesGaps();
    if (!held && pair.isKeptApart()) {
        pair.counts.add(Count::motion);
    } else {
        pp_contact found;
        if (const pp_status status = detect(pair, found); status != PP_OK) {
            fail(pair, pp_status_message(status));
            return keep(pair);
        }
        pair.counts.add(pathOf(found));
        if (found.flags & PP_FLAG_EXTENDED)
            pair.counts.add(Count::extended);

        if (found.kind == PP_OVERLAPPING) {
            if (Vector3r normal; given.patch && pair.prescribesNormal(normal)) {
                fail(pair,
                     "patch = True and a shape with fixedNormal = True: a patch has the normal of its pressure; set "
                     "fixedNormal = False, or "
                     "patch = False for a point along boundaryNormal");
                return keep(pair);
            }
            pair.counts.add(Count::overlapping);
            pair.noteTouching();
            fill(pair, found);
            lookAtDepth(*pair.interaction, std::min(pair.particle1->rounding(), pair.particle2->rounding()),
                        found.overlap, pair.counts);
            return true;
        }
        if (held || (given.interactionDistance > 0 && !(found.distance > given.interactionDistance)))
            return acrossGap(pair);
        pair.noteApart(found.distance - given.interactionDistance);
    }
    return leaveApart(pair);
}

// A pair that does not touch, for laws that ask how far it is apart: solved to the end. Where no gap along the normal
// is found, it is no pair that a law could hold.
bool Ig2_ConicPP_ConicPP_ScGeom::acrossGap(Pair& pair)
{
    pp_settings settings = pair.settings.library;
    settings.solve_separated = 1;
    const pp_pose pose1 = pair.pose1(), pose2 = pair.pose2();
    pp_contact found;
    if (const pp_status status = pp_contact_detect(pair.particle1->handle(), &pose1, pair.particle2->handle(), &pose2,
                                                   &settings, nullptr, &found);
        status != PP_OK) {
        fail(pair, pp_status_message(status));
        return keep(pair);
    }
    const Vector3r point(found.point), normal(found.normal);
    const double gap
        = gapBefore(*pair.particle1, pose1, point, -normal) + gapBefore(*pair.particle2, pose2, point, normal);
    if (!std::isfinite(gap) || (!pair.real && gap > pair.settings.given.interactionDistance)) {
        pair.noteApart(0);
        return leaveApart(pair);
    }
    pair.noteTouching();
    yade::ScGeom& geom = *pair.geom;
    geom.refR1 = pair.particle1->boundingRadius();
    geom.refR2 = pair.particle2->boundingRadius();
    geom.contactPoint = point;
    geom.penetrationDepth = -gap;
    pair.precompute(normal, scene);
    return true;
}

bool Ig2_ConicPP_ConicPP_ScGeom::leaveApart(PairInScene& pair)
{
    if (!pair.real && !pair.force)
        return false;
    // The law ends the contact when it reads a negative overlap.
    pair.geom->penetrationDepth = apart;
    pair.precompute(pair.lastNormal(), scene);
    return true;
}

// Unknown is not separated: a contact keeps its last overlap, point and normal for this step.
bool Ig2_ConicPP_ConicPP_ScGeom::keep(PairInScene& pair)
{
    if (pair.real)
        pair.precompute(pair.lastNormal(), scene);
    return pair.real || pair.force;
}

pp_status Ig2_ConicPP_ConicPP_ScGeom::detect(Pair& pair, pp_contact& found)
{
    const pp_pose pose1 = pair.pose1(), pose2 = pair.pose2();
    pp_pair_state* const state = pair.state();
    const auto ask = [&] {
        return pp_contact_detect(pair.particle1->handle(), &pose1, pair.particle2->handle(), &pose2,
                                 &pair.settings.library, state, &found);
    };
    return fromNothingIfNew(ask(), found, pair.real, state, ask);
}

void Ig2_ConicPP_ConicPP_ScGeom::fill(Pair& pair, pp_contact& found)
{
    const Posed body1 { pair.particle1, pair.pose1() }, body2 { pair.particle2, pair.pose2() };
    // For physics made from radii (FrictPhys, Mindlin). A property of the body, so that stiffness
    // does not depend on where a particle happens to be touched first.
    pair.geom->refR1 = pair.particle1->boundingRadius();
    pair.geom->refR2 = pair.particle2->boundingRadius();

    const Vector3r point(found.point);
    Vector3r normal(found.normal);
    if (pair.settings.given.patch) {
        pp_patch patch;
        const pp_status status = pp_patch_of_contact(body1.particle->handle(), &body1.pose, body2.particle->handle(),
                                                     &body2.pose, &found, pair.settings.given.patchTolerance,
                                                     tracksEnergy(), pair.lastPatch(), &patch, nullptr, 0, nullptr);
        if (fillPatch(pair, status, patch, Vector3r::Zero(), 1.0)) {
            fillPhysics(pair, body1, body2, found, patch.area);
            return;
        }
    }
    if (!pair.settings.given.patch && pair.prescribesNormal(normal)) {
        // Overlap, and the points on both surfaces, along that normal through the contact point.
        const double depth1 = distanceToSurface(*pair.particle1, pair.pose1(), point, normal);
        const double depth2 = distanceToSurface(*pair.particle2, pair.pose2(), point, -normal);
        found.overlap = depth1 + depth2;
        copyTo(found.normal, normal);
        copyTo(found.point_on_a, point + depth1 * normal);
        copyTo(found.point_on_b, point - depth2 * normal);
    }

    // In this order: precompute() takes the old normal and the new contact point.
    ScGeom& geom = *pair.geom;
    geom.contactPoint = point;
    geom.penetrationDepth = found.overlap;
    pair.precompute(normal, scene);
    fillPhysics(pair, body1, body2, found, 0);
}

bool Ig2_ConicPP_ConicPP_ScGeom::tracksEnergy() const { return scene && scene->trackEnergy; }

bool Ig2_ConicPP_ConicPP_ScGeom::fillPatch(PairInScene& pair, pp_status status, const pp_patch& patch,
                                           const Vector3r& origin, double sense)
{
    const std::optional<PatchInStep> here = PatchInStep::of(status, patch);
    if (!here) {
        pair.counts.add(Count::patchFallbacks);
        return false;
    }
    pair.counts.add(Count::patches);
    if (patch.flags & PP_PATCH_CARRIED)
        pair.counts.add(Count::patchesCarried);
    if (patch.flags & ~PP_PATCH_CARRIED)
        pair.counts.add(Count::doubtfulPatches);
    ScGeom& geom = *pair.geom;
    geom.contactPoint = origin + here->point;
    geom.penetrationDepth = here->patch.force / here->patch.area;
    pair.precompute(sense * here->normal, scene);
    if (pair.own)
        pair.own->setPatch(here->patch);
    return true;
}

double Ig2_ConicPP_ConicPP_ScGeom::areaAtPoint(const PairInScene& pair, const Posed& body1, const Posed& body2,
                                               const pp_contact& found)
{
    double area;
    const pp_status status = pp_contact_area(body1.particle->handle(), &body1.pose, body2.particle->handle(),
                                             &body2.pose, &found, pair.settings.given.areaTolerance, &area);
    // Bodies that overlap by nothing but rounding: no point lies in both, and no force comes from such a contact.
    if (status == PP_BAD_POINT)
        area = 0;
    else
        requireOk(status);
    pair.counts.add(Count::areas);
    return area;
}

void Ig2_ConicPP_ConicPP_ScGeom::fillPhysics(PairInScene& pair, const Posed& body1, const Posed& body2,
                                             const pp_contact& found, double patchArea)
{
    const ContactSettings& settings = pair.settings.given;
    if (settings.patch && patchArea == 0 && pair.own) {
        patchArea = areaAtPoint(pair, body1, body2, found);
        pair.own->setPatch(ContactPatch::disc(patchArea, found.overlap, Vector3r(found.normal)));
    }
    // In the first step of a contact YADE calls this functor before the one that makes the physics:
    // the area of that step stays 0, as with YADE's own functor. Physics of another kind have no
    // place for an area, which is then not computed at all.
    yade::IPhys* const given = pair.interaction->phys.get();
    if (!given || typeid(*given) == typeid(ConicJointPhys))
        return;
    auto* const phys = castTo<yade::KnKsPhys, yade::KnKsPhys>(given);
    if (!phys)
        return;
    phys->ptOnP1 = Vector3r(found.point_on_a);
    phys->ptOnP2 = Vector3r(found.point_on_b);

    if (!settings.calContactArea) {
        phys->jointLength = 1.0;
        phys->contactArea = settings.twoDimension ? settings.unitWidth2D : 1.0;
    } else if (settings.twoDimension) {
        // The width of the overlap in the plane, across the normal.
        const Vector3r normal(found.normal), outOfPlane = settings.twoDdir.stableNormalized();
        Vector3r across = normal.cross(outOfPlane);
        if (across.norm() < 1e-7)
            across = outOfPlane.unitOrthogonal();
        across.normalize();
        const Vector3r point(found.point);
        const auto reach = [&](const Vector3r& direction) {
            return std::min(distanceToSurface(*body1.particle, body1.pose, point, direction),
                            distanceToSurface(*body2.particle, body2.pose, point, direction));
        };
        phys->jointLength = reach(across) + reach(-across);
        phys->contactArea = settings.unitWidth2D * phys->jointLength;
        pair.counts.add(Count::areas);
    } else {
        phys->contactArea = patchArea > 0 ? patchArea : areaAtPoint(pair, body1, body2, found);
    }
}

void Ig2_ConicPP_ConicPP_ScGeom::fail(const PairInScene& pair, const std::string& why)
{
    fail(*pair.interaction, pair.state1, pair.state2, pair.shift2, why.c_str());
}

void Ig2_ConicPP_ConicPP_ScGeom::fail(const Interaction& interaction, const State& state1, const State& state2,
                                      const Vector3r& shift2, const char* why) noexcept
{
    try {
        counters.ofThisThread().add(Count::failures);
        failures.add(
            { interaction.id1, interaction.id2, poseOf(state1, Vector3r::Zero()), poseOf(state2, shift2), why });
    } catch (...) {
        // There may be no memory for a copy of the text, nor for a first row of counters.
    }
}

} // namespace potential_particles
