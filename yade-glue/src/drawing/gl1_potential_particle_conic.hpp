// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functor that draws potential particles in YADE's 3-D window, and the way into that window.
#pragma once

#include "abi/window.hpp"

#include "surface_mesh.hpp"
#include "registration/class_table.hpp"

#include <boost/python/object.hpp>

#include <memory>
#include <unordered_map>

namespace potential_particles {

// For every PotentialParticle, plain ones too: YADE's own functor keeps what it draws by the number of the body and of
// the shape, and reads past its lists in scenes that hold other bodies.
class Gl1_PotentialParticle_Conic final : public yade::GlShapeFunctor {
public:
    ~Gl1_PotentialParticle_Conic() override;
    PP_FUNCTOR_1D_OVERRIDES
    std::string renders() const override;

    // Only the window's own thread draws.
    void go(const boost::shared_ptr<yade::Shape>& shape, const boost::shared_ptr<yade::State>& state, bool wire,
            const yade::GLViewInfo& view) override;

private:
    struct Kept {
        std::weak_ptr<const Particle> particle;
        DrawnMesh mesh; // empty without a mesh, which has been reported
    };
    const DrawnMesh& meshOf(const std::shared_ptr<const Particle>& particle);

    std::unordered_map<std::uint64_t, Kept> meshes; // by Particle::serial
    std::size_t sweepAt = 64; // at this number, meshes of particles that are gone are dropped
};

// The dispatcher by which a renderer (yade.qt.Renderer()) draws shapes, as a Python object of YADE's class
// GlShapeDispatcher. It is a part of the renderer, which must live longer; YADE's own lives as long as the process.
// YADE gives no access to it, so that it is looked for at its declared place: an object of that very class must lie
// there, or this throws std::runtime_error.
boost::python::object windowDispatcher(const boost::python::object& renderer);

} // namespace potential_particles
