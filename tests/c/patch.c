/* Patches with a closed form, their points, and what is refused. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>

enum { ROOM = 4000 };

/* Two spheres press on each other as a paraboloid. */
static void spheres(void) {
    const double radius_a = 1.0, radius_b = 0.5, overlap = 1e-5;
    pp_particle *a = new_sphere(radius_a), *b = new_sphere(radius_b);
    pp_pose pose_a = pose_at(1, 2, 3), pose_b = pose_at(1 + radius_a + radius_b - overlap, 2, 3);
    pp_contact contact;
    pp_patch patch;
    static pp_patch_point points[ROOM];
    size_t count = 0;
    CHECK_STATUS(pp_contact_detect(a, &pose_a, b, &pose_b, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_patch_of_contact(a, &pose_a, b, &pose_b, &contact, 1e-6, 1, NULL, &patch, points, ROOM, &count),
                 PP_OK);
    const double reduced = radius_a * radius_b / (radius_a + radius_b), force = PI * reduced * overlap * overlap;
    CHECK_NEAR(patch.force[0], force, 1e-4 * force);
    CHECK_NEAR(patch.energy, force * overlap / 3, 1e-4 * force * overlap);
    CHECK_NEAR(patch.area, 2 * PI * reduced * overlap, 1e-4 * patch.area);
    CHECK_NEAR(patch.largest_depth, overlap, 1e-6 * overlap);
    CHECK(patch.flags == 0 && patch.error <= 1e-6 && patch.rays > 0);
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(patch.pressure_centre[i], pose_a.position[i] + patch.branch_a[i], 1e-14);
        CHECK_NEAR(patch.pressure_centre[i], pose_b.position[i] + patch.branch_b[i], 1e-14);
    }
    double length_a, length_b;
    CHECK_STATUS(pp_particle_depth_length(a, &length_a), PP_OK);
    CHECK_STATUS(pp_particle_depth_length(b, &length_b), PP_OK);
    CHECK_NEAR(length_a, radius_a, 1e-15);
    CHECK_NEAR(patch.length, length_a + length_b, 1e-15);
    /* The points add up to the patch. */
    double area = 0, load = 0;
    for (size_t i = 0; i < count; i++) {
        area += points[i].area;
        load += points[i].area * points[i].depth * points[i].normal[0];
    }
    CHECK_NEAR(area, patch.area, 1e-12 * area);
    CHECK_NEAR(load, patch.force[0], 1e-12 * load);
    /* Without points, and with too little room for them. */
    pp_patch same;
    CHECK_STATUS(pp_patch_of_contact(a, &pose_a, b, &pose_b, &contact, 1e-6, 1, NULL, &same, NULL, 0, NULL), PP_OK);
    CHECK(same.force[0] == patch.force[0]);
    size_t needed = 0;
    FILL(same);
    CHECK_STATUS(pp_patch_of_contact(a, &pose_a, b, &pose_b, &contact, 1e-6, 1, NULL, &same, points, 1, &needed),
                 PP_BUFFER_TOO_SMALL);
    CHECK(needed == count);
    CHECK_UNTOUCHED(same);
    pp_particle_free(a);
    pp_particle_free(b);
}

/* A sphere on a plane, and on two triangles that cover it. */
static void sphere_on_a_floor(void) {
    const double radius = 1.0, overlap = 1e-4;
    pp_particle *ball = new_sphere(radius);
    pp_pose pose = pose_at(0.01, 0.02, radius - overlap);
    const double point[3] = {0, 0, 0}, normal[3] = {0, 0, 1};
    pp_flat_contact contact;
    pp_patch whole;
    CHECK_STATUS(pp_contact_plane(ball, &pose, point, normal, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_patch_on_plane(ball, &pose, &contact, 1e-8, 0, NULL, &whole, NULL, 0, NULL), PP_OK);
    const double force = PI * radius * overlap * overlap;
    CHECK_NEAR(whole.force[2], -force, 1e-4 * force);
    CHECK(isnan(whole.energy));
    const double halves[2][9] = {{-1, -1, 0, 1, -1, 0, 1, 1, 0}, {-1, -1, 0, 1, 1, 0, -1, 1, 0}};
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        pp_patch part;
        CHECK_STATUS(pp_contact_triangle(ball, &pose, halves[i], NULL, NULL, &contact), PP_OK);
        CHECK_STATUS(pp_patch_on_triangle(ball, &pose, halves[i], 1, &contact, 1e-8, 0, NULL, &part, NULL, 0, NULL),
                     PP_OK);
        sum += part.force[2];
    }
    CHECK_NEAR(sum, whole.force[2], 1e-7 * force);
    pp_particle_free(ball);
}

/* Of a pair and of a floor: the third look at the same pose is carried on, unless points are asked for. */
static void carried_on(void) {
    const double overlap = 1e-4, point[3] = {0, 0, 0}, normal[3] = {0, 0, 1};
    const double triangle[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    pp_particle *ball = new_sphere(1.0);
    pp_pose here = pose_at(1, 2, 3), there = pose_at(3 - overlap, 2, 3), above = pose_at(0, 0, 1 - overlap);
    pp_patch_state states[3] = {{{0}}};
    pp_patch patches[3], whole;
    pp_contact pair;
    pp_flat_contact floor, part;
    CHECK_STATUS(pp_contact_detect(ball, &here, ball, &there, NULL, NULL, &pair), PP_OK);
    CHECK_STATUS(pp_contact_plane(ball, &above, point, normal, NULL, NULL, &floor), PP_OK);
    CHECK_STATUS(pp_contact_triangle(ball, &above, triangle, NULL, NULL, &part), PP_OK);
    for (int look = 0; look < 3; look++) {
        CHECK_STATUS(
            pp_patch_of_contact(ball, &here, ball, &there, &pair, 1e-4, 0, &states[0], &patches[0], NULL, 0, NULL),
            PP_OK);
        CHECK_STATUS(pp_patch_on_plane(ball, &above, &floor, 1e-4, 0, &states[1], &patches[1], NULL, 0, NULL), PP_OK);
        CHECK_STATUS(
            pp_patch_on_triangle(ball, &above, triangle, 1, &part, 1e-4, 0, &states[2], &patches[2], NULL, 0, NULL),
            PP_OK);
        for (int i = 0; i < 3; i++) CHECK((patches[i].flags == PP_PATCH_CARRIED) == (look > 1));
    }
    static pp_patch_point points[ROOM];
    size_t count = 0;
    CHECK_STATUS(
        pp_patch_of_contact(ball, &here, ball, &there, &pair, 1e-4, 0, &states[0], &whole, points, ROOM, &count),
        PP_OK);
    CHECK(whole.flags == 0 && count > 0);
    pp_particle_free(ball);
}

static void what_is_refused(void) {
    pp_particle *sphere = new_sphere(1.0);
    pp_pose pose_a = pose_at(0, 0, 0), pose_b = pose_at(1.9, 0, 0), far = pose_at(3, 0, 0);
    pp_contact contact, apart;
    CHECK_STATUS(pp_contact_detect(sphere, &pose_a, sphere, &pose_b, NULL, NULL, &contact), PP_OK);
    CHECK_STATUS(pp_contact_detect(sphere, &pose_a, sphere, &far, NULL, NULL, &apart), PP_OK);
    pp_patch patch;
    FILL(patch);
    pp_patch_point point;
    double length;
    CHECK_STATUS(pp_particle_depth_length(NULL, &length), PP_NULL_POINTER);
    CHECK_STATUS(pp_patch_of_contact(NULL, &pose_a, sphere, &pose_b, &contact, 1e-4, 0, NULL, &patch, NULL, 0, NULL),
                 PP_NULL_POINTER);
    CHECK_STATUS(pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, NULL, 1e-4, 0, NULL, &patch, NULL, 0, NULL),
                 PP_NULL_POINTER);
    CHECK_STATUS(pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, &contact, 1e-4, 0, NULL, NULL, NULL, 0, NULL),
                 PP_NULL_POINTER);
    CHECK_STATUS(pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, &contact, 1e-4, 0, NULL, &patch, NULL, 1, NULL),
                 PP_NULL_POINTER);
    CHECK_STATUS(
        pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, &contact, 1e-4, 0, NULL, &patch, &point, 1, NULL),
        PP_NULL_POINTER);
    CHECK_STATUS(pp_patch_of_contact(sphere, &pose_a, sphere, &far, &apart, 1e-4, 0, NULL, &patch, NULL, 0, NULL),
                 PP_BAD_POINT);
    const double bad[] = {NAN, INFINITY, -1e-4, 0.0, 0.99e-12, 0.1001};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        check_case("tolerance = %g", bad[i]);
        CHECK_STATUS(
            pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, &contact, bad[i], 0, NULL, &patch, NULL, 0, NULL),
            PP_BAD_SETTING);
    }
    check_case(NULL);
    CHECK_STATUS(pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, &contact, 1e-4, 2, NULL, &patch, NULL, 0, NULL),
                 PP_BAD_SETTING);
    contact.normal[1] = NAN;
    CHECK_STATUS(pp_patch_of_contact(sphere, &pose_a, sphere, &pose_b, &contact, 1e-4, 0, NULL, &patch, NULL, 0, NULL),
                 PP_BAD_POINT);
    CHECK_UNTOUCHED(patch);
    pp_particle_free(sphere);
}

void test_patch(void) {
    spheres();
    sphere_on_a_floor();
    carried_on();
    what_is_refused();
}
