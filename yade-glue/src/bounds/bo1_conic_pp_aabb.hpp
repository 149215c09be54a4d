// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bounds functors: potential particles to Aabb.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "registration/class_table.hpp"

namespace potential_particles {

// For ConicPotentialParticle. With a BoundWatch, the box of the body as it is turned; without, that of all turns, since
// nobody would see it turn. The dispatcher widens either for the motion of the centre.
class Bo1_ConicPP_Aabb : public yade::BoundFunctor {
public:
    ~Bo1_ConicPP_Aabb() override;
    PP_FUNCTOR_1D_OVERRIDES

    void go(const boost::shared_ptr<yade::Shape>& shape, boost::shared_ptr<yade::Bound>& bound, const yade::Se3r& at,
            const yade::Body* body) override;

private:
    PP_ARCHIVED
};

// The same for every PotentialParticle, YADE's own among them.
class Bo1_PP_Aabb_Conic final : public Bo1_ConicPP_Aabb {
public:
    ~Bo1_PP_Aabb_Conic() override;
    PP_FUNCTOR_1D_OVERRIDES

private:
    PP_ARCHIVED
};

} // namespace potential_particles
