// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall.hpp"
#include "fix_shapes.hpp"
#include "motion.hpp"
#include "text_file.hpp"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

constexpr const char* style = "fix wall/potential/particle";
constexpr const char* expected
    = "expected KN KS FRICTION RESTITUTION, then plane X Y Z NX NY NZ, stl FILE, scale S, flat EPS, linear VX VY VZ, or rotate X Y Z AX AY AZ PERIOD";

} // namespace

FixWall::FixWall(LAMMPS* lmp, int count, char** arguments)
    : Fix(lmp, count, arguments)
{
    restart_peratom = restart_global = create_attribute = 1;
    maxexchange_dynamic = 1;
    vector_flag = extvector = global_freq = 1;
    size_vector = sums;
    if (count < 7)
        error->all(FLERR, "{}: {}", style, expected);
    pp_settings_default(&how);
    const double restitution = numberAt(arguments, 6, "restitution");
    law = { numberAt(arguments, 3, "normal stiffness"), numberAt(arguments, 4, "shear stiffness"), numberAt(arguments, 5, "friction"),
        dampingRatioOf(restitution) };
    if (!(law.normalStiffness > 0 && law.shearStiffness >= 0 && law.friction >= 0 && restitution >= 0.01 && restitution <= 1)
        || (law.shearStiffness == 0 && law.friction > 0))
        error->all(FLERR, "{}: KN KS FRICTION RESTITUTION = {} {} {} {}: KN must be above 0, KS too if there is friction, FRICTION not below 0, and "
            "RESTITUTION in [0.01, 1]", style, arguments[3], arguments[4], arguments[5], arguments[6]);
    double scale = 1;
    for (int i = 7; i < count;) {
        const auto threeAt = [&](int at, const char* what) {
            return Vector3d(numberAt(arguments, at, what), numberAt(arguments, at + 1, what), numberAt(arguments, at + 2, what));
        };
        const auto is = [&](const char* word, int values) { return !strcmp(arguments[i], word) && i + values < count; };
        if (is("plane", 6)) {
            planes.push_back({ threeAt(i + 1, "plane"), threeAt(i + 4, "plane") });
            if (!(planes.back().normal.norm() > 0))
                error->all(FLERR, "{}: plane {} has a normal of length 0", style, planes.size());
            planes.back().normal.normalize();
            i += 7;
        } else if (is("stl", 1)) {
            file = arguments[i + 1];
            i += 2;
        } else if (is("scale", 1)) {
            scale = numberAt(arguments, i + 1, "scale");
            if (!(scale > 0))
                error->all(FLERR, "{}: scale = {}: it must be above 0", style, scale);
            i += 2;
        } else if (is("flat", 1)) {
            how.flat_regularisation = numberAt(arguments, i + 1, "flat");
            if (!(how.flat_regularisation >= 0 && how.flat_regularisation <= 0.1))
                error->all(FLERR, "{}: flat = {}: it must lie in [0, 0.1]", style, arguments[i + 1]);
            i += 2;
        } else if (is("linear", 3)) {
            linear = threeAt(i + 1, "linear");
            i += 4;
        } else if (is("rotate", 7)) {
            centre = threeAt(i + 1, "rotate");
            axis = threeAt(i + 4, "rotate");
            const double period = numberAt(arguments, i + 7, "period");
            if (!(axis.norm() > 0) || period == 0)
                error->all(FLERR, "{}: rotate needs an axis of some length and a period other than 0", style);
            axis.normalize();
            rate = 2 * M_PI / period;
            i += 8;
        } else
            error->all(FLERR, "{}: '{}': {}", style, arguments[i], expected);
    }
    if (!file.empty()) {
        try {
            mesh = std::make_unique<Mesh>(fileForAll(lmp, file), file, scale);
        } catch (const std::runtime_error& refused) {
            error->all(FLERR, std::string(refused.what()));
        }
    }
    if (planes.empty() && !mesh)
        error->all(FLERR, "{}: there is no wall: give plane or stl", style);
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
}

FixWall::~FixWall()
{
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
}

double FixWall::numberAt(char** arguments, int i, const char* what) const
{
    const double value = utils::numeric(FLERR, arguments[i], false, lmp);
    if (!std::isfinite(value))
        error->all(FLERR, "{}: {} = {}: it must be finite", style, what, arguments[i]);
    return value;
}

int FixWall::setmask() { return FixConst::POST_FORCE; }

void FixWall::init() { shapes = FixShapes::of(lmp, style); }

FixWall::Frame FixWall::frameNow() const
{
    const double time = update->atime + static_cast<double>(update->ntimestep - update->atimestep) * update->dt;
    return { Quaterniond(Eigen::AngleAxisd(std::fmod(rate * time, 2 * M_PI), axis)), centre + time * linear, linear, rate * axis };
}

Vector3d FixWall::intoWall(const Frame& frame, const Vector3d& x) const { return centre + frame.turn.conjugate() * (x - frame.origin); }

bool FixWall::shareVertex(int element, int other) const
{
    const int first = static_cast<int>(planes.size());
    if (element < first || other < first)
        return false;
    const auto &mine = mesh->triangle(element - first), &its = mesh->triangle(other - first);
    return std::any_of(mine.begin(), mine.end(), [&](int v) { return std::find(its.begin(), its.end(), v) != its.end(); });
}

void FixWall::post_force(int)
{
    own[contacts] = own[elastic] = own[forceX] = own[forceY] = own[forceZ] = 0;
    const Frame frame = frameNow();
    const bool advance = !update->setupflag;
    size_t most = 0;
    for (int i = 0; i < atom->nlocal; ++i)
        if (atom->mask[i] & groupbit) {
            meet(i, frame, advance);
            most = std::max(most, around[i].known.size());
        }
    maxexchange = 1 + static_cast<int>(most) * savedSize;
}

double FixWall::ballDistance(int element, const Vector3d& position, double radius) const
{
    const int triangle = element - static_cast<int>(planes.size());
    if (triangle < 0)
        return std::abs(planes[element].normal.dot(position - planes[element].point)) - radius;
    const auto& corners = mesh->triangle(triangle);
    const Vector3d &a = mesh->vertex(corners[0]), normal = (mesh->vertex(corners[1]) - a).cross(mesh->vertex(corners[2]) - a);
    return std::abs(normal.dot(position - a)) / normal.norm() - radius;
}

// All elements that the body can touch before it has come by the skin.
void FixWall::lookAround(Surroundings& here, double radius)
{
    const Vector3d position(here.last.position);
    const int firstTriangle = static_cast<int>(planes.size());
    here.way = 0;
    here.limit = neighbor->skin;
    here.elements.clear();
    candidates.clear();
    if (mesh)
        mesh->near(position, radius + here.limit, candidates);
    for (int p = -firstTriangle; p < 0; ++p)
        candidates.push_back(p);
    for (int candidate : candidates) {
        const int element = candidate + firstTriangle;
        const double distance = ballDistance(element, position, radius);
        if (!(distance > here.limit))
            here.elements.push_back({ element, distance });
    }
}

// All contacts of an atom with the wall.
void FixWall::meet(int i, const Frame& frame, bool advance)
{
    const Shape& shape = shapes->shape(atom->type[i]);
    Surroundings& here = around[i];
    const Vector3d position = intoWall(frame, Vector3d(atom->x[i]));
    const double* q = shapes->orientations()[i];
    const Quaterniond turned = frame.turn.conjugate() * Quaterniond(q[0], q[1], q[2], q[3]);
    const pp_pose pose { { position[0], position[1], position[2] }, { turned.w(), turned.x(), turned.y(), turned.z() } };
    here.way += wayBetween(here.last, pose, shape.radius);
    here.last = pose;
    if (!std::isfinite(here.way))
        error->one(FLERR, "{}: atom {} has the position {} {} {}, orientation {} {} {} {}: they must be finite; a smaller timestep or softer contacts may help",
            style, atom->tag[i], atom->x[i][0], atom->x[i][1], atom->x[i][2], q[0], q[1], q[2], q[3]);
    if (!(here.way < here.limit))
        lookAround(here, shape.radius);
    if (here.elements.empty()) {
        here.known.clear();
        return;
    }
    solve(i, shape, here);
    for (size_t n = 0; n < touched.size(); ++n)
        now[slotOf[n]].touches = !yields(touched[n]);
    for (size_t n = 0; n < touched.size(); ++n)
        if (now[slotOf[n]].touches)
            applyLaw(i, frame, advance, touched[n].found, now[slotOf[n]], here);
    for (Known& one : now)
        if (!one.touches)
            one.history.touching = false;
    here.known.swap(now);
}

// Fills `now`, with a memory for each element that touches or nearly does, and `touched`.
void FixWall::solve(int i, const Shape& shape, Surroundings& here)
{
    const int firstTriangle = static_cast<int>(planes.size());
    now.clear();
    touched.clear();
    slotOf.clear();
    for (Asleep& one : here.elements) {
        if (here.way < one.wake)
            continue;
        const int element = one.element;
        const auto old = std::find_if(here.known.begin(), here.known.end(), [&](const Known& k) { return k.element == element; });
        Known next = old != here.known.end() ? *old : Known { element, false, {}, {} };
        next.touches = false;
        pp_flat_contact found;
        const pp_status status = element < firstTriangle
            ? pp_contact_plane(shape.particle.get(), &here.last, planes[element].point.data(), planes[element].normal.data(), &how, &next.state, &found)
            : pp_contact_triangle(shape.particle.get(), &here.last, mesh->points(element - firstTriangle).data(), &how, &next.state, &found);
        if (status != PP_OK) {
            const double *x = here.last.position, *q = here.last.orientation;
            error->one(FLERR, "{}: the contact of atom {} with {} {} failed: {}. Shape {}; pose in the wall's frame {:.17g} {:.17g} {:.17g}, {:.17g} {:.17g} {:.17g} {:.17g}",
                style, atom->tag[i], element < firstTriangle ? "plane" : "triangle", element < firstTriangle ? element + 1 : element - firstTriangle + 1,
                pp_status_message(status), shape.name, x[0], x[1], x[2], q[0], q[1], q[2], q[3]);
        }
        if (found.kind == PP_SEPARATED && found.distance > farShare * shape.radius) {
            one.wake = here.way + found.distance;
            continue;
        }
        if (found.kind == PP_OVERLAPPING) {
            slotOf.push_back(static_cast<int>(now.size()));
            touched.push_back({ element - firstTriangle, found, uncertaintyOf(found, shape.radius) });
        }
        now.push_back(next);
    }
}

bool FixWall::yields(const TriangleContact& one) const
{
    return one.triangle >= 0 && std::any_of(touched.begin(), touched.end(), [&](const TriangleContact& other) {
        return other.triangle >= 0 && other.triangle != one.triangle && yieldsTo(*mesh, other, one);
    });
}

void FixWall::applyLaw(int i, const Frame& frame, bool advance, const pp_flat_contact& found, Known& contact, Surroundings& here)
{
    // A contact that comes over a seam takes its history along.
    if (!contact.history.touching)
        for (Known& left : here.known)
            if (left.history.touching && shareVertex(left.element, contact.element)
                && std::none_of(now.begin(), now.end(), [&](const Known& k) { return k.touches && k.element == left.element; })) {
                contact.history = left.history;
                left.history.touching = false;
                break;
            }
    const Vector3d turn(atom->omega[i]), arm = frame.turn * Vector3d(found.branch);
    ContactMotion motion;
    motion.overlap = found.overlap;
    motion.normal = frame.turn * Vector3d(found.normal);
    const Vector3d ofWall = frame.velocity + frame.angularVelocity.cross(Vector3d(atom->x[i]) + arm - frame.origin);
    motion.velocity = ofWall - Vector3d(atom->v[i]) - turn.cross(arm);
    motion.spin = 0.5 * motion.normal.dot(turn + frame.angularVelocity);
    motion.mass = atom->rmass[i];
    const ContactForce force = contactForce(law, motion, update->dt, advance, contact.history);
    Map<Vector3d>(atom->f[i]) -= force.onB;
    Map<Vector3d>(atom->torque[i]) -= arm.cross(force.onB);
    own[contacts] += 1;
    own[elastic] += force.elastic;
    own[slid] += force.slid;
    own[damped] += force.damped;
    for (int d = 0; d < 3; ++d)
        own[forceX + d] += force.onB[d];
}

int FixWall::touching(int i) const
{
    return static_cast<int>(std::count_if(around[i].known.begin(), around[i].known.end(), [](const Known& one) { return one.touches; }));
}

double FixWall::compute_vector(int n)
{
    double all = 0;
    MPI_Allreduce(&own[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

int FixWall::pack(int i, double* buffer) const
{
    int m = 0;
    buffer[m++] = touching(i);
    for (const Known& one : around[i].known) {
        if (!one.touches)
            continue;
        buffer[m++] = one.element;
        for (const Vector3d* part : { &one.history.shear, &one.history.normal, &one.history.damping })
            for (int d = 0; d < 3; ++d)
                buffer[m++] = (*part)[d];
        for (double x : one.state.solution)
            buffer[m++] = x;
    }
    return m;
}

int FixWall::unpack(int i, const double* buffer)
{
    int m = 0;
    around[i] = {};
    around[i].known.resize(static_cast<size_t>(buffer[m++]));
    for (Known& one : around[i].known) {
        one.element = static_cast<int>(buffer[m++]);
        one.touches = one.history.touching = true;
        for (Vector3d* part : { &one.history.shear, &one.history.normal, &one.history.damping })
            for (int d = 0; d < 3; ++d)
                (*part)[d] = buffer[m++];
        for (double& x : one.state.solution)
            x = buffer[m++];
    }
    return m;
}

int FixWall::pack_exchange(int i, double* buffer) { return pack(i, buffer); }

int FixWall::unpack_exchange(int i, double* buffer) { return unpack(i, buffer); }

int FixWall::pack_restart(int i, double* buffer)
{
    const int size = 1 + pack(i, buffer + 1);
    buffer[0] = size;
    return size;
}

void FixWall::unpack_restart(int i, int nth)
{
    const double* extra = atom->extra[i];
    for (int n = 0; n < nth; ++n)
        extra += static_cast<int>(extra[0]);
    unpack(i, extra + 1);
}

int FixWall::maxsize_restart()
{
    int most = 2;
    for (int i = 0; i < atom->nlocal; ++i)
        most = std::max(most, size_restart(i));
    return most;
}

void FixWall::write_restart(FILE* out)
{
    double all[2] = {};
    MPI_Reduce(&own[slid], all, 2, MPI_DOUBLE, MPI_SUM, 0, world);
    if (comm->me == 0) {
        const int size = sizeof all;
        fwrite(&size, sizeof size, 1, out);
        fwrite(all, sizeof all, 1, out);
    }
}

void FixWall::restart(char* saved)
{
    if (comm->me == 0)
        std::memcpy(&own[slid], saved, 2 * sizeof(double));
}

double FixWall::memory_usage()
{
    double bytes = static_cast<double>(around.capacity() * sizeof(Surroundings));
    for (const Surroundings& here : around)
        bytes += static_cast<double>(here.elements.capacity() * sizeof(Asleep) + here.known.capacity() * sizeof(Known));
    return bytes;
}

} // namespace potential_particles
