// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounding_box.hpp"

#include "abi/primitives.hpp"
#include "shape/conic_potential_particle.hpp"
#include "shape/particle_of.hpp"

#include <algorithm>
#include <limits>
#include <typeinfo>

namespace potential_particles {

using yade::PotentialParticle;
using yade::Quaternionr;
using yade::Vector3r;

namespace {

    // What holds a shape: the library's polyhedron, or points that the script gave.
    class Outline {
    public:
        explicit Outline(const boost::shared_ptr<yade::Shape>& owner)
            : shape(static_cast<const PotentialParticle&>(*owner))
        {
            bool computed = !shape.AabbMinMax; // YADE's cube of half size R need not hold the particle
            if (typeid(shape) == typeid(ConicPotentialParticle))
                computed = computed || static_cast<const ConicPotentialParticle&>(shape).automaticBox;
            if (computed)
                particle = particleOf(owner, shape, keeper);
            if (particle && !particle->handle())
                particle = nullptr;
        }

        double radius() const
        {
            if (particle)
                return particle->boundingRadius();
            double square = 0;
            eachPoint([&](const Vector3r& point) { square = std::max(square, point.squaredNorm()); });
            return std::sqrt(square);
        }

        // About the centre.
        Box turned(const Quaternionr& turn) const
        {
            Box box { Vector3r::Zero(), Vector3r::Zero() };
            if (!particle) {
                // The centre belongs to it, as in YADE's own functor.
                eachPoint([&](const Vector3r& point) {
                    const Vector3r now = turn * point;
                    box.lower = box.lower.cwiseMin(now);
                    box.upper = box.upper.cwiseMax(now);
                });
                return box;
            }
            const pp_pose pose = { { 0, 0, 0 }, { turn.w(), turn.x(), turn.y(), turn.z() } };
            if (pp_particle_box(particle->handle(), &pose, box.lower.data(), box.upper.data()) != PP_OK)
                return { Vector3r::Constant(-radius()),
                         Vector3r::Constant(radius()) }; // of no valid orientation: of any
            const Eigen::Matrix3d world = turn.normalized().toRotationMatrix();
            for (int i = 0; i < 3; ++i) {
                const Vector3r e = world.row(i);
                box.upper[i] = std::min(box.upper[i], particle->support().along(e));
                box.lower[i] = std::max(box.lower[i], -particle->support().along(-e));
            }
            return box;
        }

    private:
        template <class Visit> void eachPoint(Visit&& visit) const
        {
            if (shape.AabbMinMax && !shape.vertices.empty()) {
                std::for_each(shape.vertices.begin(), shape.vertices.end(), visit);
                return;
            }
            // Of a shape that the library refuses: a cube of half size R, as YADE has it.
            const Vector3r lower = shape.AabbMinMax ? Vector3r(-shape.minAabbRotated) : Vector3r::Constant(-shape.R);
            const Vector3r upper = shape.AabbMinMax ? shape.maxAabbRotated : Vector3r::Constant(shape.R);
            for (int corner = 0; corner < 8; ++corner)
                visit(Vector3r(corner & 1 ? upper[0] : lower[0], corner & 2 ? upper[1] : lower[1],
                               corner & 4 ? upper[2] : lower[2]));
        }

        const PotentialParticle& shape;
        const Particle* particle = nullptr;
        std::shared_ptr<const Particle> keeper;
    };

    const yade::Cell* shearedCell(const yade::Scene& scene)
    {
        return scene.isPeriodic && scene.cell->hasShear ? scene.cell.get() : nullptr;
    }

} // namespace

Box boxAsTurned(const boost::shared_ptr<yade::Shape>& shape, const yade::Se3r& at, const yade::Scene& scene)
{
    const Outline outline(shape);
    const yade::Cell* cell = shearedCell(scene);
    if (!cell) {
        const Box box = outline.turned(at.orientation);
        return { at.position + box.lower, at.position + box.upper };
    }
    // The collider's coordinate i is u.x with a row u of the matrix: the reach along u, of a body turned so that u is
    // the first axis.
    const Vector3r centre = cell->unshearTrsf * at.position;
    Box box { centre, centre };
    for (int i = 0; i < 3; ++i) {
        const Vector3r u = cell->unshearTrsf.row(i);
        const Box along
            = outline.turned((Quaternionr::FromTwoVectors(u, Vector3r::UnitX()) * at.orientation).normalized());
        box.lower[i] += u.norm() * along.lower[0];
        box.upper[i] += u.norm() * along.upper[0];
    }
    return box;
}

Box boxOfAnyTurn(const boost::shared_ptr<yade::Shape>& shape, const yade::Se3r& at, const yade::Scene& scene)
{
    const double radius = Outline(shape).radius();
    const yade::Cell* cell = shearedCell(scene);
    if (!cell)
        return { at.position.array() - radius, at.position.array() + radius };
    const Vector3r centre = cell->unshearTrsf * at.position, reach = radius * cell->unshearTrsf.rowwise().norm();
    return { centre - reach, centre + reach };
}

bool hasCorners(const yade::Shape& shape)
{
    const StandIn* kind = standInOf(shape);
    return kind ? kind->hullOf != nullptr : typeid(shape) == typeid(yade::Facet);
}

Box boxOfCorners(const yade::Shape& shape, const yade::Se3r& at, const yade::Scene& scene)
{
    const yade::Cell* cell = shearedCell(scene);
    const Vector3r most = Vector3r::Constant(std::numeric_limits<double>::infinity());
    Box box { most, -most };
    const auto add = [&](const Vector3r& corner) {
        const Vector3r world = at.position + at.orientation * corner;
        const Vector3r place = cell ? Vector3r(cell->unshearTrsf * world) : world;
        box.lower = box.lower.cwiseMin(place);
        box.upper = box.upper.cwiseMax(place);
    };
    if (typeid(shape) == typeid(yade::Facet)) {
        for (const Vector3r& vertex : static_cast<const yade::Facet&>(shape).vertices)
            add(vertex);
    } else if (const StandIn* kind = standInOf(shape)) {
        const StandIn::Hull hull = kind->hullOf(kind->measuresOf(shape));
        std::for_each_n(hull.points.begin(), hull.count, add);
        const Vector3r reach
            = hull.radius * (cell ? Vector3r(cell->unshearTrsf.rowwise().norm()) : Vector3r::Ones().eval());
        box.lower -= reach;
        box.upper += reach;
    }
    return box;
}

} // namespace potential_particles
