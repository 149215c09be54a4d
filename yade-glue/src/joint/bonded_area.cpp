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

    // How far a body reaches from a point within it.
    class Reach {
    public:
        explicit Reach(const MovingBody& body)
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

        double along(const Vector3r& point, const Vector3r& direction) const
        {
            if (particle)
                return particle->handle() ? distanceToSurface(*particle, pose, point, direction) : 0;
            double least = std::numeric_limits<double>::infinity();
            if (isFacet) {
                const Vector3r up = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
                for (std::size_t i = 0; i < 3; ++i) {
                    const Vector3r outward = (vertices[(i + 1) % 3] - vertices[i]).cross(up);
                    if (const double slope = outward.dot(direction); slope > 0)
                        least = std::min(least, std::max(0.0, outward.dot(vertices[i] - point) / slope));
                }
            }
            return least;
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

    // Where two lines meet, each through two points; the origin where they do not.
    Plane meet(const Plane& a, const Plane& b, const Plane& c, const Plane& d)
    {
        const double slope = cross(b - a, d - c);
        return slope != 0 ? Plane(a + cross(c - a, d - c) / slope * (b - a)) : Plane(Plane::Zero());
    }

    // The corners of a convex area about the origin, from rays. Where the sides next to two rays meet between them, another ray seeks
    // the corner. `spread`: lengths in which the area is about as wide as high.
    template <class Length> std::vector<Plane> cornersOf(const Plane& spread, const Length& lengthAlong)
    {
        constexpr int rays = 24;
        const auto point = [&](const Plane& towards) {
            const Plane direction = towards.normalized();
            return Plane(lengthAlong(direction) * direction);
        };
        std::vector<Plane> found, all;
        for (int i = 0; i < rays; ++i)
            found.push_back(point({ spread.x() * std::cos(2 * M_PI * (i + 0.5) / rays), spread.y() * std::sin(2 * M_PI * (i + 0.5) / rays) }));
        for (int i = 0; i < rays; ++i) {
            const Plane &before = found[(i + rays - 1) % rays], &here = found[i], &next = found[(i + 1) % rays], &after = found[(i + 2) % rays];
            all.push_back(here);
            const Plane corner = meet(before, here, next, after);
            const double close = 1e-6 * spread.norm();
            if (cross(here, corner) > 0 && cross(corner, next) > 0 && (corner - here).norm() > close && (corner - next).norm() > close)
                all.push_back(point(corner));
        }
        // What lies on a straight side is no corner.
        const double area = polygonArea(all);
        std::vector<Plane> corners;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Plane &before = corners.empty() ? all.back() : corners.back(), &after = all[(i + 1) % all.size()];
            if (cross(all[i] - before, after - all[i]) > 1e-5 * area)
                corners.push_back(all[i]);
        }
        return corners;
    }

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
        const Reach reach1(one), reach2(other);
        corners = cornersOf(radii, [&](const Plane& direction) {
            const Vector3r way = axes.col(1) * direction.x() + axes.col(2) * direction.y();
            const double length = std::min(reach1.along(centroid, way), reach2.along(centroid, way));
            return std::isfinite(length) ? length : 0;
        });
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
