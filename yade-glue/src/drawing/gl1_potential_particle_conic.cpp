// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/definitions.hpp"

#include "abi/window.hpp"

#include "gl1_potential_particle_conic.hpp"
#include "particle/particle_store.hpp"

#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>
#include <boost/python/ptr.hpp>

#include <GL/gl.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <stdexcept>

namespace py = boost::python;

namespace potential_particles {

namespace {

    // OpenGL as the process has it: the plugin must load where there is none, and YADE draws with what its window
    // loads.
    struct OpenGL {
        decltype(&glPushAttrib) pushAttributes;
        decltype(&glPopAttrib) popAttributes;
        decltype(&glDisable) disable;
        decltype(&glPolygonMode) polygonMode;
        decltype(&glColor3dv) colour;
        decltype(&glBegin) begin;
        decltype(&glEnd) end;
        decltype(&glNormal3fv) normal;
        decltype(&glVertex3fv) vertex;

        // Null when it lacks.
        static const OpenGL* ofProcess()
        {
            static const OpenGL found;
            return found.complete ? &found : nullptr;
        }

    private:
        bool complete = true;

        OpenGL()
        {
            find(pushAttributes, "glPushAttrib");
            find(popAttributes, "glPopAttrib");
            find(disable, "glDisable");
            find(polygonMode, "glPolygonMode");
            find(colour, "glColor3dv");
            find(begin, "glBegin");
            find(end, "glEnd");
            find(normal, "glNormal3fv");
            find(vertex, "glVertex3fv");
        }

        template <class Function> void find(Function& function, const char* name)
        {
            function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
            complete = complete && function;
        }
    };

    void draw(const OpenGL& gl, const DrawnMesh& mesh)
    {
        gl.begin(GL_TRIANGLES);
        for (const std::uint32_t i : mesh.triangles) {
            gl.normal(mesh.corners[i].normal.data());
            gl.vertex(mesh.corners[i].point.data());
        }
        gl.end();
    }

} // namespace

Gl1_PotentialParticle_Conic::~Gl1_PotentialParticle_Conic() = default;

PP_FUNCTOR_1D_DEFINITIONS(Gl1_PotentialParticle_Conic)
std::string Gl1_PotentialParticle_Conic::renders() const { return get1DFunctorType1(); }

// Called from the event loop of the window, which no exception may reach.
void Gl1_PotentialParticle_Conic::go(const boost::shared_ptr<yade::Shape>& shape, const boost::shared_ptr<yade::State>&,
                                     bool wire, const yade::GLViewInfo&)
try {
    const OpenGL* const gl = OpenGL::ofProcess();
    if (!gl)
        return;
    // By way of the store, whose lock holds while the lists of the shape are read: scripts may be setting them.
    const auto particle = ParticleStore::instance().find(shape, static_cast<const yade::PotentialParticle&>(*shape));
    const DrawnMesh& mesh = meshOf(particle);
    gl->pushAttributes(GL_CURRENT_BIT | GL_ENABLE_BIT | GL_POLYGON_BIT);
    gl->colour(shape->color.data());
    if (wire) {
        // The far side too: a box of lines is there to be looked into.
        gl->disable(GL_CULL_FACE);
        gl->disable(GL_LIGHTING);
        gl->polygonMode(GL_FRONT_AND_BACK, GL_LINE);
    }
    draw(*gl, mesh);
    gl->popAttributes();
} catch (...) {
    // Out of memory: not drawn this time.
}

const DrawnMesh& Gl1_PotentialParticle_Conic::meshOf(const std::shared_ptr<const Particle>& particle)
{
    const auto found = meshes.find(particle->serial);
    if (found != meshes.end())
        return found->second.mesh;
    if (meshes.size() >= sweepAt) {
        for (auto one = meshes.begin(); one != meshes.end();)
            one = one->second.particle.expired() ? meshes.erase(one) : std::next(one);
        sweepAt = std::max<std::size_t>(64, 2 * meshes.size());
    }
    DrawnMesh made;
    try {
        made = DrawnMesh::of(*particle);
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "potential_particles: a shape is not drawn in the window: %s\n", error.what());
    }
    return meshes.emplace(particle->serial, Kept { particle, std::move(made) }).first->second.mesh;
}

PP_PYTHON_AS_BASE(Gl1_PotentialParticle_Conic, yade::GlShapeFunctor)

namespace {

    // The first word of an object that has virtual functions; its class is known by it.
    const void* virtualTable(const void* object)
    {
        const void* table;
        std::memcpy(&table, object, sizeof table);
        return table;
    }

} // namespace

py::object windowDispatcher(const py::object& renderer)
{
    using yade::GlShapeDispatcher;
    GlShapeDispatcher& part = py::extract<yade::OpenGLRenderer&>(renderer)().shapeDispatcher;
    const py::object example = py::import("yade.wrapper").attr("GlShapeDispatcher")();
    if (virtualTable(&part) != virtualTable(&py::extract<GlShapeDispatcher&>(example)()))
        throw std::runtime_error("no GlShapeDispatcher at its declared place in OpenGLRenderer");
    return py::object(py::ptr(&part));
}

} // namespace potential_particles
