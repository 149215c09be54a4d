// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers for numpy, which reads and writes bytes.
#pragma once

#include <boost/python/errors.hpp>
#include <boost/python/handle.hpp>
#include <boost/python/object.hpp>

#include <cstring>
#include <stdexcept>
#include <vector>

namespace potential_particles {

template <class Value> boost::python::object bytes(const std::vector<Value>& values)
{
    const auto size = static_cast<Py_ssize_t>(values.size() * sizeof(Value));
    return boost::python::object(
        boost::python::handle<>(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(values.data()), size)));
}

// Rows that numpy wrote.
template <class Row> std::vector<Row> rowsOf(const boost::python::object& bytes)
{
    char* data = nullptr;
    Py_ssize_t size = 0;
    if (PyBytes_AsStringAndSize(bytes.ptr(), &data, &size) != 0)
        boost::python::throw_error_already_set();
    if (size % static_cast<Py_ssize_t>(sizeof(Row)) != 0)
        throw std::invalid_argument("an array has another length than its rows");
    std::vector<Row> rows(static_cast<std::size_t>(size) / sizeof(Row));
    if (size > 0)
        std::memcpy(rows.data(), data, static_cast<std::size_t>(size));
    return rows;
}

} // namespace potential_particles
