/* Particles that were built: what stands where in the frame of their planes or points. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

/* The corners of a brick of 3 x 2 x 1, turned by 90 degrees about z and moved. */
static void a_hull_is_known_by_its_frame(void) {
    double points[9][3];
    for (int i = 0; i < 8; i++) {
        const double x = i & 1 ? 1.5 : -1.5, y = i & 2 ? 1.0 : -1.0, z = i & 4 ? 0.5 : -0.5;
        points[i][0] = 10.0 - y, points[i][1] = 20.0 + x, points[i][2] = 30.0 + z;
    }
    /* One inside does not matter. */
    points[8][0] = 10.1, points[8][1] = 20.2, points[8][2] = 30.3;
    pp_particle *brick = NULL;
    pp_built built;
    CHECK(pp_particle_from_points(&points[0][0], 9, 0.05, 0.0, 0.0, &brick, &built, NULL, 0) == PP_OK);
    double planes[6][4], r;
    size_t count;
    CHECK(pp_particle_planes(brick, &planes[0][0], 6, &count) == PP_OK && count == 6);
    CHECK(pp_particle_rounding_radius(brick, &r) == PP_OK);
    CHECK_NEAR(r, 0.05, 1e-12);
    const double centre[3] = {10, 20, 30}, half[3] = {1.0, 1.5, 0.5};
    for (int axis = 0; axis < 3; axis++) {
        CHECK_NEAR(built.centroid[axis], centre[axis], 1e-5);
        CHECK_NEAR(built.mass.centroid[axis], 0.0, 1e-5);
    }
    /* Its edges lie along the axes already, and the nearest principal ones are those. */
    CHECK_NEAR(built.orientation[0], 1.0, 1e-9);
    for (int i = 0; i < 6; i++)
        for (int axis = 0; axis < 3; axis++)
            if (fabs(planes[i][axis]) > 0.5) CHECK_NEAR(planes[i][3] + r, half[axis], 1e-5);
    CHECK(built.mass.volume > 0.97 * 6.0 && built.mass.volume < 6.0);
    CHECK(built.mass.inertia[0] > built.mass.inertia[1] && built.mass.inertia[2] > built.mass.inertia[0]);

    /* The same from its faces, with normals of any length. */
    const double faces[6][4] = { { 2, 0, 0, 22 },     { -1, 0, 0, -9 },  { 0, 1, 0, 21.5 },
                                 { 0, -3, 0, -55.5 }, { 0, 0, 1, 30.5 }, { 0, 0, -1, -29.5 } };
    pp_particle *same = NULL;
    pp_built again;
    CHECK(pp_particle_from_faces(&faces[0][0], 6, 0.05, 0.0, 0.0, &same, &again, NULL, 0) == PP_OK);
    CHECK_NEAR(again.mass.volume, built.mass.volume, 1e-5);
    pp_particle_free(same);
    pp_particle_free(brick);
}

static void what_is_no_body_is_told(void) {
    const double flat[5][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 2, 1, 0 } },
                 planes[2][4] = { { 1, 0, 0, 1 }, { -1, 0, 0, 1 } };
    const double none[1][4] = {{0, 0, 0, 1}}, infinite[4][3] = {{INFINITY, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    pp_particle *out = NULL;
    char why[PP_MESSAGE_SIZE];
    CHECK(pp_particle_from_points(&flat[0][0], 5, 0.1, 0, 0, &out, NULL, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "flat"));
    CHECK(pp_particle_from_points(&flat[0][0], 3, 0.1, 0, 0, &out, NULL, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "3 points"));
    CHECK(pp_particle_from_points(&infinite[0][0], 4, 0.1, 0, 0, &out, NULL, why, sizeof why) == PP_BAD_POINT
          && strstr(why, "point 0"));
    CHECK(pp_particle_from_faces(&planes[0][0], 2, 0.1, 0, 0, &out, NULL, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "enclose"));
    CHECK(pp_particle_from_faces(&none[0][0], 1, 0.1, 0, 0, &out, NULL, why, sizeof why) == PP_PLANE_ZERO_NORMAL
          && strstr(why, "plane 0"));
    CHECK(pp_particle_from_points(&corner[0][0], 4, 0.5, 0, 0, &out, NULL, why, sizeof why) == PP_BAD_ROUNDING_RADIUS
          && strstr(why, "rounding=0.5"));
    CHECK(pp_particle_from_points(&corner[0][0], 4, 0.1, 2, 0, &out, NULL, why, sizeof why) == PP_BAD_SPHERICITY
          && strstr(why, "k=2"));
    CHECK(pp_particle_from_points(&corner[0][0], 4, 0.1, 0, -1, &out, NULL, why, sizeof why) == PP_BAD_SHADOW_RADIUS
          && strstr(why, "R=-1"));
    CHECK(pp_particle_from_points(NULL, 4, 0.1, 0, 0, &out, NULL, why, sizeof why) == PP_NULL_POINTER
          && strstr(why, "points"));
    CHECK(pp_particle_from_points(&corner[0][0], 4, 0.1, 0, 0, NULL, NULL, NULL, 0) == PP_NULL_POINTER);
    CHECK(out == NULL);
}

void test_builder(void) {
    a_hull_is_known_by_its_frame();
    what_is_no_body_is_told();
}
