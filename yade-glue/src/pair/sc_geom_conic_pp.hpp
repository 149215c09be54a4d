// SPDX-License-Identifier: GPL-3.0-or-later
//
// ScGeom that also holds the state that the library keeps of the pair.
#pragma once

#include "abi/archive.hpp"
#include "abi/scgeom.hpp"
#include "kept_apart.hpp"

#include "plugin-common/contact_patch.hpp"

#include <potential_particles.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>

namespace potential_particles {

// It takes no class index of its own: for the dispatchers it is an ScGeom, so every law on ScGeom
// serves it as before. (Its name sorts behind "ScGeom" because dispMatrix() shows, for an index,
// the first class that has it.)
class ScGeomConicPP final : public yade::ScGeom {
public:
    ScGeomConicPP();
    ~ScGeomConicPP() override;
    PP_ABI_SERIALIZABLE_OVERRIDES

private:
    // First: they are looked at in each step, and lie beside what YADE's class ends with.
    std::atomic<bool> saved { false };
    bool heldByBond = false;
    std::unique_ptr<ContactPatch> foundPatch;
    std::unique_ptr<pp_patch_state> keptPatch;

public:
    // Of a facet that left its contact to another one at the last look: which, and where on the seam; not saved.
    struct Left {
        int to = -1; // -1: it did not
        unsigned feature = 0; // of the facet
        double share = 0; // on an edge, from its first vertex
    } left;
    // Not saved: made again by the first look after loading, and after saving.
    KeptApart apart;
    // Saved but for its last contact. Last: in each step a contact reads what stands before, the beginning of `apart`,
    // and this.
    pp_pair_state state {};

    // Of the last look, if the functor has to find it; not saved. Only pairs with a patch take memory for it.
    const ContactPatch& patch() const
    {
        static const ContactPatch none;
        return foundPatch ? *foundPatch : none;
    }
    void setPatch(const ContactPatch& found)
    {
        if (foundPatch)
            *foundPatch = found;
        else
            foundPatch = std::make_unique<ContactPatch>(found);
    }

    // What the library keeps of the patch; not saved.
    pp_patch_state* lastPatch()
    {
        if (!keptPatch)
            keptPatch = std::make_unique<pp_patch_state>();
        return keptPatch.get();
    }

    // At each look, first: drops what is not saved if the pair was saved since the last, so that a run continues after
    // a save like one loaded from it. By the thread that looks, since a script may save from another.
    void dropIfSaved()
    {
        if (!saved.load(std::memory_order_relaxed))
            return;
        saved.store(false, std::memory_order_relaxed);
        forgetUnsaved();
    }

    // Whether a bond holds the pair, so that no functor need find its contact. Not saved: the law says so in each step.
    // The contact after it is a new one, with no memory of those before.
    bool isHeldByBond() const { return heldByBond; }
    void setHeldByBond(bool held)
    {
        if (heldByBond && !held) {
            forgetUnsaved();
            state = {};
        }
        heldByBond = held;
    }

private:
    void forgetUnsaved()
    {
        std::fill(std::begin(state.last_contact), std::end(state.last_contact), 0.0);
        apart.forget();
        left = {};
        keptPatch.reset();
    }

    PP_ARCHIVED

    std::string pyMemory() const;
    void pySetMemory(const std::string& hexadecimal);
};

} // namespace potential_particles
