/*
 * potential_particles.h - contact between potential particles (Houlsby 2009).
 *
 * Generated from src/capi by cbindgen; do not edit. MIT OR Apache-2.0.
 *
 * A particle is a convex shape given by planes (a, b, c, d), a rounding radius r, a sphericity k
 * and the radius R of a shadow sphere:
 *     S(x) = (1-k)/r^2 * sum <a x + b y + c z - d>^2 + k/R^2 * |x|^2,   f(x) = S(x) - 1,
 * with <t> = max(t, 0); f < 0 inside, f = 0 on the surface. pp_contact_detect finds the contact
 * of two of them.
 *
 * Conventions, the same for every function
 *   Result    An int32_t status: PP_OK (0) or a positive code; pp_status_message gives its sentence.
 *             Codes are integers; numbers are never reused. A failed solve is a status of its own
 *             and never reads as "separated".
 *   Order     Inputs first, then the state of the pair, then outputs.
 *   Outputs   Written only when the call returns PP_OK. Exceptions: message buffers, which are written
 *             on failure and always end with a zero byte; counts, and the error of pp_particle_mesh,
 *             also with PP_BUFFER_TOO_SMALL; the arrays of a batch, pair by pair.
 *   Ownership What pp_..._new gives, pp_..._free takes back, once. Everything else stays the
 *             caller's: the library keeps no pointer after a call returns.
 *   NULL      Refused with PP_NULL_POINTER unless a parameter says that it may be NULL; an array of no
 *             elements may be NULL. "Pointers" names what else a caller must hold to; any pointer that
 *             is not NULL points to as many valid, aligned objects as the call says.
 *   Numbers   NaN and infinity are refused with a status that says where they were, except in values that
 *             are not used (r for k = 1, R for k = 0) and in what the library fills itself (states of pairs).
 *   Units     Any consistent length unit. Rotations by quaternion w, x, y, z, local to world; in the
 *             plane about z.
 *   Threads   Particles never change after creation: any number of threads may share them. A
 *             pp_pair_state or an output belongs to one call at a time. Nothing is shared between calls.
 *             Only functions that take a number of threads start any, and end them before they return.
 *   Errors    No panic and no exception leaves the library, and nothing is printed. Where memory runs
 *             out the process is aborted, as by all of Rust.
 *   Layout    Structs have the same layout on every platform with 8-byte doubles; reserved fields
 *             must be 0. pp_abi_version and pp_struct_size tell whether a loaded library fits.
 *
 * In short
 *     pp_particle *cube = NULL;
 *     char why[PP_MESSAGE_SIZE];
 *     if (pp_particle_new(planes, 6, r, k, R, &cube, why, sizeof why) != PP_OK) {
 *         puts(why);
 *         return 1;
 *     }
 *     pp_contact contact;
 *     pp_pair_state state = {0};
 *     if (pp_contact_detect(cube, &pose_a, cube, &pose_b, NULL, &state, &contact) == PP_OK &&
 *         contact.kind == PP_OVERLAPPING) { ... contact.normal, contact.overlap ... }
 *     pp_particle_free(cube);
 * A whole step at once, on several threads: pp_contact_detect_batch.
 */


#ifndef POTENTIAL_PARTICLES_H
#define POTENTIAL_PARTICLES_H

#include <stddef.h>
#include <stdint.h>

// Version of this header; compare with pp_version of the library that was loaded.
#define PP_VERSION_MAJOR 0

// Grows with additions (or, while the major version is 0, with any change of the interface).
#define PP_VERSION_MINOR 2

// Grows with corrections that leave the interface as it is.
#define PP_VERSION_PATCH 0

// Number of the binary interface: it grows by 1 whenever a program compiled with an older header could
// not use the library (a struct, a function or the meaning of a number has changed), and not with
// additions. A program that loads the library should refuse to go on unless pp_abi_version() ==
// PP_ABI_VERSION.
#define PP_ABI_VERSION 3

// The point on the boundary lies on the plane, or inside the triangle.
#define PP_ON_INTERIOR 0

// It lies on the edge from vertex 0 to 1; PP_ON_EDGE + 1: from 1 to 2; PP_ON_EDGE + 2: from 2 to 0.
#define PP_ON_EDGE 1

// It is vertex 0; PP_ON_VERTEX + i: vertex i.
#define PP_ON_VERTEX 4

// Most planes that a particle may have.
#define PP_MAX_PLANES 65536

// Size of a message buffer that holds every message whole.
#define PP_MESSAGE_SIZE 512

// Formulation "midway" (paper eqs 4 and 44): minimise t with s_A <= t and s_B <= t.
#define PP_MIDWAY 0

// Formulation "closest" (paper eqs 3, 9, 34-43): minimise s_A with s_B <= 1, and the swap.
#define PP_CLOSEST 1

// The library's own solver, in doubles and, where those do not settle a pair, in extended precision.
#define PP_FAST 0

// The paper's second-order cone programs, solved by clarabel: slow; independent of PP_FAST, to check it.
// Refused with PP_NO_CONE_PROGRAM by a library built without it (Cargo feature cone-program).
#define PP_CONE_PROGRAM 1

// The two particles share no interior point: s >= 1.
#define PP_SEPARATED 1

// The two particles overlap: s < 1.
#define PP_OVERLAPPING 2

// pp_closest_point: the point P1 on A, where s_B is least.
#define PP_ON_A 0

// pp_closest_point: the point P2 on B, where s_A is least.
#define PP_ON_B 1

// "closest" was asked for and has no answer: the centre (for k = 0, the core) of one particle lies inside
// the other, or may do so within rounding, and |P1 - P2| is no overlap then. All fields are those of midway.
#define PP_FLAG_SLACK 1

// Separation was proved without solving to the end: s is a proved lower bound >= 1; of the geometry only
// distance is set.
#define PP_FLAG_REJECTED 2

// Both gradients vanish at the contact point, as when the centres coincide: no normal is right, and
// the one given is the line of centres, or the x axis of B.
#define PP_FLAG_NORMAL_BY_CENTRES 4

// Started from the solution that the pair remembers (pp_pair_state).
#define PP_FLAG_WARM 8

// Answered in extended precision (about 32 digits): doubles did not settle it, or not to the gap asked for.
#define PP_FLAG_EXTENDED 16

// Carried on from the last contact, without a solution from the planes (carry_tolerance); with
// PP_FLAG_REJECTED from where the pair was last solved apart.
#define PP_FLAG_CARRIED 32

// The gap is above the tolerance asked for: rounding allows no better. It is still a bound.
#define PP_FLAG_ROUNDING_LIMITED 64

// Rejected by balls: two that hold the particles do not meet.
#define PP_FLAG_BY_SPHERES 128

// Rejected by a face: one particle lies beyond a face of the other.
#define PP_FLAG_BY_FACE 256

// Rejected from memory: what separated the pair at the last call still does.
#define PP_FLAG_BY_MEMORY 512

// flat_regularisation was raised, and its default value was used in this call instead: the raised one
// would have left open whether the particles overlap.
#define PP_FLAG_DEFAULT_REGULARISATION 1024

// The gradient vanishes on a flat boundary, as when the centre of the particle lies on it: the normal is the
// boundary's own.
#define PP_FLAG_NORMAL_BY_BOUNDARY 2048

// Closest: both points are free to move along flat faces (k = 0), so that the overlap, their distance, has a
// part along these, up to what the faces have in common; or they are farther apart along the surface than
// across it, as with faces that are nearly flat. It is the answer by definition, but not a depth: midway's
// overlap is.
#define PP_FLAG_FREE 4096

// The overlap is larger than the depth length of one of the particles (r for k = 0, R for a sphere): the bodies
// are deeper in each other than the potential is made for, and normal and overlap may jump.
#define PP_FLAG_DEEP 8192

// The patch turns back under itself, as in deep overlaps of round bodies, or ends where no ray goes on. What
// turns back is part of the answer, but a part that no ray from the contact point reaches may be missing,
// which the estimated error does not tell: the far side of a rod that goes through the other body.
#define PP_PATCH_FOLDED 1

// The tolerance was not reached with the most rays (1500, or two million planes looked at), or is beyond what
// rounding allows where the bodies hardly touch (overlaps of 1e-11 of their size at 1e-4); error tells how far
// off the answer may be.
#define PP_PATCH_TOLERANCE_NOT_REACHED 2

// The contact point lies in the core of both bodies, or the boundary reaches through that of A (s is 0 or
// nearly): the patch is that of slightly rounder bodies.
#define PP_PATCH_DEEP 4

// No patch was found around the contact point, and force and area are 0: an overlap within rounding.
#define PP_PATCH_EMPTY 8

// The patch follows from that of an earlier pose by its stiffness (struct pp_patch_state): it has no
// points, and area and moments are those of that pose.
#define PP_PATCH_CARRIED 16

// Whether a plane is active at the contact point, or at a surface point, is uncertain within the bound on that
// point. The derivatives are those with the plane inactive; the derivative of s is the same either way.
#define PP_DERIVATIVE_SWITCHING 1

// Flat faces or edges touch (k = 0, or nearly): along them flat_regularisation alone holds the point, whose
// derivatives may be as large as 1/flat_regularisation, and hold for motions of about its size only. Raise it
// for derivatives of practical use.
#define PP_DERIVATIVE_FREE 2

// The contact is separated: overlap and surface points have no derivatives, and are NaN.
#define PP_DERIVATIVE_SEPARATED 4

// Fewer than four digits may be right: depths of active planes are of the size of their rounding (at a
// boundary, by bodies whose r is 1e-11 of their size), or planes switch even in 32 digits.
#define PP_DERIVATIVE_IMPRECISE 8

// A validated particle. Created by pp_particle_new, released by pp_particle_free; immutable,
// so that bodies and threads may share one.
typedef struct pp_particle pp_particle;

// What every function of the C interface returns: PP_OK or a positive code.
typedef int32_t pp_status;

// Where a body is: world = rotation(orientation) * local + position.
typedef struct pp_pose {
    // Centre of the particle (origin of its local frame), world frame, length units of the caller.
    double position[3];
    // Quaternion w, x, y, z, local to world. Normalised by the library; any length in
    // [1e-150, 1e150] will do.
    double orientation[4];
} pp_pose;

// How to solve: the defaults, changed where needed. In C pp_settings_default fills them in, and a NULL pointer
// in place of a pp_settings means the defaults.
typedef struct pp_settings {
    // PP_MIDWAY (default) or PP_CLOSEST.
    uint32_t formulation;
    // PP_FAST (default) or PP_CONE_PROGRAM.
    uint32_t back_end;
    // 0 (default): a separated pair may be answered by a proof of separation alone
    // (PP_FLAG_REJECTED). 1: always solve, so that s, point and normal are set.
    uint32_t solve_separated;
    // Must be 0.
    uint32_t reserved;
    // Relative gap of s^2 at which the solver may stop; in (0, 0.1], default 1e-12, a decade above what
    // rounding leaves for well-conditioned pairs. Where rounding leaves more, the answer has
    // PP_FLAG_ROUNDING_LIMITED. Below 1e-13 the solver goes on in extended precision (some
    // 10 us) until the gap is what was asked for: 1e-14 gives s, and points, to the last digits of a double.
    double gap_tolerance;
    // Weight of the point on A in the contact point of PP_CLOSEST: point = w*P1 + (1-w)*P2, in
    // [0, 1], default 0.5 (equal stiffness). Paper: relative stiffness of the particles.
    double weight_on_a;
    // Where k is below this, the contact point on a flat face is chosen as if k were this value (about a sphere
    // of the bounding radius); shape, s and overlap stay those of the given k within the gap, which grows by at
    // most this value. In [0, 0.1], default 1e-13, the smallest whose pull on a flat face of unit size exceeds
    // rounding; smaller values count as 1e-13. For exactly parallel faces any value gives the point nearest to
    // the centres. Raise it to 1e-4, say, when points on flat faces jump from step to step. It never decides
    // whether particles overlap: where it would, the default is used
    // (PP_FLAG_DEFAULT_REGULARISATION).
    double flat_regularisation;
    // 0 (default): every contact is solved. Above 0: a contact may be carried on from the last one of its
    // pair and not solved (PP_FLAG_CARRIED), where no plane can have switched and its point is
    // known to this share of the smaller bounding radius; a separated pair, as long as s is surely above 1. In
    // [0, 0.1]; 1e-9 is a good choice. Needs a pp_pair_state; contacts of
    // PP_CLOSEST and by PP_CONE_PROGRAM are always solved.
    double carry_tolerance;
} pp_settings;

// What one ordered pair (A, B), or a particle A and a flat boundary, keeps from call to call.
//
// Owned by the caller: set all bytes to 0 to begin with or to forget; copy it freely within a process. One
// caller at a time.
typedef struct pp_pair_state {
    // The last solution, from which the next call starts. Private to the library. It may be saved and loaded
    // again, with all other bytes 0: whatever it holds, an answer changes by no more than its gap.
    double solution[8];
    // What carry_tolerance needs of the last contact. Private to the library. Not to be saved, as answers
    // depend on it. It is used only for the two particles for which it was written, while they exist.
    double last_contact[40];
} pp_pair_state;

// The answer for one pair. Frames: world axes unless said otherwise; lengths in the caller's unit; s, weight
// and gap have no unit. Of particles in the plane every vector has z = 0. Fields that do not apply are NaN.
typedef struct pp_contact {
    // PP_SEPARATED or PP_OVERLAPPING. A failed solve has no kind: it returns a status.
    int32_t kind;
    // The formulation that the geometry below answers (PP_MIDWAY if PP_FLAG_SLACK is set).
    uint32_t formulation;
    // The back end that answered: PP_FAST or PP_CONE_PROGRAM.
    uint32_t back_end;
    // Sum of PP_FLAG_... bits.
    uint32_t flags;
    // Pairs of quadratics solved; rounds of a contact carried on; interior-point iterations of the cone-program
    // back end.
    uint32_t iterations;
    // Always 0.
    uint32_t reserved;
    // Midway: t, the common scale at which the two particles touch at one point; t < 1 overlap.
    // Closest: s_A at P2. Rejected pairs: a lower bound, >= 1. No unit.
    double s;
    // Closest: s_B at P1; NaN for midway.
    double s_b;
    // Weight u of B, in [0, 1]: (1-u) grad S_A + u grad S_B = 0 at the solution (closest: at P2).
    double weight;
    // Bound on the error of s, and of s_b: |s - s*| <= gap. Proved for answers in extended precision
    // (PP_FLAG_EXTENDED); in doubles rounding is counted to first order, so that it is an estimate
    // (docs/theory.md).
    double gap;
    // Estimated bound on the distance of the point (closest: of each of P1 and P2) to the exact optimum,
    // length: of first order in the rounding of the data.
    double point_bound;
    // Overlap (YADE: penetrationDepth), length, >= 0 when overlapping (0 where s < 1 by rounding alone); NaN
    // when separated.
    double overlap;
    // Unit contact normal, from A to B (positive force on B pushes it along +normal), from the gradients
    // of S_A and S_B; for k below flat_regularisation from those of the regularised shapes, so that it is
    // defined even where flat-faced cores overlap.
    double normal[3];
    // Contact point, world frame: P3 of midway, or the weighted mean of P1 and P2 of closest.
    double point[3];
    // Contact point minus position of A: exact lever arm even far from the world origin.
    double branch_a[3];
    // Contact point minus position of B.
    double branch_b[3];
    // Point on the surface of A inside B, world frame; P1 of closest. NaN when separated.
    double point_on_a[3];
    // Point on the surface of B inside A, world frame; P2 of closest. NaN when separated.
    double point_on_b[3];
    // Separated: lower bound on the distance between the two particles, length, with the rounding of s and
    // of their bounding volumes estimated; 0 when none is known.
    // NaN when overlapping.
    double distance;
} pp_contact;

// Volume and inertia of a particle of unit density, in its local frame.
typedef struct pp_mass_properties {
    // Volume, length^3.
    double volume;
    // Centroid, local frame. YADE wants it at the local origin.
    double centroid[3];
    // Inertia about the local origin for density 1: xx, yy, zz, xy, yz, zx of the integral of
    // (|x|^2 I - x x^T) dV, length^5.
    double inertia[6];
    // Estimated bound on the relative error of the volume and of every moment of inertia about an axis through
    // the origin, and of the centroid as a share of the radii of gyration. No unit.
    double error;
} pp_mass_properties;

// How a particle that was built stands in the frame of its planes or points: x_given = centroid +
// orientation x.
typedef struct pp_built {
    // Origin of the particle's frame, which is its centroid; in the given frame, length.
    double centroid[3];
    // Quaternion (w, x, y, z) of unit length, w >= 0, that turns from the particle's frame, whose axes are
    // principal axes of inertia, to the given one.
    double orientation[4];
    // Of the particle in its own frame, to 1e-6; with more than 30 planes to 1e-4.
    struct pp_mass_properties mass;
    // Volume of the sharp body that it was made of.
    double sharp_volume;
} pp_built;

// One closest point alone; frames and units as in struct pp_contact.
typedef struct pp_closest {
    // 1 when there is no such point: for PP_ON_A because the centre of B (for k = 0, its core) lies inside A,
    // for PP_ON_B the reverse. The numbers below are NaN then. Else 0.
    uint32_t slack;
    // Always 0.
    uint32_t reserved;
    // Scale of the other particle at the point: s_B at P1, s_A at P2. No unit.
    double s;
    // Bound on the error of s: |s - s*| <= gap (as in struct pp_contact).
    double gap;
    // Estimated bound on the distance of the point to the exact optimum, length.
    double point_bound;
    // P1 or P2, world frame.
    double point[3];
    // The point minus position of A: exact lever arm even far from the world origin.
    double branch_a[3];
    // The point minus position of B.
    double branch_b[3];
} pp_closest;

// Derivatives of a contact in the poses of A and B, as of struct pp_contact. Columns of each row: shift of A
// along x, y, z; rotation of A about x, y, z through its position (world axes, radians); then the same six
// of B.
// What is NaN in the contact is NaN here.
typedef struct pp_derivatives {
    // Sum of PP_DERIVATIVE_... bits.
    uint32_t flags;
    // Always 0.
    uint32_t reserved;
    // Of s.
    double s[12];
    // Of s_b; NaN for midway.
    double s_b[12];
    // Of overlap; NaN when separated.
    double overlap[12];
    // Of normal, a row for each of x, y, z.
    double normal[3][12];
    // Of point.
    double point[3][12];
    // Of point_on_a (of a boundary: on_particle); NaN when separated.
    double point_on_a[3][12];
    // Of point_on_b (of a boundary: on_boundary); of a pair NaN when separated.
    double point_on_b[3][12];
} pp_derivatives;

// Derivatives of the caller's cost with respect to the fields of a contact. For a field that is NaN in the
// contact the derivative must be 0.
typedef struct pp_contact_weights {
    // In s.
    double s;
    // In s_b.
    double s_b;
    // In overlap.
    double overlap;
    // In normal.
    double normal[3];
    // In point.
    double point[3];
    // In point_on_a (of a boundary: on_particle).
    double point_on_a[3];
    // In point_on_b (of a boundary: on_boundary).
    double point_on_b[3];
} pp_contact_weights;

// Derivatives of a cost with respect to the shape of a particle. Calls add to it: set all numbers, and the
// planes, to 0 first.
typedef struct pp_shape_gradient {
    // Four numbers for each plane of the particle, in a, b, c and d; the caller's memory.
    double *planes;
    // How many planes there is room for: those of the particle.
    size_t count;
    // In the rounding radius r.
    double r;
    // In the sphericity k; at k = 0 and 1 towards the inside of its range.
    double k;
    // In the radius R of the shadow sphere.
    double shadow_radius;
} pp_shape_gradient;

// Derivatives of a cost in the pose of a body.
typedef struct pp_pose_gradient {
    // In a shift, world axes.
    double shift[3];
    // In a turn about its position, world axes, per radian.
    double turn[3];
} pp_pose_gradient;

// The contact of a particle A with a flat boundary T, a plane or a closed triangle of no thickness. World
// axes; lengths in the caller's unit; s and gap have no unit. Fields that do not apply are NaN.
//
// x* is the point of T where the scale s of A is least. A overlaps T if that scale is below 1.
typedef struct pp_flat_contact {
    // PP_SEPARATED or PP_OVERLAPPING. A failed solve has no kind: it returns a status.
    int32_t kind;
    // Where on T the point x* lies: PP_ON_INTERIOR, PP_ON_EDGE + i or PP_ON_VERTEX + i.
    uint32_t feature;
    // Sum of PP_FLAG_... bits: REJECTED with BY_SPHERES, or with BY_FACE (of A, or T itself);
    // ROUNDING_LIMITED, EXTENDED, DEFAULT_REGULARISATION, NORMAL_BY_BOUNDARY.
    uint32_t flags;
    // Quadratics solved.
    uint32_t iterations;
    // Scale of A at x*, the least on T, of A as regularised (flat_regularisation). Rejected: a lower bound,
    // no less than 1. Triangles that share the edge or vertex on which x* lies get the same s to the last
    // bit: a caller can give the contact at a seam to the triangle with the least s, and break ties by its
    // own numbering. If a flat face (k = 0) lies on several triangles, their s differ by flat_regularisation
    // only; the place of the contact is then known to some percent of the size with the default, to 1e-6 of
    // the size with 1e-4.
    double s;
    // Bound on the error of s, with rounding to first order in doubles (as in struct pp_contact).
    double gap;
    // Estimated bound on the distance of on_boundary to the exact x*, length.
    double point_bound;
    // Distance from x* along the normal to the surface of A (YADE: penetrationDepth), length, >= 0 when
    // overlapping; NaN when separated.
    double overlap;
    // Separated: lower bound on the distance between A and T, length; 0 when none is known. NaN when
    // overlapping.
    double distance;
    // Unit normal from A to T: the gradient of S_A at x*; inside T exactly the normal of T or its opposite.
    double normal[3];
    // Contact point, halfway between on_boundary and on_particle, world frame; x* when separated.
    double point[3];
    // Contact point minus position of A: exact lever arm even far from the world origin.
    double branch[3];
    // x*, world frame.
    double on_boundary[3];
    // The point of the surface of A beyond x* along the normal, world frame; NaN when separated.
    double on_particle[3];
} pp_flat_contact;

// What one ordered pair (A, B), or a particle A and a flat boundary, keeps of its patch. While no point of it
// has moved by more than 0.3 sqrt(tolerance) of the largest depth, the next ones follow from it without an
// integral.
//
// Owned by the caller: set all bytes to 0 to begin with or to forget; copy it freely within a process. One
// caller at a time. Not to be saved, as answers depend on it. It is used only for the particles, the
// tolerance and the with_energy for which it was written, while the particles exist.
typedef struct pp_patch_state {
    // Private to the library.
    double last_patch[112];
} pp_patch_state;

// The contact patch of two bodies A and B, or of A and a flat boundary B: the surface on which the scales of
// both are equal and at most 1, with the pressure p = K length (1 - s), K the caller's stiffness per area
// (force/length^3). What is proportional to K is given over K. World axes; lengths in the caller's unit.
// Its normal n points from A to B. In the plane it is a curve: areas are lengths, all is per unit of depth.
typedef struct pp_patch {
    // Sum of PP_PATCH_... bits.
    uint32_t flags;
    // Number of rays that were followed.
    uint32_t rays;
    // Estimated relative error, the largest of three: of the force; of the torque, relative to |force| times
    // the reach of the patch; of the energy, if asked for.
    double error;
    // Estimated relative error of the area; NaN in the plane.
    double area_error;
    // pp_particle_depth_length of A, plus that of B for two particles.
    double length;
    // Integral of p n over K: the force on B (minus that on A) over K, length^3.
    double force[3];
    // Torque of that on B about the point of the contact (of a boundary: on_boundary) over K, length^4.
    double torque[3];
    // The point of the axis of the wrench that lies in the plane of the patch, world frame: where a law
    // applies the force.
    double pressure_centre[3];
    // The same minus position of A.
    double branch_a[3];
    // The same minus position of B (of a boundary: of A).
    double branch_b[3];
    // Couple along that axis, torque . force / |force|, over K, length^4.
    double couple;
    // Area, length^2.
    double area;
    // Centroid minus pressure_centre.
    double centroid[3];
    // xx, yy, zz, xy, yz, zx of the integral of y y^T over the area about the centroid, length^4.
    double second_moment[6];
    // Integral of |y|^2 over the area, y from the axis of the wrench, length^4.
    double polar_moment;
    // Integral of p |y| over that of p: the lever of friction against twist, length.
    double twist_lever;
    // Mean of p/K, an overlap, length.
    double mean_depth;
    // Largest p/K, that of the contact point, length.
    double largest_depth;
    // Elastic energy over K, length^4; NaN unless asked for.
    double energy;
} pp_patch;

// A point of quadrature on a patch.
typedef struct pp_patch_point {
    // Its place minus the point of the contact (of a boundary: on_boundary), world axes.
    double position[3];
    // Its share of the area, length^2.
    double area;
    // p/K = length (1 - s) there, length.
    double depth;
    // Unit normal of the patch, from A to B, world axes.
    double normal[3];
} pp_patch_point;

// Derivatives of the force and the torques of a contact patch in the poses of A and B, over K, world axes;
// columns as of struct pp_derivatives. They are minus the second derivative of the energy.
typedef struct pp_patch_derivatives {
    // Of the force on B, a row for each of x, y, z; that on A is minus it. length^2 and length^3.
    double force[3][12];
    // Of the torque on A about its position. length^3 and length^4.
    double torque_on_a[3][12];
    // Of the torque on B about its position (of a boundary: that of A).
    double torque_on_b[3][12];
} pp_patch_derivatives;

// The call did what it says; its outputs are written.
#define PP_OK 0

// A pointer that must not be NULL was NULL.
#define PP_NULL_POINTER 1

// A pose holds a position that is not finite.
#define PP_BAD_POSITION 2

// A pose holds a quaternion that is not finite, or of a length outside [1e-150, 1e150].
#define PP_BAD_ORIENTATION 3

// A point or direction is not finite, a direction has no length, or a contact was not filled or is not
// of the kind that is needed.
#define PP_BAD_POINT 4

// The settings name a formulation that does not exist.
#define PP_UNKNOWN_FORMULATION 5

// The settings name a back end that does not exist.
#define PP_UNKNOWN_BACK_END 6

// A setting or a tolerance argument is outside its documented range, or a reserved field is not 0.
#define PP_BAD_SETTING 7

// No solver reached an answer: the contact is unknown, which is not "no contact".
#define PP_SOLVER_FAILED 8

// An internal error was caught at the boundary: please report it.
#define PP_INTERNAL_ERROR 9

// The output buffer is too small; the needed size was written.
#define PP_BUFFER_TOO_SMALL 10

// The settings ask for the cone-program back end, and the library was built without it.
#define PP_NO_CONE_PROGRAM 11

// An index or a count names something that is not there; of any function, an array of more elements than any
// memory holds.
#define PP_BAD_INDEX 12

// The vertices of a triangle lie on one line, so that it has no normal.
#define PP_DEGENERATE_TRIANGLE 13

// The tolerance of a mesh is outside its documented range.
#define PP_BAD_TOLERANCE 14

// The contact has no derivative: gradients or curvatures vanish there, as in the core of both bodies.
#define PP_NO_DERIVATIVE 15

// One particle lies in the plane z = 0 and the other does not; or, of one that does, a pose, the normal of a
// plane or a triangle leaves that plane.
#define PP_NOT_IN_PLANE 16

// A plane holds a coefficient that is not finite.
#define PP_PLANE_NOT_FINITE 20

// A plane has a normal (a, b, c) of length zero, or so short or long that its square, or the square over
// r^2, leaves the range of doubles.
#define PP_PLANE_ZERO_NORMAL 21

// k is not a number in [0, 1].
#define PP_BAD_SPHERICITY 22

// r is not a positive finite number, or so small that squares of depths leave the range of doubles, and
// k < 1 needs it.
#define PP_BAD_ROUNDING_RADIUS 23

// R is not a positive finite number, or k/R^2 leaves the range of doubles, and k > 0 needs it.
#define PP_BAD_SHADOW_RADIUS 24

// f(0) >= 0: the origin of the local frame is not inside the particle.
#define PP_CENTRE_OUTSIDE 25

// k = 0 and the planes do not enclose a bounded volume.
#define PP_UNBOUNDED 26

// More planes than PP_MAX_PLANES.
#define PP_TOO_MANY_PLANES 27

// The particle reaches less than 1e-30 or more than 1e30 from its centre.
#define PP_BAD_SIZE 28

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Version of the loaded library as "major.minor.patch". Static text: do not free it.
const char *pp_version(void);

// PP_ABI_VERSION of the loaded library.
uint32_t pp_abi_version(void);

// Size in bytes of a struct as the loaded library knows it, by its name ("pp_contact"), to be compared with
// sizeof; 0 for a name it does not know. For languages that write the structs down themselves.
//
// Pointers: name is NULL or a text that ends with a zero byte.
size_t pp_struct_size(const char *name);

// The fields of a struct, for languages that make it of them: for each a line with its name, numpy's format
// of a number of it ("f8", "i4", "u4"), how many numbers it has, and its first byte. Known are pp_contact,
// pp_closest, pp_flat_contact and pp_settings; NULL for another name. Static text: do not free it.
//
// Pointers: name is NULL or a text that ends with a zero byte.
const char *pp_struct_fields(const char *name);

// Finds the contacts of many pairs of bodies: the way for a DEM program to hand over a whole step.
//
// Body i is particles[i] at poses[i]; pair n is that of the bodies pairs[2n] (A) and pairs[2n+1] (B),
// counted from 0. Each pose is converted once, however many pairs its body is in. Each contact and state is,
// to the last bit, that of pp_contact_detect for the pair alone, whatever the number of threads.
//
// particles, poses: body_count of each; several bodies may share a particle. A particle may be NULL and
// a pose may be bad: that is told by the statuses of the pairs that name such a body, if any.
// pairs: pair_count rows of two indices. settings: may be NULL (defaults); the same for all pairs.
// threads: how many work on it, the calling one among them: 0 and 1 mean the calling thread alone,
// more than 256 count as 256. Threads are started and ended within the call, which is worth its time from
// some thousand pairs on.
// states: one for each pair, read and updated; may be NULL. contacts: one for each pair; written where
// its status is PP_OK. statuses: one for each pair, all of them written: as pp_contact_detect would return,
// or PP_BAD_INDEX for a body that is not there.
// The call itself returns PP_OK when it went through all pairs, whatever their statuses; an error means
// that nothing was written.
// Pointers: may be NULL where the count is 0. No array overlaps another, and states, contacts and
// statuses are not used by another call at the same time.
// Errors: PP_NULL_POINTER, PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING,
// PP_BAD_INDEX (a count that no memory could hold).
pp_status pp_contact_detect_batch(const struct pp_particle *const *particles,
                                  const struct pp_pose *poses,
                                  size_t body_count,
                                  const uint32_t *pairs,
                                  size_t pair_count,
                                  const struct pp_settings *settings,
                                  uint32_t threads,
                                  struct pp_pair_state *states,
                                  struct pp_contact *contacts,
                                  pp_status *statuses);

// Builds a particle whose faces are at given planes, about its centroid and along its principal axes.
//
// planes: count rows of a, b, c, h; inside is a x + b y + c z <= h. (a, b, c) may have any length. These
// are the faces themselves; the planes of pp_particle_new lie deeper, by about r. Planes that make no face
// are left out.
// rounding: the rounding radius r over the size, in (0, 0.5). The size is the diameter of the largest ball
// between the planes. k: sphericity, in [0, 1). shadow: R over the size, or 0 for the distance from the
// centroid to the farthest corner.
// out: receives the particle; release it with pp_particle_free.
// built: receives how it stands in the given frame, and its mass properties (may be NULL).
// message: receives, on failure, a sentence that names the plane or value (may be NULL).
// Errors: PP_NULL_POINTER, PP_PLANE_ZERO_NORMAL (also of a plane whose numbers are not finite),
// PP_UNBOUNDED (the planes enclose no volume), and those of pp_particle_new.
// Pointers: planes points to 4*count doubles, out to one pointer, built to one struct, message to
// message_size bytes.
pp_status pp_particle_from_faces(const double *planes,
                                 size_t count,
                                 double rounding,
                                 double k,
                                 double shadow,
                                 struct pp_particle **out,
                                 struct pp_built *built,
                                 char *message,
                                 size_t message_size);

// Builds a particle from the convex hull of points, about its centroid and along its principal axes.
//
// points: count rows of x, y, z, in any order; those inside the hull do not matter. No part of the particle
// lies outside the hull. Triangles of the hull that are coplanar to 1e-6 of its extent are one face.
// All else as pp_particle_from_faces.
// Errors: PP_NULL_POINTER, PP_BAD_POINT, PP_UNBOUNDED (fewer than four points, or all in one plane), and
// those of pp_particle_new.
// Pointers: points points to 3*count doubles, out to one pointer, built to one struct, message to
// message_size bytes.
pp_status pp_particle_from_points(const double *points,
                                  size_t count,
                                  double rounding,
                                  double k,
                                  double shadow,
                                  struct pp_particle **out,
                                  struct pp_built *built,
                                  char *message,
                                  size_t message_size);

// Fills settings with the defaults.
//
// Pointers: settings is valid for writing.
// Errors: PP_NULL_POINTER.
pp_status pp_settings_default(struct pp_settings *settings);

// Finds the contact of particle A at pose_a with particle B at pose_b.
//
// settings: may be NULL (defaults). state: may be NULL; else that of this ordered pair, read, and updated
// when the call returns PP_OK. With carry_tolerance above 0 a contact of PP_MIDWAY by PP_FAST is carried on
// from the last one and not solved, where that can be: the answer has PP_FLAG_CARRIED, and its
// gap and point_bound hold as for any other. out: the answer; see struct pp_contact for frames, units and
// signs.
// Pointers: state and out are not used by another call at the same time.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_UNKNOWN_FORMULATION,
// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
pp_status pp_contact_detect(const struct pp_particle *a,
                            const struct pp_pose *pose_a,
                            const struct pp_particle *b,
                            const struct pp_pose *pose_b,
                            const struct pp_settings *settings,
                            struct pp_pair_state *state,
                            struct pp_contact *out);

// The point on one of the particles where the scale of the other is least: P1 on A, P2 on B (paper eqs
// 3, 9). pp_contact_detect with PP_CLOSEST needs both; this is for pairs that have only one, and for
// callers that want only one.
//
// on: PP_ON_A or PP_ON_B. settings: may be NULL (defaults); the formulation and solve_separated do not
// matter. out: the point, or slack = 1 where there is none.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_INDEX (on), PP_UNKNOWN_FORMULATION,
// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
pp_status pp_closest_point(const struct pp_particle *a,
                           const struct pp_pose *pose_a,
                           const struct pp_particle *b,
                           const struct pp_pose *pose_b,
                           uint32_t on,
                           const struct pp_settings *settings,
                           struct pp_closest *out);

// Contact area: the area of the cut that the plane through the contact point, normal to the contact
// normal, makes through the intersection of both particles.
//
// contact: an overlapping answer of pp_contact_detect for the same particles and poses.
// relative_tolerance: in [1e-12, 0.1]; 1e-6 is a good choice. It is used only where rounding prevents a
// closed form, and the area is then known to 1e-9 at best. Elsewhere the area is exact but for rounding:
// 1e-12 of it, or 2e-16 size/r where that is more. With r near 1e-9 of the size or less, thin sections
// may be wrong. area: receives length^2; 0 when separated.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact
// was not filled: no kind, point or normal; or its point is outside a particle), PP_BAD_SETTING.
pp_status pp_contact_area(const struct pp_particle *a,
                          const struct pp_pose *pose_a,
                          const struct pp_particle *b,
                          const struct pp_pose *pose_b,
                          const struct pp_contact *contact,
                          double relative_tolerance,
                          double *area);

// The derivatives of a contact in the poses of both bodies, at the contact, which is not solved again.
//
// settings: may be NULL (defaults). contact: the answer of pp_contact_detect for the same bodies, poses and
// settings.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact was not filled, or
// was rejected without a point), PP_NO_DERIVATIVE, PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END,
// PP_BAD_SETTING, PP_SOLVER_FAILED.
pp_status pp_contact_derivatives(const struct pp_particle *a,
                                 const struct pp_pose *pose_a,
                                 const struct pp_particle *b,
                                 const struct pp_pose *pose_b,
                                 const struct pp_settings *settings,
                                 const struct pp_contact *contact,
                                 struct pp_derivatives *out);

// The derivatives of a cost in poses and shapes of both bodies, from its derivatives in the numbers of their
// contact (reverse mode). The work is linear in the number of active planes.
//
// settings, contact: as of pp_contact_derivatives. shape_a, shape_b: may be NULL; else added to. poses:
// receives those of A and B. flags: receives PP_DERIVATIVE_... bits.
// Pointers: planes of a gradient holds 4 * count numbers; poses has room for 2. The two gradients are not
// the same.
// Errors: those of pp_contact_derivatives, and PP_BAD_INDEX (count).
pp_status pp_contact_gradient(const struct pp_particle *a,
                              const struct pp_pose *pose_a,
                              const struct pp_particle *b,
                              const struct pp_pose *pose_b,
                              const struct pp_settings *settings,
                              const struct pp_contact *contact,
                              const struct pp_contact_weights *weights,
                              struct pp_shape_gradient *shape_a,
                              struct pp_shape_gradient *shape_b,
                              struct pp_pose_gradient *poses,
                              uint32_t *flags);

// The derivatives of a contact with a plane or a triangle in the poses of the particle and of the boundary,
// which stands in place of B and turns about the position of A, too.
//
// vertices: NULL for a plane; else as for pp_contact_triangle. contact: the answer of pp_contact_plane or
// pp_contact_triangle for the same body, pose and settings.
// Pointers: vertices holds 9 numbers.
// Errors: those of pp_contact_derivatives, and PP_DEGENERATE_TRIANGLE.
pp_status pp_flat_contact_derivatives(const struct pp_particle *a,
                                      const struct pp_pose *pose_a,
                                      const double *vertices,
                                      const struct pp_settings *settings,
                                      const struct pp_flat_contact *contact,
                                      struct pp_derivatives *out);

// The derivatives of a cost in the pose and the shape of a particle, and in the pose of the plane or
// triangle that it touches, from its derivatives in the numbers of the contact.
//
// vertices, contact and the pose of the boundary: as of pp_flat_contact_derivatives; the rest as of
// pp_contact_gradient.
// Pointers: vertices holds 9 numbers; planes of the gradient 4 * count; poses has room for 2.
// Errors: those of pp_contact_gradient, and PP_DEGENERATE_TRIANGLE.
pp_status pp_flat_contact_gradient(const struct pp_particle *a,
                                   const struct pp_pose *pose_a,
                                   const double *vertices,
                                   const struct pp_settings *settings,
                                   const struct pp_flat_contact *contact,
                                   const struct pp_contact_weights *weights,
                                   struct pp_shape_gradient *shape,
                                   struct pp_pose_gradient *poses,
                                   uint32_t *flags);

// Finds the contact of particle A at pose_a with the plane through a point (world frame) with this normal
// (of any length). A may touch it from either side; where its centre lies on the plane to rounding, A counts
// as in front of it (PP_FLAG_NORMAL_BY_BOUNDARY).
//
// settings: may be NULL (defaults); gap_tolerance, flat_regularisation and solve_separated count. A
// gap_tolerance below 1e-13, or a gap in doubles that is too wide, is answered in extended precision
// (PP_FLAG_EXTENDED). state: may be NULL; else that of A and this boundary, read and updated as
// by pp_contact_detect (the last point, from which the next search starts).
// Pointers: point and normal hold 3 numbers each.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT, PP_UNKNOWN_FORMULATION,
// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
pp_status pp_contact_plane(const struct pp_particle *a,
                           const struct pp_pose *pose_a,
                           const double *point,
                           const double *normal,
                           const struct pp_settings *settings,
                           struct pp_pair_state *state,
                           struct pp_flat_contact *out);

// Finds the contact of particle A at pose_a with a closed triangle, which A may touch from either side.
//
// vertices: three points, world frame, one after the other; seen from the front they run
// counter-clockwise. Where the centre of A lies on the triangle to rounding, A counts as in front of it
// (PP_FLAG_NORMAL_BY_BOUNDARY).
// settings: may be NULL (defaults); gap_tolerance, flat_regularisation and solve_separated count. A
// gap_tolerance below 1e-13, or a gap in doubles that is too wide, is answered in extended precision
// (PP_FLAG_EXTENDED). state: may be NULL; else that of A and this boundary, read and updated as
// by pp_contact_detect.
// Pointers: vertices holds 9 numbers.
// Errors: those of pp_contact_plane, and PP_DEGENERATE_TRIANGLE.
pp_status pp_contact_triangle(const struct pp_particle *a,
                              const struct pp_pose *pose_a,
                              const double *vertices,
                              const struct pp_settings *settings,
                              struct pp_pair_state *state,
                              struct pp_flat_contact *out);

// How the scale of A goes on from where it is least on a triangle of a mesh, an edge or a vertex, into a
// neighbour that shares it, without solving the triangle. Where it falls, a contact there is the
// neighbour's; where it rises, both have the same.
//
// vertices, neighbour: three points each, world frame, as for pp_contact_triangle. feature: PP_ON_EDGE + i
// or PP_ON_VERTEX + i of the triangle, as pp_contact_triangle has found it before. settings: as for
// pp_contact_triangle.
// share: in and out; on an edge the place of the least scale, from the edge's first vertex to the next
// one, 0 to 1: a guess, and what was found. For a vertex it is left alone.
// sense: receives -1 where it falls, 1 where it rises, 0 where the triangle's least scale is not there for
// sure, or is no less than 1, or only a solution can tell: ask pp_contact_triangle.
// Errors: those of pp_contact_triangle without PP_SOLVER_FAILED; PP_BAD_POINT also for another feature or
// a share outside of 0 to 1.
pp_status pp_seam_slope(const struct pp_particle *a,
                        const struct pp_pose *pose_a,
                        const double *vertices,
                        uint32_t feature,
                        const double *neighbour,
                        const struct pp_settings *settings,
                        double *share,
                        int32_t *sense);

// Contact area with a flat boundary: the area of the cut that the plane through the contact point, normal to
// the contact normal, makes through the particle. (It is not cut off at the edges of a triangle.)
//
// contact: an overlapping answer of pp_contact_plane or pp_contact_triangle for the same particle and pose.
// relative_tolerance: in [1e-12, 0.1], as for pp_contact_area. area: receives length^2; 0 when separated.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact has no kind, or its
// point is outside the particle), PP_BAD_SETTING.
pp_status pp_flat_contact_area(const struct pp_particle *a,
                               const struct pp_pose *pose_a,
                               const struct pp_flat_contact *contact,
                               double relative_tolerance,
                               double *area);

// Creates a particle from count planes.
//
// planes: count rows of a, b, c, d (outward normal and offset; local frame; the normal is used as
// given). They are the planes of the core. For k = 0 a face lies at a x + b y + c z = d + r where no other
// plane counts; where many planes nearly share a place the surface lies deeper. pp_particle_from_faces puts
// the faces themselves where they are wanted. May be
// NULL when count is 0.
// r: rounding radius, length. k: sphericity, in [0, 1]. shadow_radius: R, length.
// out: receives the particle; release it with pp_particle_free.
// message: receives, on failure, a sentence that names the plane or value (may be NULL).
// Errors: PP_NULL_POINTER, PP_PLANE_NOT_FINITE, PP_PLANE_ZERO_NORMAL, PP_BAD_SPHERICITY,
// PP_BAD_ROUNDING_RADIUS, PP_BAD_SHADOW_RADIUS, PP_CENTRE_OUTSIDE, PP_UNBOUNDED,
// PP_TOO_MANY_PLANES, PP_BAD_SIZE.
// Pointers: planes points to 4*count doubles, out to one pointer, message to message_size bytes.
pp_status pp_particle_new(const double *planes,
                          size_t count,
                          double r,
                          double k,
                          double shadow_radius,
                          struct pp_particle **out,
                          char *message,
                          size_t message_size);

// Creates a particle in the plane z = 0 from count lines a x + b y = d: that of the planes (a, b, 0, d), of
// which only the cut at z = 0 counts.
//
// It is used as any other, at poses with z = 0 and a turn about z alone, together with particles in the plane
// or with planes whose normal is (x, y, 0): PP_NOT_IN_PLANE otherwise. Answers lie at z = 0. Areas are lengths,
// volumes areas, and masses, forces of patches and energies are per unit of depth.
// lines: count rows of a, b, d (outward normal and offset); may be NULL when count is 0. r, k, shadow_radius,
// out, message, errors: as of pp_particle_new, the codes of planes for lines; for k = 0 the lines must enclose
// an area.
// Pointers: lines points to 3*count doubles, out to one pointer, message to message_size bytes.
pp_status pp_particle_new_in_plane(const double *lines,
                                   size_t count,
                                   double r,
                                   double k,
                                   double shadow_radius,
                                   struct pp_particle **out,
                                   char *message,
                                   size_t message_size);

// Creates a particle in the plane z = 0 from points whose convex hull is a polygon with rounded corners; it is
// used as one of pp_particle_new_in_plane.
//
// The local origin is the centroid of the polygon, its sides are those of the polygon (k = 0), and the shadow
// circle goes through its outermost corner.
// points: count rows of x, y, in any order.
// r: rounding radius, length, less than the distance of each side from the centroid. k: sphericity, in [0, 1].
// out: receives the particle; release it with pp_particle_free.
// message: receives, on failure, a sentence that names the point or value (may be NULL).
// Errors: PP_NULL_POINTER, PP_PLANE_NOT_FINITE (a point is not), PP_UNBOUNDED (the points enclose no area),
// PP_BAD_SPHERICITY, PP_BAD_ROUNDING_RADIUS, PP_TOO_MANY_PLANES, PP_BAD_INDEX (a count that no memory could
// hold).
// Pointers: points points to 2*count doubles, out to one pointer, message to message_size bytes.
pp_status pp_particle_new_polygon(const double *points,
                                  size_t count,
                                  double r,
                                  double k,
                                  struct pp_particle **out,
                                  char *message,
                                  size_t message_size);

// The same shape factor times as large: d, r and R multiplied by it.
//
// out: receives the new particle; release it with pp_particle_free.
// message: receives, on failure, a sentence that names the value (may be NULL).
// Errors: PP_NULL_POINTER, and those of pp_particle_new for what the factor makes of r, R and d.
// Pointers: out points to one pointer, message to message_size bytes.
pp_status pp_particle_scaled(const struct pp_particle *particle,
                             double factor,
                             struct pp_particle **out,
                             char *message,
                             size_t message_size);

// Releases a particle; NULL is allowed and does nothing. No call that uses it may still be running;
// states of its pairs may stay.
// Pointers: particle is NULL or came from pp_particle_new and was not released yet.
void pp_particle_free(struct pp_particle *particle);

// Rounding radius r as given to pp_particle_new, length.
//
// Errors: PP_NULL_POINTER.
pp_status pp_particle_rounding_radius(const struct pp_particle *particle, double *r);

// Sphericity k as given to pp_particle_new, no unit.
//
// Errors: PP_NULL_POINTER.
pp_status pp_particle_sphericity(const struct pp_particle *particle, double *k);

// Radius R of the shadow sphere as given to pp_particle_new, length.
//
// Errors: PP_NULL_POINTER.
pp_status pp_particle_shadow_radius(const struct pp_particle *particle, double *shadow_radius);

// Planes as given to pp_particle_new, without those that are one with an earlier one: rows of a, b, c, d,
// local frame.
//
// planes: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
// planes, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
// Pointers: planes is valid for writing 4*capacity doubles.
// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
pp_status pp_particle_planes(const struct pp_particle *particle,
                             double *planes,
                             size_t capacity,
                             size_t *count);

// The length by which 1 - s is multiplied to give a depth below the surface: r/|n| for k = 0, R for k = 1; in
// between the inverse slope of s at the face nearest to the centre. A constant of the particle.
//
// Errors: PP_NULL_POINTER.
pp_status pp_particle_depth_length(const struct pp_particle *particle,
                                   double *length);

// The patch of an overlapping contact of A with B.
//
// contact: an answer of pp_contact_detect for the same particles and poses. tolerance: relative, in
// [1e-12, 0.1]; 1e-4 is a good choice. with_energy: 0 or 1. state: may be NULL; else that of the pair, read
// and updated: the patch may then be carried on from an earlier one (PP_PATCH_CARRIED). It is not used where
// points are asked for. points: room for capacity points of quadrature; may be NULL with a capacity of 0.
// count: receives their number; may be NULL with a capacity of 0.
// Buffers: the library keeps some 100 kilobytes for each thread that calls this, until the thread ends.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact was not filled, or is
// separated), PP_BAD_SETTING (tolerance, with_energy), PP_BUFFER_TOO_SMALL (count receives the needed size,
// points the first ones).
pp_status pp_patch_of_contact(const struct pp_particle *a,
                              const struct pp_pose *pose_a,
                              const struct pp_particle *b,
                              const struct pp_pose *pose_b,
                              const struct pp_contact *contact,
                              double tolerance,
                              uint32_t with_energy,
                              struct pp_patch_state *state,
                              struct pp_patch *patch,
                              struct pp_patch_point *points,
                              size_t capacity,
                              size_t *count);

// The patch of an overlapping contact of A with a plane: the part of the plane inside A. Its normal is that
// of the contact, from A to the plane.
//
// contact: an answer of pp_contact_plane for the same particle and pose. The rest as for pp_patch_of_contact.
// Errors: those of pp_patch_of_contact.
pp_status pp_patch_on_plane(const struct pp_particle *a,
                            const struct pp_pose *pose_a,
                            const struct pp_flat_contact *contact,
                            double tolerance,
                            uint32_t with_energy,
                            struct pp_patch_state *state,
                            struct pp_patch *patch,
                            struct pp_patch_point *points,
                            size_t capacity,
                            size_t *count);

// The patch of an overlapping contact of A with a triangle: the part of the triangle inside A. Patches of
// coplanar triangles add up to that of the slab they cover, and those of a closed mesh to force, torque and
// energy of the mesh.
//
// vertices: as for pp_contact_triangle. from_front: 1 where A presses on its front, from which the vertices run
// counter-clockwise, as for a closed mesh seen from outside; 0 for its back. contact: an answer of
// pp_contact_triangle for the same particle, pose and vertices. The rest as for pp_patch_of_contact.
// Pointers: vertices holds 9 numbers.
// Errors: those of pp_patch_of_contact, and PP_DEGENERATE_TRIANGLE.
pp_status pp_patch_on_triangle(const struct pp_particle *a,
                               const struct pp_pose *pose_a,
                               const double *vertices,
                               uint32_t from_front,
                               const struct pp_flat_contact *contact,
                               double tolerance,
                               uint32_t with_energy,
                               struct pp_patch_state *state,
                               struct pp_patch *patch,
                               struct pp_patch_point *points,
                               size_t capacity,
                               size_t *count);

// The derivatives of the patch of an overlapping contact of A with B.
//
// contact, tolerance: as of pp_patch_of_contact; the derivatives are known to about the root of the
// tolerance.
// Errors: those of pp_patch_of_contact, and PP_NO_DERIVATIVE (no patch was found).
pp_status pp_patch_derivatives_of_contact(const struct pp_particle *a,
                                          const struct pp_pose *pose_a,
                                          const struct pp_particle *b,
                                          const struct pp_pose *pose_b,
                                          const struct pp_contact *contact,
                                          double tolerance,
                                          struct pp_patch_derivatives *out);

// The derivatives of the patch of an overlapping contact of A with a plane or a triangle, in the poses of A
// and of the boundary, which stands in place of B and turns about the position of A, too.
//
// vertices: NULL for a plane; else, as from_front (0 for a plane), as of pp_patch_on_triangle. contact,
// tolerance: as of pp_patch_on_plane and pp_patch_on_triangle.
// Pointers: vertices holds 9 numbers.
// Errors: those of pp_patch_on_triangle, and PP_NO_DERIVATIVE (no patch was found).
pp_status pp_patch_derivatives_on_boundary(const struct pp_particle *a,
                                           const struct pp_pose *pose_a,
                                           const double *vertices,
                                           uint32_t from_front,
                                           const struct pp_flat_contact *contact,
                                           double tolerance,
                                           struct pp_patch_derivatives *out);

// f = S - 1 at a world point (3 doubles), and its gradient (3 doubles, world axes, 1/length; may
// be NULL).
//
// f < 0 inside, 0 on the surface, > 0 outside.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT.
// Pointers: Pointers are NULL or valid: point for reading 3 doubles, f and gradient for writing 1 and 3.
pp_status pp_particle_potential(const struct pp_particle *particle,
                                const struct pp_pose *pose,
                                const double *point,
                                double *f,
                                double *gradient);

// Axis-aligned box, world axes, that holds the particle at this pose: that of the corners of
// pp_particle_corners.
//
// lower, upper: receive 3 doubles each, world frame.
// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION.
// Pointers: Pointers are NULL or valid; lower and upper for writing 3 doubles.
pp_status pp_particle_box(const struct pp_particle *particle,
                          const struct pp_pose *pose,
                          double *lower,
                          double *upper);

// Radius about the centre of a ball that holds the particle, length.
//
// Errors: PP_NULL_POINTER.
pp_status pp_particle_bounding_radius(const struct pp_particle *particle, double *radius);

// Whether the planes alone enclose a volume: 1, or 0 where only the shadow sphere bounds the particle,
// at R/sqrt(k).
//
// That is valid for k > 0, and seldom meant where there are planes: one may have been left out.
// Errors: PP_NULL_POINTER.
pp_status pp_particle_planes_enclose(const struct pp_particle *particle,
                                     int32_t *enclose);

// Corners, local frame, of a polyhedron that holds the particle: rows of x, y, z.
//
// corners: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
// corners, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
// Pointers: corners is valid for writing 3*capacity doubles.
// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
pp_status pp_particle_corners(const struct pp_particle *particle,
                              double *corners,
                              size_t capacity,
                              size_t *count);

// How far the particle reaches along a direction (3 doubles, local frame, any length): an upper bound of e .
// x over all its points x, where e = direction / |direction|. It follows from the corners of
// pp_particle_corners.
//
// Errors: PP_NULL_POINTER, PP_BAD_POINT.
// Pointers: direction points to 3 doubles.
pp_status pp_particle_support(const struct pp_particle *particle,
                              const double *direction,
                              double *support);

// Distance from the centre to the surface along a direction (3 doubles, local frame, any length).
//
// The surface point is distance * direction / |direction|, local frame: for meshes and pictures.
// Errors: PP_NULL_POINTER, PP_BAD_POINT.
// Pointers: Pointers are NULL or valid; direction for reading 3 doubles.
pp_status pp_particle_surface_distance(const struct pp_particle *particle,
                                       const double *direction,
                                       double *distance);

// Volume, centroid and inertia for unit density, by adaptive quadrature over the true surface.
//
// tolerance: relative, 1e-12 to 1; 1e-6 is usual and takes milliseconds for some tens of planes. Where it
// cannot be reached, the error of the properties says so.
// Errors: PP_NULL_POINTER, PP_BAD_SETTING.
pp_status pp_particle_mass_properties(const struct pp_particle *particle,
                                      double tolerance,
                                      struct pp_mass_properties *properties);

// The sentence for a status code, in English, without a full stop.
//
// Never NULL; an unknown code gives "unknown status code". The text is static: do not free it.
const char *pp_status_message(pp_status status);

// A closed mesh of triangles inside the particle, its corners on the surface, local frame.
//
// tolerance: the largest distance from the surface to the mesh, over the bounding radius; in [1e-5, 1].
// vertices: room for vertex_capacity rows of x, y, z. normals: the same for the outward unit normals of
// the surface at the vertices; NULL when not wanted. triangles: room for triangle_capacity rows of
// three indices of vertices, from 0, counter-clockwise from outside. Buffers may be NULL when their
// capacity is 0.
// vertex_count, triangle_count: receive the numbers, also when a buffer is too small
// (PP_BUFFER_TOO_SMALL), so that one call asks the size; it takes as long as one that fills the buffers.
// error: receives the bound on the distance from any point of the surface to the mesh, length. May be
// NULL.
// Errors: PP_NULL_POINTER, PP_BAD_TOLERANCE, PP_BUFFER_TOO_SMALL, PP_SOLVER_FAILED (rounding leaves no
// surface: scale the particle to a size near 1).
// Pointers: Pointers are NULL or valid for writing what they have room for.
pp_status pp_particle_mesh(const struct pp_particle *particle,
                           double tolerance,
                           double *vertices,
                           double *normals,
                           size_t vertex_capacity,
                           size_t *vertex_count,
                           uint32_t *triangles,
                           size_t triangle_capacity,
                           size_t *triangle_count,
                           double *error);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* POTENTIAL_PARTICLES_H */
