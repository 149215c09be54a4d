// SPDX-License-Identifier: GPL-2.0-or-later
//
// A fix whose atoms carry what their contacts remember, rows of different lengths, as they migrate and restart.
#pragma once

#include "atom.h"
#include "comm.h"
#include "fix.h"

#include <algorithm>
#include <cstdio>

namespace potential_particles {

class CarryingFix : public LAMMPS_NS::Fix {
public:
    using Fix::Fix;

    int pack_exchange(int i, double* buffer) override { return pack(i, buffer); }
    int unpack_exchange(int i, double* buffer) override { return unpack(i, buffer); }
    // In a file the row has its length before it.
    int pack_restart(int i, double* buffer) override
    {
        const int size = 1 + pack(i, buffer + 1);
        buffer[0] = size;
        return size;
    }
    void unpack_restart(int i, int nth) override
    {
        const double* extra = atom->extra[i];
        for (int n = 0; n < nth; ++n)
            extra += static_cast<int>(extra[0]);
        unpack(i, extra + 1);
    }
    int size_restart(int i) override { return 1 + sizeOf(i); }
    int maxsize_restart() override
    {
        int most = 1 + withoutContacts;
        for (int i = 0; i < atom->nlocal; ++i)
            most = std::max(most, size_restart(i));
        return most;
    }

protected:
    // What a restart file has of the fix as a whole.
    template <class Saved> void writeSaved(FILE* file, const Saved& all) const
    {
        const int size = sizeof all;
        if (comm->me == 0) {
            fwrite(&size, sizeof size, 1, file);
            fwrite(&all, sizeof all, 1, file);
        }
    }

    // Numbers of an atom before those of its contacts: how many contacts, and its ID or the mark of its shape.
    static constexpr int withoutContacts = 2;
    virtual int sizeOf(int i) const = 0; // of all that pack() writes
    virtual int pack(int i, double* buffer) const = 0;
    virtual int unpack(int i, const double* buffer) = 0;
};

} // namespace potential_particles
