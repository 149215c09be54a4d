// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers for numpy, which reads bytes.
#pragma once

#include <boost/python/handle.hpp>
#include <boost/python/object.hpp>

#include <vector>

namespace potential_particles {

template <class Value> boost::python::object bytes(const std::vector<Value>& values)
{
    const auto size = static_cast<Py_ssize_t>(values.size() * sizeof(Value));
    return boost::python::object(
        boost::python::handle<>(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(values.data()), size)));
}

} // namespace potential_particles
