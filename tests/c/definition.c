/* The definition of a particle is given back as it was given, in space and in the plane. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

enum { SIDES = 5 };

/* Normals of any length, the offsets so that the centre is inside. */
static const double planes[4 * SIDES] = {
    0, 0, -2, 0.3, 1.5, 0, 1, 0.7, -1, 0, 1, 0.6, 0, 3, 1, 0.5, 0.1, -1, 0.3, 0.4,
};
static const double lines[3 * SIDES] = {1, 0, 0.5, -2, 0.1, 0.6, 0, 1, 0.7, 0.3, -1, 0.4, 1, 1, 0.9};

static void definition_in_space(void) {
    const double r = 0.1, k = 0.25, big = 1.75;
    pp_particle *particle = new_particle(planes, SIDES, r, k, big);
    double got;
    CHECK_STATUS(pp_particle_rounding_radius(particle, &got), PP_OK);
    CHECK(got == r);
    CHECK_STATUS(pp_particle_sphericity(particle, &got), PP_OK);
    CHECK(got == k);
    CHECK_STATUS(pp_particle_shadow_radius(particle, &got), PP_OK);
    CHECK(got == big);

    size_t count = 99;
    double rows[4 * SIDES + 1];
    CHECK_STATUS(pp_particle_planes(particle, NULL, 0, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count == SIDES);
    FILL(rows);
    count = 99;
    CHECK_STATUS(pp_particle_planes(particle, rows, SIDES - 1, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count == SIDES);
    CHECK_UNTOUCHED(rows);
    count = 99;
    CHECK_STATUS(pp_particle_planes(particle, rows, SIDES, &count), PP_OK);
    CHECK(count == SIDES);
    CHECK_SAME_BYTES(rows, planes, sizeof planes);
    CHECK_UNTOUCHED(rows[4 * SIDES]);

    pp_particle *sphere = new_sphere(2.0);
    count = 99;
    CHECK_STATUS(pp_particle_planes(sphere, NULL, 0, &count), PP_OK);
    CHECK(count == 0);
    /* Though there is nothing to write. */
    CHECK_STATUS(pp_particle_planes(sphere, NULL, 1, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_sphericity(sphere, &got), PP_OK);
    CHECK(got == 1);
    CHECK_STATUS(pp_particle_shadow_radius(sphere, &got), PP_OK);
    CHECK(got == 2);

    FILL(got);
    FILL(count);
    FILL(rows);
    CHECK_STATUS(pp_particle_rounding_radius(NULL, &got), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_sphericity(NULL, &got), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_shadow_radius(NULL, &got), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_rounding_radius(particle, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_sphericity(particle, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_shadow_radius(particle, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_planes(NULL, rows, SIDES, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_planes(particle, NULL, SIDES, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_planes(particle, NULL, 1, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_planes(particle, rows, SIDES, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(got);
    CHECK_UNTOUCHED(count);
    CHECK_UNTOUCHED(rows);
    pp_particle_free(particle);
    pp_particle_free(sphere);
}

static void definition_in_the_plane(void) {
    const double r = 0.1, k = 0.25, big = 1.75;
    pp_particle_2d *particle = NULL;
    CHECK_STATUS(pp_particle_new_2d(lines, SIDES, r, k, big, &particle, NULL, 0), PP_OK);
    double got;
    CHECK_STATUS(pp_particle_rounding_radius_2d(particle, &got), PP_OK);
    CHECK(got == r);
    CHECK_STATUS(pp_particle_sphericity_2d(particle, &got), PP_OK);
    CHECK(got == k);
    CHECK_STATUS(pp_particle_shadow_radius_2d(particle, &got), PP_OK);
    CHECK(got == big);
    size_t count = 99;
    double rows[3 * SIDES + 1];
    FILL(rows);
    CHECK_STATUS(pp_particle_lines_2d(particle, rows, SIDES - 1, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count == SIDES);
    CHECK_UNTOUCHED(rows);
    CHECK_STATUS(pp_particle_lines_2d(particle, rows, SIDES, &count), PP_OK);
    CHECK_SAME_BYTES(rows, lines, sizeof lines);
    CHECK_UNTOUCHED(rows[3 * SIDES]);

    FILL(got);
    FILL(count);
    CHECK_STATUS(pp_particle_rounding_radius_2d(NULL, &got), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_sphericity_2d(NULL, &got), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_shadow_radius_2d(NULL, &got), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_rounding_radius_2d(particle, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_lines_2d(NULL, rows, SIDES, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_lines_2d(particle, NULL, SIDES, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_lines_2d(particle, NULL, 1, &count), PP_NULL_POINTER);
    CHECK_UNTOUCHED(got);
    CHECK_UNTOUCHED(count);
    pp_particle_free_2d(particle);
}

/* A square of half size 1 without sphericity, rounded by r: its reach along n is |n_x| + |n_y| + r |n|. */
static void bounds_in_the_plane(void) {
    const double square[12] = {1, 0, 1, -1, 0, 1, 0, 1, 1, 0, -1, 1}, r = 0.25;
    pp_particle_2d *particle = NULL;
    CHECK_STATUS(pp_particle_new_2d(square, 4, r, 0.0, 0.0, &particle, NULL, 0), PP_OK);
    const pp_pose_2d pose = {.position = {5, -6}, .angle = PI / 6};
    double lower[2], upper[2];
    CHECK_STATUS(pp_particle_box_2d(particle, &pose, lower, upper), PP_OK);
    const double reach = sin(PI / 6) + cos(PI / 6) + r;
    for (int j = 0; j < 2; j++) {
        CHECK(pose.position[j] - lower[j] >= reach - 1e-12 && pose.position[j] - lower[j] < 1.2 * reach);
        CHECK(upper[j] - pose.position[j] >= reach - 1e-12 && upper[j] - pose.position[j] < 1.2 * reach);
    }
    double corners[2 * 64];
    size_t count = 0;
    CHECK_STATUS(pp_particle_corners_2d(particle, NULL, 0, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count >= 3 && count <= 64);
    CHECK_STATUS(pp_particle_corners_2d(particle, corners, 64, &count), PP_OK);
    for (int i = 0; i < 16; i++) {
        const double n[2] = {cos(i * PI / 8), sin(i * PI / 8)};
        double furthest = -INFINITY;
        for (size_t c = 0; c < count; c++) furthest = fmax(furthest, n[0] * corners[2 * c] + n[1] * corners[2 * c + 1]);
        CHECK(furthest >= fabs(n[0]) + fabs(n[1]) + r - 1e-12);
    }
    double distance;
    const double along[2] = {0, -3e200}, diagonal[2] = {1e-200, 1e-200}, none[2] = {0, 0}, bad[2] = {1, NAN};
    CHECK_STATUS(pp_particle_surface_distance_2d(particle, along, &distance), PP_OK);
    CHECK_NEAR(distance, 1 + r, 1e-13);
    CHECK_STATUS(pp_particle_surface_distance_2d(particle, diagonal, &distance), PP_OK);
    CHECK_NEAR(distance, sqrt(2.0) + r, 1e-13);

    FILL(lower);
    FILL(upper);
    FILL(distance);
    FILL(count);
    const pp_pose_2d nowhere = {.angle = NAN};
    CHECK_STATUS(pp_particle_box_2d(NULL, &pose, lower, upper), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box_2d(particle, NULL, lower, upper), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box_2d(particle, &pose, NULL, upper), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box_2d(particle, &pose, lower, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box_2d(particle, &nowhere, lower, upper), PP_BAD_ORIENTATION);
    CHECK_STATUS(pp_particle_corners_2d(NULL, corners, 64, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_corners_2d(particle, NULL, 64, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_corners_2d(particle, NULL, 1, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance_2d(NULL, along, &distance), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance_2d(particle, NULL, &distance), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance_2d(particle, along, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance_2d(particle, none, &distance), PP_BAD_POINT);
    CHECK_STATUS(pp_particle_surface_distance_2d(particle, bad, &distance), PP_BAD_POINT);
    CHECK_UNTOUCHED(lower);
    CHECK_UNTOUCHED(upper);
    CHECK_UNTOUCHED(distance);
    CHECK_UNTOUCHED(count);
    pp_particle_free_2d(particle);
}

void test_definition(void) {
    definition_in_space();
    definition_in_the_plane();
    bounds_in_the_plane();
}
