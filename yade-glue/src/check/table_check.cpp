// SPDX-License-Identifier: GPL-3.0-or-later
#include "load_check.hpp"

#include "bounds/bo1_conic_pp_aabb.hpp"
#include "bounds/bound_watch.hpp"
#include "shape/conic_potential_particle.hpp"
#include "drawing/gl1_potential_particle_conic.hpp"
#include "contact/ig2_conic_pp.hpp"
#include "pair/sc_geom_conic_pp.hpp"

#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <initializer_list>

namespace potential_particles {

namespace py = boost::python;
using namespace yade;

namespace {

    constexpr std::size_t firstVirtual = 2; // behind offset-to-top and type information

    struct Table {
        const void* const* slots;
        std::size_t words; // as the symbol table of its library has it; 0 when not found
    };

    Table tableOf(const void* object)
    {
        const auto* functions = *static_cast<const void* const* const*>(object);
        Dl_info library;
        ElfW(Sym)* symbol = nullptr;
        const bool known = dladdr1(functions, &library, reinterpret_cast<void**>(&symbol), RTLD_DL_SYMENT) && symbol;
        return { functions - firstVirtual, known ? symbol->st_size / sizeof(void*) : 0 };
    }

    // overridden: slots that the derived class fills itself.
    void compareTables(std::vector<std::string>& found, const char* name, const Factorable& derived,
                       const Factorable& base, std::size_t words, std::initializer_list<std::size_t> overridden)
    {
        const Table own = tableOf(&derived), theirs = tableOf(&base);
        if (own.words != words || theirs.words != words) {
            found.push_back(std::string(name) + ": virtual table of " + std::to_string(own.words)
                            + " words, its base's " + std::to_string(theirs.words) + ", expected "
                            + std::to_string(words) + " in both");
            return;
        }
        for (std::size_t slot = firstVirtual; slot < words; ++slot) {
            const bool ours = std::find(overridden.begin(), overridden.end(), slot) != overridden.end();
            const bool equal = own.slots[slot] == theirs.slots[slot];
            if (ours == equal && own.slots[slot] != nullptr)
                found.push_back(std::string(name) + ": slot " + std::to_string(slot) + " of the virtual table is "
                                + (equal ? "the base's, expected ours" : "not the base's"));
        }
    }

    // A functor of ours against one of YADE that overrides the same functions: the sizes must agree.
    template <class Base>
    void compareSizes(std::vector<std::string>& found, const Base& functor, const char* builtinName)
    {
        const py::object builtin = py::import("yade.wrapper").attr(builtinName)();
        const std::size_t ours = tableOf(&functor).words;
        const std::size_t theirs = tableOf(&py::extract<Base&>(builtin)()).words;
        if (ours == 0 || ours != theirs)
            found.push_back(functor.getClassName() + ": virtual table of " + std::to_string(ours) + " words, "
                            + builtinName + " has " + std::to_string(theirs));
    }

} // namespace

void checkTables(std::vector<std::string>& found)
{
    const ConicPotentialParticle shape;
    const PotentialParticle plainShape;
    // What Shape may add stands between Serializable's functions and the index functions.
    constexpr std::size_t more = shapeExtraSlots;
    // 19 and 20 are the second base's offset and type information.
    compareTables(found, "ConicPotentialParticle", shape, plainShape, 28 + more,
                  { 2, 3, 4, 5, 6, 7, 8, 10, 12, 14 + more, 15 + more, 16 + more, 20 + more, 22 + more, 23 + more,
                    24 + more, 25 + more, 26 + more });
    const ScGeomConicPP geom;
    const ScGeom plainGeom;
    compareTables(found, "ScGeomConicPP", geom, plainGeom, 28, { 2, 3, 4, 5, 6, 7, 8, 10, 12, 20, 23, 24 });
    compareSizes<IGeomFunctor>(found, Ig2_ConicPP_ConicPP_ScGeom(), "Ig2_PP_PP_ScGeom");
    compareSizes<BoundFunctor>(found, Bo1_ConicPP_Aabb(), "PotentialParticle2AABB");
    compareSizes<GlShapeFunctor>(found, Gl1_PotentialParticle_Conic(), "Gl1_PotentialParticle");
    const BoundWatch watch;
    const py::object plainEngine = py::import("yade.wrapper").attr("GlobalEngine")();
    compareTables(found, "BoundWatch", watch, py::extract<GlobalEngine&>(plainEngine)(), 16, { 2, 3, 4, 6, 12, 15 });
}

} // namespace potential_particles
