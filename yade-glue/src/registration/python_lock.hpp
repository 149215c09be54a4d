// SPDX-License-Identifier: GPL-3.0-or-later
//
// Python's lock, and what Python raised.
#pragma once

#include <boost/python/handle.hpp>

#include <string>

namespace potential_particles {

// For threads that may not hold it: those that step, or load an archive.
struct PythonLock {
    const PyGILState_STATE state = PyGILState_Ensure();
    ~PythonLock() { PyGILState_Release(state); }
};

struct PythonError {
    std::string kind, message;
};

// The error that is set, which is cleared; with the lock.
inline PythonError takePythonError()
{
    namespace py = boost::python;
    PyObject *kind = nullptr, *value = nullptr, *trace = nullptr;
    PyErr_Fetch(&kind, &value, &trace);
    PyErr_NormalizeException(&kind, &value, &trace);
    const py::handle<> itsKind(py::allow_null(kind)), itsValue(py::allow_null(value)), itsTrace(py::allow_null(trace));
    const auto words = [](PyObject* made) {
        const py::handle<> held(py::allow_null(made));
        const char* const found = held ? PyUnicode_AsUTF8(held.get()) : nullptr;
        return std::string(found ? found : "unknown Python error");
    };
    PythonError error { words(kind ? PyObject_GetAttrString(kind, "__name__") : nullptr),
                        words(value ? PyObject_Str(value) : nullptr) };
    PyErr_Clear();
    return error;
}

} // namespace potential_particles
