// SPDX-License-Identifier: GPL-3.0-or-later
//
// Material down to FrictMat.
#pragma once

#include "indexable.hpp"
#include "serializable.hpp"

namespace yade {

class State;

class Material : public Serializable, public Indexable {
public:
    ~Material() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    virtual boost::shared_ptr<State> newAssocState() const;
    virtual bool stateTypeOk(State*) const;
    PP_ABI_TOP_INDEX_OVERRIDES

    int id;
    std::string label;
    Real density;
};
PP_ABI_SIZE(Material, 80);
PP_ABI_OFFSET(Material, id, 32);
PP_ABI_OFFSET(Material, label, 40);
PP_ABI_OFFSET(Material, density, 72);

class ElastMat : public Material {
public:
    ~ElastMat() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real young;
    Real poisson; // in the physics of spheres, shear stiffness over normal stiffness
};
PP_ABI_SIZE(ElastMat, 96);
PP_ABI_OFFSET(ElastMat, young, 80);
PP_ABI_OFFSET(ElastMat, poisson, 88);

class FrictMat : public ElastMat {
public:
    FrictMat();
    ~FrictMat() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real frictionAngle; // radians
};
PP_ABI_SIZE(FrictMat, 104);
PP_ABI_OFFSET(FrictMat, frictionAngle, 96);

} // namespace yade
