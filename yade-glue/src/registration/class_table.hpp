// SPDX-License-Identifier: GPL-3.0-or-later
//
// The class table at compile time, and what a class of it declares.
#pragma once

#include <stdexcept>
#include <string>

#include <boost/serialization/version.hpp>

namespace potential_particles {

#define PP_CLASS(Name, Base, First, Second, Version, Doc) class Name;
#include "class_table.inc"

// The entry of a class.
template <class Class> struct Entry;

#define PP_ENTRY(Name, Base, First, Second, Doc)                                                                       \
    template <> struct Entry<Name> {                                                                                   \
        static constexpr const char *name = #Name, *base = #Base, *first = First, *second = Second, *doc = Doc;        \
    };

#define PP_CLASS(Name, Base, First, Second, Version, Doc) PP_ENTRY(Name, Base, First, Second, Doc)
#include "class_table.inc"

// Makes YADE's factory know the class. Defined beside each class, by PP_CLASS_DEFINITIONS.
template <class Class> void enterInFactory();

#define PP_CLASS(Name, Base, First, Second, Version, Doc) template <> void enterInFactory<Name>();
#include "class_table.inc"

} // namespace potential_particles

#define PP_CLASS(Name, Base, First, Second, Version, Doc) BOOST_CLASS_VERSION(potential_particles::Name, Version)
#include "class_table.inc"

namespace potential_particles {

// Call first in serialize(): Boost itself passes newer archives on, and they would be misread.
template <class Class> void requireReadable(unsigned version)
{
    constexpr unsigned newest = boost::serialization::version<Class>::value;
    if (version > newest)
        throw std::runtime_error("the file holds " + Class().getClassName() + " of version " + std::to_string(version)
                                 + ", and this potential_particles reads versions up to " + std::to_string(newest)
                                 + ": load it with the newer potential_particles that saved it");
}

} // namespace potential_particles

// In the class; definitions.hpp has the definitions.
#define PP_CLASS_OVERRIDES                                                                                             \
    std::string getBaseClassName(unsigned int index = 0) const override;                                               \
    std::string getClassName() const override;                                                                         \
    void pyRegisterClass(boost::python::object scope) override;

#define PP_FUNCTOR_1D_OVERRIDES                                                                                        \
    PP_CLASS_OVERRIDES                                                                                                 \
    std::string get1DFunctorType1() const override;

#define PP_FUNCTOR_2D_TYPES                                                                                            \
    std::string get2DFunctorType1() const override;                                                                    \
    std::string get2DFunctorType2() const override;                                                                    \
    std::string checkOrder() const override;

#define PP_FUNCTOR_2D_OVERRIDES                                                                                        \
    PP_CLASS_OVERRIDES                                                                                                 \
    PP_FUNCTOR_2D_TYPES
