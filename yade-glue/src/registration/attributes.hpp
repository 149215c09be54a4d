// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain attributes of a class in Python and in archives, from one list: the class has
//     template <class Visit> static void eachAttribute(Visit&& visit); // visit(name, member, docstring) for each
// and visit(name, member, docstring, since) for one that archives have from that version of the class on.
#pragma once

#include "definitions.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace potential_particles {

inline std::string text(double value) { return (std::ostringstream() << value).str(); }

// Non-finite numbers of an attribute; an empty text if all are finite. From scripts and files: they would reach
// positions of bodies.
inline std::string notFinite(double value) { return std::isfinite(value) ? "" : text(value); }
inline std::string notFinite(const yade::Vector3r& value)
{
    return value.allFinite() ? "" : (std::ostringstream() << "(" << value.transpose() << ")").str();
}
inline std::string notFinite(const yade::Quaternionr& value)
{
    return value.coeffs().allFinite() ? "" : (std::ostringstream() << "(" << value.coeffs().transpose() << ")").str();
}
inline std::string notFinite(const std::vector<double>& values)
{
    const auto found = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
    return found == values.end() ? "" : notFinite(*found);
}
template <class Other> std::string notFinite(const Other&) { return ""; }

template <class Class, class Value> void requireFinite(const char* name, const Value& value)
{
    const std::string found = notFinite(value);
    if (!found.empty())
        throw std::invalid_argument(std::string(Entry<Class>::name) + ": " + name + " = " + found
                                    + ": it must be finite");
}

// False when the class has no attribute of that name.
template <class Class> bool setAttribute(Class& object, const std::string& key, const py::object& value)
{
    bool own = false;
    Class::eachAttribute([&](const char* name, auto member, const char*, unsigned = 0) {
        if (key != name)
            return;
        using Value = typename Pointed<decltype(member)>::type;
        const Value given = py::extract<Value>(value)();
        requireFinite<Class>(name, given);
        object.*member = given;
        own = true;
    });
    return own;
}

template <class Class> py::dict dictOfAttributes(const Class& object)
{
    py::dict attributes;
    Class::eachAttribute([&](const char* name, auto member, const char*, unsigned = 0) {
        attributes[name] = py::object(object.*member);
    });
    return attributes;
}

template <class Class, class Registered> void addAttributes(Registered& registered)
{
    Class::eachAttribute([&](const char* name, auto member, const char* text, unsigned = 0) {
        using Value = typename Pointed<decltype(member)>::type;
        registered.add_property(
            name, pythonFunction<Value, const Class&>([member](const Class& object) { return object.*member; }),
            pythonFunction<void, Class&, const Value&>([member, name](Class& object, const Value& value) {
                requireFinite<Class>(name, value);
                object.*member = value;
                object.callPostLoad();
            }),
            text);
    });
}

// `version`: of the class in this archive.
template <class Class, class Archive> void archiveAttributes(Archive& archive, Class& object, unsigned version)
{
    Class::eachAttribute([&](const char* name, auto member, const char*, unsigned since = 0) {
        if (version < since)
            return;
        archiveAttribute(archive, name, object.*member);
        if (Archive::is_loading::value)
            requireFinite<Class>(name, object.*member);
    });
}

} // namespace potential_particles

// What a class with such a list overrides. Base: of YADE.
#define PP_ATTRIBUTE_DEFINITIONS(Class, Base)                                                                          \
    int Class::getBaseClassNumber() const { return 1; }                                                                \
    void Class::pySetAttr(const std::string& key, const py::object& value)                                             \
    {                                                                                                                  \
        if (!setAttribute(*this, key, value))                                                                          \
            yade::Base::pySetAttr(key, value);                                                                         \
    }                                                                                                                  \
    py::dict Class::pyDict() const                                                                                     \
    {                                                                                                                  \
        py::dict attributes = dictOfAttributes(*this);                                                                 \
        attributes.update(pyDictCustom());                                                                             \
        attributes.update(yade::Base::pyDict());                                                                       \
        return attributes;                                                                                             \
    }                                                                                                                  \
    void Class::pyRegisterClass(py::object scope)                                                                      \
    {                                                                                                                  \
        checkPyClassRegistersItself(Entry<Class>::name);                                                               \
        const py::scope inside(scope);                                                                                 \
        const auto style = docstringStyle();                                                                           \
        auto registered = registerClass<Class, yade::Base>();                                                          \
        addAttributes<Class>(registered);                                                                              \
    }                                                                                                                  \
    template <class Archive> void Class::serialize(Archive& archive, unsigned version)                                 \
    {                                                                                                                  \
        requireReadable<Class>(version);                                                                               \
        serializeBase<yade::Base>(archive, *this, #Base);                                                              \
        archiveAttributes(archive, *this, version);                                                                    \
        if (Archive::is_loading::value)                                                                                \
            callPostLoad();                                                                                            \
    }
