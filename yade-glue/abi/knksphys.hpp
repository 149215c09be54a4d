// SPDX-License-Identifier: GPL-3.0-or-later
//
// IPhys down to FrictPhys, and KnKsPhys, the contact physics of YADE's law for potential particles.
#pragma once

#include "indexable.hpp"
#include "serializable.hpp"

namespace yade {

class IPhys : public Serializable, public Indexable {
public:
    ~IPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_TOP_INDEX_OVERRIDES
};
PP_ABI_SIZE(IPhys, 32);

class NormPhys : public IPhys {
public:
    ~NormPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real kn;
    Vector3r normalForce;
};
PP_ABI_SIZE(NormPhys, 64);

class NormShearPhys : public NormPhys {
public:
    ~NormShearPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real ks;
    Vector3r shearForce;
};
PP_ABI_SIZE(NormShearPhys, 96);

class FrictPhys : public NormShearPhys {
public:
    FrictPhys();
    ~FrictPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real tangensOfFrictionAngle;
#if PP_YADE_FRICT_PHYS_EXTRA
    Real frictDissip;
#endif
};
PP_ABI_SIZE(FrictPhys, 104 + frictPhysExtraBytes);

class KnKsPhys : public FrictPhys {
public:
    KnKsPhys();
    ~KnKsPhys() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_ABI_INDEX_OVERRIDES

    Real frictionAngle;
    Real viscousDamping;
    Real maxClosure;
    Real u_elastic;
    Real brittleLength;
    Real knVol;
    Real ksVol;
    Real kn_i;
    Real ks_i;
    Vector3r normalViscous;
    Vector3r shearViscous;
    bool intactRock;
    int jointType;
    Vector3r shearDir;
    Vector3r prevNormal;
    bool warmstart;
    Vector3r ptOnP1;
    Vector3r ptOnP2;
    Real cumulative_us;
    Real mobilizedShear;
    Real contactArea;
    Real prevSigma;
    Real jointLength;
    Real shearIncrementForCD;
    bool useFaceProperties;
    Real cohesion;
    Real tension;
    bool cohesionBroken;
    bool tensionBroken;
    Real phi_b;
    Real phi_r;
    Real u_cumulative;
    Vector3r initialShearDir;
    Real effective_phi;
    bool isSliding;
};
PP_ABI_SIZE(KnKsPhys, 480 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, frictionAngle, 104 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, knVol, 144 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, normalViscous, 176 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, intactRock, 224 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, jointType, 228 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, shearDir, 232 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, warmstart, 280 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, ptOnP1, 288 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, ptOnP2, 312 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, contactArea, 352 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, jointLength, 368 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, cohesion, 392 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, phi_b, 416 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, initialShearDir, 440 + frictPhysExtraBytes);
PP_ABI_OFFSET(KnKsPhys, isSliding, 472 + frictPhysExtraBytes);

} // namespace yade
