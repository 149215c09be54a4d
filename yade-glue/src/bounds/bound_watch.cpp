// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "bound_watch.hpp"
#include "bounding_box.hpp"
#include "particle/fetch.hpp"
#include "shape/particle_of.hpp"
#include "plugin-common/motion_bound.hpp"

#include <algorithm>
#include <typeinfo>

namespace potential_particles {

BoundWatch::~BoundWatch() = default;

PP_CLASS_DEFINITIONS(BoundWatch)

bool BoundWatch::guards(const yade::Scene& scene)
{
    const auto& engines = scene.engines;
    return std::any_of(engines.begin(), engines.end(), [&](const auto& engine) {
        const yade::Engine* one = engine.get();
        return one && typeid(*one) == typeid(BoundWatch) && static_cast<const BoundWatch*>(one)->lastStep == scene.iter;
    });
}

void BoundWatch::action()
{
    lastStep = scene->iter;
    const bool changed = cellHasChanged();
    if (scene->doSort || !(changed || someBodyIsOutside()))
        return;
    scene->doSort = true;
    ++requests;
}

// Its shape says where the images of bodies are, and turns the axes of the boxes.
bool BoundWatch::cellHasChanged()
{
    if (!scene->isPeriodic || scene->cell->hSize == lastCell)
        return false;
    lastCell = scene->cell->hSize;
    return true;
}

namespace {

    // Fetches the data of the bodies some places further than this one: first the body, then what it points at.
    void fetchBodiesAhead(const std::vector<boost::shared_ptr<yade::Body>>& bodies, std::size_t place)
    {
        constexpr std::size_t ahead = 8;
        if (place + 2 * ahead < bodies.size())
            fetch(bodies[place + 2 * ahead].get(), sizeof(yade::Body));
        const yade::Body* const later = place + ahead < bodies.size() ? bodies[place + ahead].get() : nullptr;
        if (!later || !later->state || !later->bound)
            return;
        fetch(&later->state->se3, sizeof(yade::Se3r));
        fetch(&later->bound->min, 2 * sizeof(yade::Vector3r));
        fetch(later->shape.get(), sizeof(void*));
    }

} // namespace

bool BoundWatch::someBodyIsOutside()
{
    const auto& bodies = scene->bodies->body;
    known.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        fetchBodiesAhead(bodies, i);
        if (bodies[i] && bodies[i]->bound && bodies[i]->shape && isOutside(*bodies[i], known[i]))
            return true;
    }
    return false;
}

BoundWatch::Kind BoundWatch::kindOf(const yade::Shape& shape)
{
    return hasCorners(shape)                                   ? Kind::corners
        : typeid(shape) == typeid(ConicPotentialParticle)      ? Kind::conic
        : dynamic_cast<const yade::PotentialParticle*>(&shape) ? Kind::potential
                                                               : Kind::other;
}

bool BoundWatch::isOutside(const yade::Body& body, Inside& known) const
{
    const void* const itsClass = classOf(*body.shape);
    if (itsClass != known.classOfShape) {
        known.classOfShape = itsClass;
        known.kind = kindOf(*body.shape);
    }
    if (known.kind == Kind::other)
        return false;
    if (known.kind == Kind::corners)
        return cornersAreOutside(body, known);
    const yade::Se3r& at = body.state->se3;
    const Particle* particle = nullptr;
    if (known.kind == Kind::conic) {
        // The particle alone defines what must lie within only if the box is the library's.
        const auto& conic = static_cast<const ConicPotentialParticle&>(*body.shape);
        particle = conic.automaticBox ? conic.particle() : nullptr;
    }
    if (particle && known.stillHolds(*particle, at, *body.bound))
        return false;
    const double room = boxAsTurned(body.shape, at, *scene).roomIn(*body.bound);
    // Of a sheared cell the box has other axes.
    if (particle && particle->handle() && room >= 0 && !(scene->isPeriodic && scene->cell->hasShear))
        known.note(*particle, at, *body.bound, room);
    return !(room >= 0);
}

// Walls mostly stand still, and their corners are few.
bool BoundWatch::cornersAreOutside(const yade::Body& body, Inside& known) const
{
    const yade::Se3r& at = body.state->se3;
    if (known.isUnmoved(at, *body.bound))
        return false;
    Box box = boxOfCorners(*body.shape, at, *scene);
    // YADE's bound of a body that never moves is not widened, and was rounded in its own way.
    const double rounding = 1e-14 * std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    box.lower.array() += rounding;
    box.upper.array() -= rounding;
    if (!(box.roomIn(*body.bound) >= 0))
        return true;
    if (!(scene->isPeriodic && scene->cell->hasShear))
        known.noteUnmoved(at, *body.bound);
    return false;
}

namespace {
    constexpr std::uint64_t noParticle = ~std::uint64_t(0);
}

bool BoundWatch::Inside::isUnmoved(const yade::Se3r& at, const yade::Bound& bound) const
{
    return serial == noParticle && position == at.position && turn.coeffs() == at.orientation.coeffs()
        && min == bound.min && max == bound.max;
}

void BoundWatch::Inside::noteUnmoved(const yade::Se3r& at, const yade::Bound& bound)
{
    serial = noParticle;
    position = at.position;
    turn = at.orientation;
    min = bound.min;
    max = bound.max;
}

// No point of a particle moves further than its centre does, and by its turn on the ball around it.
bool BoundWatch::Inside::stillHolds(const Particle& particle, const yade::Se3r& at, const yade::Bound& bound) const
{
    if (serial != particle.serial || min != bound.min || max != bound.max)
        return false;
    const double way = (at.position - position).norm() + particle.boundingRadius() * wayOfTurn(turn, at.orientation);
    return way == 0 || way < room; // what never moves has no room: its box is not widened
}

void BoundWatch::Inside::note(const Particle& particle, const yade::Se3r& at, const yade::Bound& bound, double space)
{
    serial = isUnit(at.orientation) ? particle.serial : 0; // no particle has 0
    position = at.position;
    turn = at.orientation;
    min = bound.min;
    max = bound.max;
    // Less the rounding of poses, over ten times of it.
    room = space * (1 - 1e-9) - 1e-14 * (particle.boundingRadius() + position.norm());
}

void BoundWatch::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself(Entry<BoundWatch>::name);
    const py::scope inside(scope);
    const auto style = docstringStyle();
    registerClass<BoundWatch, yade::GlobalEngine>().add_property(
        "requests", +[](const BoundWatch& watch) { return watch.requests; },
        "How often the collider was asked to run since the scene was made or loaded.");
}

template <class Archive> void BoundWatch::serialize(Archive& archive, unsigned version)
{
    requireReadable<BoundWatch>(version);
    serializeBase<yade::GlobalEngine>(archive, *this, "GlobalEngine");
}

} // namespace potential_particles

BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::BoundWatch)
