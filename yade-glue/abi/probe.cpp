// SPDX-License-Identifier: GPL-3.0-or-later
//
// Raw material for check_abi.py: for each class of the headers with a PP_ABI_SIZE its size, and a class derived from it
// whose virtual table the compiler writes from our declaration. Compiled and examined, never run.

// The destructor, defined here, is what makes the compiler write the table into this file.
#define PP_ABI_PROBE(Class)                                                                                            \
    namespace abi_probe {                                                                                              \
    struct Class : yade::Class {                                                                                       \
        ~Class() override;                                                                                             \
    };                                                                                                                 \
    Class::~Class() = default;                                                                                         \
    }                                                                                                                  \
    extern "C" {                                                                                                       \
    extern __attribute__((visibility("default"))) const unsigned long abi_size_##Class;                                \
    const unsigned long abi_size_##Class = sizeof(yade::Class);                                                        \
    }

#include "body.hpp"
#include "bound.hpp"
#include "engine.hpp"
#include "functor.hpp"
#include "interaction.hpp"
#include "interaction_container.hpp"
#include "knksphys.hpp"
#include "laws.hpp"
#include "material.hpp"
#include "primitives.hpp"
#include "scene.hpp"
#include "scgeom.hpp"
#include "serializable.hpp"
#include "shape.hpp"
#include "state.hpp"
#include "window.hpp"
