// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve.hpp"
#include "fix_shapes.hpp"
#include "rotation.hpp"

#include "atom.h"
#include "error.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

    constexpr const char* style = "fix nve/potential/particle";

    Quaterniond quaternion(const double* q) { return Quaterniond(q[0], q[1], q[2], q[3]); }

} // namespace

FixNve::FixNve(LAMMPS* lmp, int count, char** arguments)
    : Fix(lmp, count, arguments)
{
    if (count != 3)
        error->all(FLERR, "{}: '{}': it takes no arguments", style, arguments[3]);
    time_integrate = 1;
    dynamic_group_allow = 1;
    scalar_flag = extscalar = 1;
    global_freq = 1;
}

int FixNve::groups(LAMMPS* lmp)
{
    int bits = 0;
    for (const Fix* fix : lmp->modify->get_fix_by_style("^nve/potential/particle$"))
        bits |= fix->groupbit;
    return bits;
}

int FixNve::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::FINAL_INTEGRATE; }

void FixNve::init() { shapes = FixShapes::of(lmp, style); }

void FixNve::push()
{
    const double half = 0.5 * update->dt;
    double** q = shapes->orientations();
    for (int i = 0; i < atom->nlocal; ++i) {
        if (!(atom->mask[i] & groupbit))
            continue;
        const Vector3d moments
            = atom->rmass[i] / shapes->shape(atom->type[i]).volume * shapes->shape(atom->type[i]).moments;
        const Eigen::Matrix3d at = quaternion(q[i]).toRotationMatrix();
        Map<Vector3d> v(atom->v[i]), turn(atom->omega[i]);
        v += half / atom->rmass[i] * Map<Vector3d>(atom->f[i]);
        turn = angularVelocityOf(at, moments, momentumOf(at, moments, turn) + half * Map<Vector3d>(atom->torque[i]));
    }
}

void FixNve::initial_integrate(int)
{
    push();
    double** q = shapes->orientations();
    for (int i = 0; i < atom->nlocal; ++i) {
        if (!(atom->mask[i] & groupbit))
            continue;
        const Vector3d& moments = shapes->shape(atom->type[i]).moments; // their scale does not matter here
        Map<Vector3d>(atom->x[i]) += update->dt * Map<Vector3d>(atom->v[i]);
        Map<Vector3d> turn(atom->omega[i]);
        Quaterniond at = quaternion(q[i]);
        const Vector3d momentum = momentumOf(at.toRotationMatrix(), moments, turn);
        rotateFreely(update->dt, moments, momentum, at);
        turn = angularVelocityOf(at.toRotationMatrix(), moments, momentum);
        q[i][0] = at.w();
        Map<Vector3d>(q[i] + 1) = at.vec();
    }
}

double FixNve::compute_scalar()
{
    double own = 0, all = 0;
    double** q = shapes->orientations();
    for (int i = 0; i < atom->nlocal; ++i) {
        if (!(atom->mask[i] & groupbit))
            continue;
        const Vector3d turn(atom->omega[i]);
        own += 0.5 * atom->rmass[i] / shapes->shape(atom->type[i]).volume
            * turn.dot(momentumOf(quaternion(q[i]).toRotationMatrix(), shapes->shape(atom->type[i]).moments, turn));
    }
    MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

} // namespace potential_particles
