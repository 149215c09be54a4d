// SPDX-License-Identifier: GPL-3.0-or-later
//
// For the .cpp of a class: what its entry in the class table says of it, as definitions. At the end of the file stands
// BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Class), if scenes hold it.
#pragma once

// Boost exports a class for those archives that were included before BOOST_CLASS_EXPORT: here the four that YADE saves
// to and loads from.
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>
#include <boost/serialization/export.hpp>

#include "abi/registry.hpp"
#include "class_table.hpp"
#include "python_class.hpp"

#include <boost/serialization/base_object.hpp>
#include <boost/serialization/string.hpp>

// Names in archives, known wherever a class or the part of it in one derived from it is archived.
#define PP_CLASS(Name, Base, First, Second, Version, Doc) BOOST_CLASS_EXPORT_KEY(potential_particles::Name)
#include "class_table.inc"

namespace potential_particles {

// Throws std::runtime_error when the name is taken.
template <class Class> void registerWithFactory()
{
    using yade::Factorable;
    const bool added = Singleton<yade::ClassFactory>::instance().registerFactorable(
        Entry<Class>::name, []() -> Factorable* { return new Class; },
        []() -> boost::shared_ptr<Factorable> { return boost::shared_ptr<Class>(new Class); },
        []() -> void* { return new Class; });
    if (!added)
        throw std::runtime_error(std::string("YADE already has a class ") + Entry<Class>::name
                                 + ": is potential_particles loaded from two places?");
}

template <class Class> void takeClassIndex(Class& object)
{
    int& index = object.modifyClassIndex();
    if (index == -1) {
        index = object.getMaxCurrentlyUsedClassIndexOfKin() + 1;
        object.incrementMaxCurrentlyUsedClassIndexOfKin();
    }
}

// Begin of pyRegisterClass(); properties are added to the result.
template <class Class, class Base> PythonClass<Class, Base> registerClass()
{
    return registerClass<Class, Base>(Entry<Class>::name, Entry<Class>::doc);
}

} // namespace potential_particles

#define PP_CLASS_DEFINITIONS(Class)                                                                                    \
    std::string Class::getClassName() const { return Entry<Class>::name; }                                             \
    std::string Class::getBaseClassName(unsigned int index) const { return index == 0 ? Entry<Class>::base : ""; }     \
    template <> void enterInFactory<Class>() { registerWithFactory<Class>(); }

// Of a class that YADE's dispatchers know by an index of its own: its constructor calls takeClassIndex. An instance of
// the base, because that is what knows the index; kept, because the index is a reference.
#define PP_INDEX_DEFINITIONS(Class, Base)                                                                              \
    int& Class::modifyClassIndex()                                                                                     \
    {                                                                                                                  \
        static int index = -1;                                                                                         \
        return index;                                                                                                  \
    }                                                                                                                  \
    const int& Class::getClassIndex() const { return const_cast<Class*>(this)->modifyClassIndex(); }                   \
    const int& Class::getBaseClassIndex(int depth) const                                                               \
    {                                                                                                                  \
        static const Base& base = *new Base;                                                                           \
        return depth == 1 ? base.getClassIndex() : base.getBaseClassIndex(depth - 1);                                  \
    }

#define PP_FUNCTOR_1D_DEFINITIONS(Class)                                                                               \
    PP_CLASS_DEFINITIONS(Class)                                                                                        \
    std::string Class::get1DFunctorType1() const { return Entry<Class>::first; }

#define PP_FUNCTOR_2D_DEFINITIONS(Class)                                                                               \
    PP_CLASS_DEFINITIONS(Class)                                                                                        \
    std::string Class::get2DFunctorType1() const { return Entry<Class>::first; }                                       \
    std::string Class::get2DFunctorType2() const { return Entry<Class>::second; }                                      \
    std::string Class::checkOrder() const { return get2DFunctorType1() + " " + get2DFunctorType2(); }

// Of a class without attributes beyond its base's.
#define PP_PYTHON_AS_BASE(Class, Base)                                                                                 \
    void Class::pyRegisterClass(py::object scope)                                                                      \
    {                                                                                                                  \
        checkPyClassRegistersItself(Entry<Class>::name);                                                               \
        const py::scope inside(scope);                                                                                 \
        const auto style = docstringStyle();                                                                           \
        registerClass<Class, Base>();                                                                                  \
    }

// The same in archives, for a base that is ours: Boost's own way works then.
#define PP_ARCHIVE_AS_BASE(Class, Base)                                                                                \
    template <class Archive> void Class::serialize(Archive& archive, unsigned version)                                 \
    {                                                                                                                  \
        requireReadable<Class>(version);                                                                               \
        archive& BOOST_SERIALIZATION_BASE_OBJECT_NVP(Base);                                                            \
    }
