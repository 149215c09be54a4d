/* pp_contact_detect_batch_2d: what is wrong with one pair does not touch the others, which have the very bits of a call
 * for their pair alone. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A row of bodies that touch their neighbours; more pairs than one chunk for each of several threads. */
enum { SHAPES = 3, BODIES = 300, MANY = 2 * BODIES - 3 };

typedef struct {
    pp_particle_2d *shapes[SHAPES];
    const pp_particle_2d *particles[BODIES];
    pp_pose_2d poses[BODIES];
    uint32_t pairs[2 * MANY];
} scene;

/* Each body with the next one and the one behind that. */
static void scene_new(scene *s) {
    s->shapes[0] = new_square_2d(0.4, 0.1, 0.1, 0.8);
    s->shapes[1] = new_square_2d(0.45, 0.05, 0.0, 0.0);
    s->shapes[2] = new_circle_2d(0.5);
    random_numbers numbers = {11};
    for (int i = 0; i < BODIES; i++) {
        s->particles[i] = s->shapes[i % SHAPES];
        s->poses[i] = (pp_pose_2d){{i, 0.3 * random_next(&numbers)}, 3.0 * random_next(&numbers)};
    }
    uint32_t n = 0;
    for (uint32_t further = 1; further <= 2; further++) {
        for (uint32_t i = 0; i + further < BODIES; i++) s->pairs[n++] = i, s->pairs[n++] = i + further;
    }
}

static void scene_free(scene *s) {
    for (int i = 0; i < SHAPES; i++) pp_particle_free_2d(s->shapes[i]);
}

typedef struct {
    pp_pair_state states[MANY];
    pp_contact_2d contacts[MANY];
    pp_status statuses[MANY];
} results;

static pp_status batch(const scene* s, const pp_settings* settings, uint32_t threads, pp_pair_state* states, results* r)
{
    return pp_contact_detect_batch_2d(s->particles, s->poses, BODIES, s->pairs, MANY, settings, threads, states,
                                      r->contacts, r->statuses);
}

static void one_by_one(const scene *s, const pp_settings *settings, pp_pair_state *states, results *r) {
    for (int n = 0; n < MANY; n++) {
        const uint32_t a = s->pairs[2 * n], b = s->pairs[2 * n + 1];
        r->statuses[n] = pp_contact_detect_2d(s->particles[a], &s->poses[a], s->particles[b], &s->poses[b], settings,
                                              states ? &states[n] : NULL, &r->contacts[n]);
    }
}

/* A body that is not there, one without a particle, one with a bad pose: told by the pairs that name it. */
static void faults_stay_with_their_pairs(const scene *good, results *alone, results *got) {
    scene s = *good;
    memset(alone, 0, sizeof *alone);
    one_by_one(&s, NULL, alone->states, alone);
    s.particles[3] = NULL;
    s.poses[8].position[1] = NAN;
    s.poses[20].angle = INFINITY;
    s.pairs[2 * 100] = BODIES;
    s.pairs[2 * 101 + 1] = UINT32_MAX;
    for (uint32_t threads = 1; threads <= 4; threads += 3) {
        FILL(*got);
        memset(got->states, 0, sizeof got->states);
        CHECK_STATUS(batch(&s, NULL, threads, got->states, got), PP_OK);
        int faults = 0;
        for (int n = 0; n < MANY; n++) {
            pp_status expected = PP_OK;
            for (int i = 0; i < 2; i++) {
                const uint32_t body = s.pairs[2 * n + i];
                if (body >= BODIES) expected = PP_BAD_INDEX;
                else if (body == 3) expected = PP_NULL_POINTER;
                else if (body == 8) expected = PP_BAD_POSITION;
                else if (body == 20) expected = PP_BAD_ORIENTATION;
            }
            check_case("%u threads, pair %d", (unsigned)threads, n);
            CHECK_STATUS(got->statuses[n], expected);
            if (expected == PP_OK) {
                CHECK_SAME_BYTES(&got->contacts[n], &alone->contacts[n], sizeof(pp_contact_2d));
                CHECK_SAME_BYTES(&got->states[n], &alone->states[n], sizeof(pp_pair_state));
            } else {
                faults++;
                CHECK_UNTOUCHED(got->contacts[n]);
                CHECK(got->states[n].solution[0] == 0);
            }
        }
        CHECK(faults == 3 * 4 + 2);
    }
    check_case(NULL);
}

static void bad_arguments_write_nothing(const scene *s, results *got) {
    FILL(*got);
#define BATCH(particles, poses, bodies, pairs, count, contacts, statuses) \
    pp_contact_detect_batch_2d(particles, poses, bodies, pairs, count, NULL, 2, got->states, contacts, statuses)
    CHECK_STATUS(BATCH(NULL, s->poses, BODIES, s->pairs, MANY, got->contacts, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s->particles, NULL, BODIES, s->pairs, MANY, got->contacts, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s->particles, s->poses, BODIES, NULL, MANY, got->contacts, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s->particles, s->poses, BODIES, s->pairs, MANY, NULL, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s->particles, s->poses, BODIES, s->pairs, MANY, got->contacts, NULL), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s->particles, s->poses, SIZE_MAX, s->pairs, MANY, got->contacts, got->statuses), PP_BAD_INDEX);
    CHECK_STATUS(BATCH(s->particles, s->poses, BODIES, s->pairs, SIZE_MAX, got->contacts, got->statuses), PP_BAD_INDEX);
    pp_settings settings = default_settings();
    settings.back_end = 7;
    CHECK_STATUS(batch(s, &settings, 2, got->states, got), PP_UNKNOWN_BACK_END);
    settings = default_settings();
    settings.gap_tolerance = 0;
    CHECK_STATUS(batch(s, &settings, 2, got->states, got), PP_BAD_SETTING);
    CHECK_STATUS(pp_contact_detect_batch_2d(NULL, NULL, 0, NULL, 0, NULL, 4, NULL, NULL, NULL), PP_OK);
    void *anywhere = (void *)(uintptr_t)1;
    CHECK_STATUS(pp_contact_detect_batch_2d(anywhere, anywhere, 0, anywhere, 0, NULL, 1, anywhere, anywhere, anywhere),
                 PP_OK);
    CHECK_UNTOUCHED(*got);
#undef BATCH
}

void test_planar_batch(void) {
    results *alone = malloc(sizeof *alone), *got = malloc(sizeof *got);
    CHECK(alone != NULL && got != NULL);
    if (alone == NULL || got == NULL) exit(2);
    scene s;
    scene_new(&s);
    faults_stay_with_their_pairs(&s, alone, got);
    bad_arguments_write_nothing(&s, got);
    scene_free(&s);
    free(alone);
    free(got);
}
