/* pp_contact_detect and pp_closest_point: two balls, and what is refused. */
#include "answer.h"
#include "bodies.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <float.h>
#include <math.h>

/* The contact of two balls, no field of which is another's. */
static void contact_of_two_balls(void) {
    pp_particle *small = new_sphere(0.5), *large = new_sphere(2.0);
    const pp_pose pose_a = pose_turned(10, 20, 30, 1, 2, 3, 4), pose_b = pose_turned(10, 22.25, 30, 4, 3, 2, 1);
    pp_contact c;
    CHECK_STATUS(pp_contact_detect(small, &pose_a, large, &pose_b, NULL, NULL, &c), PP_OK);
    CHECK(c.kind == PP_OVERLAPPING && c.formulation == PP_MIDWAY && c.back_end == PP_FAST && c.reserved == 0);
    CHECK_NEAR(c.s, 0.9, c.gap + 16 * DBL_EPSILON);
    CHECK_NEAR(c.overlap, 0.25, 1e-9);
    CHECK_NEAR(c.weight, 0.8, 1e-9);
    CHECK_NEAR3(c.normal, ((const double[3]){0, 1, 0}), 1e-9);
    CHECK_NEAR3(c.point, ((const double[3]){10, 20.45, 30}), 1e-9);
    CHECK_NEAR3(c.point_on_a, ((const double[3]){10, 20.5, 30}), 1e-9);
    CHECK_NEAR3(c.point_on_b, ((const double[3]){10, 20.25, 30}), 1e-9);
    CHECK_NEAR3(c.branch_a, ((const double[3]){0, 0.45, 0}), 1e-9);
    CHECK_NEAR3(c.branch_b, ((const double[3]){0, -1.8, 0}), 1e-9);
    CHECK(isnan(c.distance) && isnan(c.s_b));
    pp_particle_free(small);
    pp_particle_free(large);
}

/* A ball is its own shadow sphere: s at distance x from its centre is x over its radius. */
static void points_of_two_balls(void) {
    pp_particle *small = new_sphere(0.5), *large = new_sphere(2.0);
    const pp_pose pose_a = pose_turned(10, 20, 30, 1, 2, 3, 4), pose_b = pose_turned(10, 22.25, 30, 4, 3, 2, 1);
    pp_closest p;
    CHECK_STATUS(pp_closest_point(small, &pose_a, large, &pose_b, PP_ON_A, NULL, &p), PP_OK);
    CHECK(p.slack == 0 && p.reserved == 0);
    CHECK_NEAR(p.s, 1.75 / 2.0, p.gap + 16 * DBL_EPSILON);
    CHECK(p.gap >= 0 && p.gap < 1e-9 && p.point_bound >= 0 && p.point_bound < 1e-6);
    CHECK_NEAR3(p.point, ((const double[3]){10, 20.5, 30}), 1e-9);
    CHECK_NEAR3(p.branch_a, ((const double[3]){0, 0.5, 0}), 1e-9);
    CHECK_NEAR3(p.branch_b, ((const double[3]){0, -1.75, 0}), 1e-9);
    CHECK_STATUS(pp_closest_point(small, &pose_a, large, &pose_b, PP_ON_B, NULL, &p), PP_OK);
    CHECK_NEAR(p.s, 0.25 / 0.5, p.gap + 16 * DBL_EPSILON);
    CHECK_NEAR3(p.branch_b, ((const double[3]){0, -2, 0}), 1e-9);

    /* The small centre inside the large ball: the large one has no such point, the small one has. */
    const pp_pose inside = pose_at(10, 21, 30);
    FILL(p);
    CHECK_STATUS(pp_closest_point(small, &inside, large, &pose_b, PP_ON_B, NULL, &p), PP_OK);
    CHECK(p.slack == 1 && p.reserved == 0);
    CHECK(isnan(p.s) && isnan(p.gap) && isnan(p.point_bound));
    for (int j = 0; j < 3; j++) CHECK(isnan(p.point[j]) && isnan(p.branch_a[j]) && isnan(p.branch_b[j]));
    CHECK_STATUS(pp_closest_point(small, &inside, large, &pose_b, PP_ON_A, NULL, &p), PP_OK);
    CHECK(p.slack == 0);
    CHECK_NEAR(p.s, 0.75 / 2.0, p.gap + 16 * DBL_EPSILON);
    pp_particle_free(small);
    pp_particle_free(large);
}

static void refusals_write_nothing(void) {
    pp_particle *ball = new_sphere(1.0);
    const pp_pose here = pose_at(0, 0, 0), there = pose_at(1.5, 0, 0), nowhere = pose_at(NAN, 0, 0);
    pp_closest p;
    FILL(p);
    CHECK_STATUS(pp_closest_point(NULL, &here, ball, &there, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point(ball, NULL, ball, &there, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point(ball, &here, NULL, &there, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point(ball, &here, ball, NULL, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point(ball, &here, ball, &there, PP_ON_A, NULL, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point(ball, &here, ball, &there, 2, NULL, &p), PP_BAD_INDEX);
    CHECK_STATUS(pp_closest_point(ball, &nowhere, ball, &there, PP_ON_A, NULL, &p), PP_BAD_POSITION);
    pp_settings settings = default_settings();
    settings.gap_tolerance = -1;
    CHECK_STATUS(pp_closest_point(ball, &here, ball, &there, PP_ON_A, &settings, &p), PP_BAD_SETTING);
    CHECK_UNTOUCHED(p);
    pp_particle_free(ball);
}

void test_closest(void) {
    contact_of_two_balls();
    points_of_two_balls();
    refusals_write_nothing();
}
