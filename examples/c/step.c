/* SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * One step of 1,000 bodies: all their pairs in one call, on two threads, first from nothing and then from the states
 * that it left.
 *
 *     cc step.c $(pkg-config --cflags --libs potential-particles) -lm -o step
 */
#include <math.h>
#include <potential_particles.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 10, BODIES = SIDE * SIDE * SIDE, MOST_PAIRS = 13 * BODIES };

/* What a neighbour search gives: here each body of a grid with the 13 neighbours that come after it. */
static size_t neighbours(uint32_t *pairs) {
    size_t count = 0;
    for (int i = 0; i < BODIES; i++)
        for (int step = 0; step < 27; step++) {
            const int x = i % SIDE + step % 3 - 1, y = i / SIDE % SIDE + step / 3 % 3 - 1,
                      z = i / (SIDE * SIDE) + step / 9 - 1;
            const int j = x + SIDE * (y + SIDE * z);
            if (x < 0 || y < 0 || z < 0 || x >= SIDE || y >= SIDE || z >= SIDE || j <= i)
                continue;
            pairs[2 * count] = (uint32_t)i;
            pairs[2 * count + 1] = (uint32_t)j;
            count++;
        }
    return count;
}

static double uniform(void) { return 2.0 * rand() / RAND_MAX - 1.0; }

int main(void) {
    const double h = 0.5 - 0.05, planes[6][4] = { { 1, 0, 0, h },  { -1, 0, 0, h }, { 0, 1, 0, h },
                                                  { 0, -1, 0, h }, { 0, 0, 1, h },  { 0, 0, -1, h } };
    char why[PP_MESSAGE_SIZE];
    pp_particle *cube;
    if (pp_particle_new(&planes[0][0], 6, 0.05, 0.0, 1.0, &cube, why, sizeof why) != PP_OK) {
        fprintf(stderr, "step: %s\n", why);
        return 1;
    }
    static const pp_particle *particles[BODIES];
    static pp_pose poses[BODIES];
    static uint32_t pairs[2 * MOST_PAIRS];
    static pp_pair_state states[MOST_PAIRS]; /* static: all bytes 0, as a state begins */
    static pp_contact contacts[MOST_PAIRS];
    static pp_status statuses[MOST_PAIRS];
    srand(1);
    for (int i = 0; i < BODIES; i++) {
        particles[i] = cube; /* bodies of one shape share one particle */
        poses[i] = (pp_pose){{1.05 * (i % SIDE), 1.05 * (i / SIDE % SIDE), 1.05 * (i / (SIDE * SIDE))},
                             {1, 0.2 * uniform(), 0.2 * uniform(), 0.2 * uniform()}};
    }
    const size_t count = neighbours(pairs);
    for (int step = 0; step < 2; step++) {
        /* The call itself fails only if nothing was done; each pair has a status of its own. */
        const pp_status status = pp_contact_detect_batch(particles, poses, BODIES, pairs, count, NULL, 2, states,
                                                         contacts, statuses);
        if (status != PP_OK) {
            fprintf(stderr, "step: %s\n", pp_status_message(status));
            return 1;
        }
        size_t overlapping = 0, failed = 0, solved = 0;
        for (size_t n = 0; n < count; n++) {
            if (statuses[n] != PP_OK) {
                failed++; /* unknown, and not "apart" */
                continue;
            }
            overlapping += contacts[n].kind == PP_OVERLAPPING;
            solved += !(contacts[n].flags & PP_FLAG_REJECTED);
        }
        printf("step %d: %zu pairs, %zu solved, %zu overlap, %zu failed\n", step, count, solved, overlapping, failed);
        for (int i = 0; i < BODIES; i++)
            poses[i].position[2] += 1e-4 * uniform();
    }
    pp_particle_free(cube);
    return 0;
}
