// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way into YADE's 3-D window.
#pragma once

#include <boost/python/object.hpp>

namespace potential_particles {

// The dispatcher by which a renderer (yade.qt.Renderer()) draws shapes, as a Python object of YADE's class
// GlShapeDispatcher. It is a part of the renderer, which must live longer; YADE's own lives as long as the process.
// YADE gives no access to it, so that it is looked for at its declared place: an object of that very class must lie
// there, or this throws std::runtime_error.
boost::python::object windowDispatcher(const boost::python::object& renderer);

} // namespace potential_particles
