// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_potential_particle.hpp"
#include "arrays.hpp"
#include "fix_shapes.hpp"

#include "plugin-common/motion_bound.hpp"
#include "plugin-common/new_contact.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

    constexpr int pointValues = 9;

    std::string described(const pp_pose& pose)
    {
        std::string text = "position";
        for (double x : pose.position)
            text += fmt::format(" {:.17g}", x);
        text += ", orientation";
        for (double q : pose.orientation)
            text += fmt::format(" {:.17g}", q);
        return text;
    }

} // namespace

PairPotentialParticle::PairPotentialParticle(LAMMPS* lmp)
    : Pair(lmp)
{
    single_enable = 0;
    restartinfo = 0;
    one_coeff = 0;
    no_virial_fdotr_compute = 1;
    comm_forward = 4;
    finitecutflag = 1;
    nextra = sums;
    pvector = new double[sums] {};
    pp_settings_default(&how);
    how.carry_tolerance = 1e-9;
}

PairPotentialParticle::~PairPotentialParticle()
{
    delete[] pvector;
    if (allocated) {
        memory->destroy(setflag);
        memory->destroy(cutsq);
    }
    if (memory_ && modify->get_fix_by_id(memoryId)) {
        memory_->detach();
        modify->delete_fix(memoryId);
    }
    if (update) // computes know the style: they look for it anew even where the next run says 'pre no'
        update->first_update = 0;
}

void PairPotentialParticle::allocate()
{
    allocated = 1;
    const int n = atom->ntypes + 1;
    memory->create(setflag, n, n, "pair:setflag");
    memory->create(cutsq, n, n, "pair:cutsq");
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            setflag[i][j] = 0;
    laws.assign(static_cast<size_t>(n) * n, {});
    jointLaws.assign(static_cast<size_t>(n) * n, {});
}

int PairPotentialParticle::valueCount(int slot) const { return byPatch ? countOfNumbers(joints[slot]) : pointValues; }

void PairPotentialParticle::writeValues(int slot, double* to) const
{
    if (byPatch) {
        writeNumbers(joints[slot], to);
        return;
    }
    const ContactHistory& history = histories[slot];
    for (const Vector3d* part : { &history.shear, &history.normal, &history.damping })
        to = std::copy(part->data(), part->data() + 3, to);
}

bool PairPotentialParticle::isBond(const ContactMemory::Partner& partner) const
{
    if (partner.where >= 0)
        return isBond(partner.where);
    const auto [values, count] = memory_->arrived(partner.where);
    return byPatch && count > pointValues && readNumbers(values).isBond();
}

// Whether a contact that is remembered is one of these shapes.
bool PairPotentialParticle::fits(const ContactMemory::Partner& partner, int a, int b)
{
    if (partner.mark == markOfBoth(marks[a], marks[b]))
        return true;
    if (isBond(partner))
        error->one(FLERR,
                   "{}: atoms {} and {} are bonded, and one has another shape than its bond: leave the shapes as they "
                   "are, or begin without bonds: 'pair_style none' and the style again",
                   style, tags[a], tags[b]);
    if (!toldOfShapes)
        error->warning(FLERR,
                       "{}: the contact of atoms {} and {}, and maybe others, begins anew, since a shape has changed",
                       style, tags[a], tags[b]);
    toldOfShapes = true;
    return false;
}

// What another rank or a file has of a contact, into the last slot.
void PairPotentialParticle::takeArrived(int where, int slot)
{
    const double* values = memory_->arrived(where).values;
    if (byPatch)
        joints[slot] = readNumbers(values);
    else
        histories[slot] = { vector(values), vector(values + 3), vector(values + 6), true };
}

double PairPotentialParticle::apart(int a, int b) const
{
    return (vector(poses[a].position) - vector(poses[b].position)).norm() - radii[a] - radii[b];
}

void PairPotentialParticle::rebuild()
{
    local = atom->nlocal;
    const int all = local + atom->nghost;
    tags.assign(atom->tag, atom->tag + all);
    particles.resize(all);
    marks.resize(all);
    radii.resize(all);
    for (int i = 0; i < all; ++i) {
        const Shape& shape = shapes->shape(atom->type[i]);
        particles[i] = shape.particle.get();
        marks[i] = shape.mark;
        radii[i] = shape.radius;
    }
    poses.clear(); // gathered anew, with no way between
    ways.assign(all, 0.0);
    const bool mayGrowOld = neighbor->every > 1 || neighbor->delay > 0 || !neighbor->dist_check || neighbor->build_once;
    held.resize(mayGrowOld ? local : 0);
    for (size_t i = 0; i < held.size(); ++i)
        std::copy_n(atom->x[i], 3, held[i].begin());

    // Slots in the order of the list, for the caches; those of pairs that have left it are dropped.
    std::vector<int> from;
    std::vector<Bodies> newBodies;
    far.clear();
    for (int ii = 0; ii < list->inum; ++ii) {
        const int i = list->ilist[ii];
        for (int jj = 0; jj < list->numneigh[i]; ++jj) {
            const int j = list->firstneigh[i][jj] & NEIGHMASK;
            const bool inOrder = atom->tag[i] <= atom->tag[j];
            const int a = inOrder ? i : j, b = inOrder ? j : i;
            const ContactMemory::Partner* known = memory_->find(i, atom->tag[j]);
            if (!known || !fits(*known, a, b))
                far.push_back({ a, b, -1.0 });
            else {
                from.push_back(known->where);
                newBodies.push_back({ static_cast<uint32_t>(a), static_cast<uint32_t>(b) });
            }
        }
    }
    const int bondsBefore = byPatch ? memory_->bonds() : 0;
    const auto inNewOrder = [&](auto& of, auto&& none) {
        std::decay_t<decltype(of)> ordered(from.size());
        for (size_t n = 0; n < from.size(); ++n)
            ordered[n] = from[n] >= 0 ? std::move(of[from[n]]) : none();
        of.swap(ordered);
    };
    bodies.swap(newBodies);
    // What the library remembers makes answers differ by their tolerance. It does not migrate, nor is it in files: it
    // is dropped for all.
    states.assign(from.size(), pp_pair_state {});
    inNewOrder(answers, [] { return pp_contact {}; });
    if (byPatch) {
        inNewOrder(joints, [] { return JointHistory {}; });
        patches.clear();
        patches.resize(from.size());
    } else
        inNewOrder(histories, [] { return ContactHistory {}; });
    for (size_t n = 0; n < from.size(); ++n)
        if (from[n] < 0)
            takeArrived(from[n], static_cast<int>(n));
    if (byPatch)
        checkBonds(bondsBefore);
}

// A bond is in the list of neighbours, unless one of its atoms is gone.
void PairPotentialParticle::checkBonds(int before)
{
    int now = 0;
    for (int slot = 0; slot < slotCount(); ++slot)
        if (isBond(slot))
            now += (static_cast<int>(bodies[slot].a) < local) + (static_cast<int>(bodies[slot].b) < local);
    if (now < before && atom->natoms == atomsAtBuild)
        error->one(FLERR,
                   "{}: {} bonded atoms have lost their partner: their bonds reach beyond the list of neighbours, or "
                   "neigh_modify "
                   "exclude leaves pairs out; give a skin of more than {}, or a larger stiffness",
                   style, before - now, neighbor->skin);
    atomsAtBuild = atom->natoms;
}

int PairPotentialParticle::pack_forward_comm(int count, int* atoms, double* buffer, int, int*)
{
    double** q = shapes->orientations();
    for (int n = 0; n < count; ++n)
        // An atom of this rank, or a ghost that is handed on.
        std::copy_n(atoms[n] < local ? q[atoms[n]] : poses[atoms[n]].orientation, 4, buffer + 4 * n);
    return 4 * count;
}

void PairPotentialParticle::unpack_forward_comm(int count, int first, double* buffer)
{
    for (int n = 0; n < count; ++n)
        std::copy_n(buffer + 4 * n, 4, poses[first + n].orientation);
}

void PairPotentialParticle::gatherPoses()
{
    const size_t all = particles.size();
    const bool first = poses.size() != all;
    last.swap(poses);
    poses.resize(all);
    double** q = shapes->orientations();
    for (int i = 0; i < local; ++i)
        std::copy_n(q[i], 4, poses[i].orientation);
    comm->forward_comm(this);
    for (size_t i = 0; i < all; ++i) {
        std::copy_n(atom->x[i], 3, poses[i].position);
        ways[i] = travelled(ways[i], wayBetween(first ? pp_pose {} : last[i], poses[i], radii[i]));
        if (!std::isfinite(ways[i]))
            error->one(FLERR,
                       "{}: atom {} has the pose {}: it must be finite; a smaller timestep or softer contacts may help",
                       style, atom->tag[i], described(poses[i]));
        if (first)
            ways[i] = 0;
    }
}

void PairPotentialParticle::checkSkin()
{
    for (size_t i = 0; i < held.size(); ++i) {
        const double way = (vector(atom->x[i]) - vector(held[i].data())).norm();
        if (way > 0.5 * neighbor->skin)
            error->one(FLERR,
                       "{}: atom {} has moved by {} in {} steps without a new list of neighbours, more than half the "
                       "skin of {}: "
                       "give 'neigh_modify delay 0 every 1 check yes', or a skin of {} or more",
                       style, atom->tag[i], way, neighbor->ago, neighbor->skin, 3 * way);
    }
}

// Other fixes that turn bodies do not know of orientations.
void PairPotentialParticle::checkTurns()
{
    for (int i = 0; !toldOfTurns && i < local; ++i)
        if (!(atom->mask[i] & moving) && vector(atom->omega[i]) != Vector3d::Zero()) {
            const auto* w = atom->omega[i];
            error->warning(FLERR,
                           "{}: atom {} has the angular velocity {} {} {}, and no fix nve/potential/particle moves it: "
                           "its orientation stays as it is",
                           style, atom->tag[i], w[0], w[1], w[2]);
            toldOfTurns = true;
        }
}

bool PairPotentialParticle::sleeps(const pp_contact& found, int a, int b) const
{
    return found.kind == PP_SEPARATED && found.distance > farShare * (radii[a] + radii[b]);
}

void PairPotentialParticle::addSlot(Bodies pair, const pp_pair_state& state, const pp_contact& found)
{
    bodies.push_back(pair);
    states.push_back(state);
    answers.push_back(found);
    if (byPatch) {
        joints.emplace_back();
        patches.emplace_back();
    } else
        histories.emplace_back();
}

void PairPotentialParticle::removeSlot(int slot)
{
    const auto remove = [slot](auto& of) {
        of[slot] = std::move(of.back());
        of.pop_back();
    };
    remove(bodies);
    remove(states);
    remove(answers);
    remove(statuses);
    if (byPatch) {
        remove(joints);
        remove(patches);
    } else
        remove(histories);
}

// A contact that failed keeps the geometry of the last step, if it has one.
void PairPotentialParticle::fail(int a, int b, pp_status status)
{
    const std::string what
        = fmt::format("{}: the contact of atoms {} and {} failed: {}. Shapes {} and {}; A: {}; B: {}", style,
                      atom->tag[a], atom->tag[b], pp_status_message(status), shapes->shape(atom->type[a]).name,
                      shapes->shape(atom->type[b]).name, described(poses[a]), described(poses[b]));
    const bool badPose = status == PP_BAD_POSITION || status == PP_BAD_ORIENTATION;
    if (stopAtFailure || badPose)
        error->one(FLERR,
                   badPose ? what
                           : what + ". To go on and count failures: pair_style potential/particle failures count");
    error->warning(FLERR, what);
    failures += a < local && b < local ? 1.0 : 0.5;
}

void PairPotentialParticle::solveNear()
{
    const size_t count = bodies.size();
    statuses.resize(count);
    static_assert(sizeof(Bodies) == 2 * sizeof(uint32_t));
    const pp_status status
        = pp_contact_detect_batch(particles.data(), poses.data(), particles.size(), count ? &bodies[0].a : nullptr,
                                  count, &how, threads, states.data(), answers.data(), statuses.data());
    if (status != PP_OK)
        error->one(FLERR, "{}: {}", style, pp_status_message(status));
    for (int slot = 0; slot < slotCount();) {
        const int a = static_cast<int>(bodies[slot].a), b = static_cast<int>(bodies[slot].b);
        statuses[slot] = fromNothingIfNew(statuses[slot], answers[slot], lasts(slot), &states[slot], [&] {
            return pp_contact_detect(particles[a], &poses[a], particles[b], &poses[b], &how, &states[slot],
                                     &answers[slot]);
        });
        if (statuses[slot] != PP_OK)
            fail(a, b, statuses[slot]);
        else if (sleeps(answers[slot], a, b) && !isBond(slot)) {
            far.push_back({ a, b, wakesAt(ways[a] + ways[b], answers[slot].distance) });
            removeSlot(slot);
            continue;
        }
        applyLaw(slot++);
    }
}

void PairPotentialParticle::lookAtFar()
{
    for (size_t n = 0; n < far.size();) {
        Far& pair = far[n];
        const double both = ways[pair.a] + ways[pair.b];
        if (both < pair.wake) {
            ++n;
            continue;
        }
        const double distance = apart(pair.a, pair.b);
        if (distance > 0) {
            pair.wake = wakesAt(both, distance);
            ++n;
            continue;
        }
        pp_pair_state state = {};
        pp_contact found = {};
        const pp_status status = pp_contact_detect(particles[pair.a], &poses[pair.a], particles[pair.b], &poses[pair.b],
                                                   &how, &state, &found);
        if (status != PP_OK)
            fail(pair.a, pair.b, status);
        else if (sleeps(found, pair.a, pair.b)) {
            pair.wake = wakesAt(both, found.distance);
            ++n;
            continue;
        }
        addSlot({ static_cast<uint32_t>(pair.a), static_cast<uint32_t>(pair.b) }, state, found);
        applyLaw(slotCount() - 1);
        pair = far.back();
        far.pop_back();
    }
}

void PairPotentialParticle::compute(int eflag, int vflag)
{
    ev_init(eflag, vflag);
    advance = !update->setupflag;
    pvector[contacts] = pvector[elastic] = pvector[bonds] = pvector[fallbacks] = 0;
    checkTimeSteps();
    checkSkin();
    checkTurns();
    gatherPoses();
    solveNear();
    lookAtFar();
    pvector[failed] = failures;
    memory_->listIsNewer = true;
}

double PairPotentialParticle::memory_usage()
{
    const auto bytes = [](const auto& of) { return static_cast<double>(of.capacity() * sizeof(of[0])); };
    return Pair::memory_usage() + bytes(tags) + bytes(particles) + bytes(radii) + bytes(ways) + bytes(poses)
        + bytes(last) + bytes(held) + bytes(far) + bytes(bodies) + bytes(states) + bytes(answers) + bytes(histories)
        + bytes(statuses) + bytes(joints) + bytes(patches)
        + std::accumulate(patches.begin(), patches.end(), 0.0,
                          [](double sum, const auto& one) { return sum + (one ? one->bytes() : 0); });
}

} // namespace potential_particles
