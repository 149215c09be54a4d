// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets, and which of them has a contact at a seam.
#include "../abi/knksphys.hpp"

#include "flat_pair.hpp"
#include "ig2_flat_conic_pp.hpp"
#include "seam.hpp"

namespace potential_particles {

using yade::Body;
using yade::Vector3r;

namespace {

    pp_status contactWith(const FlatPair& pair, const BoundaryPoints& vertices, pp_flat_contact& found)
    {
        double rows[9];
        for (std::size_t i = 0; i < 3; ++i)
            std::copy_n(vertices[i].data(), 3, rows + 3 * i);
        const pp_pose turn = pair.turn();
        return pp_contact_triangle(pair.particle->handle(), &turn, rows, &pair.settings.library, &found);
    }

    // The body, if it has a facet that meets the same bodies as `own`.
    const Body* facetLike(const Body& own, int id, const yade::Scene& scene)
    {
        const Body* const body = scene.bodies->body[static_cast<std::size_t>(id)].get();
        return body && body->groupMask == own.groupMask && dynamic_cast<const yade::Facet*>(body->shape.get()) ? body : nullptr;
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

BoundaryPoints Ig2_Facet_ConicPP_ScGeom::pointsOf(const FlatPair& pair) const
{
    return verticesOf(pair.boundary, pair.state1, pair.centre());
}

pp_status Ig2_Facet_ConicPP_ScGeom::detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found)
{
    const pp_status status = contactWith(pair, points, found);
    if (status != PP_OK || found.kind != PP_OVERLAPPING)
        return status;
    pp_flat_contact ofOwner;
    const Body* const owner = ownerOf(pair, points, found, ofOwner);
    if (!owner)
        return status;
    if (takesOverNow(pair, *owner)) {
        found.kind = PP_SEPARATED;
        found.distance = 0;
    } else {
        found = ofOwner;
    }
    return status;
}

const Body* Ig2_Facet_ConicPP_ScGeom::ownerOf(FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found,
                                              pp_flat_contact& ofOwner)
{
    const double radius = pair.particle->boundingRadius();
    const FacetContact own = facetContact(points, found, pair.interaction->id1, radius);
    const Parts parts = partsAt(own);
    if (!parts.any())
        return nullptr;
    mesh.refresh(*scene);
    const auto& bodies = scene->bodies->body;
    const Body* const body = bodies[static_cast<std::size_t>(own.id)].get();
    const Body* owner = nullptr;
    BoundaryPoints best;
    if (!body)
        return nullptr;
    const double weld = weldOf(points);
    for (unsigned i = 0; i < 3; ++i) {
        // The facets at an edge are among those around its first vertex.
        if (!(((parts.edges | parts.vertices) >> i) & 1))
            continue;
        const auto [begin, end] = mesh.around(own.id, i);
        for (const int* id = begin; id != end; ++id) {
            const Body* const neighbour = *id == own.id ? nullptr : facetLike(*body, *id, *scene);
            if (!neighbour)
                continue;
            const BoundaryPoints vertices = verticesOf(*neighbour->shape, *neighbour->state, pair.centre());
            const Parts shared = sharedParts(points, vertices, weld);
            const Parts common { shared.edges & parts.edges, shared.vertices & parts.vertices };
            pp_flat_contact other;
            if (!common.any() || contactWith(pair, vertices, other) != PP_OK || other.kind != PP_OVERLAPPING)
                continue;
            const FacetContact theirs = facetContact(vertices, other, *id, radius);
            if (!yieldsTo(theirs, own, common))
                continue;
            if (!owner || isLower(theirs, facetContact(best, ofOwner, owner->id, radius))) {
                owner = neighbour;
                ofOwner = other;
                best = vertices;
            }
        }
    }
    return owner;
}

// A contact that appears has no force in its first step with KnKsPhys, whose area is not known before the step after (see
// fillPhysics): the facet that had it holds it for so long, in the place of the owner. And if YADE knows no pair of owner
// and particle, nobody else would.
bool Ig2_Facet_ConicPP_ScGeom::takesOverNow(const FlatPair& pair, const Body& owner) const
{
    const auto& particle = scene->bodies->body[static_cast<std::size_t>(pair.interaction->id2)];
    const yade::Interaction* const pairOfOwner = particle ? interactionOf(*particle, owner) : nullptr;
    if (!pairOfOwner)
        return false;
    if (!pair.real || !castTo<yade::KnKsPhys, yade::KnKsPhys>(pair.interaction->phys.get()))
        return true;
    // Another thread may be writing it, in this step: the present one then, before that -1.
    const long since = __atomic_load_n(&pairOfOwner->iterMadeReal, __ATOMIC_RELAXED);
    return since >= 0 && since < scene->iter;
}

} // namespace potential_particles
