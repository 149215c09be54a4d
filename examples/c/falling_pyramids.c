/* SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * A small complete discrete element code around the library: 100 pyramids fall into a box and come to rest.
 *
 *     cc -O2 falling_pyramids.c $(pkg-config --cflags --libs potential-particles) -lm -o falling_pyramids
 *
 * Springs and dashpots along the normal, friction that opposes sliding, all forces at the contact point. SI units;
 * world frame with z up, floor at z = 0.
 */
#include <math.h>
#include <potential_particles.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BODIES = 100, PAIRS = BODIES * (BODIES - 1) / 2, WALLS = 5 };

static const double SIZE = 0.1, DENSITY = 2600.0, GRAVITY = 9.81, HALF_WIDTH = 0.5;
static const double STIFFNESS = 1e6, DASHPOT = 0.3 /* of critical */, FRICTION = 0.5, SLIDING = 300.0 /* N s/m */;
static const double TIME_STEP = 1e-4, END = 2.0;

typedef struct {
    double velocity[3], spin[3]; /* world frame; body frame */
    double force[3], torque[3];  /* world frame */
} motion;

static pp_particle *pyramid;
static double mass, inertia[3]; /* principal, along the local axes */
static const pp_particle *particles[BODIES];
static pp_pose poses[BODIES];
static motion motions[BODIES];

static void check(pp_status status, const char *what) {
    if (status != PP_OK) {
        fprintf(stderr, "falling_pyramids: %s: %s\n", what, pp_status_message(status));
        exit(1);
    }
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double *a, const double *b, double *out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Turns v by the unit quaternion q (sense = 1: local to world) or back (-1). */
static void turn(const double *q, double sense, const double *v, double *out) {
    const double axis[3] = {sense * q[1], sense * q[2], sense * q[3]};
    double once[3], twice[3];
    cross(axis, v, once);
    cross(axis, once, twice);
    for (int i = 0; i < 3; i++)
        out[i] = v[i] + 2.0 * (q[0] * once[i] + twice[i]);
}

/* The local origin must be the centroid, of the rounded shape: it is made, measured, and made again. */
static void make_pyramid(void) {
    const double r = 0.05 * SIZE, k = 0.02, slope = sqrt(1.25), across = 1.0 / slope, up = 0.5 / slope;
    double below = 0.25 * SIZE;
    pp_mass_properties properties;
    for (int round = 0; round < 4; round++) {
        const double side = 0.5 * SIZE * across - below * up - r;
        const double planes[5][4] = { { across, 0, up, side },
                                      { -across, 0, up, side },
                                      { 0, across, up, side },
                                      { 0, -across, up, side },
                                      { 0, 0, -1, below - r } };
        char why[PP_MESSAGE_SIZE];
        pp_particle_free(pyramid);
        if (pp_particle_new(&planes[0][0], 5, r, k, 0.75 * SIZE, &pyramid, why, sizeof why) != PP_OK) {
            fprintf(stderr, "falling_pyramids: %s\n", why);
            exit(1);
        }
        check(pp_particle_mass_properties(pyramid, 1e-8, &properties), "mass");
        below += properties.centroid[2];
    }
    mass = DENSITY * properties.volume;
    for (int i = 0; i < 3; i++)
        inertia[i] = DENSITY * properties.inertia[i];
}

static double uniform(void) { return 2.0 * rand() / RAND_MAX - 1.0; }

static void place(void) {
    srand(1);
    for (int i = 0; i < BODIES; i++) {
        const double cell = 0.17, at[3] = {cell * (i % 4 - 1.5), cell * (i / 4 % 4 - 1.5), cell * (i / 16 + 0.7)};
        pp_pose pose = {{at[0], at[1], at[2]}, {uniform(), uniform(), uniform(), uniform()}};
        const double length = sqrt(pose.orientation[0] * pose.orientation[0]
                                   + dot(pose.orientation + 1, pose.orientation + 1));
        for (int c = 0; c < 4; c++)
            pose.orientation[c] /= length;
        poses[i] = pose;
        particles[i] = pyramid;
    }
}

/* Velocity of the material point of body i at this lever arm from its centre; the walls (i < 0) stand still. */
static void velocity_at(int i, const double *arm, double *out) {
    double spin[3], around[3];
    if (i < 0) {
        memset(out, 0, 3 * sizeof *out);
        return;
    }
    turn(poses[i].orientation, 1, motions[i].spin, spin);
    cross(spin, arm, around);
    for (int c = 0; c < 3; c++)
        out[c] = motions[i].velocity[c] + around[c];
}

static void push(int i, const double *force, double sense, const double *arm) {
    double torque[3];
    if (i < 0)
        return;
    cross(arm, force, torque);
    for (int c = 0; c < 3; c++) {
        motions[i].force[c] += sense * force[c];
        motions[i].torque[c] += sense * torque[c];
    }
}

/* The law of a contact: body i pushes body j along the normal, which runs from i to j. */
static void contact_force(int i, const double* arm_i, int j, const double* arm_j, const double* normal, double overlap)
{
    double of_i[3], of_j[3], sliding[3], force[3];
    velocity_at(i, arm_i, of_i);
    velocity_at(j, arm_j, of_j);
    for (int c = 0; c < 3; c++)
        sliding[c] = of_j[c] - of_i[c];
    const double opening = dot(sliding, normal), dashpot = 2.0 * DASHPOT * sqrt(STIFFNESS * 0.5 * mass);
    const double pressure = fmax(STIFFNESS * overlap - dashpot * opening, 0.0);
    for (int c = 0; c < 3; c++)
        sliding[c] -= opening * normal[c];
    const double speed = sqrt(dot(sliding, sliding));
    const double friction = speed > 0.0 ? fmin(FRICTION * pressure, SLIDING * speed) / speed : 0.0;
    for (int c = 0; c < 3; c++)
        force[c] = pressure * normal[c] - friction * sliding[c];
    push(j, force, 1, arm_j);
    push(i, force, -1, arm_i);
}

/* All pairs in one call; most are rejected by their bounding spheres. A larger code has a neighbour search. */
static int pair_forces(void) {
    static uint32_t pairs[2 * PAIRS];
    static pp_pair_state states[PAIRS];
    static pp_contact contacts[PAIRS];
    static pp_status statuses[PAIRS];
    if (pairs[1] == 0)
        for (uint32_t i = 0, n = 0; i < BODIES; i++)
            for (uint32_t j = i + 1; j < BODIES; j++, n++)
                pairs[2 * n] = i, pairs[2 * n + 1] = j;
    check(pp_contact_detect_batch(particles, poses, BODIES, pairs, PAIRS, NULL, 1, states, contacts, statuses),
          "pairs");
    int touching = 0;
    for (int n = 0; n < PAIRS; n++) {
        check(statuses[n], "pair");
        if (contacts[n].kind == PP_OVERLAPPING) {
            contact_force((int)pairs[2 * n], contacts[n].branch_a, (int)pairs[2 * n + 1], contacts[n].branch_b,
                          contacts[n].normal, contacts[n].overlap);
            touching++;
        }
    }
    return touching;
}

static int wall_forces(void) {
    const double walls[WALLS][2][3] = { { { 0, 0, 0 }, { 0, 0, 1 } },
                                        { { -HALF_WIDTH, 0, 0 }, { 1, 0, 0 } },
                                        { { HALF_WIDTH, 0, 0 }, { -1, 0, 0 } },
                                        { { 0, -HALF_WIDTH, 0 }, { 0, 1, 0 } },
                                        { { 0, HALF_WIDTH, 0 }, { 0, -1, 0 } } };
    int touching = 0;
    for (int i = 0; i < BODIES; i++)
        for (int w = 0; w < WALLS; w++) {
            pp_flat_contact contact;
            check(pp_contact_plane(pyramid, &poses[i], walls[w][0], walls[w][1], NULL, NULL, &contact), "wall");
            if (contact.kind == PP_OVERLAPPING) {
                contact_force(i, contact.branch, -1, contact.branch, contact.normal, contact.overlap);
                touching++;
            }
        }
    return touching;
}

/* Leapfrog for the centre; Euler's equations in the body frame for the spin. Clears the forces. */
static void move(void) {
    for (int i = 0; i < BODIES; i++) {
        motion *m = &motions[i];
        double *q = poses[i].orientation, torque[3], gyro[3], angular[3];
        turn(q, -1, m->torque, torque);
        for (int c = 0; c < 3; c++)
            angular[c] = inertia[c] * m->spin[c];
        cross(m->spin, angular, gyro);
        for (int c = 0; c < 3; c++) {
            m->velocity[c] += TIME_STEP * (m->force[c] / mass - (c == 2 ? GRAVITY : 0.0));
            poses[i].position[c] += TIME_STEP * m->velocity[c];
            m->spin[c] += TIME_STEP * (torque[c] - gyro[c]) / inertia[c];
        }
        /* q <- q (1, spin dt / 2), to unit length again. */
        const double w[3] = {0.5 * TIME_STEP * m->spin[0], 0.5 * TIME_STEP * m->spin[1], 0.5 * TIME_STEP * m->spin[2]};
        double next[4] = {q[0] - dot(q + 1, w), 0, 0, 0};
        cross(q + 1, w, next + 1);
        for (int c = 0; c < 3; c++)
            next[c + 1] += q[c + 1] + q[0] * w[c];
        const double length = sqrt(next[0] * next[0] + dot(next + 1, next + 1));
        for (int c = 0; c < 4; c++)
            q[c] = next[c] / length;
        memset(m->force, 0, sizeof m->force);
        memset(m->torque, 0, sizeof m->torque);
    }
}

static double kinetic_energy(void) {
    double sum = 0.0;
    for (int i = 0; i < BODIES; i++) {
        sum += 0.5 * mass * dot(motions[i].velocity, motions[i].velocity);
        for (int c = 0; c < 3; c++)
            sum += 0.5 * inertia[c] * motions[i].spin[c] * motions[i].spin[c];
    }
    return sum;
}

int main(void) {
    make_pyramid();
    place();
    printf("  time, s   contacts of pairs   of walls   kinetic energy, J   mean height, m\n");
    int pairs = 0, walls = 0;
    const long steps = lround(END / TIME_STEP);
    for (long step = 0; step <= steps; step++) {
        pairs = pair_forces();
        walls = wall_forces();
        if (step % (steps / 10) == 0) {
            double height = 0.0;
            for (int i = 0; i < BODIES; i++)
                height += poses[i].position[2] / BODIES;
            printf("  %7.2f   %17d   %8d   %17.3g   %14.4f\n", step * TIME_STEP, pairs, walls, kinetic_energy(),
                   height);
        }
        move();
    }
    int lost = 0;
    for (int i = 0; i < BODIES; i++)
        lost += !(poses[i].position[2] > 0.0
                  && fmax(fabs(poses[i].position[0]), fabs(poses[i].position[1])) < HALF_WIDTH);
    const double energy = kinetic_energy();
    pp_particle_free(pyramid);
    printf("%d lost, %s\n", lost, energy < 0.05 ? "at rest" : "still moving");
    return lost != 0 || energy >= 0.05;
}
