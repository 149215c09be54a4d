// SPDX-License-Identifier: GPL-3.0-or-later
#include "bonded_area.hpp"

#include "abi/primitives.hpp"
#include "contact/facet_mesh.hpp"
#include "particle/pose.hpp"
#include "particle/ray.hpp"
#include "shape/particle_of.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace potential_particles {

using yade::Vector3r;
using Plane = Eigen::Vector2d; // y and z of the bond

namespace {

    // Where a ray leaves a body.
    struct Exit {
        double length;
        Vector3r outward; // along the normal of the surface there
    };

    class Outline {
    public:
        explicit Outline(const MovingBody& body)
            : shape(*body.shape())
            , isWall(dynamic_cast<const yade::Wall*>(&shape))
            , isFacet(dynamic_cast<const yade::Facet*>(&shape))
        {
            const Vector3r shift = body.centre() - body.state().se3.position;
            if (isFacet)
                vertices = verticesOf(shape, body.state(), -shift);
            else if (!isWall)
                particle = particleOf(body.shape(), keeper);
            pose = poseOf(body.state(), shift);
        }

        // From a point within; never, along a wall.
        Exit exit(const Vector3r& point, const Vector3r& direction) const
        {
            Exit first { std::numeric_limits<double>::infinity(), direction };
            if (particle && particle->handle()) {
                first.length = distanceToSurface(*particle, pose, point, direction);
                const Vector3r at = point + first.length * direction;
                double potential;
                requireOk(pp_particle_potential(particle->handle(), &pose, at.data(), &potential, first.outward.data()));
            } else if (isFacet) {
                const Vector3r up = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
                for (std::size_t i = 0; i < 3; ++i) {
                    const Vector3r outward = (vertices[(i + 1) % 3] - vertices[i]).cross(up);
                    const double length = std::max(0.0, outward.dot(vertices[i] - point)) / outward.dot(direction);
                    if (outward.dot(direction) > 0 && length < first.length)
                        first = { length, outward };
                }
            }
            return first;
        }

    private:
        const yade::Shape& shape;
        const bool isWall, isFacet;
        BoundaryPoints vertices;
        const Particle* particle = nullptr;
        std::shared_ptr<const Particle> keeper;
        pp_pose pose;
    };

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

    // The corners of such an area, from rays. Where the tangents at two neighbours meet is a corner if another ray ends there; if
    // not, the rim has more corners in between, or is round.
    template <class RimAlong> class CornerSearch {
    public:
        // spread: lengths in which the area is about as wide as high.
        CornerSearch(const Plane& spread, const RimAlong& rimAlong) : rimAlong(rimAlong), close(1e-7 * spread.norm())
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
                                        nextHeight * here.outward.x() - height * next.outward.x()) / slope;
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

void bondPatch(ConicJointPhys& phys, const ContactPatch& patch, const PatchPlace& place, const Wrench& held, const MovingBody& one,
               const MovingBody& other)
{
    const Vector3r& n = place.normal;
    const Vector3r centroid = place.point + patch.centroid - patch.centroid.dot(n) * n;
    // Principal axes of the area, seen along the normal.
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = n.unitOrthogonal();
    basis.col(1) = n.cross(basis.col(0));
    const Eigen::Matrix2d moments = basis.transpose() * patch.secondMoment * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(moments);
    Eigen::Matrix3d axes;
    axes.col(0) = n;
    axes.col(1) = (basis * principal.eigenvectors().col(0)).normalized();
    axes.col(2) = n.cross(axes.col(1));
    const double alongY = std::max(0.0, principal.eigenvalues()[0]), alongZ = std::max(0.0, principal.eigenvalues()[1]);

    phys.bonded = true;
    phys.broken = false;
    phys.damage = 0;
    phys.bondArea = patch.area;
    phys.bondMoments = Vector3r(alongY + alongZ, alongZ, alongY);
    const yade::Quaternionr turn(axes);
    phys.bondTurn1 = one.turn().conjugate() * turn;
    phys.bondTurn2 = other.turn().conjugate() * turn;
    phys.bondPoint1 = one.turn().conjugate() * (centroid - one.centre());
    phys.bondPoint2 = other.turn().conjugate() * (centroid - other.centre());

    const Vector3r force = axes.transpose() * held.force;
    const Vector3r moment = axes.transpose() * (held.moment + (place.point - centroid).cross(held.force));
    const auto over = [](double load, double stiffness) { return stiffness > 0 ? -load / stiffness : 0; };
    const double kn = phys.normalStiffness, ks = phys.shearStiffness;
    phys.bondDisplacement = Vector3r(over(force.x(), kn * patch.area), over(force.y(), ks * patch.area), over(force.z(), ks * patch.area));
    phys.bondRotation = Vector3r(over(moment.x(), ks * phys.bondMoments.x()), over(moment.y(), kn * phys.bondMoments.y()),
                                 over(moment.z(), kn * phys.bondMoments.z()));

    // An ellipse has these moments about axes of twice the radii of gyration.
    const Plane radii(2 * std::sqrt(alongY / patch.area), 2 * std::sqrt(alongZ / patch.area));
    std::vector<Plane> corners;
    if (!patch.ofPoint && radii.minCoeff() > 0) {
        const Outline outline1(one), outline2(other);
        const auto rimAlong = [&](const Plane& direction) {
            const Vector3r way = axes.col(1) * direction.x() + axes.col(2) * direction.y();
            const Exit exit1 = outline1.exit(centroid, way), exit2 = outline2.exit(centroid, way);
            const Exit& first = exit1.length < exit2.length ? exit1 : exit2;
            const Plane outward(axes.col(1).dot(first.outward), axes.col(2).dot(first.outward));
            return RimPoint { std::isfinite(first.length) ? Plane(first.length * direction) : Plane(Plane::Zero()), outward.normalized() };
        };
        corners = CornerSearch(radii, rimAlong).corners();
    }
    // A patch that is not plane may leave its own plane: what its points enclose is then another area.
    if (const double area = polygonArea(corners); !(area > 0.8 * patch.area && area < 1.25 * patch.area)) {
        corners.clear();
        for (int i = 0; i < 48; ++i)
            corners.push_back(radii.cwiseProduct(Plane(std::cos(2 * M_PI * i / 48), std::sin(2 * M_PI * i / 48))));
    }
    phys.bondRim.clear();
    for (const Plane& corner : corners)
        phys.bondRim.insert(phys.bondRim.end(), { corner.x(), corner.y() });
}

} // namespace potential_particles
