/* Particles that were built: what stands where in the frame of their planes or points. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <stdint.h>
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

/* A brick of 3 x 2 x 1 far away: what is known of it sharp, and rounded by lengths. */
static void a_polyhedron_is_sharp_until_it_is_rounded(void) {
    double points[8][3], faces[6][4], corners[8][3], size, r;
    for (int i = 0; i < 8; i++)
        points[i][0] = 1000.0 + (i & 1 ? 3.0 : 0.0), points[i][1] = i & 2 ? 2.0 : 0.0, points[i][2] = i & 4 ? 1.0 : 0.0;
    pp_polyhedron *brick = NULL, *other = NULL;
    pp_particle *particle = NULL;
    pp_mass_properties mass;
    pp_built built;
    uint32_t triangles[12][3];
    size_t count;
    char why[PP_MESSAGE_SIZE];
    CHECK(pp_polyhedron_from_points(&points[0][0], 8, 0.0, &brick, NULL, 0) == PP_OK);
    CHECK(pp_polyhedron_properties(brick, &mass, &size) == PP_OK);
    CHECK_NEAR(mass.volume, 6.0, 1e-12);
    CHECK_NEAR(mass.centroid[0], 1001.5, 1e-12);
    CHECK_NEAR(mass.inertia[0], 6.0 * (4.0 + 1.0) / 12.0, 1e-12);
    CHECK_NEAR(size, 1.0, 1e-12);
    CHECK(pp_polyhedron_faces(brick, NULL, 0, &count) == PP_BUFFER_TOO_SMALL && count == 6);
    CHECK(pp_polyhedron_faces(brick, &faces[0][0], 6, &count) == PP_OK);
    for (int i = 0; i < 6; i++)
        if (faces[i][0] > 0.5) CHECK_NEAR(faces[i][3], 1003.0, 1e-12);
    CHECK(pp_polyhedron_corners(brick, &corners[0][0], 8, &count) == PP_OK && count == 8);
    CHECK(pp_polyhedron_triangles(brick, &triangles[0][0], 12, &count) == PP_OK && count == 12);
    /* Its own surface is closed and convex, and no longer with one triangle less. */
    CHECK(pp_surface_is_closed(&corners[0][0], 8, &triangles[0][0], 12, why, sizeof why) == PP_OK);
    CHECK(pp_surface_is_closed(&corners[0][0], 8, &triangles[0][0], 11, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "open: 3 edges"));
    CHECK(pp_polyhedron_from_surface(&corners[0][0], 8, &triangles[0][0], 12, 0.0, &other, why, sizeof why) == PP_OK);
    pp_polyhedron_free(other);
    CHECK(pp_polyhedron_from_surface(&corners[0][0], 7, &triangles[0][0], 12, 0.0, &other, why, sizeof why)
              == PP_BAD_POINT
          && strstr(why, "point 7"));

    CHECK(pp_particle_from_polyhedron(brick, 0.1, 0.0, 0.0, 1e-6, &particle, &built, NULL, 0) == PP_OK);
    CHECK(pp_particle_rounding_radius(particle, &r) == PP_OK && r == 0.1);
    CHECK_NEAR(built.centroid[0], 1001.5, 1e-5);
    CHECK(built.mass.volume > 5.7 && built.mass.volume < 6.0);
    pp_particle_free(particle);
    CHECK(pp_polyhedron_from_faces(&faces[0][0], 6, &other, NULL, 0) == PP_OK
          && pp_polyhedron_properties(other, &mass, NULL) == PP_OK);
    CHECK_NEAR(mass.volume, 6.0, 1e-9);
    pp_polyhedron_free(other);
    CHECK(pp_polyhedron_from_faces(NULL, 6, &other, why, sizeof why) == PP_NULL_POINTER && strstr(why, "NULL"));
    CHECK(pp_polyhedron_from_points(&points[0][0], 8, 0.0, NULL, NULL, 0) == PP_NULL_POINTER);
    const double unknown[3] = { NAN, -1.0, -INFINITY };
    for (int i = 0; i < 3; i++)
        CHECK(pp_polyhedron_from_points(&points[0][0], 8, unknown[i], &other, why, sizeof why) == PP_BAD_SETTING
              && strstr(why, "known="));
    CHECK(pp_polyhedron_faces(NULL, &faces[0][0], 6, &count) == PP_NULL_POINTER);
    CHECK(pp_polyhedron_corners(brick, NULL, 8, &count) == PP_NULL_POINTER);
    CHECK(pp_polyhedron_properties(brick, NULL, &size) == PP_NULL_POINTER);
    CHECK(pp_principal_axes(NULL, &size) == PP_NULL_POINTER);
    CHECK(pp_particle_from_polyhedron(NULL, 0.1, 0.0, 0.0, 1e-6, &particle, NULL, why, sizeof why) == PP_NULL_POINTER);
    CHECK(pp_particle_from_polyhedron(brick, 0.6, 0.0, 0.0, 1e-6, &particle, NULL, why, sizeof why)
              == PP_BAD_ROUNDING_RADIUS
          && strstr(why, "between 0 and 0.5"));
    CHECK(pp_particle_from_polyhedron(brick, 0.1, 0.0, 0.0, 2.0, &particle, NULL, why, sizeof why) == PP_BAD_SETTING);
    pp_polyhedron_free(brick);

    CHECK(pp_polyhedron_prism(4, 0.5, 0.0, 3.0, &other, NULL, 0) == PP_OK
          && pp_polyhedron_properties(other, &mass, NULL) == PP_OK);
    CHECK_NEAR(mass.volume, 1.0, 1e-12);
    pp_polyhedron_free(other);
    CHECK(pp_polyhedron_regular_solid(8, 1.0, &other, NULL, 0) == PP_OK
          && pp_polyhedron_properties(other, &mass, NULL) == PP_OK);
    CHECK_NEAR(mass.volume, sqrt(2.0) / 3.0, 1e-12);
    pp_polyhedron_free(other);
    CHECK(pp_polyhedron_regular_solid(7, 1.0, &other, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "4, 6, 8, 12 or 20"));
    pp_polyhedron_free(NULL);

    /* Of 3, 2 and 1 about axes that are turned by 30 degrees about z. */
    const double inertia[6] = {2.75, 2.25, 1.0, 0.25 * sqrt(3.0), 0.0, 0.0};
    double axes[4];
    CHECK(pp_principal_axes(inertia, axes) == PP_OK);
    CHECK_NEAR(axes[0], cos(acos(-1.0) / 12.0), 1e-12);
    CHECK_NEAR(axes[3], sin(acos(-1.0) / 12.0), 1e-12);
}

/* Round bodies have the size that is asked for: volume and inertia in closed form. */
static void round_bodies_keep_their_size(void) {
    const double pi = 3.14159265358979323846;
    const double sizes[5][5] = { { 0.5, 1.0 }, { 0.5, 1.0 }, { 1.0, 0.7, 0.5 }, { 0.5, 1.0 }, { 1, 0.7, 0.5, 1, 1 } };
    const double right[5] = { pi / 4, pi / 12, 1.4 / 3 * pi, pi / 4 + pi / 6, 1.4 / 3 * pi };
    for (uint32_t form = PP_ROUND_CYLINDER; form <= PP_ROUND_SUPERQUADRIC; form++) {
        pp_particle *particle = NULL;
        pp_built built;
        char why[PP_MESSAGE_SIZE];
        CHECK(pp_particle_round(form, sizes[form], 0, 0.0, 0.02, 0.0, &particle, &built, why, sizeof why) == PP_OK);
        CHECK_NEAR(built.mass.volume / right[form], 1.0, 5e-3);
        CHECK_NEAR(built.sharp_volume / right[form], 1.0, 1e-12);
        pp_particle_free(particle);
    }
    pp_particle *none = NULL;
    char why[PP_MESSAGE_SIZE];
    CHECK(pp_particle_round(5, sizes[0], 0, 0.0, 0.0, 0.0, &none, NULL, why, sizeof why) == PP_BAD_INDEX && !none);
    CHECK(pp_particle_round(PP_ROUND_CONE, sizes[0], 2, 0.0, 0.0, 0.0, &none, NULL, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "sides=2"));
    CHECK(pp_particle_round(PP_ROUND_CONE, NULL, 0, 0.0, 0.0, 0.0, &none, NULL, why, sizeof why) == PP_NULL_POINTER);
    CHECK(pp_particle_round(PP_ROUND_CYLINDER, sizes[0], 0, 0.0, 1.0, 0.0, &none, NULL, why, sizeof why)
              == PP_BAD_SPHERICITY
          && strstr(why, "sphere(R)"));

    /* A scan of many faces: few planes, its volume. */
    pp_polyhedron *many = NULL;
    double mass[2];
    CHECK(pp_polyhedron_prism(100, 0.5, 0.5, 1.0, &many, NULL, 0) == PP_OK);
    pp_mass_properties sharp;
    CHECK(pp_polyhedron_properties(many, &sharp, &mass[0]) == PP_OK);
    pp_built built;
    CHECK(pp_particle_fitted(many, 30, 0.0, 0.0, 0.02, 0.0, 0.0, &none, &built, why, sizeof why) == PP_OK);
    CHECK_NEAR(built.mass.volume / sharp.volume, 1.0, 1e-9);
    size_t count = 0;
    CHECK(pp_particle_planes(none, NULL, 0, &count) == PP_BUFFER_TOO_SMALL && count <= 30);
    pp_particle_free(none);
    none = NULL;
    CHECK(pp_particle_fitted(many, 3, 0.0, 0.0, 0.0, 0.0, 0.0, &none, NULL, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "planes=3"));
    CHECK(pp_particle_fitted(many, 30, 0.0, 0.0, 0.0, 0.0, 2.0, &none, NULL, why, sizeof why) == PP_BAD_SETTING);
    CHECK(pp_particle_fitted(NULL, 30, 0.0, 0.0, 0.0, 0.0, 0.0, &none, NULL, why, sizeof why) == PP_NULL_POINTER);
    pp_polyhedron_free(many);
}

/* Points on a line are flat, and sizes out of range are told. */
static void what_has_no_size_is_told(void) {
    double line[10][3], tiny[4][3] = { { 0 } };
    for (int i = 0; i < 10; i++)
        for (int axis = 0; axis < 3; axis++) line[i][axis] = i / 9.0 * (axis == 0 ? 1.0 : axis == 1 ? 0.3 : 0.7);
    for (int i = 0; i < 3; i++) tiny[i + 1][i] = 1e-90;
    pp_polyhedron *out = NULL;
    char why[PP_MESSAGE_SIZE];
    CHECK(pp_polyhedron_from_points(&line[0][0], 10, 0.0, &out, why, sizeof why) == PP_UNBOUNDED && strstr(why, "flat"));
    CHECK(pp_polyhedron_from_points(&tiny[0][0], 4, 0.0, &out, why, sizeof why) == PP_UNBOUNDED
          && strstr(why, "1e-50"));
    CHECK(out == NULL);
}

void test_builder(void) {
    round_bodies_keep_their_size();
    what_has_no_size_is_told();
    a_polyhedron_is_sharp_until_it_is_rounded();
    a_hull_is_known_by_its_frame();
    what_is_no_body_is_told();
}
