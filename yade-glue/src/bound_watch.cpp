// SPDX-License-Identifier: GPL-3.0-or-later
#include "archives.hpp"

#include "bound_watch.hpp"
#include "bounding_box.hpp"
#include "conic_potential_particle.hpp"
#include "python_class.hpp"

#include <algorithm>
#include <typeinfo>

namespace potential_particles {

namespace {

    constexpr char doc[]
        = "Runs the collider when a potential particle has left its box, be it by turning about its centre, which YADE's\n"
          "collider does not see. Put it before the collider and give that Bo1_ConicPP_Aabb (or Bo1_PP_Aabb_Conic for plain\n"
          "shapes) and a verletDist > 0: no pair is missed, however bodies move, and the collider need not run in each step.";

    bool isPotentialParticle(const yade::Shape& shape)
    {
        return typeid(shape) == typeid(ConicPotentialParticle) || dynamic_cast<const yade::PotentialParticle*>(&shape);
    }

} // namespace

BoundWatch::~BoundWatch() = default;

std::string BoundWatch::getClassName() const { return "BoundWatch"; }
std::string BoundWatch::getBaseClassName(unsigned int index) const { return index == 0 ? "GlobalEngine" : ""; }

bool BoundWatch::guards(const yade::Scene& scene)
{
    const auto& engines = scene.engines;
    return std::any_of(engines.begin(), engines.end(), [&](const auto& engine) {
        const yade::Engine* one = engine.get();
        return one && typeid(*one) == typeid(BoundWatch)
            && static_cast<const BoundWatch*>(one)->lastStep == scene.iter;
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

bool BoundWatch::someBodyIsOutside() const
{
    const auto& bodies = scene->bodies->body;
    return std::any_of(bodies.begin(), bodies.end(), [&](const boost::shared_ptr<yade::Body>& body) {
        return body && body->bound && body->shape && isPotentialParticle(*body->shape)
            && !boxAsTurned(body->shape, body->state->se3, *scene).liesIn(*body->bound);
    });
}

void BoundWatch::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself("BoundWatch");
    const py::scope inside(scope);
    const auto style = docstringStyle();
    registerClass<BoundWatch, yade::GlobalEngine>("BoundWatch", doc)
        .add_property("requests", +[](const BoundWatch& watch) { return watch.requests; },
                      "How often the collider was asked to run since the scene was made or loaded.");
}

template <class Archive> void BoundWatch::serialize(Archive& archive, unsigned)
{
    serializeBase<yade::GlobalEngine>(archive, *this, "GlobalEngine");
}

} // namespace potential_particles

BOOST_CLASS_EXPORT(potential_particles::BoundWatch)
