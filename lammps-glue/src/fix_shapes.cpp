// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_shapes.hpp"
#include "entered.hpp"
#include "fix_wall.hpp"
#include "pair_potential_particle.hpp"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

using namespace LAMMPS_NS;

namespace potential_particles {
namespace {

    constexpr const char* styleName = "potential/particle/shapes";
    constexpr const char* property = "orientation";

} // namespace

FixShapes::FixShapes(LAMMPS* lmp, int count, char** arguments)
    : Fix(lmp, count, arguments)
{
    create_attribute = 1;
    if (count < 8)
        error->all(FLERR, "fix {}: expected FILE type T NAME DENSITY ... [orient random SEED]", styleName);
    if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
        error->all(FLERR,
                   "fix {}: atoms have no radius, mass, angular velocity or torque of their own: use atom_style sphere",
                   styleName);
    if (force->ftm2v != 1.0)
        error->all(FLERR, "fix {}: units in which force is not mass times acceleration: use units si, cgs or lj",
                   styleName);
    const std::string path = arguments[3];
    try {
        shapes = readShapes(fileForAll(lmp, path), path);
    } catch (const std::runtime_error& refused) {
        error->all(FLERR, std::string(refused.what()));
    }
    ofType.assign(atom->ntypes + 1, -1);
    densities.assign(atom->ntypes + 1, 0.0);
    for (int i = 4; i < count;) {
        if (strcmp(arguments[i], "type") == 0 && i + 3 < count) {
            int low = 0, high = 0;
            utils::bounds(FLERR, arguments[i + 1], 1, atom->ntypes, low, high, error);
            int found = -1;
            std::string names;
            for (size_t s = 0; s < shapes.size(); ++s) {
                names += " " + shapes[s].name;
                if (shapes[s].name == arguments[i + 2])
                    found = static_cast<int>(s);
            }
            if (found < 0)
                error->all(FLERR, "fix {}: {} has no shape {}: it has{}", styleName, path, arguments[i + 2], names);
            const double density
                = numberIn(lmp, std::string("fix ") + styleName, "density", arguments[i + 3], 1 / bearable);
            for (int type = low; type <= high; ++type) {
                ofType[type] = found;
                densities[type] = density;
            }
            i += 4;
        } else if (strcmp(arguments[i], "orient") == 0 && i + 2 < count && strcmp(arguments[i + 1], "random") == 0) {
            random = true;
            seed = static_cast<unsigned long long>(utils::bnumeric(FLERR, arguments[i + 2], false, lmp));
            i += 3;
        } else
            error->all(FLERR, "fix {}: '{}': expected type T NAME DENSITY, or orient random SEED", styleName,
                       arguments[i]);
    }
    for (int type = 1; type <= atom->ntypes; ++type) {
        if (ofType[type] < 0)
            error->all(FLERR, "fix {}: type {} has no shape: add 'type {} NAME DENSITY'", styleName, type, type);
        if (!(massOf(type) >= 1 / bearable && massOf(type) * shape(type).radius * shape(type).radius <= bearable))
            error->all(FLERR,
                       "fix {}: type {} has the mass {} and the radius {}: masses must be above 1e-100, and moments of "
                       "inertia below 1e100",
                       styleName, type, massOf(type), shape(type).radius);
    }
    atom->add_callback(Atom::GROW);
}

FixShapes::~FixShapes()
{
    atom->delete_callback(id, Atom::GROW);
    if (update) // else LAMMPS ends
        update->first_update = 0;
}

int FixShapes::setmask() { return FixConst::PRE_NEIGHBOR | FixConst::PRE_FORCE; }

// Not in the constructor: LAMMPS enters one fix at a time.
void FixShapes::post_constructor()
{
    int isDouble = 0, columns = 0;
    if (atom->find_custom(property, isDouble, columns) < 0)
        modify->add_fix(fmt::format("{} all property/atom d2_{} 4 writedata yes", property, property));
    else if (!isDouble || columns != 4)
        error->all(FLERR, "fix {}: the property {} is not d2_{} 4: define it as 'fix {} all property/atom d2_{} 4'",
                   styleName, property, property, property, property);
}

double** FixShapes::orientations() const
{
    int isDouble = 0, columns = 0;
    const int index = atom->find_custom(property, isDouble, columns);
    if (index < 0)
        error->all(FLERR, "fix {}: the property {} is gone: leave fix {} where it is", styleName, property, property);
    return atom->darray[index];
}

std::string FixShapes::whyNotOriented(double* quaternion, tagint tag) const
{
    Eigen::Map<Eigen::Vector4d> q(quaternion);
    if (q.isZero(0)) {
        q = Eigen::Vector4d(1, 0, 0, 0);
        if (random) { // from the atom's ID, so that it does not depend on the number of ranks
            std::mt19937_64 engine(seed * 0x9e3779b97f4a7c15ull + static_cast<unsigned long long>(tag));
            std::normal_distribution<double> normal;
            do
                q = Eigen::Vector4d(normal(engine), normal(engine), normal(engine), normal(engine));
            while (q.norm() < 1e-3);
        }
    }
    if (!(q.norm() > 1e-150 && q.norm() < 1e150))
        return fmt::format("fix {}: atom {} has the orientation {} {} {} {}: it must be a quaternion w x y z",
                           styleName, tag, q[0], q[1], q[2], q[3]);
    if (std::abs(q.squaredNorm() - 1) > 1e-14) // an orientation that was restarted keeps its bits
        q.normalize();
    return "";
}

void FixShapes::init()
{
    if (modify->get_fix_by_style(std::string("^") + styleName + "$").size() > 1)
        error->all(FLERR, "fix {}: there are two of them: give all types in one", styleName);
    if (ofType.size() != static_cast<size_t>(atom->ntypes) + 1)
        error->all(FLERR, "fix {}: the number of atom types has changed: give the fix after the box is made",
                   styleName);
    checkRun();
    comm_forward = JointsOfBody::numbers;
    double** q = orientations();
    std::string why;
    for (int i = 0; i < atom->nlocal && why.empty(); ++i) {
        give(i);
        why = whyNotOriented(q[i], atom->tag[i]);
    }
    endWhereAny(lmp, why);
}

void FixShapes::checkRun() const
{
    if (update->whichflag == 2)
        error->all(FLERR,
                   "fix {}: minimize does not turn bodies: let them come to rest in a run, with a restitution below 1 "
                   "or fix viscous",
                   styleName);
    if (lmp->input->command && !strcmp(lmp->input->command, "rerun"))
        error->all(FLERR, "fix {}: rerun reads no orientations: run again from a restart file", styleName);
    if (utils::strmatch(update->integrate_style, "^respa"))
        error->all(
            FLERR,
            "fix {}: run_style respa has several time steps for the forces of one contact: use 'run_style verlet'",
            styleName);
    if (!(update->dt >= 0 && update->dt <= bearable))
        error->all(FLERR, "fix {}: timestep = {}: it must lie in [0, 1e100]", styleName, update->dt);
}

void FixShapes::give(int i)
{
    atom->radius[i] = shape(atom->type[i]).radius;
    atom->rmass[i] = massOf(atom->type[i]);
}

// What init() gave by the type holds for the whole run.
void FixShapes::setup_pre_force(int)
{
    endWhereAny(lmp, whyNotOfItsType());
    gatherJoints();
}

void FixShapes::pre_force(int)
{
    if (const std::string why = whyNotOfItsType(); !why.empty())
        error->one(FLERR, why);
    gatherJoints();
}

// From the centre of the atom, or of its periodic image that is nearest: an atom may have crossed a border since.
Eigen::Vector3d FixShapes::pointFrom(int i, const JointLoad& load) const
{
    Eigen::Vector3d point = load.heldPoint - Eigen::Vector3d(atom->x[i]);
    domain->minimum_image(FLERR, point.data());
    return point;
}

// Before pairs and walls change what their joints remember.
void FixShapes::gatherJoints()
{
    auto* const pair = dynamic_cast<PairPotentialParticle*>(force->pair_match("potential/particle", 1));
    std::vector<FixWall*> walls;
    for (Fix* const fix : modify->get_fix_list())
        if (auto* const wall = dynamic_cast<FixWall*>(fix); wall && wall->actsOnPatches())
            walls.push_back(wall);
    if (!(pair && pair->actsOnPatches()) && walls.empty()) {
        joints.clear();
        return;
    }
    joints.resize(static_cast<size_t>(atom->nlocal) + atom->nghost);
    for (JointsOfBody& one : joints)
        one.clear();
    const auto add = [&](int i, const JointLoad& load, bool outwards) {
        if (i < atom->nlocal)
            joints[i].add(load, pointFrom(i, load), outwards);
    };
    if (pair && pair->actsOnPatches())
        pair->eachLoad(add);
    for (const FixWall* const wall : walls)
        wall->eachLoad(add);
    comm->forward_comm(this);
}

int FixShapes::pack_forward_comm(int count, int* atoms, double* buffer, int, int*)
{
    for (int n = 0; n < count; ++n)
        joints[atoms[n]].write(buffer + JointsOfBody::numbers * n);
    return JointsOfBody::numbers * count;
}

void FixShapes::unpack_forward_comm(int count, int first, double* buffer)
{
    for (int n = 0; n < count; ++n)
        joints[first + n].read(buffer + JointsOfBody::numbers * n);
}

JointSide FixShapes::sideOf(int i, const JointLoad& load, bool outwards) const
{
    return joints.empty() ? JointSide {} : joints[i].without(load, pointFrom(i, load), outwards);
}

std::string FixShapes::whyNotOfItsType() const
{
    for (int i = 0; i < atom->nlocal; ++i) {
        const int type = atom->type[i];
        if (atom->radius[i] != shape(type).radius || atom->rmass[i] != massOf(type))
            return fmt::format("fix {}: atom {} of type {} has the radius {} and the mass {}, its shape {} has {} and "
                               "{}: change types between runs, and leave out 'pre no'",
                               styleName, atom->tag[i], type, atom->radius[i], atom->rmass[i], shape(type).name,
                               shape(type).radius, massOf(type));
    }
    return "";
}

// Atoms that came during a run and had no ID when they were made.
void FixShapes::pre_neighbor()
{
    double** q = orientations();
    for (int i = 0; i < atom->nlocal; ++i)
        if (const std::string why = whyNotOriented(q[i], atom->tag[i]); !why.empty())
            error->one(FLERR, why);
}

void FixShapes::set_arrays(int i)
{
    give(i);
    // The property may not have been cleared yet: fixes are called in their order.
    double* q = orientations()[i];
    for (int n = 0; n < 4; ++n)
        q[n] = 0;
    if (atom->tag[i] > 0)
        whyNotOriented(q, atom->tag[i]);
}

double FixShapes::largestRadius() const
{
    double largest = 0;
    for (int type = 1; type <= atom->ntypes; ++type)
        largest = std::max(largest, shape(type).radius);
    return largest;
}

double FixShapes::smallestRadius() const
{
    double smallest = largestRadius();
    for (int type = 1; type <= atom->ntypes; ++type)
        smallest = std::min(smallest, shape(type).radius);
    return smallest;
}

double FixShapes::memory_usage()
{
    return static_cast<double>(shapes.size() * sizeof(Shape) + joints.size() * sizeof(JointsOfBody));
}

FixShapes* FixShapes::of(LAMMPS* lmp, const std::string& asker)
{
    const auto found = lmp->modify->get_fix_by_style(std::string("^") + styleName + "$");
    if (found.empty())
        lmp->error->all(FLERR, "{}: no shapes are known: give 'fix ID all {} FILE type T NAME DENSITY' before", asker,
                        styleName);
    return static_cast<FixShapes*>(found.front());
}

} // namespace potential_particles
