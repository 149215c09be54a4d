// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/attributes.hpp"

#include "abi/knksphys.hpp"
#include "abi/material.hpp"
#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "ip2_knks_block.hpp"
#include "shape/particle_of.hpp"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace potential_particles {

using Ip2OfBlocks = Ip2_FrictMat_FrictMat_KnKsPhys_Block;

namespace {

    bool isBoundary(int id, yade::Scene* scene)
    {
        const auto& body = yade::Body::byId(id, scene);
        const auto* const shape = body && body->shape ? potentialParticle(*body->shape) : nullptr;
        return shape && shape->isBoundary;
    }

} // namespace

Ip2OfBlocks::~Ip2_FrictMat_FrictMat_KnKsPhys_Block() = default;
PP_FUNCTOR_2D_DEFINITIONS(Ip2_FrictMat_FrictMat_KnKsPhys_Block)
PP_ATTRIBUTE_DEFINITIONS(Ip2_FrictMat_FrictMat_KnKsPhys_Block, IPhysFunctor)

void Ip2OfBlocks::callPostLoad()
{
    IPhysFunctor::callPostLoad();
    if (useFaceProperties) {
        useFaceProperties = false;
        throw std::invalid_argument("useFaceProperties=True: shapes have no properties of faces; "
                                    "potential_particles.rock.joint_engine gives contacts those of their joint");
    }
}

void Ip2OfBlocks::go(const boost::shared_ptr<yade::Material>& material1,
                     const boost::shared_ptr<yade::Material>& material2,
                     const boost::shared_ptr<yade::Interaction>& interaction)
{
    if (interaction->phys)
        return;
    const bool atBoundary = isBoundary(interaction->id1, scene) || isBoundary(interaction->id2, scene);
    const auto phys = boost::make_shared<yade::KnKsPhys>();
    phys->knVol = atBoundary ? kn_i : Knormal;
    phys->ksVol = atBoundary ? ks_i : Kshear;
    phys->kn_i = kn_i;
    phys->ks_i = ks_i;
    phys->viscousDamping = viscousDamping;
    phys->cohesion = cohesion;
    phys->tension = tension;
    phys->cohesionBroken = cohesionBroken;
    phys->tensionBroken = tensionBroken;
    phys->frictionAngle = std::min(static_cast<const yade::FrictMat&>(*material1).frictionAngle,
                                   static_cast<const yade::FrictMat&>(*material2).frictionAngle);
    phys->tangensOfFrictionAngle = std::tan(phys->frictionAngle);
    phys->phi_b = phys->phi_r = phys->frictionAngle * 180 / M_PI;
    if (const auto* const geom = dynamic_cast<const yade::ScGeom*>(interaction->geom.get()))
        phys->prevNormal = geom->normal;
    interaction->phys = phys;
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Ip2_FrictMat_FrictMat_KnKsPhys_Block)
