/* What a pair remembers is a hint: whatever it holds, the answer stays within its gap. */
#include "answer.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <string.h>

static pp_contact detect(const pair *p, const pp_settings *settings, pp_memory *memory) {
    pp_contact contact;
    FILL(contact);
    CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, settings, memory, &contact), PP_OK);
    return contact;
}

static void check_same_answer(const pp_contact *warm, const pp_contact *cold) {
    double both = warm->gap + cold->gap + 4 * DBL_EPSILON * cold->s;
    CHECK(warm->kind == cold->kind || fabs(cold->s - 1) <= both);
    CHECK_NEAR(warm->s, cold->s, both);
    CHECK(warm->formulation == cold->formulation);
    CHECK_NEAR3(warm->normal, cold->normal, 1e-6);
    CHECK_NEAR3(warm->point, cold->point, 1e-6);
}

static void memory_of_other_pairs(const pair_set *set) {
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        pp_memory wandering = {{0}};
        int warm_starts = 0;
        for (int i = 0; i < PAIRS; i++) {
            check_case("pair %d, %s", i, ways[w].name);
            pp_contact cold = detect(&set->pairs[i], &settings, NULL);
            check_consistent(&cold, &set->pairs[i].pose_a, &set->pairs[i].pose_b, &settings);
            CHECK((cold.flags & PP_FLAG_WARM) == 0);

            /* Empty memory is no memory. */
            pp_memory own = {{0}};
            pp_contact first = detect(&set->pairs[i], &settings, &own);
            CHECK_SAME_BYTES(&first, &cold, sizeof cold);
            pp_contact second = detect(&set->pairs[i], &settings, &own);
            check_same_answer(&second, &cold);
            warm_starts += (second.flags & PP_FLAG_WARM) != 0;

            pp_contact elsewhere = detect(&set->pairs[i], &settings, &wandering);
            check_same_answer(&elsewhere, &cold);
        }
        /* The hint is used at all; clarabel cannot take one. */
        check_case("warm starts, %s", ways[w].name);
        CHECK(ways[w].back_end == PP_FAST ? warm_starts > PAIRS / 2 : warm_starts == 0);
    }
    check_case(NULL);
}

static void memory_of_any_bytes(const pair_set *set) {
    pp_settings settings = settings_for(&ways[0]);
    const double values[] = {NAN, INFINITY, -INFINITY, 1e300, -1e-300, 0.5, 1.0, -1.0, DBL_MAX, DBL_TRUE_MIN};
    enum { VALUES = sizeof values / sizeof values[0], NUMBERS = sizeof((pp_memory *)0)->state / sizeof(double) };
    for (int i = 0; i < 8; i++) {
        pp_contact cold = detect(&set->pairs[i], &settings, NULL);
        pp_memory filled = {{0}};
        detect(&set->pairs[i], &settings, &filled);
        for (int v = 0; v < VALUES; v++) {
            check_case("pair %d, memory full of %g", i, values[v]);
            pp_memory spoilt;
            for (int j = 0; j < NUMBERS; j++) spoilt.state[j] = values[v];
            pp_contact contact = detect(&set->pairs[i], &settings, &spoilt);
            check_same_answer(&contact, &cold);
            /* One number of a true memory spoilt, so that the rest is believed. */
            for (int j = 0; j < NUMBERS; j++) {
                check_case("pair %d, memory with number %d = %g", i, j, values[v]);
                spoilt = filled;
                spoilt.state[j] = values[v];
                contact = detect(&set->pairs[i], &settings, &spoilt);
                check_same_answer(&contact, &cold);
            }
        }
        for (int byte = 0; byte < 256; byte += 51) {
            check_case("pair %d, memory of bytes %d", i, byte);
            pp_memory spoilt;
            memset(&spoilt, byte, sizeof spoilt);
            pp_contact contact = detect(&set->pairs[i], &settings, &spoilt);
            check_same_answer(&contact, &cold);
        }
    }
    check_case(NULL);
}

/* Room to grow: what this library does not use is written as 0, whatever was there. */
static void reserved_numbers_are_zero(const pair_set *set) {
    pp_settings settings = settings_for(&ways[0]);
    pp_memory memory;
    memset(&memory, 0x5A, sizeof memory);
    detect(&set->pairs[0], &settings, &memory);
    CHECK(memory.state[0] == 1);
    for (int j = 8; j < 16; j++) CHECK(memory.state[j] == 0);
}

void test_memory(void) {
    pair_set set;
    pairs_new(&set);
    memory_of_other_pairs(&set);
    memory_of_any_bytes(&set);
    reserved_numbers_are_zero(&set);
    pairs_free(&set);
}
