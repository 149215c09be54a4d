/* Derivatives with a closed form, forward against reverse, and what is refused. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

/* Two spheres at a distance c: s = c/(a + b), overlap a + b - c, and the normal turns by 1/c. */
static void spheres(void) {
    const double a = 0.5, b = 1.0, c = 1.4;
    pp_particle *small = new_sphere(a), *large = new_sphere(b);
    pp_pose here = pose_at(1, 2, 3), there = pose_at(1 + c, 2, 3);
    for (uint32_t formulation = PP_MIDWAY; formulation <= PP_CLOSEST; formulation++) {
        pp_settings settings = default_settings();
        settings.formulation = formulation;
        pp_contact contact;
        pp_derivatives d;
        CHECK_STATUS(pp_contact_detect(small, &here, large, &there, &settings, NULL, &contact), PP_OK);
        CHECK_STATUS(pp_contact_derivatives(small, &here, large, &there, &settings, &contact, &d), PP_OK);
        const double of_s = formulation == PP_MIDWAY ? 1 / (a + b) : 1 / a;
        CHECK(d.flags == 0 && d.reserved == 0);
        CHECK_NEAR(d.s[0], -of_s, 1e-13);
        CHECK_NEAR(d.s[6], of_s, 1e-13);
        CHECK_NEAR(d.overlap[0], 1, 1e-13);
        CHECK_NEAR(d.overlap[6], -1, 1e-13);
        for (int i = 3; i < 6; i++) CHECK_NEAR(d.overlap[i], 0, 1e-13);
        CHECK_NEAR(d.normal[1][1], -1 / c, 1e-13);
        CHECK_NEAR(d.normal[1][7], 1 / c, 1e-13);
        CHECK_NEAR(d.point_on_a[0][0], 1, 1e-13);
        CHECK_NEAR(d.point_on_b[0][6], 1, 1e-13);
        CHECK(isnan(d.s_b[0]) == (formulation == PP_MIDWAY));

        pp_contact_weights weights;
        memset(&weights, 0, sizeof weights);
        weights.overlap = 2;
        weights.normal[1] = 1;
        pp_shape_gradient of_small = {NULL, 0, 0, 0, 0}, of_large = {NULL, 0, 0, 0, 0};
        pp_pose_gradient poses[2];
        uint32_t flags = 77;
        CHECK_STATUS(pp_contact_gradient(small, &here, large, &there, &settings, &contact, &weights, &of_small,
                                         &of_large, poses, &flags),
                     PP_OK);
        CHECK_NEAR(of_small.shadow_radius, 2, 1e-13);
        CHECK_NEAR(of_large.shadow_radius, 2, 1e-13);
        CHECK(flags == 0);
        for (int body = 0; body < 2; body++) {
            for (int i = 0; i < 3; i++) {
                const int column = 6 * body + i;
                CHECK_NEAR(poses[body].shift[i], 2 * d.overlap[column] + d.normal[1][column], 1e-13);
                CHECK_NEAR(poses[body].turn[i], 2 * d.overlap[column + 3] + d.normal[1][column + 3], 1e-13);
            }
        }
    }
    pp_particle_free(small);
    pp_particle_free(large);
}

/* A cube on a floor, and over the edge of a triangle: only the face that touches counts, and calls add up. */
static void cube_on_boundaries(void) {
    const double core = 0.4, r = 0.1, height = 0.49;
    pp_particle *cube = new_cube(core, r, 0.01, 1.0);
    pp_pose pose = pose_at(0, 0, height);
    const double point[3] = {0, 0, 0}, normal[3] = {0, 0, 1}, triangle[9] = {-5, 0, 0, 5, 0, 0, 0, -5, -5};
    pp_flat_contact contact;
    pp_derivatives d;
    CHECK_STATUS(pp_contact_plane(cube, &pose, point, normal, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_flat_contact_derivatives(cube, &pose, NULL, NULL, &contact, &d), PP_OK);
    CHECK_NEAR(d.overlap[2], -1, 1e-12);
    CHECK_NEAR(d.overlap[8], 1, 1e-12);
    double planes[4 * CUBE_PLANES] = {0};
    pp_shape_gradient sum = {planes, CUBE_PLANES, 0, 0, 0};
    pp_contact_weights weights;
    memset(&weights, 0, sizeof weights);
    weights.overlap = 1;
    pp_pose_gradient poses[2];
    uint32_t flags;
    for (int i = 0; i < 2; i++) {
        CHECK_STATUS(pp_flat_contact_gradient(cube, &pose, NULL, NULL, &contact, &weights, &sum, poses, &flags), PP_OK);
    }
    CHECK_NEAR(poses[0].shift[2], -1, 1e-12);
    CHECK_NEAR(poses[1].shift[2], 1, 1e-12);
    int moved = 0;
    for (int i = 0; i < CUBE_PLANES; i++) {
        if (planes[4 * i + 3] != 0) {
            moved++;
            /* A face moves with its plane, but for what the sphere holds of it. */
            CHECK_NEAR(planes[4 * i + 3], 2, 0.01);
        }
    }
    CHECK(moved == 1 && sum.r > 1.9 && sum.r < 2.1);
    /* Over an edge. */
    CHECK_STATUS(pp_contact_triangle(cube, &pose, triangle, NULL, NULL, &contact), PP_OK);
    CHECK(contact.feature >= PP_ON_EDGE && contact.feature < PP_ON_VERTEX);
    CHECK_STATUS(pp_flat_contact_derivatives(cube, &pose, NULL, NULL, &contact, &d), PP_BAD_POINT);
    CHECK_STATUS(pp_flat_contact_derivatives(cube, &pose, triangle, NULL, &contact, &d), PP_OK);
    CHECK_NEAR(d.point_on_b[0][6], 1, 1);
    for (int i = 0; i < 12; i++) CHECK(isfinite(d.overlap[i]) && isfinite(d.s[i]) && isfinite(d.normal[2][i]));
    pp_particle_free(cube);
}

/* Two balls press as a paraboloid: f = pi R' delta^2. */
static void patch(void) {
    const double radius = 1.0, overlap = 1e-4;
    pp_particle *ball = new_sphere(radius);
    pp_pose here = pose_at(0, 0, 0), there = pose_at(2 * radius - overlap, 0, 0),
            above = pose_at(0, 0, radius - overlap);
    const double point[3] = {0, 0, 0}, normal[3] = {0, 0, 1};
    pp_contact contact;
    pp_flat_contact flat;
    pp_patch_derivatives d;
    CHECK_STATUS(pp_contact_detect(ball, &here, ball, &there, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_patch_derivatives_of_contact(ball, &here, ball, &there, &contact, 1e-8, &d), PP_OK);
    const double slope = PI * radius * overlap;
    CHECK_NEAR(d.force[0][0], slope, 1e-3 * slope);
    CHECK_NEAR(d.force[0][6], -slope, 1e-3 * slope);
    /* A turn of a ball about its centre changes nothing. */
    for (int i = 0; i < 3; i++) {
        for (int column = 3; column < 6; column++) {
            CHECK_NEAR(d.force[i][column], 0, 1e-6 * slope);
            CHECK_NEAR(d.torque_on_a[i][column], 0, 1e-6 * slope);
            CHECK_NEAR(d.torque_on_b[i][column], 0, 1e-6 * slope);
        }
    }
    CHECK_STATUS(pp_contact_plane(ball, &above, point, normal, NULL, NULL, &flat), PP_OK);
    CHECK_STATUS(pp_patch_derivatives_on_boundary(ball, &above, NULL, 0, &flat, 1e-8, &d), PP_OK);
    CHECK_NEAR(d.force[2][2], 2 * slope, 1e-3 * slope);
    CHECK_STATUS(pp_patch_derivatives_on_boundary(ball, &above, NULL, 2, &flat, 1e-8, &d), PP_BAD_SETTING);
    CHECK_STATUS(pp_patch_derivatives_of_contact(ball, &here, ball, &there, &contact, 1e-20, &d), PP_BAD_SETTING);
    CHECK_STATUS(pp_patch_derivatives_of_contact(ball, &here, ball, &there, NULL, 1e-8, &d), PP_NULL_POINTER);
    pp_particle_free(ball);
}

/* A status, and nothing is touched. */
static void refused(void) {
    pp_particle *ball = new_sphere(1.0), *cube = new_cube(0.4, 0.1, 0.01, 1.0);
    pp_pose here = pose_at(0, 0, 0), there = pose_at(1.5, 0, 0), far = pose_at(5, 0, 0);
    pp_contact contact;
    pp_derivatives d;
    FILL(d);
    CHECK_STATUS(pp_contact_detect(ball, &here, ball, &far, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_contact_derivatives(ball, &here, ball, &far, NULL, &contact, &d), PP_BAD_POINT);
    CHECK_STATUS(pp_contact_detect(ball, &here, ball, &here, NULL, NULL, &contact), PP_OK);
    const pp_status status = pp_contact_derivatives(ball, &here, ball, &here, NULL, &contact, &d);
    CHECK(status == PP_NO_DERIVATIVE || status == PP_BAD_POINT);
    CHECK_STATUS(pp_contact_detect(ball, &here, ball, &there, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_contact_derivatives(NULL, &here, ball, &there, NULL, &contact, &d), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_derivatives(ball, &here, ball, &there, NULL, NULL, &d), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_derivatives(ball, &here, ball, &there, NULL, &contact, NULL), PP_NULL_POINTER);
    contact.kind = 0;
    CHECK_STATUS(pp_contact_derivatives(ball, &here, ball, &there, NULL, &contact, &d), PP_BAD_POINT);
    CHECK_UNTOUCHED(d);
    /* Every number of the contact spoilt in turn. */
    const double spoilt[] = {NAN, INFINITY, 0, -1, 1e300};
    for (size_t i = 3; i < sizeof contact / sizeof(double); i++) {
        for (int j = 0; j < 5; j++) {
            CHECK_STATUS(pp_contact_detect(ball, &here, ball, &there, NULL, NULL, &contact), PP_OK);
            ((double *)&contact)[i] = spoilt[j];
            const pp_status found = pp_contact_derivatives(ball, &here, ball, &there, NULL, &contact, &d);
            CHECK(found >= 0 && found != PP_INTERNAL_ERROR);
        }
    }
    /* A gradient of another number of planes, and weights that are no numbers. */
    CHECK_STATUS(pp_contact_detect(cube, &here, ball, &there, NULL, NULL, &contact), PP_OK);
    pp_contact_weights weights;
    memset(&weights, 0, sizeof weights);
    double planes[4] = {1, 1, 1, 1};
    pp_shape_gradient gradient = {planes, 1, 1, 1, 1};
    pp_pose_gradient poses[2];
    uint32_t flags;
    FILL(poses);
    CHECK_STATUS(
        pp_contact_gradient(cube, &here, ball, &there, NULL, &contact, &weights, &gradient, NULL, poses, &flags),
        PP_BAD_INDEX);
    weights.s = NAN;
    CHECK_STATUS(pp_contact_gradient(cube, &here, ball, &there, NULL, &contact, &weights, NULL, NULL, poses, &flags),
                 PP_BAD_SETTING);
    CHECK_UNTOUCHED(poses);
    CHECK(planes[0] == 1 && gradient.r == 1);
    pp_particle_free(ball);
    pp_particle_free(cube);
}

void test_derivatives(void) {
    spheres();
    cube_on_boundaries();
    patch();
    refused();
}
