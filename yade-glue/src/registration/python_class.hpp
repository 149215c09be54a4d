// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a class needs to stand beside YADE's own in Python: keyword constructor, docstring style, archived vectors.
// (The contact functors list their attributes in ContactSettings::eachAttribute; see ig2_conic_pp_python.cpp.)
#pragma once

#include "abi/serializable.hpp"

#include <boost/mpl/vector.hpp>
#include <boost/python/class.hpp>
#include <boost/python/docstring_options.hpp>
#include <boost/python/extract.hpp>
#include <boost/python/make_constructor.hpp>
#include <boost/python/make_function.hpp>
#include <boost/python/raw_function.hpp>
#include <boost/python/scope.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/vector.hpp>
#include <boost/shared_ptr.hpp>

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace potential_particles {

namespace py = boost::python;

template <class Class, class Base>
using PythonClass = py::class_<Class, boost::shared_ptr<Class>, py::bases<Base>, boost::noncopyable>;

template <class Class> boost::shared_ptr<Class> makeFromKeywords(py::tuple& args, py::dict& keywords)
{
    const boost::shared_ptr<Class> instance(new Class);
    instance->pyHandleCustomCtorArgs(args, keywords);
    if (py::len(args) > 0)
        throw std::runtime_error(instance->getClassName() + " takes keyword arguments only; "
                                 + std::to_string(py::len(args)) + " without keyword given");
    // Also without keywords: callPostLoad() is what makes the object ready.
    instance->pyUpdateAttrs(keywords);
    if (py::len(keywords) == 0)
        instance->callPostLoad();
    return instance;
}

template <class Class> py::object initFromKeywords(py::tuple args, py::dict keywords)
{
    // Never destroyed: Python may be gone when statics are.
    static const py::object& init = *new py::object(py::make_constructor(&makeFromKeywords<Class>));
    return init(py::object(args[0]), py::tuple(args.slice(1, py::_)), keywords);
}

// Begin of pyRegisterClass(); properties are added to the result.
template <class Class, class Base> PythonClass<Class, Base> registerClass(const char* name, const char* doc)
{
    PythonClass<Class, Base> registered(name, doc, py::no_init);
    registered.def("__init__", py::raw_function(&initFromKeywords<Class>, 1));
    return registered;
}

// Our own text in docstrings, without the C++ signatures that Boost would add.
inline py::docstring_options docstringStyle() { return py::docstring_options(true, false, false); }

// A function object as a Python function: pythonFunction<result, self, ...>(object).
template <class... Signature, class Function> py::object pythonFunction(Function function)
{
    return py::make_function(function, py::default_call_policies(), boost::mpl::vector<Signature...>());
}

// The type of the member that a member pointer points to.
template <class Pointer> struct Pointed;
template <class Class, class Value> struct Pointed<Value Class::*> {
    using type = Value;
};

// Boost archives know no Eigen vector, and a definition here could contradict that of YADE for the same type: its three
// numbers are written instead.
template <class Archive> void archiveAttribute(Archive& archive, const char* name, yade::Vector3r& value)
{
    const std::string base(name);
    for (int i = 0; i < 3; ++i) {
        const std::string element = base + "_" + "xyz"[i];
        archive& boost::serialization::make_nvp(element.c_str(), value[i]);
    }
}

template <class Archive> void archiveAttribute(Archive& archive, const char* name, yade::Quaternionr& value)
{
    const std::string base(name);
    for (int i = 0; i < 4; ++i) {
        const std::string element = base + "_" + "xyzw"[i];
        archive& boost::serialization::make_nvp(element.c_str(), value.coeffs()[i]);
    }
}

template <class Archive, class Value> void archiveAttribute(Archive& archive, const char* name, Value& value)
{
    archive& boost::serialization::make_nvp(name, value);
}

} // namespace potential_particles
