// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_memory.hpp"
#include "pair_potential_particle.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <utility>

using namespace LAMMPS_NS;

namespace potential_particles {

ContactMemory::ContactMemory(LAMMPS* lmp, int count, char** arguments)
    : Fix(lmp, count, arguments)
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
    return PRE_EXCHANGE | POST_NEIGHBOR | MIN_PRE_EXCHANGE | MIN_POST_NEIGHBOR | POST_RUN;
}

// Where the atoms are that were local when the list was built; -1: deleted. A fix that deletes atoms moves others into their place.
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
        forEachLocal(slot, [&](int i, int j) { partners[ranges[i].first + ranges[i].count++] = { pair->tagAtBuild(j), slot }; });
    maxexchange = withoutPartners;
    for (int i = 0; i < atom->nlocal; ++i) {
        ranges[i].own = atom->tag[i];
        maxexchange = std::max(maxexchange, sizeOf(i));
    }
}

// Partners are known by their IDs.
void ContactMemory::checkIds() const
{
    for (int i = 0; pair && i < atom->nlocal; ++i)
        if (ranges[i].own && ranges[i].own != atom->tag[i] && sizeOf(i) > withoutPartners)
            error->one(FLERR, "pair_style potential/particle: the atom of ID {} has the ID {} now, and contacts know their bodies by IDs: give 'compress no' to delete_atoms, and "
                "leave out 'reset_atoms id'", ranges[i].own, atom->tag[i]);
}

bool ContactMemory::lasts(const Partner& partner) const { return partner.where < 0 || pair->lasts(partner.where); }

int ContactMemory::countOf(const Partner& partner) const
{
    return partner.where >= 0 ? pair->valueCount(partner.where) : arrived(partner.where).count;
}

int ContactMemory::sizeOf(int i) const
{
    int size = withoutPartners;
    for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n)
        if (lasts(partners[n]))
            size += 2 + countOf(partners[n]);
    return size;
}

int ContactMemory::bonds() const
{
    int count = 0;
    for (int i = 0; i < atom->nlocal; ++i)
        for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n) {
            const int where = partners[n].where;
            const Arrived came = where < 0 ? arrived(where) : Arrived {};
            count += where >= 0 ? pair->isBond(where) : pair->isBond(came.values, came.count);
        }
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
    const auto sums = pair->sumsOfRun();
    for (size_t n = 0; n < sums.size(); ++n)
        *sums[n] += std::exchange(savedSums[n], 0.0);
}

// Called before the atoms are packed.
void ContactMemory::write_restart(FILE* file)
{
    collect();
    checkIds();
    std::array<double, 5> own {}, all {};
    if (pair)
        for (size_t n = 0; n < own.size(); ++n)
            own[n] = *pair->sumsOfRun()[n];
    MPI_Reduce(own.data(), all.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_SUM, 0, world);
    if (comm->me == 0) {
        const int size = sizeof all;
        fwrite(&size, sizeof size, 1, file);
        fwrite(all.data(), sizeof all, 1, file);
    }
}

void ContactMemory::restart(char* saved)
{
    if (comm->me == 0)
        std::memcpy(savedSums.data(), saved, sizeof savedSums);
}

int ContactMemory::find(int i, tagint other) const
{
    for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n)
        if (partners[n].other == other)
            return partners[n].where;
    return nowhere;
}

void ContactMemory::grow_arrays(int most) { ranges.resize(most); }

void ContactMemory::copy_arrays(int from, int to, int) { ranges[to] = ranges[from]; }

// Contacts and bonds alone: pairs that are near, but apart, have no history.
int ContactMemory::pack(int i, double* buffer) const
{
    int m = withoutPartners, count = 0;
    for (int n = ranges[i].first; n < ranges[i].first + ranges[i].count; ++n) {
        const Partner& partner = partners[n];
        if (!lasts(partner))
            continue;
        buffer[m++] = ubuf(partner.other).d;
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
    int m = withoutPartners;
    for (int n = 0; n < ranges[i].count; ++n) {
        ubuf other(buffer[m++]);
        partners.push_back({ static_cast<tagint>(other.i), -1 - static_cast<int>(values.size()) });
        const int numbers = 1 + static_cast<int>(buffer[m]);
        values.insert(values.end(), buffer + m, buffer + m + numbers);
        m += numbers;
    }
    return m;
}

int ContactMemory::pack_exchange(int i, double* buffer) { return pack(i, buffer); }

int ContactMemory::unpack_exchange(int i, double* buffer) { return unpack(i, buffer); }

int ContactMemory::pack_restart(int i, double* buffer)
{
    const int size = 1 + pack(i, buffer + 1);
    buffer[0] = size;
    return size;
}

void ContactMemory::unpack_restart(int i, int nth)
{
    const double* extra = atom->extra[i];
    for (int n = 0; n < nth; ++n)
        extra += static_cast<int>(extra[0]);
    unpack(i, extra + 1);
}

int ContactMemory::size_restart(int i) { return 1 + sizeOf(i); }

int ContactMemory::maxsize_restart()
{
    int most = 1 + withoutPartners;
    for (int i = 0; i < atom->nlocal; ++i)
        most = std::max(most, size_restart(i));
    return most;
}

double ContactMemory::memory_usage()
{
    return static_cast<double>(ranges.capacity() * sizeof(Range) + partners.capacity() * sizeof(Partner) + values.capacity() * sizeof(double));
}

} // namespace potential_particles
