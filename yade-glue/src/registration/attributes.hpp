// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain attributes of a class in Python and in archives, from one list: the class has
//     template <class Visit> static void eachAttribute(Visit&& visit); // visit(name, member, docstring) for each
#pragma once

#include "definitions.hpp"

namespace potential_particles {

// False when the class has no attribute of that name.
template <class Class> bool setAttribute(Class& object, const std::string& key, const py::object& value)
{
    bool own = false;
    Class::eachAttribute([&](const char* name, auto member, const char*) {
        if (key != name)
            return;
        object.*member = py::extract<typename Pointed<decltype(member)>::type>(value)();
        own = true;
    });
    return own;
}

template <class Class> py::dict dictOfAttributes(const Class& object)
{
    py::dict attributes;
    Class::eachAttribute([&](const char* name, auto member, const char*) { attributes[name] = py::object(object.*member); });
    return attributes;
}

template <class Class, class Registered> void addAttributes(Registered& registered)
{
    Class::eachAttribute([&](const char* name, auto member, const char* text) {
        using Value = typename Pointed<decltype(member)>::type;
        registered.add_property(
            name, pythonFunction<Value, const Class&>([member](const Class& object) { return object.*member; }),
            pythonFunction<void, Class&, const Value&>([member](Class& object, const Value& value) {
                object.*member = value;
                object.callPostLoad();
            }),
            text);
    });
}

template <class Class, class Archive> void archiveAttributes(Archive& archive, Class& object)
{
    Class::eachAttribute([&](const char* name, auto member, const char*) { archiveAttribute(archive, name, object.*member); });
}

} // namespace potential_particles

// What a class with such a list overrides. Base: of YADE.
#define PP_ATTRIBUTE_DEFINITIONS(Class, Base)                                                      \
    int Class::getBaseClassNumber() const { return 1; }                                            \
    void Class::pySetAttr(const std::string& key, const py::object& value)                         \
    {                                                                                              \
        if (!setAttribute(*this, key, value))                                                      \
            yade::Base::pySetAttr(key, value);                                                     \
    }                                                                                              \
    py::dict Class::pyDict() const                                                                 \
    {                                                                                              \
        py::dict attributes = dictOfAttributes(*this);                                             \
        attributes.update(pyDictCustom());                                                         \
        attributes.update(yade::Base::pyDict());                                                   \
        return attributes;                                                                         \
    }                                                                                              \
    void Class::pyRegisterClass(py::object scope)                                                  \
    {                                                                                              \
        checkPyClassRegistersItself(Entry<Class>::name);                                           \
        const py::scope inside(scope);                                                             \
        const auto style = docstringStyle();                                                       \
        auto registered = registerClass<Class, yade::Base>();                                      \
        addAttributes<Class>(registered);                                                          \
    }                                                                                              \
    template <class Archive> void Class::serialize(Archive& archive, unsigned version)             \
    {                                                                                              \
        requireReadable<Class>(version);                                                           \
        serializeBase<yade::Base>(archive, *this, #Base);                                          \
        archiveAttributes(archive, *this);                                                         \
    }
