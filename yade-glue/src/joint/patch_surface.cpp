// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch_surface.hpp"

#include "pair/sc_geom_conic_pp.hpp"
#include "joint_body.hpp"
#include "registration/python_bytes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace py = boost::python;

namespace potential_particles {

using yade::Vector3r;

namespace {

    // Rings of the fan about the centroid, over its rim. Pressure falls to 0 within the rounding of an edge: the last
    // but one is about where the flat part ends.
    constexpr std::array<double, 5> rings { 0.4, 0.7, 0.9, 0.98, 1.0 };

    // A side longer than this part of the rim is divided: the pressure along it need not be linear.
    constexpr double longestSide = 1.0 / 16;

    std::vector<Eigen::Vector2d> divided(const std::vector<Eigen::Vector2d>& rim)
    {
        const auto side = [&](std::size_t i) { return Eigen::Vector2d(rim[(i + 1) % rim.size()] - rim[i]); };
        double whole = 0;
        for (std::size_t i = 0; i < rim.size(); ++i)
            whole += side(i).norm();
        std::vector<Eigen::Vector2d> points;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const int parts = std::max(1, static_cast<int>(std::ceil(side(i).norm() / (longestSide * whole))));
            for (int part = 0; part < parts; ++part)
                points.push_back(rim[i] + side(i) * part / parts);
        }
        return points;
    }

    struct Node {
        Vector3r at;
        double depth;
    };

} // namespace

py::tuple patchSurface(const yade::ScGeom& geometry, const boost::shared_ptr<yade::Shape>& shape1,
                       const yade::State& state1, const boost::shared_ptr<yade::Shape>& shape2,
                       const yade::State& state2, const Vector3r& shift2)
{
    std::vector<double> corners, depths;
    const auto* const own = dynamic_cast<const ScGeomConicPP*>(&geometry);
    if (own && own->patch().area > 0 && !(geometry.penetrationDepth < 0)) {
        const PosedBody one(shape1, state1, Vector3r::Zero()), other(shape2, state2, shift2);
        const PatchFrame frame(own->patch(), { geometry.contactPoint, geometry.normal });
        const std::vector<Eigen::Vector2d> rim = divided(rimOf(own->patch(), frame, one, other));
        const auto node = [&](double part, std::size_t i) {
            const Vector3r at = frame.at(part * rim[i % rim.size()]);
            return Node { at, std::max(0.0, one.depth(at) + other.depth(at)) };
        };
        const auto triangle = [&](const Node& a, const Node& b, const Node& c) {
            for (const Node* one : { &a, &b, &c }) {
                corners.insert(corners.end(), one->at.data(), one->at.data() + 3);
                depths.push_back(one->depth);
            }
        };
        for (std::size_t i = 0; i < rim.size(); ++i) {
            triangle(node(0, i), node(rings[0], i), node(rings[0], i + 1));
            for (std::size_t ring = 1; ring < rings.size(); ++ring) {
                const Node a = node(rings[ring - 1], i), b = node(rings[ring - 1], i + 1), c = node(rings[ring], i),
                           d = node(rings[ring], i + 1);
                triangle(a, c, d);
                triangle(a, d, b);
            }
        }
    }
    return py::make_tuple(bytes(corners), bytes(depths));
}

} // namespace potential_particles
