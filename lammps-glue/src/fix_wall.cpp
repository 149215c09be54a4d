// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall.hpp"
#include "entered.hpp"
#include "fix_nve.hpp"
#include "fix_shapes.hpp"

#include "plugin-common/motion_bound.hpp"
#include "plugin-common/new_contact.hpp"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace potential_particles {
namespace {

    constexpr double mostRadii = 1e9; // coordinates are then rounded by 1e-7 of a body
    constexpr double onePlane = 1e-6; // of a radius, and as an angle: planes that are no farther apart are one

} // namespace

FixWall::~FixWall()
{
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
}

int FixWall::setmask() { return FixConst::POST_FORCE; }

void FixWall::init()
{
    shapes = FixShapes::of(lmp, std::string("fix ") + style);
    checkPlace();
    checkedStep = -1;
}

// Coordinates are rounded: where they are too large beside a body, its contacts would be rounding.
void FixWall::checkPlace() const
{
    double farthest = centre.lpNorm<Eigen::Infinity>();
    for (const Plane& plane : planes)
        farthest = std::max(farthest, plane.point.lpNorm<Eigen::Infinity>());
    if (mesh)
        farthest
            = std::max({ farthest, mesh->low().lpNorm<Eigen::Infinity>(), mesh->high().lpNorm<Eigen::Infinity>() });
    if (farthest > mostRadii * shapes->smallestRadius())
        error->all(FLERR,
                   "fix {} {}: it has a coordinate of {}, beyond {} radii of the smallest body, {}: put it nearer to "
                   "the origin",
                   id, style, farthest, mostRadii, shapes->smallestRadius());
    const double close = onePlane * shapes->smallestRadius();
    for (size_t i = 0; i < planes.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (planes[i].normal.cross(planes[j].normal).norm() < onePlane
                && std::abs(planes[i].normal.dot(planes[i].point - planes[j].point)) < close)
                error->all(FLERR,
                           "fix {} {}: planes {} and {} are one, and would push bodies twice: a plane has two sides; "
                           "leave one out",
                           id, style, j + 1, i + 1);
}

void FixWall::setup(int flags)
{
    checkBorder();
    post_force(flags);
}

// As for contacts of pairs. Of a patch the area is not known before there is one.
void FixWall::checkTimeStep()
{
    if (byPatch || checkedStep == update->dt)
        return;
    checkedStep = update->dt;
    const int moving = FixNve::groups(lmp);
    std::string why;
    for (int i = 0; i < atom->nlocal && why.empty(); ++i) {
        const double most = 2 * std::sqrt(atom->rmass[i] / law.stiffest());
        if ((atom->mask[i] & groupbit) && (atom->mask[i] & moving) && update->dt > most)
            why = fmt::format("{} {}: timestep = {}: a contact of atom {} is unstable above {}, and with levers well "
                              "below: take {} or less",
                              style, id, update->dt, atom->tag[i], most, 0.1 * most);
    }
    endWhereAny(lmp, why);
}

// A wall has no periodic images: the part of a body beyond a border does not meet the wall at the other side.
void FixWall::checkBorder() const
{
    if (comm->me != 0)
        return;
    const double reach = shapes->largestRadius();
    for (int d = 0; d < 3; ++d) {
        if (!domain->periodicity[d])
            continue;
        bool ends = false;
        for (const bool high : { false, true }) {
            const double border = high ? domain->boxhi[d] : domain->boxlo[d];
            for (const Plane& plane : planes) {
                const double slope = std::abs(plane.normal[d]);
                ends |= slope > 0 && (slope < 1 || std::abs(plane.point[d] - border) < reach);
            }
            ends |= mesh && std::abs((high ? mesh->high() : mesh->low())[d] - border) < reach;
        }
        if (ends)
            error->warning(FLERR,
                           "{} {}: the box is periodic in {}, the wall is not: bodies at the border do not meet the "
                           "wall at the other side; "
                           "extend the mesh by {} beyond the border, or leave that border free",
                           style, id, "xyz"[d], reach);
    }
}

double FixWall::timeNow() const
{
    return update->atime + static_cast<double>(update->ntimestep - update->atimestep) * update->dt;
}

FixWall::Frame FixWall::frameNow() const
{
    const double time = lastTime - start;
    return { Quaterniond(Eigen::AngleAxisd(std::fmod(rate * time, 2 * M_PI), axis)), centre + time * linear, linear,
             rate * axis };
}

Vector3d FixWall::intoWall(const Frame& frame, const Vector3d& x) const
{
    return centre + frame.turn.conjugate() * (x - frame.origin);
}

const Triangle* FixWall::triangleOf(int element) const
{
    const int triangle = element - static_cast<int>(planes.size());
    return triangle < 0 ? nullptr : &mesh->triangle(triangle);
}

bool FixWall::shareCorner(int element, int other) const
{
    const Triangle *mine = triangleOf(element), *its = triangleOf(other);
    return mine && its && SharedCorners::of(*mine, *its);
}

void FixWall::post_force(int)
{
    checkTimeStep();
    own[contacts] = own[elastic] = own[forceX] = own[forceY] = own[forceZ] = 0;
    withoutEnergy.clear();
    // Where the time was set anew since, the wall stays where it is.
    const double time = timeNow(), jump = time - lastTime - (update->setupflag ? 0 : update->dt);
    if (std::abs(jump) > 0.5 * update->dt)
        start += jump;
    lastTime = time;
    const Frame frame = frameNow();
    const bool advance = !update->setupflag;
    size_t most = 0;
    for (int i = 0; i < atom->nlocal; ++i)
        if (atom->mask[i] & groupbit) {
            meet(i, frame, advance);
            most = std::max(most, around[i].known.size());
        } else if (around[i].limit >= 0 || !around[i].known.empty()) // it has left the group
            forget(around[i]);
    maxexchange = withoutContacts + static_cast<int>(most) * savedSize();
}

double FixWall::ballDistance(int element, const Vector3d& position, double radius) const
{
    const Triangle* const triangle = triangleOf(element);
    if (!triangle)
        return std::abs(planes[element].normal.dot(position - planes[element].point)) - radius;
    const auto& [a, b, c] = *triangle;
    const Vector3d normal = (b - a).cross(c - a);
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

void FixWall::forget(Surroundings& here)
{
    for (const Known& one : here.known)
        own[changed] += one.joint.memory.energyAlong;
    here = {};
}

// All contacts of an atom with the wall.
void FixWall::meet(int i, const Frame& frame, bool advance)
{
    const Shape& shape = shapes->shape(atom->type[i]);
    Surroundings& here = around[i];
    const Vector3d position = intoWall(frame, Vector3d(atom->x[i]));
    const double* q = shapes->orientations()[i];
    const Quaterniond turned = frame.turn.conjugate() * Quaterniond(q[0], q[1], q[2], q[3]);
    const pp_pose pose { { position[0], position[1], position[2] },
                         { turned.w(), turned.x(), turned.y(), turned.z() } };
    if (here.mark != shape.mark) {
        forget(here);
        here.mark = shape.mark;
    }
    here.way = travelled(here.way, wayBetween(here.last, pose, shape.radius));
    here.last = pose;
    if (!std::isfinite(here.way))
        error->one(FLERR,
                   "{}: atom {} has the position {} {} {}, orientation {} {} {} {}: they must be finite; a smaller "
                   "timestep or softer contacts may help",
                   style, atom->tag[i], atom->x[i][0], atom->x[i][1], atom->x[i][2], q[0], q[1], q[2], q[3]);
    if (!(here.way < here.limit))
        lookAround(here, shape.radius);
    if (here.elements.empty()) {
        here.known.clear();
        return;
    }
    solve(i, shape, here);
    for (size_t n = 0; n < touched.size(); ++n)
        now[slotOf[n]].touches = byPatch || !leavesToAnother(touched[n], shape.radius);
    for (size_t n = 0; n < touched.size(); ++n)
        if (byPatch)
            applyPatchLaw(i, shape, frame, advance, touched[n], now[slotOf[n]], here.last);
        else if (now[slotOf[n]].touches)
            applyLaw(i, frame, advance, touched[n].found, now[slotOf[n]], here);
    // Where the body has left the wall, springs along it go with what they hold.
    for (const Known& old : here.known)
        if (old.joint.touching && std::none_of(now.begin(), now.end(), [&](const Known& k) {
                return k.touches && k.element == old.element;
            }))
            own[changed] += old.joint.memory.energyAlong;
    for (Known& one : now)
        if (!one.touches) {
            one.history.touching = false;
            one.joint = {};
        }
    here.known.swap(now);
}

// Fills `now`, with a memory for each element that touches or nearly does, and `touched`.
void FixWall::solve(int i, const Shape& shape, Surroundings& here)
{
    now.clear();
    touched.clear();
    slotOf.clear();
    for (Asleep& one : here.elements) {
        if (here.way < one.wake)
            continue;
        const int element = one.element;
        const Triangle* const triangle = triangleOf(element);
        const auto old
            = std::find_if(here.known.begin(), here.known.end(), [&](const Known& k) { return k.element == element; });
        Known next = old != here.known.end() ? *old : Known { element };
        const bool touchedBefore = next.touches;
        next.touches = false;
        if (neighbor->ago == 0) { // what the library remembers neither migrates nor is in files: it is dropped for all
            next.patch.reset();
            next.state = {};
        }
        pp_flat_contact found;
        const auto detect = [&] {
            if (triangle)
                return pp_contact_triangle(shape.particle.get(), &here.last, numbersOf(*triangle), &how, &next.state,
                                           &found);
            const Plane& plane = planes[element];
            return pp_contact_plane(shape.particle.get(), &here.last, plane.point.data(), plane.normal.data(), &how,
                                    &next.state, &found);
        };
        const pp_status status = fromNothingIfNew(detect(), found, touchedBefore, &next.state, detect);
        if (status != PP_OK) {
            const double *x = here.last.position, *q = here.last.orientation;
            error->one(FLERR,
                       "{}: the contact of atom {} with {} {} failed: {}. Shape {}; pose in the wall's frame {:.17g} "
                       "{:.17g} {:.17g}, {:.17g} {:.17g} {:.17g} {:.17g}",
                       style, atom->tag[i], triangle ? "triangle" : "plane",
                       1 + element - (triangle ? static_cast<int>(planes.size()) : 0), pp_status_message(status),
                       shape.name, x[0], x[1], x[2], q[0], q[1], q[2], q[3]);
        }
        if (found.kind == PP_SEPARATED && found.distance > farShare * shape.radius) {
            one.wake = wakesAt(here.way, found.distance);
            continue;
        }
        if (found.kind == PP_OVERLAPPING) {
            slotOf.push_back(static_cast<int>(now.size()));
            touched.push_back({ element, found });
        }
        now.push_back(next);
    }
}

bool FixWall::leavesToAnother(const Touched& one, double radius) const
{
    const auto contactOf = [&](const Touched& touch) {
        return TriangleContact { *triangleOf(touch.element), touch.found, touch.element, onSeam * radius };
    };
    constexpr unsigned all = 7; // its corners
    if (!triangleOf(one.element) || !liesOn(contactOf(one), all))
        return false;
    return std::any_of(touched.begin(), touched.end(), [&](const Touched& other) {
        return triangleOf(other.element) && other.element != one.element && leavesTo(contactOf(one), contactOf(other));
    });
}

void FixWall::applyLaw(int i, const Frame& frame, bool advance, const pp_flat_contact& found, Known& contact,
                       Surroundings& here)
{
    // A contact that crosses a seam keeps its history.
    if (!contact.history.touching)
        for (Known& left : here.known)
            if (left.history.touching && shareCorner(left.element, contact.element)
                && std::none_of(now.begin(), now.end(),
                                [&](const Known& k) { return k.touches && k.element == left.element; })) {
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
    push(i, force.onB, -arm.cross(force.onB), { force.elastic, force.slid, force.damped, 0, 0 });
}

void FixWall::push(int i, const Vector3d& onWall, const Vector3d& torque, const JointEnergies& energies)
{
    Map<Vector3d>(atom->f[i]) -= onWall;
    Map<Vector3d>(atom->torque[i]) += torque;
    own[contacts] += 1;
    own[elastic] += energies.elastic;
    own[slid] += energies.friction;
    own[damped] += energies.viscous;
    own[changed] += energies.area;
    own[broke] += energies.breaking;
    for (int d = 0; d < 3; ++d)
        own[forceX + d] += onWall[d];
}

pp_status FixWall::findPatch(const WallPatch& one, uint32_t withEnergy, pp_patch_state* state, pp_patch* patch) const
{
    return one.triangle
        ? pp_patch_on_triangle(one.particle, &one.pose, numbersOf(*one.triangle), one.fromFront, &one.found,
                               patchTolerance, withEnergy, state, patch, nullptr, 0, nullptr)
        : pp_patch_on_plane(one.particle, &one.pose, &one.found, patchTolerance, withEnergy, state, patch, nullptr, 0,
                            nullptr);
}

// In world axes.
std::optional<PatchInStep> FixWall::patchOn(int i, const Shape& shape, const Frame& frame, const Touched& touch,
                                            Known& contact, const pp_pose& pose)
{
    const pp_flat_contact& found = touch.found;
    if (!contact.patch)
        contact.patch = std::make_shared<KeptPatch>();
    const Triangle* const triangle = triangleOf(touch.element);
    bool fromFront = false;
    if (triangle) {
        // The body stays on the side on which the contact began.
        const auto& [a, b, c] = *triangle;
        const Vector3d front = (b - a).cross(c - a);
        const Vector3d towardsWall
            = contact.joint.touching ? frame.turn.conjugate() * contact.joint.normal : Vector3d(found.normal);
        fromFront = towardsWall.dot(front) < 0;
    }
    WallPatch one { shape.particle.get(), pose, triangle, fromFront, found, contact.patch };
    pp_patch patch;
    const pp_status status = findPatch(one, 0, &contact.patch->ofForce, &patch);
    const Vector3d x(atom->x[i]);
    const Eigen::Matrix3d turn = frame.turn.toRotationMatrix();
    if (auto here = PatchInStep::of(status, patch)) {
        withoutEnergy.push_back(std::move(one));
        here->point = x + turn * Vector3d(patch.branch_a);
        here->normal = turn * here->normal;
        here->patch.centroid = turn * here->patch.centroid;
        here->patch.secondMoment = turn * here->patch.secondMoment * turn.transpose();
        return here;
    }
    double area = 0; // stays 0 where they overlap by nothing but rounding
    pp_flat_contact_area(one.particle, &pose, &found, areaTolerance, &area);
    const Vector3d normal = turn * Vector3d(found.normal);
    return PatchInStep { ContactPatch::disc(area, found.overlap, normal), x + turn * Vector3d(found.branch), normal };
}

void FixWall::applyPatchLaw(int i, const Shape& shape, const Frame& frame, bool advance, const Touched& touch,
                            Known& contact, const pp_pose& pose)
{
    const double mass = atom->rmass[i];
    const double* q = shapes->orientations()[i];
    JointBody body {
        Vector3d(atom->x[i]), Quaterniond(q[0], q[1], q[2], q[3]), Vector3d(atom->v[i]), Vector3d(atom->omega[i]), {}
    };
    body.mass
        = { Vector3d::Constant(1 / mass), shape.volume / mass * shape.moments.cwiseInverse(), body.centre, body.turn };
    const JointBody wall { frame.origin, frame.turn, frame.velocity, frame.angularVelocity, {} };
    const std::optional<PatchInStep> here = patchOn(i, shape, frame, touch, contact, pose);
    if (!contact.joint.touching)
        contact.joint.memory.broken = update->ntimestep >= wholeBefore;
    const JointSides sides { shapes->sideOf(i, contact.joint.memory, true), {} };
    const JointForces forces = jointForces(joint, contact.joint, body, wall, sides, here, update->dt, advance,
                                           [](int) { return PosedShape {}; });
    const double square = 4 * mass / forces.normalStiffness;
    if (update->dt * update->dt > square)
        error->one(FLERR,
                   "{}: timestep = {}: the joint of atom {} with the wall, of stiffness {}, is unstable above {}, and "
                   "with levers well below: take {} or less",
                   style, update->dt, atom->tag[i], forces.normalStiffness, std::sqrt(square), 0.1 * std::sqrt(square));
    push(i, forces.onOther.force, forces.onOne.torque, forces.energies);
}

double FixWall::memory_usage()
{
    double bytes = static_cast<double>(around.capacity() * sizeof(Surroundings));
    for (const Surroundings& here : around)
        bytes += static_cast<double>(here.elements.capacity() * sizeof(Asleep) + here.known.capacity() * sizeof(Known));
    return bytes;
}

} // namespace potential_particles
