// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain attributes of a class in Python and in archives, from one list: the class has
//     template <class Visit> static void eachAttribute(Visit&& visit); // visit(name, member, docstring) for each
// and visit(name, member, docstring, since) for one that archives have from that version of the class on.
#pragma once

#include "definitions.hpp"

namespace potential_particles {

// False when the class has no attribute of that name.
template <class Class> bool setAttribute(Class& object, const std::string& key, const py::object& value)
{
    bool own = false;
    Class::eachAttribute([&](const char* name, auto member, const char*, unsigned = 0) {
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
    Class::eachAttribute([&](const char* name, auto member, const char*, unsigned = 0) { attributes[name] = py::object(object.*member); });
    return attributes;
}

template <class Class, class Registered> void addAttributes(Registered& registered)
{
    Class::eachAttribute([&](const char* name, auto member, const char* text, unsigned = 0) {
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

// `version`: of the class in this archive.
template <class Class, class Archive> void archiveAttributes(Archive& archive, Class& object, unsigned version)
{
    Class::eachAttribute([&](const char* name, auto member, const char*, unsigned since = 0) {
        if (version >= since)
            archiveAttribute(archive, name, object.*member);
    });
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
        archiveAttributes(archive, *this, version);                                                \
    }
