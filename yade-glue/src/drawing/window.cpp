// SPDX-License-Identifier: GPL-3.0-or-later
#include "abi/window.hpp"

#include "window.hpp"

#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>
#include <boost/python/ptr.hpp>

#include <cstring>
#include <stdexcept>

namespace py = boost::python;

namespace potential_particles {

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
