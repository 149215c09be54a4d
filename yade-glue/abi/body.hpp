// SPDX-License-Identifier: GPL-3.0-or-later
//
// Body: shape, state and bound of one particle.
#pragma once

#include "serializable.hpp"

#include <map>

namespace yade {

class Material;
class State;
class Shape;
class Bound;

class Body : public Serializable {
public:
    Body();
    ~Body() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    virtual void userForcedDisplacementRedrawHook();

    static const boost::shared_ptr<Body>& byId(int id, Scene* scene);

    int id;
    int groupMask;
    int flags;
    int subdomain;
    boost::shared_ptr<Material> material;
    boost::shared_ptr<State> state;
    boost::shared_ptr<Shape> shape;
    boost::shared_ptr<Bound> bound;
    std::map<int, boost::shared_ptr<Interaction>> intrs;
    int clumpId;
    long iterBorn;
    Real timeBorn;
};
PP_ABI_SIZE(Body, 176);
PP_ABI_OFFSET(Body, id, 24);
PP_ABI_OFFSET(Body, groupMask, 28);
PP_ABI_OFFSET(Body, flags, 32);
PP_ABI_OFFSET(Body, subdomain, 36);
PP_ABI_OFFSET(Body, material, 40);
PP_ABI_OFFSET(Body, state, 56);
PP_ABI_OFFSET(Body, shape, 72);
PP_ABI_OFFSET(Body, bound, 88);
PP_ABI_OFFSET(Body, intrs, 104);
PP_ABI_OFFSET(Body, clumpId, 152);
PP_ABI_OFFSET(Body, iterBorn, 160);
PP_ABI_OFFSET(Body, timeBorn, 168);

// Never made here.
class BodyContainer : public Serializable {
public:
    BodyContainer() = delete;
    ~BodyContainer() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

    std::vector<boost::shared_ptr<Body>> body; // with holes where bodies were erased
    std::byte others[152];
};
PP_ABI_SIZE(BodyContainer, 200);
PP_ABI_OFFSET(BodyContainer, body, 24);

} // namespace yade
