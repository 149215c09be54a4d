// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets, and which of them has a contact at a seam.
#include "registration/definitions.hpp"

#include "abi/knksphys.hpp"
#include "flat_pair.hpp"
#include "ig2_flat_conic_pp.hpp"

#include "plugin-common/new_contact.hpp"

#include <array>

namespace potential_particles {

using yade::Body;
using yade::Vector3r;

namespace {

    // `state`: of the pair with this triangle, or null.
    pp_status contactWith(const FlatPair& pair, const BoundaryPoints& vertices, pp_pair_state* state,
                          pp_flat_contact& found)
    {
        const pp_pose turn = pair.turn();
        return pp_contact_triangle(pair.particle->handle(), &turn, numbersOf(vertices), &pair.settings.library, state,
                                   &found);
    }

    TriangleContact contactOf(const FlatPair& pair, const BoundaryPoints& vertices, const pp_flat_contact& found,
                              int id)
    {
        return { vertices, found, id, onSeam * pair.particle->boundingRadius() };
    }

    // Of a point on an edge: where, from the edge's first vertex to the next one, 0 to 1.
    double shareOnEdge(const TriangleContact& contact)
    {
        if (contact.found.feature < PP_ON_EDGE || contact.found.feature >= PP_ON_VERTEX)
            return 0;
        const std::size_t i = contact.found.feature - PP_ON_EDGE;
        const Vector3r along = contact.corners[(i + 1) % 3] - contact.corners[i];
        return std::clamp((contact.point() - contact.corners[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    }

    // Whether S falls from the minimum of a facet, on a seam, into the neighbour that shares this point. By convexity
    // it does if it falls towards a vertex; the neighbour's minimum is then lower, off the seam. If S rises towards all
    // vertices, the point is the neighbour's minimum too.
    enum class Slope { falls, rises, unclear };

    Slope slopeInto(const BoundaryPoints& neighbour, const TriangleContact& own)
    {
        // In directions that are steeper than this no rounding of point and normal matters.
        constexpr double clear = 1e-6;
        if (own.found.flags & PP_FLAG_NORMAL_BY_BOUNDARY)
            return Slope::unclear;
        const Vector3r gradient(own.found.normal);
        bool rises = true;
        for (const Vector3r& vertex : neighbour) {
            const Vector3r way = vertex - own.point();
            const double length = way.norm(), slope = gradient.dot(way);
            if (length <= own.rounding)
                continue;
            if (slope < -clear * length)
                return Slope::falls;
            rises = rises && slope > clear * length;
        }
        return rises ? Slope::rises : Slope::unclear;
    }

    // The body, if it has a facet that meets the same bodies as `own`.
    const Body* facetLike(const Body& own, int id, const yade::Scene& scene)
    {
        const Body* const body = scene.bodies->body[static_cast<std::size_t>(id)].get();
        return body && body->groupMask == own.groupMask && dynamic_cast<const yade::Facet*>(body->shape.get())
            ? body
            : nullptr;
    }

    // YADE keeps an interaction with one of its bodies.
    const yade::Interaction* interactionOf(const Body& one, const Body& other)
    {
        for (const auto& [holder, id] : { std::pair { &one, other.id }, std::pair { &other, one.id } })
            if (const auto found = holder->intrs.find(id); found != holder->intrs.end())
                return found->second.get();
        return nullptr;
    }

} // namespace

Ig2_Facet_ConicPP_ScGeom::~Ig2_Facet_ConicPP_ScGeom() = default;
PP_FUNCTOR_2D_DEFINITIONS(Ig2_Facet_ConicPP_ScGeom)
PP_PYTHON_AS_BASE(Ig2_Facet_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)
PP_ARCHIVE_AS_BASE(Ig2_Facet_ConicPP_ScGeom, Ig2_ConicPP_ConicPP_ScGeom)

BoundaryPoints Ig2_Facet_ConicPP_ScGeom::pointsOf(const FlatPair& pair) const
{
    return verticesOf(pair.boundary, pair.state1, pair.centre());
}

pp_status Ig2_Facet_ConicPP_ScGeom::detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found)
{
    if (stillLeaves(pair, points)) {
        found = {};
        found.kind = PP_SEPARATED;
        found.flags = PP_FLAG_BY_MEMORY;
        return PP_OK;
    }
    if (pair.own)
        pair.own->left = {};
    const auto ask = [&] { return contactWith(pair, points, pair.state(), found); };
    const pp_status status = fromNothingIfNew(ask(), found, pair.real, pair.state(), ask);
    // Patches on triangles that share an edge add up: each has what lies on it.
    if (status != PP_OK || found.kind != PP_OVERLAPPING || pair.settings.given.patch)
        return status;
    pp_flat_contact ofOwner;
    const yade::Interaction* const owner = ownerOf(pair, points, found, ofOwner);
    if (!owner)
        return status;
    if (mustHold(pair) && !hasForce(*owner)) {
        found = ofOwner;
    } else {
        found.kind = PP_SEPARATED;
        found.distance = 0;
    }
    return status;
}

// The particle stays on the side on which the contact began.
pp_status Ig2_Facet_ConicPP_ScGeom::findPatch(const FlatPair& pair, const BoundaryPoints& points,
                                              const pp_flat_contact& found, pp_patch& patch) const
{
    const Vector3r front = (points[1] - points[0]).cross(points[2] - points[0]);
    const bool lasts = pair.real && !(pair.geom->penetrationDepth < 0);
    const Vector3r towardsParticle = lasts ? pair.lastNormal() : Vector3r(-Vector3r(found.normal));
    const pp_pose turn = pair.turn();
    return pp_patch_on_triangle(pair.particle->handle(), &turn, numbersOf(points), towardsParticle.dot(front) > 0,
                                &found, pair.settings.given.patchTolerance, tracksEnergy(), pair.lastPatch(), &patch,
                                nullptr, 0, nullptr);
}

bool Ig2_Facet_ConicPP_ScGeom::stillLeaves(const FlatPair& pair, const BoundaryPoints& points) const
{
    if (!pair.own || pair.own->left.to < 0 || pair.real || pair.settings.given.patch)
        return false;
    auto& left = pair.own->left;
    const auto& bodies = scene->bodies->body;
    const auto number = [](int id) { return static_cast<std::size_t>(id); };
    const Body* const facet = bodies[number(pair.interaction->id1)].get();
    const Body* const particle = bodies[number(pair.interaction->id2)].get();
    const Body* const neighbour
        = facet && particle && number(left.to) < bodies.size() ? facetLike(*facet, left.to, *scene) : nullptr;
    if (!neighbour || !interactionOf(*particle, *neighbour))
        return false;
    const BoundaryPoints others = verticesOf(*neighbour->shape, *neighbour->state, pair.centre());
    if (!isFeatureOf(SharedCorners::of(points, others).mine, left.feature))
        return false;
    int sense = 0;
    const pp_pose turn = pair.turn();
    const pp_status status = pp_seam_slope(pair.particle->handle(), &turn, numbersOf(points), left.feature,
                                           numbersOf(others), &pair.settings.library, &left.share, &sense);
    return status == PP_OK && (sense < 0 || (sense > 0 && left.to < pair.interaction->id1));
}

// A new contact has no force in its first step with KnKsPhys, whose area is unknown before the next step (see
// fillPhysics): the facet that had it holds it until then, instead of the owner.
bool Ig2_Facet_ConicPP_ScGeom::mustHold(const FlatPair& pair) const
{
    return pair.real && castTo<yade::KnKsPhys, yade::KnKsPhys>(pair.interaction->phys.get());
}

bool Ig2_Facet_ConicPP_ScGeom::hasForce(const yade::Interaction& pairOfOwner) const
{
    // Another thread may be writing it, in this step: the present one then, before that -1.
    const long since = __atomic_load_n(&pairOfOwner.iterMadeReal, __ATOMIC_RELAXED);
    return since >= 0 && since < scene->iter;
}

// Whether a facet leaves its contact to this neighbour. `solve`: the neighbour's contact is wanted if it does.
bool Ig2_Facet_ConicPP_ScGeom::leaves(const TriangleContact& own, const Neighbour& neighbour, const FlatPair& pair,
                                      bool solve, pp_flat_contact& other) const
{
    // Mostly the slope alone says it.
    if (isFeatureOf(neighbour.shared, own.found.feature)) {
        const Slope slope = slopeInto(neighbour.vertices, own);
        if (slope == Slope::rises && own.number < neighbour.id)
            return false;
        if (slope != Slope::unclear && !solve)
            return true;
    }
    return contactWith(pair, neighbour.vertices, nullptr, other) == PP_OK && other.kind == PP_OVERLAPPING
        && leavesTo(own, contactOf(pair, neighbour.vertices, other, neighbour.id));
}

// Of the facets on which the point of the contact lies as well; until `visit` says false.
template <class Visit>
void Ig2_Facet_ConicPP_ScGeom::eachNeighbour(const FlatPair& pair, const TriangleContact& own, Visit visit)
{
    constexpr unsigned all = 7;
    if (!liesOn(own, all))
        return;
    mesh.refresh(*scene);
    const auto& bodies = scene->bodies->body;
    const Body* const facet = bodies[static_cast<std::size_t>(own.number)].get();
    const Body* const particle = bodies[static_cast<std::size_t>(pair.interaction->id2)].get();
    if (facet)
        mesh.see(*facet, verticesOf(*facet->shape, *facet->state, Vector3r::Zero()));
    for (unsigned i = 0; facet && particle && i < 3; ++i) {
        // The facets at an edge are among those around its first vertex.
        if (!liesOn(own, cornersOfEdge(i)))
            continue;
        const auto [begin, end] = mesh.around(own.number, i);
        for (const int* id = begin; id != end; ++id) {
            const Body* const body = *id == own.number ? nullptr : facetLike(*facet, *id, *scene);
            // One that YADE does not let meet the particle cannot have the contact.
            const yade::Interaction* const theirs = body ? interactionOf(*particle, *body) : nullptr;
            if (!theirs)
                continue;
            const BoundaryPoints vertices = verticesOf(*body->shape, *body->state, pair.centre());
            const SharedCorners shared = SharedCorners::of(own.corners, vertices);
            if (liesOn(own, shared.mine) && !visit(Neighbour { theirs, *id, vertices, shared.mine }))
                return;
        }
    }
}

const yade::Interaction* Ig2_Facet_ConicPP_ScGeom::ownerOf(const FlatPair& pair, const BoundaryPoints& points,
                                                           const pp_flat_contact& found, pp_flat_contact& ofOwner)
{
    const TriangleContact own = contactOf(pair, points, found, pair.interaction->id1);
    // To leave the contact, one lower neighbour is enough; to hold it, the lowest is needed.
    const bool holds = mustHold(pair);
    const yade::Interaction* owner = nullptr;
    eachNeighbour(pair, own, [&](const Neighbour& neighbour) {
        pp_flat_contact other = {};
        if (!leaves(own, neighbour, pair, holds, other))
            return true;
        if (!holds && pair.own && isFeatureOf(neighbour.shared, found.feature))
            pair.own->left = { neighbour.id, found.feature, shareOnEdge(own) };
        if (!owner || (holds && other.s < ofOwner.s)) {
            owner = neighbour.theirs;
            ofOwner = other;
        }
        return holds;
    });
    return owner;
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ig2_Facet_ConicPP_ScGeom)
