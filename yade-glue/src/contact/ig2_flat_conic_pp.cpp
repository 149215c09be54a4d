// SPDX-License-Identifier: GPL-3.0-or-later
//
// What go() does for a flat boundary, and for a wall.
#include "registration/definitions.hpp"

#include "flat_pair.hpp"
#include "ig2_flat_conic_pp.hpp"
#include "loop/step.hpp"
#include "particle/particle.hpp"
#include "shape/particle_of.hpp"

#include "plugin-common/new_contact.hpp"

#include <algorithm>

namespace potential_particles {

using yade::Interaction;
using yade::Shape;
using yade::State;
using yade::Vector3r;

namespace {

    Count pathOf(const pp_flat_contact& found)
    {
        if (found.flags & PP_FLAG_BY_SPHERES)
            return Count::spheres;
        if (found.flags & PP_FLAG_BY_MEMORY)
            return Count::memory;
        return found.flags & PP_FLAG_BY_FACE ? Count::face : Count::cold;
    }

} // namespace

bool Ig2_Flat_ConicPP::go(const boost::shared_ptr<Shape>& cm1, const boost::shared_ptr<Shape>& cm2, const State& state1,
                          const State& state2, const Vector3r& shift2, const bool& force,
                          const boost::shared_ptr<Interaction>& interaction) noexcept
{
    return served(state1, state2, shift2, force, interaction, nullptr, [&](const PairInScene& of) {
        FlatPair pair { of, *cm1 };
        return answer(pair, cm2);
    });
}

bool Ig2_Flat_ConicPP::goInLoop(Step& step, Counters::Row& counts, BodyInStep& body1, BodyInStep& body2,
                                PairInStep& pairInStep, const boost::shared_ptr<Interaction>& interaction) noexcept
{
    const Vector3r shift2 = Vector3r::Zero();
    return served(*body1.state, *body2.state, shift2, false, interaction, &counts, [&](const PairInScene& of) {
        step.look(body2, *body2.shape, of.state2);
        const bool waysAreKnown = body1.flat.kind != Flat::Kind::none && body2.particle;
        FlatPair pair { of, **body1.shape, &body1, &body2, waysAreKnown ? &pairInStep : nullptr };
        return answer(pair, *body2.shape);
    });
}

bool Ig2_Flat_ConicPP::answer(FlatPair& pair, const boost::shared_ptr<Shape>& shape2)
{
    // A wall is a boundary, and two boundaries never touch.
    if (const auto* shape = potentialParticle(*shape2); shape && shape->isBoundary)
        return false;
    if (pair.isHeldByBond())
        return leaveApart(pair);
    pair.counts.add(Count::calls);
    pair.particle = pair.known ? pair.body2->particle : particleOf(shape2, pair.keeper);
    return contact(pair);
}

bool Ig2_Flat_ConicPP::contact(FlatPair& pair)
{
    if (!pair.findGeom()) {
        fail(pair, "the interaction holds a geometry that is no ScGeom; it is left as it is");
        return true;
    }
    if (!pair.particle->handle()) {
        fail(pair, "shape of the second body: " + pair.particle->refusal());
        return keep(pair);
    }
    const BoundaryPoints points = pointsOf(pair);
    if (pair.isKeptApart(points)) {
        pair.counts.add(Count::motion);
        return leaveApart(pair);
    }
    pp_flat_contact found;
    if (const pp_status status = detect(pair, points, found); status != PP_OK) {
        fail(pair, pp_status_message(status));
        return keep(pair);
    }
    pair.counts.add(pathOf(found));
    if (found.kind != PP_OVERLAPPING) {
        pair.noteDistance(points, found.distance);
        return leaveApart(pair);
    }
    pair.counts.add(Count::overlapping);
    pair.noteTouching();
    fill(pair, points, found);
    lookAtDepth(*pair.interaction, pair.particle->rounding(), found.overlap, pair.counts);
    return true;
}

void Ig2_Flat_ConicPP::fill(FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found)
{
    const Vector3r centre = pair.centre();
    // From body 1, the boundary, to the particle.
    const Vector3r normal = -Vector3r(found.normal);
    // In this order: precompute() takes the old normal and the new contact point.
    yade::ScGeom& geom = *pair.geom;
    // For physics made from radii; a boundary has none of its own.
    geom.refR1 = geom.refR2 = pair.particle->boundingRadius();
    pp_patch patch;
    const bool patched
        = pair.settings.given.patch && fillPatch(pair, findPatch(pair, points, found, patch), patch, centre, -1.0);
    if (!patched) {
        geom.contactPoint = centre + Vector3r(found.point);
        geom.penetrationDepth = found.overlap;
        pair.precompute(normal, scene);
    }

    // The boundary cuts nothing off: the area is that of the particle with itself.
    pp_contact cut = {};
    cut.kind = PP_OVERLAPPING;
    copyTo(cut.normal, normal);
    copyTo(cut.point, centre + Vector3r(found.point));
    copyTo(cut.point_on_a, centre + Vector3r(found.on_boundary));
    copyTo(cut.point_on_b, centre + Vector3r(found.on_particle));
    copyTo(cut.branch_a, Vector3r(found.point));
    copyTo(cut.branch_b, Vector3r(found.point));
    const Posed posed { pair.particle, pair.pose2() };
    fillPhysics(pair, posed, posed, cut, patched ? patch.area : 0);
}

Ig2_Wall_ConicPP_ScGeom::~Ig2_Wall_ConicPP_ScGeom() = default;
PP_FUNCTOR_2D_DEFINITIONS(Ig2_Wall_ConicPP_ScGeom)
PP_PYTHON_AS_BASE(Ig2_Wall_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)
PP_ARCHIVE_AS_BASE(Ig2_Wall_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)

// The wall's orientation does not count, in YADE neither.
BoundaryPoints Ig2_Wall_ConicPP_ScGeom::pointsOf(const FlatPair& pair) const
{
    const int axis = static_cast<const yade::Wall&>(pair.boundary).axis;
    if (axis < 0 || axis > 2)
        throw std::invalid_argument("Wall.axis = " + std::to_string(axis) + ": choose 0, 1 or 2");
    Vector3r foot = Vector3r::Zero();
    foot[axis] = pair.state1.se3.position[axis] - pair.centre()[axis];
    return { foot, foot, foot };
}

pp_status Ig2_Wall_ConicPP_ScGeom::detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found)
{
    const auto& wall = static_cast<const yade::Wall&>(pair.boundary);
    const Vector3r normal = Vector3r::Unit(wall.axis) * (wall.sense < 0 ? -1 : 1);
    const pp_pose turn = pair.turn();
    const auto ask = [&] {
        return pp_contact_plane(pair.particle->handle(), &turn, points[0].data(), normal.data(), &pair.settings.library,
                                pair.state(), &found);
    };
    const pp_status status = fromNothingIfNew(ask(), found, pair.real, pair.state(), ask);
    if (status != PP_OK || found.kind != PP_OVERLAPPING || wall.sense == 0 || Vector3r(found.normal).dot(normal) < 0)
        return status;
    // The centre is behind a wall that pushes to one side only: the overlap is the particle's reach behind it.
    const Vector3r least(found.on_boundary);
    found.overlap = distanceToSurface(*pair.particle, turn, least, -normal);
    copyTo(found.normal, -normal);
    copyTo(found.on_particle, least - found.overlap * normal);
    copyTo(found.point, least - 0.5 * found.overlap * normal);
    copyTo(found.branch, least - 0.5 * found.overlap * normal);
    return status;
}

pp_status Ig2_Wall_ConicPP_ScGeom::findPatch(const FlatPair& pair, const BoundaryPoints&, const pp_flat_contact& found,
                                             pp_patch& patch) const
{
    const pp_pose turn = pair.turn();
    return pp_patch_on_plane(pair.particle->handle(), &turn, &found, pair.settings.given.patchTolerance, tracksEnergy(),
                             pair.lastPatch(), &patch, nullptr, 0, nullptr);
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_Wall_ConicPP_ScGeom)
