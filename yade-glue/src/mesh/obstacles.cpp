// SPDX-License-Identifier: GPL-3.0-or-later
#include "obstacles.hpp"

#include "abi/bound.hpp"
#include "abi/registry.hpp"
#include "abi/scene.hpp"
#include "abi/state.hpp"
#include "particle/stand_in.hpp"
#include "shape/particle_of.hpp"

#include <limits>
#include <utility>

namespace potential_particles {

namespace {

    using Extent = std::pair<yade::Vector3r, yade::Vector3r>;

    // All of space where nothing is known.
    Extent extentOf(const yade::Body& body, bool boundsHold)
    {
        const yade::Bound* const bound = body.bound.get();
        // Of bodies that the collider has not seen yet the numbers say nothing.
        if (boundsHold && bound && bound->lastUpdateIter >= body.iterBorn && (bound->max - bound->min).minCoeff() >= 0)
            return { bound->min, bound->max };
        const auto* const conic = dynamic_cast<const ConicPotentialParticle*>(body.shape.get());
        const Particle* const particle = conic ? conic->particle() : nullptr;
        const double radius = particle ? particle->boundingRadius() : std::numeric_limits<double>::infinity();
        const yade::Vector3r around = yade::Vector3r::Constant(radius);
        return { body.state->pos - around, body.state->pos + around };
    }

} // namespace

py::list bodiesNear(const yade::Vector3r& lower, const yade::Vector3r& upper, bool boundsHold)
{
    py::list found;
    const auto scene = Singleton<yade::Omega>::instance().getScene();
    for (const auto& body : scene->bodies->body) {
        if (!body || !body->shape)
            continue;
        const Extent box = extentOf(*body, boundsHold);
        if ((box.second - lower).minCoeff() >= 0 && (upper - box.first).minCoeff() >= 0)
            found.append(body->id);
    }
    return found;
}

py::object definitionOf(const yade::Shape& shape)
{
    const StandIn* kind = standInOf(shape);
    const yade::PotentialParticle* const particle = potentialParticle(shape);
    if (!kind && !particle)
        kind = standInOfBase(shape);
    if (!kind && !particle)
        return py::object();
    const Definition found = particle ? Definition::of(*particle) : kind->definitionOf(kind->measuresOf(shape));
    py::list planes;
    for (std::size_t i = 0; found.listsAgree() && i < found.a.size(); ++i)
        planes.append(py::make_tuple(found.a[i], found.b[i], found.c[i], found.d[i]));
    return py::make_tuple(py::tuple(planes), found.r, found.k, found.R);
}

} // namespace potential_particles
