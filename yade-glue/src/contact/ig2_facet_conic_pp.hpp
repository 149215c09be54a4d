// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functor between YADE's facets and potential particles.
#pragma once

#include "facet_mesh.hpp"
#include "ig2_flat_conic_pp.hpp"

#include "plugin-common/seam.hpp"

namespace potential_particles {

class Ig2_Facet_ConicPP_ScGeom final : public Ig2_Flat_ConicPP {
public:
    ~Ig2_Facet_ConicPP_ScGeom() override;
    PP_FUNCTOR_2D_OVERRIDES

protected:
    BoundaryPoints pointsOf(const FlatPair& pair) const override;
    pp_status detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found) override;
    pp_status findPatch(const FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found,
                        pp_patch& patch) const override;

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);

    bool mustHold(const FlatPair& pair) const;
    bool hasForce(const yade::Interaction& pairOfOwner) const;
    // The particle's pair with the neighbour that has the contact, and, if the facet may have to hold it, that contact;
    // null: the facet itself has it.
    const yade::Interaction* ownerOf(const FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found,
                                     pp_flat_contact& ofOwner);
    // Whether the facet left its contact to a neighbour in the step before, and does so still.
    bool stillLeaves(const FlatPair& pair, const BoundaryPoints& points) const;
    struct Neighbour {
        const yade::Interaction* theirs; // with the particle
        int id;
        BoundaryPoints vertices;
        unsigned shared; // of the facet's corners
    };
    template <class Visit> void eachNeighbour(const FlatPair& pair, const TriangleContact& own, Visit visit);
    bool leaves(const TriangleContact& own, const Neighbour& neighbour, const FlatPair& pair, bool solve,
                pp_flat_contact& other) const;

    FacetMesh mesh;
};

} // namespace potential_particles
