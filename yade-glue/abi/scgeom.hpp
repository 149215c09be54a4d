// SPDX-License-Identifier: GPL-3.0-or-later
//
// IGeom down to ScGeom: the contact geometry that the laws read.
#pragma once

#include "indexable.hpp"
#include "serializable.hpp"
#include "state.hpp"

namespace yade {

class IGeom : public Serializable, public Indexable {
public:
    ~IGeom() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_TOP_INDEX_OVERRIDES
};
PP_ABI_SIZE(IGeom, 32);

class GenericSpheresContact : public IGeom {
public:
    ~GenericSpheresContact() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Vector3r normal; // unit, from body 1 to body 2
    Vector3r contactPoint; // in the periodic image of body 1
    Real refR1;
    Real refR2;
};
PP_ABI_SIZE(GenericSpheresContact, 96);
PP_ABI_OFFSET(GenericSpheresContact, normal, 32);
PP_ABI_OFFSET(GenericSpheresContact, contactPoint, 56);
PP_ABI_OFFSET(GenericSpheresContact, refR1, 80);
PP_ABI_OFFSET(GenericSpheresContact, refR2, 88);

// The constructor leaves normal and contactPoint without a value.
class ScGeom : public GenericSpheresContact {
public:
    ScGeom();
    ~ScGeom() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    // Turns the frame of the contact from the normal stored here to `currentNormal`, stores that,
    // and sets shearInc from the velocities at contactPoint. Not new: the stored normal must still
    // be that of the last step.
    void precompute(const State& state1, const State& state2, const Scene* scene,
                    const boost::shared_ptr<Interaction>& interaction, const Vector3r& currentNormal, bool isNew,
                    const Vector3r& shift2, bool avoidGranularRatcheting);

    // Carries a vector of the tangent plane along with the turn of the frame that precompute() found.
    Vector3r& rotate(Vector3r& tangent) const;

    Vector3r twist_axis;
    Vector3r orthonormal_axis;
    Real& radius1; // refR1
    Real& radius2; // refR2
    Real penetrationDepth; // overlap, positive in contact
    Vector3r shearInc;
};
PP_ABI_SIZE(ScGeom, 192);
PP_ABI_OFFSET(ScGeom, twist_axis, 96);
PP_ABI_OFFSET(ScGeom, orthonormal_axis, 120);
PP_ABI_OFFSET(ScGeom, penetrationDepth, 160);
PP_ABI_OFFSET(ScGeom, shearInc, 168);

// Made by the factory, and never here: no field of it is declared.
class ScGeom6D : public ScGeom {
public:
    ScGeom6D() = delete;
    ~ScGeom6D() override;

    // Bending and twist from the orientations at the first contact (isNew) or bond to the present ones; after
    // precompute().
    void precomputeRotations(const State& state1, const State& state2, bool isNew, bool creep);
};

} // namespace yade
