// SPDX-License-Identifier: GPL-3.0-or-later
//
// A class that stands in a module of one's own, outside of the plugin: its entry, as those of class_table.inc, and the
// module. examples/own_law shows both.
#pragma once

#include "abi/archive.hpp"
#include "abi/functor.hpp"
#include "attributes.hpp"

#include <boost/python/import.hpp>
#include <boost/python/module.hpp>

// In the global namespace, before the class is declared in namespace potential_particles; the arguments are those of
// PP_CLASS. What serialize() writes may change with the version alone.
#define PP_OWN_CLASS(Name, Base, First, Second, Version, Doc)                                                          \
    namespace potential_particles {                                                                                    \
    class Name;                                                                                                        \
    PP_ENTRY(Name, Base, First, Second, Doc)                                                                           \
    template <> void enterInFactory<Name>();                                                                           \
    }                                                                                                                  \
    BOOST_CLASS_VERSION(potential_particles::Name, Version)                                                            \
    BOOST_CLASS_EXPORT_KEY(potential_particles::Name)

// At the end of the file, in the global namespace: `from module import Name` enters the class into YADE, once the
// plugin has compared this YADE with what is declared in abi/.
#define PP_OWN_MODULE(module, Name)                                                                                    \
    BOOST_CLASS_EXPORT_IMPLEMENT(potential_particles::Name)                                                            \
    BOOST_PYTHON_MODULE(module)                                                                                        \
    {                                                                                                                  \
        boost::python::import("potential_particles.yade");                                                             \
        potential_particles::enterInFactory<potential_particles::Name>();                                              \
        Singleton<yade::Omega>::instance().buildDynlibDatabase({ #Name });                                             \
        boost::python::scope().attr(#Name) = boost::python::import("yade.wrapper").attr(#Name);                        \
    }
