// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact functors between YADE's walls and facets and potential particles.
#pragma once

#include "abi/primitives.hpp"

#include "facet_mesh.hpp"
#include "ig2_other_conic_pp.hpp"
#include "pair/kept_apart.hpp"

#include "plugin-common/seam.hpp"

namespace potential_particles {

struct FlatPair;

// What is common to planes and triangles. The point of the boundary where the particle's scale is least decides
// (pp_contact_plane, pp_contact_triangle).
class Ig2_Flat_ConicPP : public Ig2_Other_ConicPP {
public:
    bool go(const boost::shared_ptr<yade::Shape>& shape1, const boost::shared_ptr<yade::Shape>& shape2,
            const yade::State& state1, const yade::State& state2, const yade::Vector3r& shift2, const bool& force,
            const boost::shared_ptr<yade::Interaction>& interaction) noexcept override;
    // In the place of that of the base, which is not virtual: the tables of functors are compared with YADE's.
    bool goInLoop(Step& step, Counters::Row& counts, BodyInStep& body1, BodyInStep& body2, PairInStep& pairInStep,
                  const boost::shared_ptr<yade::Interaction>& interaction) noexcept;

protected:
    // The points of the boundary for KeptApart.
    virtual BoundaryPoints pointsOf(const FlatPair& pair) const = 0;
    // The contact; positions from the particle's centre, world axes. A boundary that leaves its contact to another
    // answers separated by the distance 0; with PP_FLAG_BY_MEMORY if it is known from the step before that it does.
    virtual pp_status detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found) = 0;
    // The patch of that contact, from the particle's centre.
    virtual pp_status findPatch(const FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found,
                                pp_patch& patch) const = 0;

private:
    bool answer(FlatPair& pair, const boost::shared_ptr<yade::Shape>& shape2);
    bool contact(FlatPair& pair);
    void fill(FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found);
};

class Ig2_Wall_ConicPP_ScGeom final : public Ig2_Flat_ConicPP {
public:
    ~Ig2_Wall_ConicPP_ScGeom() override;
    PP_FUNCTOR_2D_OVERRIDES

protected:
    BoundaryPoints pointsOf(const FlatPair& pair) const override;
    pp_status detect(FlatPair& pair, const BoundaryPoints& points, pp_flat_contact& found) override;
    pp_status findPatch(const FlatPair& pair, const BoundaryPoints& points, const pp_flat_contact& found,
                        pp_patch& patch) const override;

private:
    PP_ARCHIVED
};

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
    PP_ARCHIVED

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
