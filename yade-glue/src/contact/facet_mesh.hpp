// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which facets of a scene share a vertex.
#pragma once

#include "abi/scene.hpp"
#include "pair/kept_apart.hpp"

#include <array>
#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

#include <boost/weak_ptr.hpp>

namespace potential_particles {

// Of a body with a Facet, in world axes from `origin`. Throws std::invalid_argument when it has no three vertices.
BoundaryPoints verticesOf(const yade::Shape& facet, const yade::State& state, const yade::Vector3r& origin);

// The facets around each vertex, from their positions when the scene's number of bodies changed last, or when a
// facet was seen elsewhere (a gate that closes). The caller must check for later motion: this only gives the facets
// to check.
class FacetMesh {
public:
    // Call in each step before around(), from any thread: the first one of a step looks whether the mesh is still
    // that of the scene, and the others wait for it.
    void refresh(const yade::Scene& scene);

    // From any thread, after refresh(): the facet is here now (world axes). If that is not where it was, the mesh
    // is made anew: in the next step if it rests, else once in so many steps, since most that moves keeps its
    // neighbours.
    void see(const yade::Body& facet, const BoundaryPoints& vertices);

    // Ids of the facets that have vertex i of this one, itself among them; in ascending order.
    std::pair<const int*, const int*> around(int facet, std::size_t i) const;

private:
    static constexpr long patience = 50; // steps
    enum Moved : int { no, moves, rests };

    bool isOf(const yade::Scene& scene) const;
    bool isLate(const yade::Scene& scene) const;
    void build(const yade::Scene& scene);

    using Corners = std::array<int, 3>; // numbers of points; -1: the body has no facet
    std::vector<Corners> corners; // by body
    std::vector<std::size_t> first; // by point: where its facets begin in `facets`
    std::vector<int> facets;
    std::vector<BoundaryPoints> built; // by body: where the facet was then
    long builtIn = 0; // step
    std::atomic<int> moved { no }; // a facet, since
    boost::weak_ptr<yade::Factorable> owner; // the scene; its address may be used again

    // What refresh() has last said yes to. `step` is written last and read first.
    std::mutex mutex;
    std::atomic<long> step { -1 };
    std::atomic<const yade::Scene*> seen { nullptr };
    std::atomic<std::size_t> bodies { 0 };
};

} // namespace potential_particles
