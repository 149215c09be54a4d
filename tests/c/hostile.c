/* A hostile caller: every double of every struct that goes in spoilt in turn, numbers at the ends of their range,
 * the state of one pair used for another. Whatever comes, a status comes back, and nothing else is touched. */
#include "answer.h"
#include "bodies.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

static const double extremes[] = {
    NAN,     INFINITY, -INFINITY, 0.0,  -0.0,   DBL_TRUE_MIN, -DBL_TRUE_MIN, DBL_MIN, DBL_MAX,
    -DBL_MAX, 1e-200,  1e200,     1e18, -1e-18, DBL_EPSILON,  1.0,           -1.0,
};
enum { EXTREMES = sizeof extremes / sizeof extremes[0] };

/* An answer with a status of success holds together; any other status leaves the output as it was. */
static void check_call(pp_status status, const pp_contact *contact) {
    if (status != PP_OK) {
        CHECK(status > 0 && status != PP_INTERNAL_ERROR);
        CHECK_UNTOUCHED(*contact);
        return;
    }
    CHECK(contact->kind == PP_SEPARATED || contact->kind == PP_OVERLAPPING);
    CHECK(contact->s >= 0);
    CHECK((contact->kind == PP_OVERLAPPING) == (contact->s < 1));
    CHECK(contact->kind == PP_SEPARATED || isfinite(contact->overlap));
    CHECK((contact->flags & PP_FLAG_REJECTED) != 0 || fabs(dot(contact->normal, contact->normal) - 1) < 1e-12);
    CHECK(contact->reserved == 0);
}

/* Poses with one number, then two, at an extreme. */
static void poses_of_any_numbers(const pair_set *set) {
    const pair *p = &set->pairs[0];
    for (int e = 0; e < EXTREMES; e++) {
        for (int i = 0; i < 14; i++) {
            for (int j = i; j < 14; j++) {
                pp_pose poses[2] = {p->pose_a, p->pose_b};
                double *numbers = (double *)poses;
                numbers[i] = numbers[j] = extremes[e];
                check_case("pose numbers %d and %d = %g", i, j, extremes[e]);
                pp_contact contact;
                pp_pair_state state = {0};
                FILL(contact);
                pp_status status = pp_contact_detect(p->a, &poses[0], p->b, &poses[1], NULL, &state, &contact);
                check_call(status, &contact);
                if (!isfinite(extremes[e])) CHECK(status == PP_BAD_POSITION || status == PP_BAD_ORIENTATION);
            }
        }
    }
    check_case(NULL);
}

/* Particles with one number at an extreme: refused with a sentence, or whole. */
static void particles_of_any_numbers(void) {
    pp_particle *partner = new_cube(0.5, 0.1, 0.2, 1.0);
    pp_pose here = pose_at(0, 0, 0), there = pose_turned(0.3, 0.2, 0.9, 1, 0.1, 0.2, 0.3);
    for (int e = 0; e < EXTREMES; e++) {
        for (int i = 0; i < 4 * CUBE_PLANES + 3; i++) {
            double planes[4 * CUBE_PLANES + 3];
            cube_planes(0.4, planes);
            double *r = planes + 4 * CUBE_PLANES, *k = r + 1, *shadow = r + 2;
            *r = 0.1, *k = 0.2, *shadow = 0.9;
            planes[i] = extremes[e];
            check_case("particle number %d = %g", i, extremes[e]);
            pp_particle *particle;
            char why[PP_MESSAGE_SIZE];
            FILL(particle);
            FILL(why);
            pp_status status = pp_particle_new(planes, CUBE_PLANES, *r, *k, *shadow, &particle, why, sizeof why);
            if (status != PP_OK) {
                CHECK(status >= PP_PLANE_NOT_FINITE && status <= PP_BAD_SIZE);
                CHECK_UNTOUCHED(particle);
                CHECK(memchr(why, 0, sizeof why) != NULL && why[0] != 0);
                continue;
            }
            double radius = NAN;
            CHECK_STATUS(pp_particle_bounding_radius(particle, &radius), PP_OK);
            CHECK(radius > 0 && isfinite(radius));
            for (int w = 0; w < 2; w++) {
                pp_settings settings = settings_for(&ways[w]);
                pp_contact contact;
                FILL(contact);
                check_call(pp_contact_detect(particle, &here, partner, &there, &settings, NULL, &contact), &contact);
            }
            pp_particle_free(particle);
        }
    }
    check_case(NULL);
    pp_particle_free(partner);
}

/* Contacts given back for their area with any number spoilt. */
static void contacts_of_any_numbers(const pair_set *set) {
    const pair *p = &set->pairs[0];
    pp_settings settings = settings_for(&ways[0]);
    pp_contact good;
    CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, &settings, NULL, &good), PP_OK);
    size_t first = offsetof(pp_contact, s) / sizeof(double), count = sizeof good / sizeof(double);
    for (int e = 0; e < EXTREMES; e++) {
        for (size_t i = first; i < count; i++) {
            pp_contact spoilt = good;
            memcpy((char *)&spoilt + i * sizeof(double), &extremes[e], sizeof(double));
            check_case("contact double %zu = %g", i, extremes[e]);
            double area;
            FILL(area);
            pp_status status = pp_contact_area(p->a, &p->pose_a, p->b, &p->pose_b, &spoilt, 1e-3, &area);
            if (status == PP_OK) CHECK(area >= 0);
            else CHECK_UNTOUCHED(area);
        }
    }
    check_case(NULL);
}

/* One state that wanders over all pairs and both orders, and a copy of it that stays behind. */
static void one_state_for_all(const pair_set *set) {
    pp_settings settings = settings_for(&ways[0]);
    pp_pair_state wandering = {0}, old = {0};
    for (int round = 0; round < 4; round++) {
        for (int i = 0; i < PAIRS; i++) {
            const pair *p = &set->pairs[(7 * i + round) % PAIRS];
            check_case("round %d, pair %d", round, i);
            pp_contact cold, warm, stale;
            CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, &settings, NULL, &cold), PP_OK);
            CHECK_STATUS(pp_contact_detect(p->b, &p->pose_b, p->a, &p->pose_a, &settings, &wandering, &warm), PP_OK);
            CHECK_NEAR(warm.s, cold.s, warm.gap + cold.gap);
            CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, &settings, &wandering, &warm), PP_OK);
            CHECK_NEAR(warm.s, cold.s, warm.gap + cold.gap);
            pp_pair_state copy = old;
            CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, &settings, &copy, &stale), PP_OK);
            CHECK_NEAR(stale.s, cold.s, stale.gap + cold.gap);
            if (i == PAIRS / 2) old = wandering;
        }
    }
    check_case(NULL);
}

/* Positions that are finite one by one, yet whose difference is not: nobody can solve that, and a
 * failed solve is neither "separated" nor an answer. */
static void overflow_is_a_failure(void) {
    pp_particle *a = new_sphere(1.0);
    pp_pose pose_a = pose_at(-1.7e308, 0, 0), pose_b = pose_at(1.7e308, 0, 0);
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        pp_contact contact;
        pp_pair_state state;
        FILL(contact);
        FILL(state);
        check_case("overflow, %s", ways[w].name);
        CHECK_STATUS(pp_contact_detect(a, &pose_a, a, &pose_b, &settings, &state, &contact), PP_SOLVER_FAILED);
        CHECK_UNTOUCHED(contact);
        CHECK_UNTOUCHED(state);
    }
    check_case(NULL);
    pp_particle_free(a);
}

void test_hostile(void) {
    pair_set set;
    pairs_new(&set);
    poses_of_any_numbers(&set);
    particles_of_any_numbers();
    contacts_of_any_numbers(&set);
    one_state_for_all(&set);
    overflow_is_a_failure();
    pairs_free(&set);
}
