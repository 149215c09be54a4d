// SPDX-License-Identifier: GPL-3.0-or-later
#include "step.hpp"

#include "abi/bound.hpp"
#include "abi/shape.hpp"
#include "shape/particle_of.hpp"
#include "particle/pose.hpp"
#include "pair/turn_bound.hpp"

#include <cmath>
#include <limits>

namespace potential_particles {

std::atomic<Step*> Step::running { nullptr };

namespace {

    std::uint64_t nextGeneration()
    {
        static std::atomic<std::uint64_t> last { 0 };
        return ++last;
    }

} // namespace

void Step::lookAnew(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
{
    std::uint64_t seen = body.step.load(std::memory_order_acquire);
    // One thread looks, the others wait for it: it takes a few tens of nanoseconds.
    while (seen != count) {
        if (seen == busy) {
            seen = body.step.load(std::memory_order_acquire);
        } else if (body.step.compare_exchange_weak(seen, busy, std::memory_order_acquire)) {
            break;
        }
    }
    if (seen == count)
        return;
    try {
        const Particle* particle = particleOf(shape, body.keeper);
        const yade::Vector3r& position = state.se3.position;
        const yade::Quaternionr& orientation = state.se3.orientation;
        if (!particle->handle() || !position.allFinite() || !isUnit(orientation))
            particle = nullptr;
        const double radius = particle ? particle->boundingRadius() : 0;
        const double way = (position - body.formerPosition).norm() + radius * wayOfTurn(body.formerOrientation, orientation);
        const double sum = body.way.travelled + way * (1 + 1e-12);
        // Whether the way since the last look is known, so that it can be added to the sum.
        const bool continues
            = particle && particle->serial == body.serial && isUnit(body.formerOrientation) && std::isfinite(sum);
        if (!continues) {
            body.way.generation = nextGeneration();
            body.way.travelled = 0;
        } else if (way > 0) {
            body.way.travelled = std::nextafter(sum, std::numeric_limits<double>::infinity());
        }
        body.particle = particle;
        body.serial = particle ? particle->serial : 0; // no particle has 0
        body.formerPosition = position;
        body.formerOrientation = orientation;
    } catch (...) {
        body.particle = nullptr;
        body.serial = 0;
        body.way.generation = nextGeneration();
    }
    body.step.store(count, std::memory_order_release);
}

bool Step::gather(std::size_t id, yade::Body* given)
{
    BodyInStep* const found = bodies.at(id);
    if (!found)
        return false;
    BodyInStep& body = *found;
    ways[id] = Way();
    body.body = given;
    body.hasShape = given && given->shape && given->state;
    if (!body.hasShape) {
        // Of another body with this id, or of this one with a shape, nothing will be known.
        body.way.generation = nextGeneration();
        body.particle = nullptr;
        body.serial = 0;
        return true;
    }
    const yade::State& state = *given->state;
    body.position = state.se3.position;
    body.orientation = state.se3.orientation;
    body.velocity = state.vel;
    body.spin = state.angVel;
    body.mass = state.mass;
    constexpr unsigned everyDegree = 63;
    body.isHeld = state.blockedDOFs == everyDegree;
    body.subdomain = given->subdomain;
    body.isClump = given->clumpId >= 0 && given->clumpId == given->id;
    body.hasBox = static_cast<bool>(given->bound);
    if (body.hasBox) {
        body.lowest = given->bound->min;
        body.highest = given->bound->max;
    }
    const yade::Shape& shape = *given->shape;
    // What an object is does not change, and its virtual table says it.
    const void* const itsClass = *reinterpret_cast<const void* const*>(&shape);
    if (itsClass != body.classOfShape) {
        body.classOfShape = itsClass;
        body.isPotential = potentialParticle(shape);
    }
    body.isBoundary = body.fixesNormal = false;
    if (body.isPotential) {
        const auto& potential = static_cast<const yade::PotentialParticle&>(shape);
        body.isBoundary = potential.isBoundary;
        body.fixesNormal = potential.fixedNormal;
        look(body, given->shape, state);
        ways[id] = body.way;
    }
    return true;
}

} // namespace potential_particles
