// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mesh.hpp"

#include "abi/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>

namespace potential_particles {

using yade::Vector3r;

namespace {

    // Gives the same number to points that are closer than their weld.
    class Welder {
    public:
        // `largest`: no weld is longer.
        explicit Welder(double largest) : cell(8 * largest) { }

        int numberOf(const Vector3r& point, double weld)
        {
            // A point within the weld lies in one of the cells that a cube of twice that size touches.
            const Index low = indexOf(point - Vector3r::Constant(weld));
            const Index high = indexOf(point + Vector3r::Constant(weld));
            Index at = low;
            for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
                for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
                    for (at[2] = low[2]; at[2] <= high[2]; ++at[2]) {
                        const auto [begin, end] = known.equal_range(keyOf(at));
                        for (auto one = begin; one != end; ++one)
                            if ((points[static_cast<std::size_t>(one->second)] - point).norm() <= weld)
                                return one->second;
                    }
            const int number = static_cast<int>(points.size());
            points.push_back(point);
            known.emplace(keyOf(indexOf(point)), number);
            return number;
        }

        std::size_t size() const { return points.size(); }

    private:
        using Index = std::array<std::int64_t, 3>;

        Index indexOf(const Vector3r& point) const
        {
            Index index;
            for (int i = 0; i < 3; ++i)
                index[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(point[i] / cell));
            return index;
        }

        static std::uint64_t keyOf(const Index& index)
        {
            std::uint64_t key = 0;
            for (const std::int64_t one : index)
                key = (key ^ static_cast<std::uint64_t>(one)) * 0x9e3779b97f4a7c15u + (key >> 29);
            return key;
        }

        const double cell;
        std::vector<Vector3r> points;
        std::unordered_multimap<std::uint64_t, int> known;
    };

    // Beyond, cells have no number; such a mesh has no digits left either.
    bool isUsable(const BoundaryPoints& vertices, double weld)
    {
        return weld > 0 && std::all_of(vertices.begin(), vertices.end(), [weld](const Vector3r& vertex) {
            return vertex.allFinite() && vertex.cwiseAbs().maxCoeff() < 1e18 * weld;
        });
    }

} // namespace

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
    if (!isOf(scene)) {
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

void FacetMesh::build(const yade::Scene& scene)
{
    const auto& all = scene.bodies->body;
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
