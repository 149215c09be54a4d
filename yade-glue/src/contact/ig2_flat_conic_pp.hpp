// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is common to the contact functors between flat boundaries and potential particles.
#pragma once

#include "abi/primitives.hpp"
#include "ig2_other_conic_pp.hpp"
#include "pair/kept_apart.hpp"

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

} // namespace potential_particles
