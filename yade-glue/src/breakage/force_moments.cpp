// SPDX-License-Identifier: GPL-3.0-or-later
#include "force_moments.hpp"

#include "abi/knksphys.hpp"
#include "abi/material.hpp"
#include "joint/conic_joint.hpp"
#include "pair/sc_geom_conic_pp.hpp"

#include <typeinfo>

namespace potential_particles {

using yade::Vector3r;

namespace {

    // dynamic_cast is slow, and the contacts of a scene are of one or two classes: those of the last answers are known.
    template <class Wanted> class Cast {
    public:
        template <class Object> const Wanted* operator()(const Object& object)
        {
            const void* const itsClass = *reinterpret_cast<const void* const*>(&object);
            if (itsClass == known)
                return static_cast<const Wanted*>(&object);
            if (itsClass == other)
                return nullptr;
            const auto* const found = dynamic_cast<const Wanted*>(&object);
            (found ? known : other) = itsClass;
            return found;
        }

    private:
        const void *known = nullptr, *other = nullptr; // virtual tables
    };

    const Vector3r& centreOf(const std::vector<boost::shared_ptr<yade::Body>>& bodies, const yade::Body& body)
    {
        const bool inClump = body.clumpId >= 0 && body.clumpId != body.id;
        const yade::Body* const clump = inClump ? bodies[static_cast<std::size_t>(body.clumpId)].get() : nullptr;
        return (clump ? *clump : body).state->se3.position;
    }

    // The parts of a contact, if it is one that pushes or pulls.
    struct Reader {
        Cast<yade::ScGeom> geometryOf;
        Cast<yade::NormShearPhys> physicsOf;
        Cast<ConicJointPhys> jointOf;
        const yade::ScGeom* geometry = nullptr;
        const yade::NormShearPhys* physics = nullptr;

        bool read(const yade::Interaction& pair)
        {
            if (!pair.hasGeomAndPhys())
                return false;
            geometry = geometryOf(*pair.geom);
            physics = physicsOf(*pair.phys);
            if (!geometry || !physics)
                return false;
            const ConicJointPhys* const joint = geometry->penetrationDepth > 0 ? nullptr : jointOf(*pair.phys);
            return geometry->penetrationDepth > 0 || (joint && joint->bonded);
        }
    };

} // namespace

void sumForceMoments(const yade::Scene& scene, std::vector<Tensor>& sums)
{
    const auto& bodies = scene.bodies->body;
    sums.assign(bodies.size(), Tensor::Zero());
    Reader contact;
    for (std::size_t id = 0; id < bodies.size(); ++id) {
        if (!bodies[id])
            continue;
        const auto& pairs = bodies[id]->intrs;
        // Each pair once, in the order of ids: the container of all pairs has another one after a scene was loaded.
        for (auto at = pairs.upper_bound(static_cast<int>(id)); at != pairs.end(); ++at) {
            const yade::Interaction& pair = *at->second;
            if (!contact.read(pair))
                continue;
            const auto id1 = static_cast<std::size_t>(pair.id1), id2 = static_cast<std::size_t>(pair.id2);
            // YADE keeps the pairs of an erased body until the next step.
            if (id1 >= bodies.size() || id2 >= bodies.size() || !bodies[id1] || !bodies[id2])
                continue;
            const Vector3r force = contact.physics->normalForce + contact.physics->shearForce;
            const Vector3r& point = contact.geometry->contactPoint;
            Vector3r other = centreOf(bodies, *bodies[id2]);
            if (scene.isPeriodic)
                other += scene.cell->hSize * pair.cellDist.cast<double>();
            sums[id1] -= force * (point - centreOf(bodies, *bodies[id1])).transpose();
            sums[id2] += force * (point - other).transpose();
        }
    }
}

double volumeByMass(const yade::Body& body)
{
    const double density = body.material ? body.material->density : 0;
    return density > 0 ? body.state->mass / density : 0;
}

} // namespace potential_particles
