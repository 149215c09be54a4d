// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mesh.hpp"

#include "abi/primitives.hpp"

#include "plugin-common/welder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace potential_particles {

using yade::Vector3r;

BoundaryPoints verticesOf(const yade::Shape& shape, const yade::State& state, const Vector3r& origin)
{
    const auto& vertices = static_cast<const yade::Facet&>(shape).vertices;
    if (vertices.size() != 3)
        throw std::invalid_argument("a Facet with " + std::to_string(vertices.size()) + " vertices: give three");
    const Vector3r centre = state.se3.position - origin;
    BoundaryPoints points;
    for (std::size_t i = 0; i < 3; ++i)
        points[i] = centre + state.se3.orientation * vertices[i];
    return points;
}

void FacetMesh::refresh(const yade::Scene& scene)
{
    const auto isSeen = [&] {
        return step.load(std::memory_order_acquire) == scene.iter && seen.load(std::memory_order_acquire) == &scene
            && bodies.load(std::memory_order_acquire) == scene.bodies->body.size();
    };
    if (isSeen())
        return;
    const std::lock_guard<std::mutex> lock(mutex);
    if (isSeen())
        return;
    if (!isOf(scene) || isLate(scene)) {
        step.store(-1, std::memory_order_release);
        build(scene);
        owner = const_cast<yade::Scene&>(scene).weak_from_this();
    }
    seen.store(&scene, std::memory_order_release);
    bodies.store(scene.bodies->body.size(), std::memory_order_release);
    step.store(scene.iter, std::memory_order_release);
}

bool FacetMesh::isOf(const yade::Scene& scene) const
{
    return owner.lock().get() == &scene && bodies.load(std::memory_order_relaxed) == scene.bodies->body.size();
}

bool FacetMesh::isLate(const yade::Scene& scene) const
{
    const int how = moved.load(std::memory_order_relaxed);
    return how == rests || (how == moves && scene.iter - builtIn >= patience);
}

void FacetMesh::see(const yade::Body& facet, const BoundaryPoints& vertices)
{
    const auto id = static_cast<std::size_t>(facet.id);
    if (id >= built.size() || moved.load(std::memory_order_relaxed) == rests)
        return;
    const double weld = weldOf(vertices);
    if (std::equal(
            vertices.begin(), vertices.end(), built[id].begin(),
            [weld](const Vector3r& one, const Vector3r& other) { return (one - other).squaredNorm() <= weld * weld; }))
        return;
    const bool atRest = facet.state->vel == Vector3r::Zero() && facet.state->angVel == Vector3r::Zero();
    moved.store(atRest ? rests : moves, std::memory_order_relaxed);
}

void FacetMesh::build(const yade::Scene& scene)
{
    const auto& all = scene.bodies->body;
    built.assign(all.size(), BoundaryPoints { Vector3r::Zero(), Vector3r::Zero(), Vector3r::Zero() });
    builtIn = scene.iter;
    moved.store(no, std::memory_order_relaxed);
    corners.assign(all.size(), Corners { -1, -1, -1 });
    first.clear();
    facets.clear();

    struct Placed {
        std::size_t id;
        BoundaryPoints vertices;
        double weld;
    };
    std::vector<Placed> placed;
    double largest = 0;
    for (std::size_t id = 0; id < all.size(); ++id) {
        if (!all[id] || !dynamic_cast<const yade::Facet*>(all[id]->shape.get()))
            continue;
        const BoundaryPoints vertices = verticesOf(*all[id]->shape, *all[id]->state, Vector3r::Zero());
        placed.push_back({ id, vertices, weldOf(vertices) });
        built[id] = vertices;
        largest = std::isfinite(placed.back().weld) ? std::max(largest, placed.back().weld) : largest;
    }

    Welder welder(largest);
    for (const Placed& one : placed)
        if (isUsable(one.vertices, one.weld))
            for (std::size_t i = 0; i < 3; ++i)
                corners[one.id][i] = welder.numberOf(one.vertices[i], one.weld);

    // Lists of all points in a row: counted, then filled in the order of the bodies.
    first.assign(welder.size() + 1, 0);
    for (const Corners& three : corners)
        for (const int point : three)
            if (point >= 0)
                ++first[static_cast<std::size_t>(point) + 1];
    for (std::size_t i = 1; i < first.size(); ++i)
        first[i] += first[i - 1];
    facets.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t id = 0; id < corners.size(); ++id)
        for (const int point : corners[id])
            if (point >= 0)
                facets[next[static_cast<std::size_t>(point)]++] = static_cast<int>(id);
}

std::pair<const int*, const int*> FacetMesh::around(int facet, std::size_t i) const
{
    if (facet < 0 || static_cast<std::size_t>(facet) >= corners.size())
        return { nullptr, nullptr };
    const int point = corners[static_cast<std::size_t>(facet)][i];
    if (point < 0)
        return { nullptr, nullptr };
    const auto at = static_cast<std::size_t>(point);
    return { facets.data() + first[at], facets.data() + first[at + 1] };
}

} // namespace potential_particles
