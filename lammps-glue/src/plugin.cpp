// SPDX-License-Identifier: GPL-2.0-or-later
//
// Entry of the plugin: `plugin load potential_particles_plugin.so` calls lammpsplugin_init.
#include "contact_memory.hpp"
#include "fix_nve.hpp"
#include "fix_shapes.hpp"
#include "fix_wall.hpp"
#include "pair_potential_particle.hpp"
#include "abi/plugin.hpp"

#include "error.h"
#include "exceptions.h"
#include "lammps.h"
#include "update.h"

#include <potential_particles.h>

using namespace potential_particles;

namespace {

template <class Style> void* makePair(void* lammps) { return new Style(static_cast<LAMMPS_NS::LAMMPS*>(lammps)); }

template <class Style> void* makeFix(void* lammps, int count, char** arguments)
{
    auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps);
    // Between runs: what is new, or knows what is gone, is made ready even where the next run says 'pre no'.
    if (!lmp->update->whichflag)
        lmp->update->first_update = 0;
    try {
        return new Style(lmp, count, arguments);
    } catch (const LAMMPS_NS::LAMMPSException&) {
        throw;
    } catch (const std::exception&) { // of one rank alone, maybe
        lmp->error->one(FLERR, "fix {} {}: there is no memory for what it shall read: give smaller files", arguments[0],
                        arguments[2]);
    }
}

} // namespace

extern "C" void lammpsplugin_init(void* lammps, void* handle, void* registerPlugin)
{
    auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps);
    if (pp_abi_version() != PP_ABI_VERSION)
        lmp->error->all(
            FLERR,
            "potential particles: the library has interface {}, the plugin was built for {}: build the plugin anew",
            pp_abi_version(), PP_ABI_VERSION);
    const auto enter = reinterpret_cast<RegisterPlugin*>(registerPlugin);

    PluginEntry pair {
        lmp->version, "pair", "potential/particle", "contacts of potential particles", "potential-particles", {}, handle
    };
    pair.creator.without = &makePair<PairPotentialParticle>;
    enter(&pair, lammps);

    const auto enterFix = [&](const char* name, const char* info, StyleWithArguments* creator) {
        PluginEntry fix { lmp->version, "fix", name, info, "potential-particles", {}, handle };
        fix.creator.withArguments = creator;
        enter(&fix, lammps);
    };
    enterFix("potential/particle/shapes", "shapes and orientations of potential particles", &makeFix<FixShapes>);
    enterFix("nve/potential/particle", "motion of potential particles", &makeFix<FixNve>);
    enterFix("wall/potential/particle", "planes and meshes that potential particles touch", &makeFix<FixWall>);
    enterFix("potential/particle/memory", "what contacts remember; made by the pair style", &makeFix<ContactMemory>);
}
