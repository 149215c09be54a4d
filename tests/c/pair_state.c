/* The solution that a pair remembers is a hint: whatever it holds, the answer stays within its gap. */
#include "answer.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <string.h>

static pp_contact detect(const pair *p, const pp_settings *settings, pp_pair_state *state) {
    pp_contact contact;
    FILL(contact);
    CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, settings, state, &contact), PP_OK);
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

static void solution_of_any_bytes(const pair_set *set) {
    pp_settings settings = settings_for(&ways[0]);
    const double values[] = {NAN, INFINITY, -INFINITY, 1e300, -1e-300, 0.5, 1.0, -1.0, DBL_MAX, DBL_TRUE_MIN};
    enum { VALUES = sizeof values / sizeof values[0], NUMBERS = sizeof((pp_pair_state *)0)->solution / sizeof(double) };
    for (int i = 0; i < 8; i++) {
        pp_contact cold = detect(&set->pairs[i], &settings, NULL);
        pp_pair_state filled = {0};
        detect(&set->pairs[i], &settings, &filled);
        for (int v = 0; v < VALUES; v++) {
            check_case("pair %d, state full of %g", i, values[v]);
            pp_pair_state spoilt;
            for (size_t j = 0; j < sizeof spoilt / sizeof(double); j++) ((double *)&spoilt)[j] = values[v];
            pp_contact contact = detect(&set->pairs[i], &settings, &spoilt);
            check_same_answer(&contact, &cold);
            /* One number of a true solution spoilt, so that the rest is believed. */
            for (int j = 0; j < NUMBERS; j++) {
                check_case("pair %d, solution with number %d = %g", i, j, values[v]);
                spoilt = filled;
                spoilt.solution[j] = values[v];
                contact = detect(&set->pairs[i], &settings, &spoilt);
                check_same_answer(&contact, &cold);
            }
        }
        for (int byte = 0; byte < 256; byte += 51) {
            check_case("pair %d, state of bytes %d", i, byte);
            pp_pair_state spoilt;
            memset(&spoilt, byte, sizeof spoilt);
            pp_contact contact = detect(&set->pairs[i], &settings, &spoilt);
            check_same_answer(&contact, &cold);
        }
    }
    check_case(NULL);
}

void test_pair_state(void) {
    pair_set set;
    pairs_new(&set);
    solution_of_any_bytes(&set);
    pairs_free(&set);
}
