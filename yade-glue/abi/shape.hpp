// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shape and YADE's own potential particle.
#pragma once

#include "indexable.hpp"
#include "serializable.hpp"

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
public:
    ~Shape() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
#if PP_YADE_SHAPE_HAS_VOLUME
    virtual Real getVolume();
#endif
    PP_ABI_TOP_INDEX_OVERRIDES

    boost::shared_ptr<BoundFunctor> boundFunctor;
    boost::shared_ptr<InternalForceFunctor> internalforcefunctor;
    Vector3r color;
    bool wire;
    bool highlight;
};
PP_ABI_SIZE(Shape, 96);
PP_ABI_OFFSET(Shape, color, 64);
PP_ABI_OFFSET(Shape, wire, 88);
PP_ABI_OFFSET(Shape, highlight, 89);

class PotentialParticle : public Shape {
public:
    PotentialParticle();
    ~PotentialParticle() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    int id; // lies in the tail padding of Shape
    bool isBoundary;
    bool fixedNormal;
    Vector3r boundaryNormal;
    // With AabbMinMax the bounds functor rotates `vertices` and boxes them (and makes them of the
    // rotated box below when there are none); without, it takes a cube of half size R.
    bool AabbMinMax;
    // The local box is [-minAabb, +maxAabb]: both are positive lengths.
    Vector3r minAabb;
    Vector3r maxAabb;
    Vector3r minAabbRotated;
    Vector3r maxAabbRotated;
    Real r;
    Real R;
    Real k;
    std::vector<Vector3r> vertices;
    std::vector<Real> a;
    std::vector<Real> b;
    std::vector<Real> c;
    std::vector<Real> d;
};
PP_ABI_SIZE(PotentialParticle, 376);
PP_ABI_OFFSET(PotentialParticle, id, 92);
PP_ABI_OFFSET(PotentialParticle, isBoundary, 96);
PP_ABI_OFFSET(PotentialParticle, fixedNormal, 97);
PP_ABI_OFFSET(PotentialParticle, boundaryNormal, 104);
PP_ABI_OFFSET(PotentialParticle, AabbMinMax, 128);
PP_ABI_OFFSET(PotentialParticle, minAabb, 136);
PP_ABI_OFFSET(PotentialParticle, maxAabb, 160);
PP_ABI_OFFSET(PotentialParticle, minAabbRotated, 184);
PP_ABI_OFFSET(PotentialParticle, maxAabbRotated, 208);
PP_ABI_OFFSET(PotentialParticle, r, 232);
PP_ABI_OFFSET(PotentialParticle, R, 240);
PP_ABI_OFFSET(PotentialParticle, k, 248);
PP_ABI_OFFSET(PotentialParticle, vertices, 256);
PP_ABI_OFFSET(PotentialParticle, a, 280);
PP_ABI_OFFSET(PotentialParticle, b, 304);
PP_ABI_OFFSET(PotentialParticle, c, 328);
PP_ABI_OFFSET(PotentialParticle, d, 352);

} // namespace yade
