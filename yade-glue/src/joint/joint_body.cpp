// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_body.hpp"

#include "abi/primitives.hpp"
#include "contact/facet_mesh.hpp"
#include "particle/particle.hpp"
#include "shape/particle_of.hpp"

namespace potential_particles {

PosedBody::PosedBody(const boost::shared_ptr<yade::Shape>& shape, const yade::State& state, const yade::Vector3r& shift)
{
    pose = poseOf(state, shift);
    if (dynamic_cast<const yade::Facet*>(shape.get())) {
        triangle = verticesOf(*shape, state, -shift);
    } else if (!dynamic_cast<const yade::Wall*>(shape.get())) {
        const Particle* const found = particleOf(shape, keeper);
        particle = found->handle();
        boundingRadius = found->boundingRadius();
        if (particle)
            requireOk(pp_particle_depth_length(particle, &depthLength));
    }
}

} // namespace potential_particles
