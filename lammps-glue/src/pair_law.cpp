// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a contact of the pair style does to its bodies, in its point or on its patch.
#include "pair_potential_particle.hpp"
#include "arrays.hpp"
#include "fix_shapes.hpp"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

namespace potential_particles {

void PairPotentialParticle::applyLaw(int slot)
{
    if (byPatch)
        actOnPatch(slot);
    else if (answers[slot].kind == PP_OVERLAPPING)
        actInPoint(slot);
    else
        histories[slot].touching = false;
}

void PairPotentialParticle::push(int i, const Vector3d& force, const Vector3d& torque)
{
    if (i >= local)
        return;
    add(atom->f[i], force);
    add(atom->torque[i], torque);
}

// Of one contact; where another rank has one of the bodies, it adds its half.
void PairPotentialParticle::count(int a, int b, const Vector3d& onB, const JointEnergies& energies)
{
    const double share = a < local && b < local ? 1.0 : 0.5;
    pvector[elastic] += share * energies.elastic;
    pvector[slid] += share * energies.friction;
    pvector[damped] += share * energies.viscous;
    pvector[changed] += share * energies.area;
    pvector[broke] += share * energies.breaking;
    if (evflag) {
        const Vector3d between = vector(poses[a].position) - vector(poses[b].position);
        ev_tally_xyz(a, b, local, 0, energies.elastic, 0.0, -onB[0], -onB[1], -onB[2], between[0], between[1],
                     between[2]);
    }
}

void PairPotentialParticle::actInPoint(int slot)
{
    const pp_contact& found = answers[slot];
    const int a = static_cast<int>(bodies[slot].a), b = static_cast<int>(bodies[slot].b);
    const Vector3d armA = vector(found.branch_a), armB = vector(found.branch_b), turnA = vector(atom->omega[a]),
                   turnB = vector(atom->omega[b]);
    ContactMotion motion;
    motion.overlap = found.overlap;
    motion.normal = vector(found.normal);
    motion.velocity = vector(atom->v[b]) + turnB.cross(armB) - vector(atom->v[a]) - turnA.cross(armA);
    motion.spin = 0.5 * motion.normal.dot(turnA + turnB);
    const double inverse = inverseMass(a) + inverseMass(b);
    motion.mass = inverse > 0 ? 1 / inverse : 0; // two that no force moves need no dashpot
    const LawParameters& law = laws[atom->type[a] * (atom->ntypes + 1) + atom->type[b]];
    const ContactForce force = contactForce(law, motion, update->dt, advance, histories[slot]);
    push(a, -force.onB, -armA.cross(force.onB));
    push(b, force.onB, armB.cross(force.onB));
    pvector[contacts] += a < local && b < local ? 1.0 : 0.5;
    count(a, b, force.onB, { force.elastic, force.slid, force.damped, 0, 0 });
}

bool PairPotentialParticle::isMoved(int i) const { return !moving || (atom->mask[i] & moving); }

double PairPotentialParticle::inverseMass(int i) const { return isMoved(i) ? 1 / atom->rmass[i] : 0; }

JointBody PairPotentialParticle::bodyOf(int i) const
{
    const double* q = poses[i].orientation;
    const Shape& shape = shapes->shape(atom->type[i]);
    JointBody body { vector(poses[i].position),
                     Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
                     vector(atom->v[i]),
                     vector(atom->omega[i]),
                     {} };
    if (isMoved(i))
        body.mass = { Vector3d::Constant(1 / atom->rmass[i]),
                      shape.volume / atom->rmass[i] * shape.moments.cwiseInverse(), body.centre, body.turn };
    return body;
}

PosedShape PairPotentialParticle::posedShape(int i) const
{
    PosedShape posed;
    posed.particle = particles[i];
    posed.pose = poses[i];
    posed.boundingRadius = radii[i];
    pp_particle_depth_length(posed.particle, &posed.depthLength);
    return posed;
}

// A contact that is new.
JointHistory PairPotentialParticle::newJoint(const JointParameters& joint) const
{
    JointHistory history;
    history.memory.broken = update->ntimestep >= wholeBefore;
    history.memory.bonded = makesBonds && !history.memory.broken && (joint.cohesion > 0 || joint.tensileStrength > 0);
    return history;
}

std::optional<PatchInStep> PairPotentialParticle::patchOf(int slot)
{
    const pp_contact& found = answers[slot];
    if (found.kind != PP_OVERLAPPING)
        return {};
    const auto [a, b] = bodies[slot];
    auto& kept = patches[slot];
    if (!kept)
        kept = std::make_unique<KeptPatch>();
    const auto find = [&, a = a, b = b](uint32_t withEnergy, pp_patch_state* state, pp_patch* patch) {
        return pp_patch_of_contact(particles[a], &poses[a], particles[b], &poses[b], &found, patchTolerance, withEnergy,
                                   state, patch, nullptr, 0, nullptr);
    };
    pp_patch patch;
    if (auto here = PatchInStep::of(find(0, &kept->ofForce, &patch), patch)) {
        here->patch.energy = eflag_either ? kept->energy(find) : 0;
        return here;
    }
    pvector[fallbacks] += static_cast<int>(a) < local && static_cast<int>(b) < local ? 1.0 : 0.5;
    double area = 0; // stays 0 for bodies that overlap by nothing but rounding: no point lies in both
    pp_contact_area(particles[a], &poses[a], particles[b], &poses[b], &found, areaTolerance, &area);
    const Vector3d normal = vector(found.normal);
    return PatchInStep { ContactPatch::disc(area, found.overlap, normal), vector(found.point), normal };
}

void PairPotentialParticle::actOnPatch(int slot)
{
    JointHistory& history = joints[slot];
    // While a bond holds, it alone carries the pair.
    const std::optional<PatchInStep> here = history.isBond() && history.memory.bonded ? std::nullopt : patchOf(slot);
    if (!here && !history.lasts())
        return;
    const int a = static_cast<int>(bodies[slot].a), b = static_cast<int>(bodies[slot].b);
    const JointParameters& joint = jointLaws[atom->type[a] * (atom->ntypes + 1) + atom->type[b]];
    if (!history.lasts())
        history = newJoint(joint);
    JointForces forces;
    try {
        const JointSides sides { shapes->sideOf(a, history.memory, true), shapes->sideOf(b, history.memory, false) };
        forces = jointForces(joint, history, bodyOf(a), bodyOf(b), sides, here, update->dt, advance,
                             [&](int body) { return posedShape(body == 1 ? a : b); });
    } catch (const std::exception& refused) {
        error->one(FLERR, "{}: the patch of atoms {} and {} cannot become a bond: {}", style, atom->tag[a],
                   atom->tag[b], refused.what());
    }
    checkTimeStep(a, b, forces);
    push(a, forces.onOne.force, forces.onOne.torque);
    push(b, forces.onOther.force, forces.onOther.torque);
    const double share = a < local && b < local ? 1.0 : 0.5;
    pvector[contacts] += history.lasts() ? share : 0.0;
    pvector[bonds] += history.isBond() ? share : 0.0;
    count(a, b, forces.onOther.force, forces.energies);
    if (!history.lasts())
        history = {};
}

void PairPotentialParticle::checkTimeStep(int a, int b, const JointForces& forces) const
{
    const double square = 4 / (forces.normalStiffness * (inverseMass(a) + inverseMass(b)));
    if (update->dt * update->dt > square)
        error->one(FLERR,
                   "{}: timestep = {}: the joint of atoms {} and {}, of stiffness {}, is unstable above {}, and with "
                   "levers well below: take {} or less",
                   style, update->dt, atom->tag[a], atom->tag[b], forces.normalStiffness, std::sqrt(square),
                   0.1 * std::sqrt(square));
}

} // namespace potential_particles
