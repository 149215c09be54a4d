// SPDX-License-Identifier: GPL-3.0-or-later
#include "step.hpp"

#include "abi/bound.hpp"
#include "abi/primitives.hpp"
#include "abi/shape.hpp"
#include "shape/particle_of.hpp"
#include "particle/particle.hpp"
#include "plugin-common/motion_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <typeinfo>

namespace potential_particles {

std::atomic<Step*> Step::running { nullptr };

namespace {

    std::uint64_t nextGeneration()
    {
        static std::atomic<std::uint64_t> last { 0 };
        return ++last;
    }

    Flat::Kind kindOf(const yade::Shape& shape)
    {
        return typeid(shape) == typeid(yade::Facet) ? Flat::Kind::facet
            : typeid(shape) == typeid(yade::Wall)   ? Flat::Kind::wall
                                                    : Flat::Kind::none;
    }

    // Whether it is the same boundary in its own axes; if not, what it is from now on.
    bool isStill(Flat& flat, const yade::Shape& shape)
    {
        if (flat.kind == Flat::Kind::wall) {
            const auto& wall = static_cast<const yade::Wall&>(shape);
            const bool same = wall.axis == flat.axis && wall.sense == flat.sense;
            flat.axis = wall.axis;
            flat.sense = wall.sense;
            return same;
        }
        const auto& vertices = static_cast<const yade::Facet&>(shape).vertices;
        if (vertices.size() != 3) {
            flat.radius = std::numeric_limits<double>::quiet_NaN();
            return false;
        }
        if (std::equal(vertices.begin(), vertices.end(), flat.vertices.begin()) && std::isfinite(flat.radius))
            return true;
        std::copy(vertices.begin(), vertices.end(), flat.vertices.begin());
        flat.radius = std::max({ vertices[0].norm(), vertices[1].norm(), vertices[2].norm() }) * (1 + 1e-12);
        return false;
    }

} // namespace

// True for one thread in a step, which then looks at the body; the others wait for it: it takes a few tens of
// nanoseconds.
bool Step::mayLook(std::atomic<std::uint64_t>& step) const
{
    std::uint64_t seen = step.load(std::memory_order_acquire);
    while (seen != count) {
        if (seen == busy) {
            seen = step.load(std::memory_order_acquire);
        } else if (step.compare_exchange_weak(seen, busy, std::memory_order_acquire)) {
            return true;
        }
    }
    return false;
}

void Step::lookAnew(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
{
    if (!mayLook(body.step))
        return;
    lookAtParticle(body, shape, state);
    body.step.store(count, std::memory_order_release);
}

void Step::fillLate(BodyInStep& body, FlatBody& flat)
{
    if (!mayLook(body.gatheredIn))
        return;
    fill(body, flat.body);
    flat.waits = count + remembered;
    // It has been given another shape: nothing is known of its way.
    if (body.flat.kind == Flat::Kind::none)
        body.way.generation = nextGeneration();
    body.gatheredIn.store(count, std::memory_order_release);
}

void Step::lookAtParticle(BodyInStep& body, const boost::shared_ptr<yade::Shape>& shape, const yade::State& state)
{
    try {
        const Particle* particle = particleOf(shape, body.keeper);
        const yade::Vector3r& position = state.se3.position;
        const yade::Quaternionr& orientation = state.se3.orientation;
        if (!particle->handle() || !position.allFinite() || !isUnit(orientation))
            particle = nullptr;
        const double radius = particle ? particle->boundingRadius() : 0;
        const double way
            = (position - body.formerPosition).norm() + radius * wayOfTurn(body.formerOrientation, orientation);
        const double sum = travelled(body.way.travelled, way);
        // Whether the way since the last look is known, so that it can be added to the sum.
        const bool continues
            = particle && particle->serial == body.serial && isUnit(body.formerOrientation) && std::isfinite(sum);
        if (!continues) {
            body.way.generation = nextGeneration();
            body.way.travelled = 0;
        } else {
            body.way.travelled = sum;
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
}

// A wall's orientation does not count. Motion without a bound (not a number, say) starts a new period in each step.
void Step::lookAtFlat(BodyInStep& body, const yade::Shape& shape)
{
    const bool same = isStill(body.flat, shape);
    const bool turns = body.flat.kind == Flat::Kind::facet;
    const double turn = turns ? body.flat.radius * wayOfTurn(body.formerOrientation, body.orientation) : 0;
    const double way = (body.position - body.formerPosition).norm() + turn;
    const double sum = travelled(body.way.travelled, way);
    if (!same || !std::isfinite(sum) || (turns && !isUnit(body.formerOrientation))) {
        body.way.generation = nextGeneration();
        body.way.travelled = 0;
    } else {
        body.way.travelled = sum;
    }
    body.formerPosition = body.position;
    body.formerOrientation = body.orientation;
}

void Step::fill(BodyInStep& body, yade::Body* given)
{
    body.body = given;
    body.hasShape = given && given->shape && given->state;
    if (!body.hasShape) {
        // Of another body with this id, or of this one with a shape, nothing will be known.
        body.way.generation = nextGeneration();
        body.particle = nullptr;
        body.serial = 0;
        body.flat.kind = Flat::Kind::none;
        body.classOfShape = nullptr;
        return;
    }
    const yade::State& state = *given->state;
    body.shape = &given->shape;
    body.state = &state;
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
    const void* const itsClass = classOf(shape);
    if (itsClass != body.classOfShape) {
        body.classOfShape = itsClass;
        body.isPotential = potentialParticle(shape);
        body.flat = Flat();
        body.flat.kind = kindOf(shape);
        body.way.generation = nextGeneration();
    }
    body.isBoundary = body.fixesNormal = false;
    if (body.isPotential) {
        const auto& potential = static_cast<const yade::PotentialParticle&>(shape);
        body.isBoundary = potential.isBoundary;
        body.fixesNormal = potential.fixedNormal;
        look(body, given->shape, state);
    } else if (body.flat.kind != Flat::Kind::none) {
        lookAtFlat(body, shape);
    }
}

} // namespace potential_particles
