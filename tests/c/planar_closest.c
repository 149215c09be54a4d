/* pp_closest_point_2d: one closest point alone, against closed forms. */
#include "answer.h"
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>

/* A circle is its own shadow: s at distance x from its centre is x over its radius. */
static void points_of_two_circles(void) {
    pp_particle_2d *small = new_circle_2d(0.5), *large = new_circle_2d(2.0);
    const pp_pose_2d pose_a = {{10, 20}, 1.0}, pose_b = {{10, 22.25}, -2.0}, inside = {{10, 21}, 0.0};
    pp_closest_2d p;
    CHECK_STATUS(pp_closest_point_2d(small, &pose_a, large, &pose_b, PP_ON_A, NULL, &p), PP_OK);
    CHECK(p.slack == 0 && p.reserved == 0);
    CHECK_NEAR(p.s, 1.75 / 2.0, p.gap + 16 * DBL_EPSILON);
    CHECK(p.gap >= 0 && p.gap < 1e-9 && p.point_bound >= 0 && p.point_bound < 1e-6);
    CHECK_NEAR2(p.point, 10, 20.5, 1e-9);
    CHECK_NEAR2(p.branch_a, 0, 0.5, 1e-9);
    CHECK_NEAR2(p.branch_b, 0, -1.75, 1e-9);
    CHECK_STATUS(pp_closest_point_2d(small, &pose_a, large, &pose_b, PP_ON_B, NULL, &p), PP_OK);
    CHECK_NEAR(p.s, 0.25 / 0.5, p.gap + 16 * DBL_EPSILON);
    CHECK_NEAR2(p.branch_b, 0, -2, 1e-9);

    /* The small centre inside the large circle: the large one has no such point, the small one has. */
    FILL(p);
    CHECK_STATUS(pp_closest_point_2d(small, &inside, large, &pose_b, PP_ON_B, NULL, &p), PP_OK);
    CHECK(p.slack == 1 && p.reserved == 0);
    CHECK(isnan(p.s) && isnan(p.gap) && isnan(p.point_bound));
    for (int j = 0; j < 2; j++) CHECK(isnan(p.point[j]) && isnan(p.branch_a[j]) && isnan(p.branch_b[j]));
    CHECK_STATUS(pp_closest_point_2d(small, &inside, large, &pose_b, PP_ON_A, NULL, &p), PP_OK);
    CHECK(p.slack == 0);
    CHECK_NEAR(p.s, 0.75 / 2.0, p.gap + 16 * DBL_EPSILON);
    pp_particle_free_2d(small);
    pp_particle_free_2d(large);
}

static void refusals_write_nothing(void) {
    pp_particle_2d *circle = new_circle_2d(1.0);
    const pp_pose_2d here = {{0, 0}, 0}, there = {{1.5, 0}, 0}, nowhere = {{NAN, 0}, 0}, unturned = {{0, 0}, INFINITY};
    pp_closest_2d p;
    FILL(p);
    CHECK_STATUS(pp_closest_point_2d(NULL, &here, circle, &there, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point_2d(circle, NULL, circle, &there, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point_2d(circle, &here, NULL, &there, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point_2d(circle, &here, circle, NULL, PP_ON_A, NULL, &p), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point_2d(circle, &here, circle, &there, PP_ON_A, NULL, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_closest_point_2d(circle, &here, circle, &there, 2, NULL, &p), PP_BAD_INDEX);
    CHECK_STATUS(pp_closest_point_2d(circle, &nowhere, circle, &there, PP_ON_A, NULL, &p), PP_BAD_POSITION);
    CHECK_STATUS(pp_closest_point_2d(circle, &here, circle, &unturned, PP_ON_A, NULL, &p), PP_BAD_ORIENTATION);
    pp_settings settings = default_settings();
    settings.gap_tolerance = -1;
    CHECK_STATUS(pp_closest_point_2d(circle, &here, circle, &there, PP_ON_A, &settings, &p), PP_BAD_SETTING);
    CHECK_UNTOUCHED(p);
    pp_particle_free_2d(circle);
}

void test_planar_closest(void) {
    points_of_two_circles();
    refusals_write_nothing();
}
