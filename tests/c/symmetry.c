/* What must not matter: which body is called A, and where the pair lies. */
#include "answer.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <float.h>
#include <math.h>

static pp_contact detect(const pair *p, const pp_settings *settings) {
    pp_contact contact;
    FILL(contact);
    CHECK_STATUS(pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, settings, NULL, &contact), PP_OK);
    return contact;
}

static void swapped_bodies_mirror(const pair_set *set) {
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        accuracy allowed = accuracy_of(settings.back_end, 1.0);
        for (int i = 0; i < PAIRS; i++) {
            const pair *p = &set->pairs[i];
            pair swapped = {.a = p->b, .b = p->a, .pose_a = p->pose_b, .pose_b = p->pose_a};
            check_case("pair %d, %s", i, ways[w].name);
            pp_contact one = detect(p, &settings), two = detect(&swapped, &settings);
            double both = one.gap + two.gap + 4 * DBL_EPSILON * one.s, opposite[3];
            walk((const double[3]){0, 0, 0}, -1.0, two.normal, opposite);
            CHECK(one.formulation == two.formulation);
            if (one.formulation == PP_MIDWAY) {
                CHECK(one.kind == two.kind || fabs(one.s - 1) <= both);
                CHECK_NEAR(one.s, two.s, both);
                CHECK_NEAR(one.weight, 1 - two.weight, allowed.direction);
            } else {
                /* A problem of its own per body: s of the one order is s_b of the other. */
                CHECK_NEAR(one.s, two.s_b, both + allowed.s * one.s);
                CHECK_NEAR(one.s_b, two.s, both + allowed.s * two.s);
            }
            if (one.kind == PP_OVERLAPPING && two.kind == PP_OVERLAPPING) {
                CHECK_NEAR(one.overlap, two.overlap, allowed.length);
                CHECK_NEAR3(one.point_on_a, two.point_on_b, allowed.length);
                CHECK_NEAR3(one.point_on_b, two.point_on_a, allowed.length);
            }
            CHECK_NEAR3(one.normal, opposite, allowed.direction);
            CHECK_NEAR3(one.point, two.point, allowed.length);
            CHECK_NEAR3(one.branch_a, two.branch_b, allowed.length);
            CHECK_NEAR3(one.branch_b, two.branch_a, allowed.length);
        }
    }
    check_case(NULL);
}

/* Positions on a grid of 2^-20 moved by 2^30: the difference of the two is the same double, and so
 * must be all that is measured from the bodies. */
static void far_from_the_origin(const pair_set *set) {
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        for (int i = 0; i < PAIRS; i++) {
            pair here = set->pairs[i];
            for (int j = 0; j < 3; j++) {
                here.pose_a.position[j] = ldexp(floor(ldexp(here.pose_a.position[j], 20)), -20);
                here.pose_b.position[j] = ldexp(floor(ldexp(here.pose_b.position[j], 20)), -20);
            }
            pair there = here;
            for (int j = 0; j < 3; j++) {
                there.pose_a.position[j] += j == 1 ? -0x1p30 : 0x1p30;
                there.pose_b.position[j] += j == 1 ? -0x1p30 : 0x1p30;
            }
            check_case("pair %d, %s", i, ways[w].name);
            pp_contact near = detect(&here, &settings), far = detect(&there, &settings);
            CHECK_SAME_BYTES(&far.s, &near.s, sizeof near.s);
            CHECK_SAME_BYTES(&far.overlap, &near.overlap, sizeof near.overlap);
            CHECK_SAME_BYTES(far.normal, near.normal, sizeof near.normal);
            CHECK_SAME_BYTES(far.branch_a, near.branch_a, sizeof near.branch_a);
            CHECK_SAME_BYTES(far.branch_b, near.branch_b, sizeof near.branch_b);
        }
    }
    check_case(NULL);
}

void test_symmetry(void) {
    pair_set set;
    pairs_new(&set);
    swapped_bodies_mirror(&set);
    far_from_the_origin(&set);
    pairs_free(&set);
}
