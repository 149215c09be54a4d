// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bound and Aabb: the box of a body, as the collider sorts it.
#pragma once

#include "indexable.hpp"
#include "serializable.hpp"

namespace yade {

class Bound : public Serializable, public Indexable {
public:
    ~Bound() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_TOP_INDEX_OVERRIDES

    int lastUpdateIter;
    Vector3r refPos; // of the body when the box was made
    Real sweepLength; // by which the dispatcher widened the functor's box
    Vector3r color;
    // In a periodic scene these are in the axes of the cell without its shear.
    Vector3r min;
    Vector3r max;
};
PP_ABI_SIZE(Bound, 144);
PP_ABI_OFFSET(Bound, lastUpdateIter, 32);
PP_ABI_OFFSET(Bound, refPos, 40);
PP_ABI_OFFSET(Bound, sweepLength, 64);
PP_ABI_OFFSET(Bound, color, 72);
PP_ABI_OFFSET(Bound, min, 96);
PP_ABI_OFFSET(Bound, max, 120);

class Aabb : public Bound {
public:
    Aabb();
    ~Aabb() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES
};
PP_ABI_SIZE(Aabb, 144);

} // namespace yade
