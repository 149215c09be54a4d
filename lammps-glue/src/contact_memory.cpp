// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_memory.hpp"
#include "entered.hpp"
#include "mark.hpp"
#include "pair_potential_particle.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <unordered_map>
#include <utility>

using namespace LAMMPS_NS;

namespace potential_particles {

ContactMemory::ContactMemory(LAMMPS* lmp, int count, char** arguments)
    : CarryingFix(lmp, count, arguments)
{
    restart_peratom = 1;
    restart_global = 1; // so that write_restart is called before atoms are packed
    create_attribute = 1;
    maxexchange_dynamic = 1;
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
}

ContactMemory::~ContactMemory()
{
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
}

int ContactMemory::setmask()
{
    using namespace FixConst;
    return PRE_EXCHANGE | POST_NEIGHBOR | POST_RUN;
}

// Where the atoms are that were local when the list was built; -1: deleted. A fix that deletes atoms moves others into
// their place.
std::vector<int> ContactMemory::placesNow(int local) const
{
    std::vector<int> places(local);
    std::unordered_map<tagint, int> byId;
    for (int i = 0; i < local; ++i) {
        places[i] = i;
        if (i < atom->nlocal && atom->tag[i] == pair->tagAtBuild(i))
            continue;
        if (byId.empty())
            for (int k = 0; k < atom->nlocal; ++k)
                byId[atom->tag[k]] = k;
        const auto found = byId.find(pair->tagAtBuild(i));
        places[i] = found == byId.end() ? -1 : found->second;
    }
    return places;
}

void ContactMemory::collect()
{
    if (!pair || !listIsNewer)
        return;
    listIsNewer = false;
    values.clear();
    std::fill(ranges.begin(), ranges.end(), Range {});
    const int slots = pair->slotCount(), local = pair->localAtBuild();
    const std::vector<int> places = placesNow(local);
    const auto forEachLocal = [&](int slot, auto&& doWith) {
        const auto [a, b] = pair->bodiesOf(slot);
        if (a < local && places[a] >= 0)
            doWith(places[a], b);
        if (b < local && places[b] >= 0)
            doWith(places[b], a);
    };
    for (int slot = 0; slot < slots; ++slot)
        forEachLocal(slot, [&](int i, int) { ++ranges[i].count; });
    int sum = 0;
    for (Range& range : ranges) {
        range.first = sum;
        sum += range.count;
        range.count = 0;
    }
    partners.resize(sum);
    for (int slot = 0; slot < slots; ++slot)
        forEachLocal(slot, [&](int i, int j) {
            partners[ranges[i].first + ranges[i].count++] = { pair->tagAtBuild(j), slot, pair->markAtBuild(slot) };
        });
    maxexchange = withoutContacts;
    for (int i = 0; i < atom->nlocal; ++i) {
        ranges[i].own = atom->tag[i];
        maxexchange = std::max(maxexchange, sizeOf(i));
    }
}

void ContactMemory::setup_pre_exchange()
{
    forgetThoseBefore();
    checkIds();
}

// A new atom may have the ID of a deleted one: what contacts remember belongs to the latter.
void ContactMemory::forgetThoseBefore()
{
    const int own = !partners.empty();
    int any = 0;
    MPI_Allreduce(&own, &any, 1, MPI_INT, MPI_MAX, world);
    if (!any)
        return;
    std::vector<tagint> mine, all;
    for (int i = 0; i < atom->nlocal; ++i)
        if (!ranges[i].own)
            mine.push_back(atom->tag[i]);
    const int count = static_cast<int>(mine.size());
    std::vector<int> counts(comm->nprocs), offsets(comm->nprocs, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
    all.resize(offsets.back() + counts.back());
    MPI_Allgatherv(mine.data(), count, MPI_LMP_TAGINT, all.data(), counts.data(), offsets.data(), MPI_LMP_TAGINT,
                   world);
    std::sort(all.begin(), all.end());
    for (int i = 0; i < atom->nlocal; ++i) {
        const auto first = partners.begin() + ranges[i].first;
        const auto isNew
            = [&](const Partner& partner) { return std::binary_search(all.begin(), all.end(), partner.other); };
        ranges[i].count = static_cast<int>(std::remove_if(first, first + ranges[i].count, isNew) - first);
    }
}

// Partners are known by their IDs.
void ContactMemory::checkIds() const
{
    std::string why;
    for (int i = 0; pair && i < atom->nlocal && why.empty(); ++i)
        if (ranges[i].own && ranges[i].own != atom->tag[i] && sizeOf(i) > withoutContacts)
            why = fmt::format("pair_style potential/particle: the atom of ID {} has the ID {} now, and contacts know "
                              "their bodies by IDs: give 'compress no' to delete_atoms, and "
                              "leave out 'reset_atoms id'",
                              ranges[i].own, atom->tag[i]);
    endWhereAny(lmp, why);
}

bool ContactMemory::lasts(const Partner& partner) const { return partner.where < 0 || pair->lasts(partner.where); }

int ContactMemory::countOf(const Partner& partner) const
{
    return partner.where >= 0 ? pair->valueCount(partner.where) : arrived(partner.where).count;
}

int ContactMemory::sizeOf(int i) const
{
    int size = withoutContacts;
    for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n)
        if (lasts(partners[n]))
            size += ofPartner + countOf(partners[n]);
    return size;
}

int ContactMemory::bonds() const
{
    int count = 0;
    for (int i = 0; i < atom->nlocal; ++i)
        for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n)
            count += pair->isBond(partners[n]);
    return count;
}

void ContactMemory::post_neighbor()
{
    if (!pair)
        return;
    pair->rebuild();
    listIsNewer = true;
}

void ContactMemory::attach(PairPotentialParticle* style)
{
    if (pair == style)
        return;
    pair = style;
    if (fromFile.sums.back() > 0 && fromFile.byPatch != pair->actsOnPatches())
        error->all(FLERR,
                   "pair_style potential/particle: the contacts of the restart file act {}: give the pair_style {} "
                   "'patch TOL' as when it was written",
                   pair->actsOnPatches() ? "in a point" : "on patches", pair->actsOnPatches() ? "without" : "with");
    const auto sums = pair->sumsOfRun();
    for (size_t n = 0; comm->me == 0 && n < sums.size(); ++n)
        *sums[n] += fromFile.sums[n];
    fromFile = {};
}

// Called before the atoms are packed.
void ContactMemory::write_restart(FILE* file)
{
    collect();
    checkIds();
    Saved all { savedFormat, pair ? static_cast<double>(pair->actsOnPatches()) : fromFile.byPatch, {} };
    std::array<double, 6> own {};
    if (pair)
        for (size_t n = 0; n < pair->sumsOfRun().size(); ++n)
            own[n] = *pair->sumsOfRun()[n];
    else if (comm->me == 0)
        own = fromFile.sums;
    own.back() = 0;
    for (int i = 0; i < atom->nlocal; ++i)
        own.back() += sizeOf(i) > withoutContacts;
    MPI_Reduce(own.data(), all.sums.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_SUM, 0, world);
    writeSaved(file, all);
}

void ContactMemory::restart(char* saved)
{
    std::memcpy(&fromFile.format, saved, sizeof fromFile.format);
    if (fromFile.format != savedFormat)
        error->all(FLERR,
                   "pair_style potential/particle: the contacts of the restart file are of another version of the "
                   "plugin: read the file with that one");
    std::memcpy(&fromFile, saved, sizeof fromFile);
}

const ContactMemory::Partner* ContactMemory::find(int i, tagint other) const
{
    for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n)
        if (partners[n].other == other)
            return &partners[n];
    return nullptr;
}

void ContactMemory::grow_arrays(int most) { ranges.resize(most); }

void ContactMemory::copy_arrays(int from, int to, int) { ranges[to] = ranges[from]; }

// Contacts and bonds alone: pairs that are near, but apart, have no history.
int ContactMemory::pack(int i, double* buffer) const
{
    int m = withoutContacts, count = 0;
    for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n) {
        const Partner& partner = partners[n];
        if (!lasts(partner))
            continue;
        buffer[m++] = ubuf(partner.other).d;
        buffer[m++] = partner.mark;
        const int numbers = countOf(partner);
        buffer[m++] = numbers;
        if (partner.where >= 0)
            pair->writeValues(partner.where, buffer + m);
        else
            std::copy_n(arrived(partner.where).values, numbers, buffer + m);
        m += numbers;
        ++count;
    }
    buffer[0] = count;
    buffer[1] = ubuf(ranges[i].own).d;
    return m;
}

int ContactMemory::unpack(int i, const double* buffer)
{
    ubuf own(buffer[1]);
    ranges[i] = { static_cast<int>(partners.size()), static_cast<int>(buffer[0]), static_cast<tagint>(own.i) };
    int m = withoutContacts;
    for (int n = 0; n < ranges[i].count; ++n) {
        ubuf other(buffer[m++]);
        partners.push_back({ static_cast<tagint>(other.i), -1 - static_cast<int>(values.size()), buffer[m++] });
        const int numbers = 1 + static_cast<int>(buffer[m]);
        values.insert(values.end(), buffer + m, buffer + m + numbers);
        m += numbers;
    }
    return m;
}

double ContactMemory::memory_usage()
{
    return static_cast<double>(ranges.capacity() * sizeof(Range) + partners.capacity() * sizeof(Partner)
                               + values.capacity() * sizeof(double));
}

} // namespace potential_particles
