/* Particles in the plane: their two constructors, and what all other calls answer or refuse of them. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { LINES = 4 };

/* What the library refuses is tested in Rust; here that each refusal is its status, and speaks of lines. */
static void refusals_have_their_status(void) {
    static const struct {
        size_t line, column; /* which number of the square is spoilt, */
        double value;
        size_t count;
        double r, k, shadow_radius;
        pp_status expected;
        const char *named;
    } cases[] = {
        {2, 1, NAN, LINES, 0.5, 0.3, 2.0, PP_PLANE_NOT_FINITE, "line 2"},
        {2, 1, -INFINITY, LINES, 0.5, 0.3, 2.0, PP_PLANE_NOT_FINITE, "line 2"},
        {3, 1, -0.0, LINES, 0.5, 0.3, 2.0, PP_PLANE_ZERO_NORMAL, "line 3"},
        {1, 2, -0.7, LINES, 0.5, 0.3, 2.0, PP_CENTRE_OUTSIDE, "line 1"},
        {0, 0, 1, LINES, 0.5, 1.5, 2.0, PP_BAD_SPHERICITY, "k=1.5"},
        {0, 0, 1, LINES, 0.0, 0.3, 2.0, PP_BAD_ROUNDING_RADIUS, "r=0"},
        {0, 0, 1, LINES, 0.5, 0.3, -2.0, PP_BAD_SHADOW_RADIUS, "R=-2"},
        {0, 0, 1, 3, 0.5, 0.0, 2.0, PP_UNBOUNDED, "the lines do not enclose an area"},
        {0, 0, 1, 0, 0.5, 0.0, 2.0, PP_UNBOUNDED, "the lines do not enclose an area"},
    };
    pp_particle *particle;
    char message[PP_MESSAGE_SIZE];
    FILL(particle);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double lines[3 * LINES] = {1, 0, 1, -1, 0, 1, 0, 1, 1, 0, -1, 1};
        lines[3 * cases[i].line + cases[i].column] = cases[i].value;
        memset(message, 0, sizeof message);
        CHECK_STATUS(pp_particle_new_in_plane(lines, cases[i].count, cases[i].r, cases[i].k, cases[i].shadow_radius,
                                              &particle, message, sizeof message),
                     cases[i].expected);
        CHECK(strstr(message, "plane") == NULL);
        if (strstr(message, cases[i].named) == NULL) CHECK_TEXT(message, cases[i].named); /* fails, and shows both */
    }
    const double line[3] = {1, 0, 1};
    CHECK_STATUS(pp_particle_new_in_plane(line, SIZE_MAX, 0.5, 0.3, 2.0, &particle, NULL, 0), PP_TOO_MANY_PLANES);
    CHECK_STATUS(pp_particle_new_in_plane(NULL, LINES, 0.5, 0.3, 2.0, &particle, message, sizeof message),
                 PP_NULL_POINTER);
    CHECK_TEXT(message, "lines must not be NULL");
    CHECK_UNTOUCHED(particle);
    CHECK_STATUS(pp_particle_new_in_plane(NULL, 0, 0.0, 1.0, 2.0, NULL, message, sizeof message), PP_NULL_POINTER);
}

/* A triangle of legs 3 and 4 somewhere, its corners in no order and with a point inside; u and v, the distances
 * beyond the two sides of a corner, have u^2 + v^2 = r^2 on its rounding. */
static void polygon_from_points(void) {
    const double points[] = {104.0, 50.0, 101.0, 51.0, 100.0, 53.0, 100.0, 50.0}, r = 0.1;
    const double lost = r * r * (1 - PI / 4) * (1 + 5.0 / 3 + 5.0 / 4);
    pp_particle *triangle = NULL;
    char message[PP_MESSAGE_SIZE];
    CHECK_STATUS(pp_particle_new_polygon(points, 4, r, 0.0, &triangle, message, sizeof message), PP_OK);
    pp_mass_properties found;
    CHECK_STATUS(pp_particle_mass_properties(triangle, 1e-9, &found), PP_OK);
    CHECK_NEAR(found.volume, 6.0 - lost, 1e-7);
    CHECK_NEAR(found.inertia[0] + found.inertia[1], found.inertia[2], 1e-12);
    double planes[4 * 3];
    size_t count;
    CHECK_STATUS(pp_particle_planes(triangle, planes, 3, &count), PP_OK);
    CHECK(count == 3 && planes[2] == 0 && planes[6] == 0 && planes[10] == 0);
    pp_particle_free(triangle);

    pp_particle *none;
    FILL(none);
    const double on_a_line[] = {0, 0, 1, 1, 2, 2}, not_finite[] = {0, 0, 1, NAN, 1, 0};
    CHECK_STATUS(pp_particle_new_polygon(on_a_line, 3, r, 0.0, &none, message, sizeof message), PP_UNBOUNDED);
    CHECK(strstr(message, "enclose no area") != NULL);
    CHECK_STATUS(pp_particle_new_polygon(not_finite, 3, r, 0.0, &none, message, sizeof message), PP_PLANE_NOT_FINITE);
    CHECK(strstr(message, "vertex 1") != NULL);
    CHECK_STATUS(pp_particle_new_polygon(points, 4, 2.0, 0.0, &none, message, sizeof message), PP_BAD_ROUNDING_RADIUS);
    CHECK_STATUS(pp_particle_new_polygon(points, SIZE_MAX, r, 0.0, &none, message, sizeof message), PP_BAD_INDEX);
    CHECK(strcmp(message, pp_status_message(PP_BAD_INDEX)) == 0);
    CHECK_STATUS(pp_particle_new_polygon(points, 4, r, -1.0, &none, NULL, 0), PP_BAD_SPHERICITY);
    CHECK_STATUS(pp_particle_new_polygon(NULL, 4, r, 0.0, &none, message, sizeof message), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_new_polygon(points, 4, r, 0.0, NULL, NULL, 0), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_new_polygon(NULL, 0, r, 0.0, &none, NULL, 0), PP_UNBOUNDED);
    CHECK_UNTOUCHED(none);
}

static pp_particle *new_square(double core, double r) {
    const double lines[3 * LINES] = {1, 0, core, -1, 0, core, 0, 1, core, 0, -1, core};
    pp_particle *square = NULL;
    CHECK_STATUS(pp_particle_new_in_plane(lines, LINES, r, 0.0, 0.0, &square, NULL, 0), PP_OK);
    return square;
}

/* Two squares, side on side: contact, length, patch and a line as their boundary, all of them at z = 0. */
static void squares_side_on_side(void) {
    const double core = 0.5, r = 1e-4, overlap = 1e-7;
    pp_particle *square = new_square(core, r);
    const pp_pose pose_a = pose_at(1, 2, 0), pose_b = pose_at(1.2, 2 + 2 * (core + r) - overlap, 0);
    pp_contact contact;
    double length;
    CHECK_STATUS(pp_contact_detect(square, &pose_a, square, &pose_b, NULL, NULL, &contact), PP_OK);
    CHECK_NEAR(contact.overlap, overlap, 1e-12);
    CHECK(contact.point[2] == 0 && contact.normal[2] == 0);
    CHECK_STATUS(pp_contact_area(square, &pose_a, square, &pose_b, &contact, 1e-6, &length), PP_OK);
    CHECK_NEAR(length, 0.8, 1e-3);
    pp_patch patch;
    pp_patch_point points[64];
    size_t count = 0;
    CHECK_STATUS(
        pp_patch_of_contact(square, &pose_a, square, &pose_b, &contact, 1e-6, 1, NULL, &patch, points, 64, &count),
        PP_OK);
    CHECK_NEAR(patch.area, 0.8, 1e-4);
    CHECK_NEAR(patch.force[1], 0.8 * overlap, 1e-4 * overlap);
    CHECK_NEAR(patch.pressure_centre[0], 1.1, 1e-9);
    CHECK_NEAR(patch.energy, 0.4 * overlap * overlap, 1e-4 * overlap * overlap);
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += points[i].area;
    CHECK_NEAR(sum, patch.area, 1e-12);
    pp_flat_contact flat;
    const double point[3] = {0, 2 - core - r + overlap, 0}, up[3] = {0, 3, 0};
    CHECK_STATUS(pp_contact_plane(square, &pose_a, point, up, NULL, NULL, &flat), PP_OK);
    CHECK_NEAR(flat.overlap, overlap, 1e-12);
    pp_particle_free(square);
}

static void what_leaves_the_plane_is_refused(void) {
    pp_particle *square = new_square(0.5, 0.1), *sphere = new_sphere(1.0);
    const pp_pose home = pose_at(0, 0, 0), raised = pose_at(0, 0, 1e-9), turned = pose_turned(1, 0, 0, 1, 0, 0, 0.3);
    const pp_pose leaning = pose_turned(1, 0, 0, 1, 0, 1e-9, 0.3);
    pp_contact contact;
    CHECK_STATUS(pp_contact_detect(square, &home, square, &turned, NULL, NULL, &contact), PP_OK);
    pp_contact untouched;
    FILL(untouched);
    CHECK_STATUS(pp_contact_detect(square, &home, sphere, &turned, NULL, NULL, &untouched), PP_NOT_IN_PLANE);
    CHECK_STATUS(pp_contact_detect(square, &raised, square, &turned, NULL, NULL, &untouched), PP_NOT_IN_PLANE);
    CHECK_STATUS(pp_contact_detect(square, &home, square, &leaning, NULL, NULL, &untouched), PP_NOT_IN_PLANE);
    CHECK_UNTOUCHED(untouched);
    pp_closest closest;
    CHECK_STATUS(pp_closest_point(square, &home, sphere, &turned, PP_ON_A, NULL, &closest), PP_NOT_IN_PLANE);
    pp_patch patch;
    CHECK_STATUS(pp_patch_of_contact(square, &home, square, &leaning, &contact, 1e-4, 0, NULL, &patch, NULL, 0, NULL),
                 PP_NOT_IN_PLANE);
    pp_derivatives derivatives;
    CHECK_STATUS(pp_contact_derivatives(square, &home, square, &leaning, NULL, &contact, &derivatives),
                 PP_NOT_IN_PLANE);
    pp_flat_contact flat;
    const double point[3] = {0, 0, 0}, slanted[3] = {0, 1, 1}, vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    CHECK_STATUS(pp_contact_plane(square, &home, point, slanted, NULL, NULL, &flat), PP_NOT_IN_PLANE);
    CHECK_STATUS(pp_contact_triangle(square, &home, vertices, NULL, NULL, &flat), PP_NOT_IN_PLANE);
    const pp_particle *const bodies[] = {square, sphere, square};
    const pp_pose poses[] = {home, turned, turned};
    const uint32_t pairs[] = {0, 1, 0, 2};
    pp_contact contacts[2];
    pp_status statuses[2];
    CHECK_STATUS(pp_contact_detect_batch(bodies, poses, 3, pairs, 2, NULL, 1, NULL, contacts, statuses), PP_OK);
    CHECK(statuses[0] == PP_NOT_IN_PLANE && statuses[1] == PP_OK);
    pp_particle_free(square);
    pp_particle_free(sphere);
}

void test_in_plane(void) {
    refusals_have_their_status();
    polygon_from_points();
    squares_side_on_side();
    what_leaves_the_plane_is_refused();
}
