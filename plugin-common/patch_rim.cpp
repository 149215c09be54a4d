// SPDX-License-Identifier: MIT OR Apache-2.0
#include "patch_rim.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace potential_particles {

using Eigen::Vector3d;
using Plane = Eigen::Vector2d; // y and z of the frame

PosedShape::Exit PosedShape::exitOfTriangle(const Vector3d& point, const Vector3d& direction) const
{
    Exit first { std::numeric_limits<double>::infinity(), direction };
    if (!triangle)
        return first;
    const auto& vertices = *triangle;
    const Vector3d up = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d outward = (vertices[(i + 1) % 3] - vertices[i]).cross(up);
        const double length = std::max(0.0, outward.dot(vertices[i] - point)) / outward.dot(direction);
        if (outward.dot(direction) > 0 && length < first.length)
            first = { length, outward };
    }
    return first;
}

double PosedShape::depth(const Vector3d& point, Vector3d* gradient) const
{
    double potential = 0;
    Vector3d slope = Vector3d::Zero();
    if (particle)
        if (const pp_status status = pp_particle_potential(particle, &pose, point.data(), &potential, slope.data());
            status != PP_OK)
            throw std::runtime_error(pp_status_message(status));
    const double s = std::sqrt(potential + 1);
    if (gradient)
        *gradient = s > 0 ? Vector3d(-depthLength / (2 * s) * slope) : Vector3d(Vector3d::Zero());
    return depthLength * (1 - s);
}

double PosedShape::reach(const Vector3d& point) const
{
    return particle ? (point - Vector3d(pose.position)).norm() + boundingRadius : 0;
}

namespace {

    // The depth is concave along a ray and begins above 0: Newton's method from outside comes down to its end without
    // crossing it, as that for a single body.
    PosedShape::Exit exitOf(const PosedShape& one, const PosedShape& other, const Vector3d& point,
                            const Vector3d& direction)
    {
        const double outside = std::max(one.reach(point), other.reach(point));
        PosedShape::Exit exit { outside, direction };
        for (int step = 0; step < 100; ++step) {
            const Vector3d at = point + exit.length * direction;
            Vector3d gradient, ofOther;
            const double depth = one.depth(at, &gradient) + other.depth(at, &ofOther);
            gradient += ofOther;
            const double slope = gradient.dot(direction), next = exit.length - depth / slope;
            if (!(slope < 0) || !(next < exit.length))
                break;
            const bool last = exit.length - next < std::numeric_limits<double>::epsilon() * outside;
            exit = { std::max(next, 0.0), -gradient };
            if (last || next <= 0)
                break;
        }
        for (const PosedShape* body : { &one, &other })
            if (const PosedShape::Exit edge = body->exitOfTriangle(point, direction); edge.length < exit.length)
                exit = edge;
        return exit;
    }

    double cross(const Plane& a, const Plane& b) { return a.x() * b.y() - a.y() * b.x(); }

    double polygonArea(const std::vector<Plane>& points)
    {
        double sum = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            sum += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
        return sum;
    }

    // A point of the rim of a convex area about the origin, and the direction outwards there.
    struct RimPoint {
        Plane at, outward;
    };

    // The corners of such an area, from rays. Where the tangents at two neighbours meet is a corner if another ray ends
    // there; if not, the rim has more corners in between, or is round.
    template <class RimAlong> class CornerSearch {
    public:
        // spread: lengths in which the area is about as wide as high.
        CornerSearch(const Plane& spread, const RimAlong& rimAlong)
            : rimAlong(rimAlong)
            , close(1e-7 * spread.norm())
        {
            constexpr int rays = 12;
            const auto ray = [&](int i) {
                const double angle = 2 * M_PI * (i + 0.3) / rays; // no axis of symmetry: corners may lie there
                return rimAlong(Plane(spread.x() * std::cos(angle), spread.y() * std::sin(angle)).normalized());
            };
            RimPoint here = ray(0);
            for (int i = 1; i <= rays; ++i) {
                const RimPoint next = ray(i % rays);
                all.push_back(here.at);
                between(here, next, 3);
                here = next;
            }
        }

        std::vector<Plane> corners() const
        {
            // What lies on a straight side is no corner.
            const double least = 1e-5 * polygonArea(all);
            std::vector<Plane> found;
            for (std::size_t i = 0; i < all.size(); ++i) {
                const Plane &before = found.empty() ? all.back() : found.back(), &after = all[(i + 1) % all.size()];
                if (cross(all[i] - before, after - all[i]) > least)
                    found.push_back(all[i]);
            }
            return found;
        }

    private:
        void between(const RimPoint& here, const RimPoint& next, int depth)
        {
            const double slope = cross(here.outward, next.outward);
            if (!(slope > 0))
                return;
            const double height = here.outward.dot(here.at), nextHeight = next.outward.dot(next.at);
            const Plane meeting = Plane(height * next.outward.y() - nextHeight * here.outward.y(),
                                        nextHeight * here.outward.x() - height * next.outward.x())
                / slope;
            const bool isBetween = cross(here.at, meeting) > 0 && cross(meeting, next.at) > 0;
            if (!isBetween || !((meeting - here.at).norm() > close && (meeting - next.at).norm() > close))
                return;
            const RimPoint middle = rimAlong(meeting.normalized());
            const bool isCorner = (middle.at - meeting).norm() <= close;
            if (!isCorner && depth > 0)
                between(here, middle, depth - 1);
            all.push_back(middle.at);
            if (!isCorner && depth > 0)
                between(middle, next, depth - 1);
        }

        const RimAlong& rimAlong;
        const double close;
        std::vector<Plane> all;
    };

} // namespace

PatchFrame::PatchFrame(const ContactPatch& patch, const PatchPlace& place)
    : centroid(place.point + patch.centroid - patch.centroid.dot(place.normal) * place.normal)
{
    const Vector3d& n = place.normal;
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = n.unitOrthogonal();
    basis.col(1) = n.cross(basis.col(0));
    const Eigen::Matrix2d moments = basis.transpose() * patch.secondMoment * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(moments);
    axes.col(0) = n;
    axes.col(1) = (basis * principal.eigenvectors().col(0)).normalized();
    axes.col(2) = n.cross(axes.col(1));
    alongY = std::max(0.0, principal.eigenvalues()[0]);
    alongZ = std::max(0.0, principal.eigenvalues()[1]);
}

std::vector<Plane> rimOf(const ContactPatch& patch, const PatchFrame& frame, const PosedShape& one,
                         const PosedShape& other)
{
    // An ellipse has these moments about axes of twice the radii of gyration.
    const Plane radii(2 * std::sqrt(frame.alongY / patch.area), 2 * std::sqrt(frame.alongZ / patch.area));
    std::vector<Plane> corners;
    if (!patch.ofPoint && radii.minCoeff() > 0) {
        const auto rimAlong = [&](const Plane& direction) {
            const Vector3d way = frame.at(direction) - frame.centroid;
            const PosedShape::Exit exit = exitOf(one, other, frame.centroid, way);
            return RimPoint {
                exit.length * direction,
                Plane(frame.axes.col(1).dot(exit.outward), frame.axes.col(2).dot(exit.outward)).normalized()
            };
        };
        corners = CornerSearch(radii, rimAlong).corners();
    }
    if (const double area = polygonArea(corners); !(area > 0.8 * patch.area && area < 1.25 * patch.area)) {
        corners.clear();
        for (int i = 0; i < 48; ++i)
            corners.push_back(radii.cwiseProduct(Plane(std::cos(2 * M_PI * i / 48), std::sin(2 * M_PI * i / 48))));
    }
    return corners;
}

} // namespace potential_particles
