// SPDX-License-Identifier: GPL-3.0-or-later
//
// ScGeom that also holds what the library remembers about the pair.
#pragma once

#include "../abi/archive.hpp"
#include "../abi/scgeom.hpp"
#include "kept_apart.hpp"
#include "kept_off.hpp"

#include <boost/serialization/access.hpp>

#include <potential_particles.h>

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

    pp_memory memory = { { 0 } };
    // Not saved: made again by the first look after loading.
    KeptApart apart;
    // Of a pair that touches; nor is this.
    std::unique_ptr<pp_carry> carry;
    // Of a particle and a flat boundary, which use none of the above; nor is this.
    std::unique_ptr<KeptOff> off;

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);

    std::string pyMemory() const;
    void pySetMemory(const std::string& hexadecimal);
};

} // namespace potential_particles
