// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_lists.hpp"

#include "particle/particle_store.hpp"
#include "published.hpp"

#include <algorithm>
#include <array>

#include <boost/python/extract.hpp>

namespace py = boost::python;

namespace potential_particles {

using yade::PotentialParticle;
using yade::Vector3r;

namespace {

    constexpr std::array<std::pair<const char*, std::vector<double> PotentialParticle::*>, 4> lists
        = { { { "a", &PotentialParticle::a },
              { "b", &PotentialParticle::b },
              { "c", &PotentialParticle::c },
              { "d", &PotentialParticle::d } } };

} // namespace

void setVertices(PotentialParticle& shape, std::vector<Vector3r> vertices)
{
    auto& held = shape.vertices;
    if (vertices.size() <= held.capacity()) {
        // In place: a reader sees old and new corners mixed for one step, and only its end moves.
        held.assign(vertices.begin(), vertices.end());
        return;
    }
    if (held.capacity() > 0)
        vertices.reserve(2 * vertices.size()); // it changes: let the next change fit
    const auto old = std::make_shared<std::vector<Vector3r>>();
    retire(old);
    held.swap(vertices);
    old->swap(vertices);
}

void setList(PotentialParticle& shape, std::vector<double> PotentialParticle::*list, std::vector<double> values)
{
    const std::lock_guard<std::mutex> lock(ParticleStore::instance().mutexOf(shape));
    (shape.*list).swap(values);
}

bool setList(PotentialParticle& shape, const std::string& name, const py::object& value)
{
    if (name == "vertices") {
        setVertices(shape, py::extract<std::vector<Vector3r>>(value)());
        return true;
    }
    const auto found = std::find_if(lists.begin(), lists.end(), [&](const auto& list) { return name == list.first; });
    if (found == lists.end())
        return false;
    // Python first: turning objects into numbers may run any code.
    setList(shape, found->second, py::extract<std::vector<double>>(value)());
    return true;
}

} // namespace potential_particles
