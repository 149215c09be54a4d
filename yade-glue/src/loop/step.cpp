// SPDX-License-Identifier: GPL-3.0-or-later
#include "step.hpp"

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

void Step::look(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
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
        const double way = (position - body.position).norm() + radius * wayOfTurn(body.orientation, orientation);
        const double sum = body.travelled + way * (1 + 1e-12);
        // Whether the way since the last look is known, so that it can be added to the sum.
        const bool continues
            = particle && particle->serial == body.serial && isUnit(body.orientation) && std::isfinite(sum);
        if (!continues) {
            body.generation = nextGeneration();
            body.travelled = 0;
        } else if (way > 0) {
            body.travelled = std::nextafter(sum, std::numeric_limits<double>::infinity());
        }
        body.particle = particle;
        body.serial = particle ? particle->serial : 0; // no particle has 0
        body.state = &state;
        body.position = position;
        body.orientation = orientation;
    } catch (...) {
        body.particle = nullptr;
        body.serial = 0;
        body.generation = nextGeneration();
    }
    body.step.store(count, std::memory_order_release);
}

} // namespace potential_particles
