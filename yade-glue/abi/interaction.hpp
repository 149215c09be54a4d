// SPDX-License-Identifier: GPL-3.0-or-later
//
// Interaction: a pair of bodies that may touch.
#pragma once

#include "serializable.hpp"

namespace yade {

class IGeom;
class IPhys;
class IGeomFunctor;
class IPhysFunctor;
class LawFunctor;

class Interaction : public Serializable {
public:
    Interaction(int newId1, int newId2);
    ~Interaction() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    boost::python::dict pyDictCustom() const override;

    // Throws std::logic_error when it has a geometry or physics.
    void swapOrder();
    // As it was when it was made, without a geometry, physics and functors.
    void reset();

    // In YADE's own words "real": it has been through geometry and physics functors.
    bool hasGeomAndPhys() const { return geom && phys; }

    bool isActive;
    struct {
        bool geomExists;
        boost::shared_ptr<IGeomFunctor> geom;
        boost::shared_ptr<IPhysFunctor> phys;
        boost::shared_ptr<LawFunctor> constLaw;
    } functorCache;
    int id1;
    int id2;
    long iterMadeReal;
    long iterLastSeen;
    boost::shared_ptr<IGeom> geom;
    boost::shared_ptr<IPhys> phys;
    Vector3i cellDist; // cells by which body 2 is shifted; its length is the functor's shift2
    int linIx;
    long iterBorn;
};
PP_ABI_SIZE(Interaction, 168);
PP_ABI_OFFSET(Interaction, isActive, 24);
PP_ABI_OFFSET(Interaction, functorCache, 32);
PP_ABI_OFFSET(Interaction, id1, 88);
PP_ABI_OFFSET(Interaction, id2, 92);
PP_ABI_OFFSET(Interaction, iterMadeReal, 96);
PP_ABI_OFFSET(Interaction, iterLastSeen, 104);
PP_ABI_OFFSET(Interaction, geom, 112);
PP_ABI_OFFSET(Interaction, phys, 128);
PP_ABI_OFFSET(Interaction, cellDist, 144);
PP_ABI_OFFSET(Interaction, linIx, 156);
PP_ABI_OFFSET(Interaction, iterBorn, 160);

} // namespace yade
