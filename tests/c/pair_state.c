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

static void state_of_other_pairs(const pair_set *set) {
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        pp_pair_state wandering = {0};
        int warm_starts = 0;
        for (int i = 0; i < PAIRS; i++) {
            check_case("pair %d, %s", i, ways[w].name);
            pp_contact cold = detect(&set->pairs[i], &settings, NULL);
            check_consistent(&cold, &set->pairs[i].pose_a, &set->pairs[i].pose_b, &settings);
            CHECK((cold.flags & PP_FLAG_WARM) == 0);

            /* An empty state is no state. */
            pp_pair_state own = {0};
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

/* A number of any size and sign, or any bits at all. */
static double any_number(random_numbers *numbers) {
    const double choice = random_next(numbers), power = random_next(numbers), sign = random_next(numbers) < 0 ? -1 : 1;
    if (choice < 0) return sign * pow(10, 3 * power);
    if (choice < 0.6) return sign * pow(10, 308 * power);
    double any;
    random_next(numbers);
    memcpy(&any, &numbers->state, sizeof any);
    return any;
}

/* States of random numbers that say they are filled: the kind is that of the cold answer, and the gap says something.
 */
static void state_of_random_numbers(const pair_set *set) {
    random_numbers numbers = {23};
    int overlapping = 0;
    for (int time = 0; time < 20000; time++) {
        const pair *p = &set->pairs[time % PAIRS];
        pp_settings settings = default_settings();
        settings.formulation = (uint32_t)(time / PAIRS % 2);
        settings.carry_tolerance = 1e-9;
        pp_contact cold = detect(p, &settings, NULL);
        pp_pair_state state;
        for (size_t j = 0; j < sizeof state / sizeof(double); j++) ((double *)&state)[j] = any_number(&numbers);
        state.solution[0] = 1;
        check_case("state %d of random numbers", time);
        for (int again = 0; again < 2; again++) {
            pp_contact contact = detect(p, &settings, &state);
            CHECK(contact.kind == cold.kind || fabs(cold.s - 1) < 1e-9);
            if (contact.kind != PP_OVERLAPPING || cold.kind != PP_OVERLAPPING) continue;
            overlapping++;
            CHECK_NEAR(contact.s, cold.s, contact.gap + cold.gap + 4 * DBL_EPSILON);
            CHECK(contact.gap < 1e-9 + 10 * cold.gap);
        }
    }
    check_case(NULL);
    CHECK(overlapping > 10000);
}

void test_pair_state(void) {
    pair_set set;
    pairs_new(&set);
    state_of_other_pairs(&set);
    solution_of_any_bytes(&set);
    state_of_random_numbers(&set);
    pairs_free(&set);
}
