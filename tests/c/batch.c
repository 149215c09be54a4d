/* pp_contact_detect_batch: every contact and state has the very bits of a call for its pair alone, whatever the number
 * of threads, and what is wrong with one pair does not touch the others. */
#include "bodies.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* More than one chunk for each of several threads, and no multiple of any. */
enum { BODIES = 2 * PAIRS, MANY = 777, STEPS = 3 };

typedef struct {
    pair_set set;
    const pp_particle *particles[BODIES];
    pp_pose poses[BODIES];
    uint32_t pairs[2 * MANY];
} scene;

/* The true pairs first, then bodies as they come, most of them far from each other. */
static void scene_new(scene *s) {
    pairs_new(&s->set);
    for (int i = 0; i < PAIRS; i++) {
        s->particles[2 * i] = s->set.pairs[i].a, s->poses[2 * i] = s->set.pairs[i].pose_a;
        s->particles[2 * i + 1] = s->set.pairs[i].b, s->poses[2 * i + 1] = s->set.pairs[i].pose_b;
    }
    random_numbers numbers = {7};
    for (uint32_t n = 0; n < 2 * MANY; n++) {
        s->pairs[n] = n < BODIES ? n : (uint32_t)((random_next(&numbers) + 1) / 2 * BODIES);
    }
}

/* What a step of one's own moves. */
static void move(scene *s) {
    for (int i = 0; i < BODIES; i++) s->poses[i].position[i % 3] += 1e-3;
}

typedef struct {
    pp_pair_state states[MANY];
    pp_contact contacts[MANY];
    pp_status statuses[MANY];
} results;

static pp_status batch(const scene* s, const pp_settings* settings, uint32_t threads, pp_pair_state* states, results* r)
{
    return pp_contact_detect_batch(s->particles, s->poses, BODIES, s->pairs, MANY, settings, threads, states,
                                   r->contacts, r->statuses);
}

static void one_by_one(const scene *s, const pp_settings *settings, pp_pair_state *states, results *r) {
    for (int n = 0; n < MANY; n++) {
        const uint32_t a = s->pairs[2 * n], b = s->pairs[2 * n + 1];
        r->statuses[n] = pp_contact_detect(s->particles[a], &s->poses[a], s->particles[b], &s->poses[b], settings,
                                           states ? &states[n] : NULL, &r->contacts[n]);
    }
}

static void check_same(const results *got, const results *expected) {
    CHECK_SAME_BYTES(got->statuses, expected->statuses, sizeof got->statuses);
    CHECK_SAME_BYTES(got->contacts, expected->contacts, sizeof got->contacts);
    CHECK_SAME_BYTES(got->states, expected->states, sizeof got->states);
}

static void same_bits_as_one_by_one(results *alone, results *got) {
    const uint32_t threads[] = {0, 1, 2, 4, 1000};
    for (uint32_t formulation = PP_MIDWAY; formulation <= PP_CLOSEST; formulation++) {
        pp_settings settings = default_settings();
        settings.formulation = formulation;
        for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++) {
            scene s;
            scene_new(&s);
            memset(alone, 0, sizeof *alone);
            memset(got, 0, sizeof *got);
            for (int step = 0; step < STEPS; step++) {
                check_case("formulation %u, %u threads, step %d", (unsigned)formulation, (unsigned)threads[t], step);
                one_by_one(&s, &settings, alone->states, alone);
                CHECK_STATUS(batch(&s, &settings, threads[t], got->states, got), PP_OK);
                check_same(got, alone);
                int contacts = 0, warm = 0;
                for (int n = 0; n < MANY; n++) {
                    CHECK_STATUS(got->statuses[n], PP_OK);
                    contacts += got->contacts[n].kind == PP_OVERLAPPING;
                    warm += (got->contacts[n].flags & PP_FLAG_WARM) != 0;
                }
                /* The states are used: what overlapped before starts where it was. */
                CHECK(contacts > PAIRS / 4 && contacts < MANY / 2);
                CHECK(step == 0 ? warm == 0 : warm >= contacts - 3);
                move(&s);
            }
            pairs_free(&s.set);
        }
    }
    check_case("no states, no settings");
    scene s;
    scene_new(&s);
    memset(alone, 0, sizeof *alone);
    memset(got, 0, sizeof *got);
    one_by_one(&s, NULL, NULL, alone);
    CHECK_STATUS(batch(&s, NULL, 2, NULL, got), PP_OK);
    check_same(got, alone);
    check_case(NULL);
    pairs_free(&s.set);
}

/* Followed from pose to pose, with contacts that are carried on. */
static void carried_as_one_by_one(results *alone, results *got) {
    pp_settings settings = default_settings();
    settings.carry_tolerance = 1e-9;
    for (uint32_t threads = 1; threads <= 2; threads++) {
        scene s;
        scene_new(&s);
        memset(alone, 0, sizeof *alone);
        memset(got, 0, sizeof *got);
        int carried = 0;
        for (int step = 0; step < STEPS; step++) {
            check_case("carried, %u threads, step %d", (unsigned)threads, step);
            one_by_one(&s, &settings, alone->states, alone);
            CHECK_STATUS(batch(&s, &settings, threads, got->states, got), PP_OK);
            check_same(got, alone);
            for (int n = 0; n < MANY; n++) carried += (got->contacts[n].flags & PP_FLAG_CARRIED) != 0;
            for (int i = 0; i < BODIES; i++) s.poses[i].position[i % 3] += 1e-7;
        }
        CHECK(carried > PAIRS / 4);
        check_case("without states all are solved, as without carry_tolerance");
        CHECK_STATUS(batch(&s, NULL, threads, NULL, alone), PP_OK);
        CHECK_STATUS(batch(&s, &settings, threads, NULL, got), PP_OK);
        CHECK_SAME_BYTES(got->contacts, alone->contacts, sizeof got->contacts);
        check_case(NULL);
        pairs_free(&s.set);
    }
}

/* A body that is not there, one without a particle, one with a bad pose: told by the pairs that name it. */
static void faults_stay_with_their_pairs(results *alone, results *got) {
    scene s;
    scene_new(&s);
    memset(alone, 0, sizeof *alone);
    one_by_one(&s, NULL, alone->states, alone);
    s.particles[3] = NULL;
    s.poses[8].position[1] = NAN;
    s.poses[9].orientation[0] = INFINITY;
    s.pairs[10] = BODIES;
    s.pairs[13] = UINT32_MAX;
    /* Both at fault, in either order. */
    const uint32_t faulty[] = {8, 3, 3, 8, 9, 3, 9, 8};
    memcpy(&s.pairs[60], faulty, sizeof faulty);
    for (uint32_t threads = 1; threads <= 4; threads += 3) {
        FILL(*got);
        memset(got->states, 0, sizeof got->states);
        CHECK_STATUS(batch(&s, NULL, threads, got->states, got), PP_OK);
        int faults = 0;
        for (int n = 0; n < MANY; n++) {
            const uint32_t a = s.pairs[2 * n], b = s.pairs[2 * n + 1];
            pp_status expected = PP_OK;
            const uint32_t both[2] = {b, a};
            /* That of A is told where both are at fault. */
            for (int i = 0; i < 2; i++) {
                if (both[i] >= BODIES) expected = PP_BAD_INDEX;
                else if (both[i] == 3) expected = PP_NULL_POINTER;
                else if (both[i] == 8) expected = PP_BAD_POSITION;
                else if (both[i] == 9) expected = PP_BAD_ORIENTATION;
            }
            check_case("%u threads, pair %d of %u and %u", (unsigned)threads, n, (unsigned)a, (unsigned)b);
            CHECK_STATUS(got->statuses[n], expected);
            pp_contact single;
            if (a < BODIES && b < BODIES) {
                CHECK_STATUS(pp_contact_detect(s.particles[a], &s.poses[a], s.particles[b], &s.poses[b], NULL, NULL,
                                               &single),
                             expected);
            }
            if (expected == PP_OK) {
                CHECK_SAME_BYTES(&got->contacts[n], &alone->contacts[n], sizeof(pp_contact));
                CHECK_SAME_BYTES(&got->states[n], &alone->states[n], sizeof(pp_pair_state));
            } else {
                faults++;
                CHECK_UNTOUCHED(got->contacts[n]);
                CHECK(got->states[n].solution[0] == 0);
            }
        }
        CHECK(faults >= 6);
    }
    check_case(NULL);
    pairs_free(&s.set);
}

static void bad_arguments_write_nothing(results *got) {
    scene s;
    scene_new(&s);
    FILL(*got);
#define BATCH(particles, poses, bodies, pairs, count, contacts, statuses) \
    pp_contact_detect_batch(particles, poses, bodies, pairs, count, NULL, 2, got->states, contacts, statuses)
    CHECK_STATUS(BATCH(NULL, s.poses, BODIES, s.pairs, MANY, got->contacts, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s.particles, NULL, BODIES, s.pairs, MANY, got->contacts, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s.particles, s.poses, BODIES, NULL, MANY, got->contacts, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s.particles, s.poses, BODIES, s.pairs, MANY, NULL, got->statuses), PP_NULL_POINTER);
    CHECK_STATUS(BATCH(s.particles, s.poses, BODIES, s.pairs, MANY, got->contacts, NULL), PP_NULL_POINTER);
    /* No memory holds so many: seen before anything is read. */
    CHECK_STATUS(BATCH(s.particles, s.poses, SIZE_MAX, s.pairs, MANY, got->contacts, got->statuses), PP_BAD_INDEX);
    CHECK_STATUS(BATCH(s.particles, s.poses, BODIES, s.pairs, SIZE_MAX, got->contacts, got->statuses), PP_BAD_INDEX);
    pp_settings settings = default_settings();
    settings.formulation = 7;
    CHECK_STATUS(batch(&s, &settings, 2, got->states, got), PP_UNKNOWN_FORMULATION);
    settings = default_settings();
    settings.back_end = 7;
    CHECK_STATUS(batch(&s, &settings, 2, got->states, got), PP_UNKNOWN_BACK_END);
    settings = default_settings();
    settings.gap_tolerance = 0;
    CHECK_STATUS(batch(&s, &settings, 2, got->states, got), PP_BAD_SETTING);
    CHECK_UNTOUCHED(*got);

    /* Nothing to do, and nothing to do it with. */
    CHECK_STATUS(pp_contact_detect_batch(NULL, NULL, 0, NULL, 0, NULL, 4, NULL, NULL, NULL), PP_OK);
    CHECK_STATUS(BATCH(s.particles, s.poses, BODIES, NULL, 0, NULL, NULL), PP_OK);
    /* Where a pointer to nothing leads does not matter: other languages have such ones. */
    void *anywhere = (void *)(uintptr_t)1;
    CHECK_STATUS(BATCH(s.particles, s.poses, BODIES, anywhere, 0, anywhere, anywhere), PP_OK);
    CHECK_STATUS(pp_contact_detect_batch(anywhere, anywhere, 0, anywhere, 0, NULL, 1, anywhere, anywhere, anywhere),
                 PP_OK);
    CHECK_UNTOUCHED(*got);
    CHECK_STATUS(BATCH(NULL, NULL, 0, s.pairs, 1, got->contacts, got->statuses), PP_OK);
    CHECK_STATUS(got->statuses[0], PP_BAD_INDEX);
#undef BATCH
    pairs_free(&s.set);
}

void test_batch(void) {
    results *alone = malloc(sizeof *alone), *got = malloc(sizeof *got);
    CHECK(alone != NULL && got != NULL);
    if (alone == NULL || got == NULL) exit(2);
    same_bits_as_one_by_one(alone, got);
    carried_as_one_by_one(alone, got);
    faults_stay_with_their_pairs(alone, got);
    bad_arguments_write_nothing(got);
    free(alone);
    free(got);
}
