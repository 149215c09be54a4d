/* Particles of the plane: the same interface with two coordinates, against closed forms. */
#include "answer.h"
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double not_finite[] = {NAN, INFINITY, -INFINITY};

static void layout_is_as_written_down(void) {
    CHECK(sizeof(pp_pose_2d) == 24);
    CHECK(offsetof(pp_pose_2d, position) == 0);
    CHECK(offsetof(pp_pose_2d, angle) == 16);
}

/* A square that is accepted; each refusal spoils one thing in it. */
typedef struct {
    double lines[3 * SQUARE_LINES];
    size_t count;
    double r, k, shadow_radius;
} recipe;

static recipe good_recipe(void) {
    recipe square = {.count = SQUARE_LINES, .r = 0.5, .k = 0.3, .shadow_radius = 2.0};
    square_lines_2d(1.0, square.lines);
    return square;
}

/* The message names the value, and speaks of lines. */
static void check_refused(const recipe *spoilt, pp_status expected, const char *named) {
    pp_particle_2d *particle;
    char message[PP_MESSAGE_SIZE];
    FILL(particle);
    FILL(message);
    CHECK_STATUS(pp_particle_new_2d(spoilt->lines, spoilt->count, spoilt->r, spoilt->k, spoilt->shadow_radius,
                                    &particle, message, sizeof message),
                 expected);
    CHECK_UNTOUCHED(particle);
    bool ends = memchr(message, 0, sizeof message) != NULL;
    CHECK(ends);
    if (!ends) return;
    CHECK(strstr(message, "plane") == NULL);
    if (strstr(message, named) == NULL) CHECK_TEXT(message, named); /* fails, and shows both */
}

static void lines_are_checked(void) {
    for (int value = 0; value < 3; value++) {
        for (int column = 0; column < 3; column++) {
            recipe spoilt = good_recipe();
            spoilt.lines[3 * 2 + column] = not_finite[value];
            check_case("column %d = %g", column, not_finite[value]);
            check_refused(&spoilt, PP_PLANE_NOT_FINITE, "line 2");
        }
    }
    check_case(NULL);
    recipe spoilt = good_recipe();
    spoilt.lines[3 * 3 + 1] = -0.0;
    check_refused(&spoilt, PP_PLANE_ZERO_NORMAL, "line 3");
    spoilt = good_recipe();
    spoilt.k = 1.5;
    check_refused(&spoilt, PP_BAD_SPHERICITY, "k=1.5");
    spoilt = good_recipe();
    spoilt.r = 0.0;
    check_refused(&spoilt, PP_BAD_ROUNDING_RADIUS, "r=0");
    spoilt = good_recipe();
    spoilt.shadow_radius = -2.0;
    check_refused(&spoilt, PP_BAD_SHADOW_RADIUS, "R=-2");
    spoilt = good_recipe();
    spoilt.lines[3 * 1 + 2] = -0.7;
    check_refused(&spoilt, PP_CENTRE_OUTSIDE, "line 1");
    for (size_t count = 0; count < SQUARE_LINES; count++) {
        recipe open = good_recipe();
        open.count = count;
        open.k = 0.0;
        check_case("%zu lines of a square", count);
        check_refused(&open, PP_UNBOUNDED, "the lines do not enclose an area");
        pp_particle_free_2d(
            new_polygon_2d(open.lines, count, open.r, 0.3, open.shadow_radius)); /* the circle closes it */
    }
    check_case(NULL);
}

static void lines_are_limited_and_null_refused(void) {
    size_t most = PP_MAX_PLANES;
    double *lines = calloc(3 * (most + 1), sizeof *lines);
    pp_particle_2d *particle;
    char message[PP_MESSAGE_SIZE] = "";
    CHECK(lines != NULL);
    if (lines == NULL) return;
    FILL(particle);
    CHECK_STATUS(pp_particle_new_2d(lines, most + 1, 0.5, 0.3, 2.0, &particle, message, sizeof message),
                 PP_TOO_MANY_PLANES);
    CHECK(strstr(message, "65537 lines") != NULL);
    CHECK_STATUS(pp_particle_new_2d(lines, SIZE_MAX, 0.5, 0.3, 2.0, &particle, NULL, 0), PP_TOO_MANY_PLANES);
    CHECK_STATUS(pp_particle_new_2d(lines, most, 0.5, 0.3, 2.0, &particle, NULL, 0), PP_PLANE_ZERO_NORMAL);
    CHECK_STATUS(pp_particle_new_2d(NULL, SQUARE_LINES, 0.5, 0.3, 2.0, &particle, message, sizeof message),
                 PP_NULL_POINTER);
    CHECK_TEXT(message, "lines must not be NULL");
    CHECK_UNTOUCHED(particle);
    CHECK_STATUS(pp_particle_new_2d(NULL, 0, 0.0, 1.0, 2.0, NULL, message, sizeof message), PP_NULL_POINTER);
    pp_particle_free_2d(NULL);
    free(lines);
}

/* S of a square by hand: line x = 1 is passed by 0.25, half of r. */
static void potential_and_radius(void) {
    const double core = 1.0, r = 0.5, k = 0.3, shadow_radius = 2.0;
    pp_particle_2d *square = new_square_2d(core, r, k, shadow_radius);
    const pp_pose_2d pose = {.position = {3, 4}, .angle = PI / 2}; /* local x is world y */
    const double point[2] = {3 - 0.5, 4 + 1.25};
    double f, gradient[2], radius;
    CHECK_STATUS(pp_particle_potential_2d(square, &pose, point, &f, gradient), PP_OK);
    double m = k / (shadow_radius * shadow_radius);
    CHECK_NEAR(f, (1 - k) * 0.25 + m * (0.5 * 0.5 + 1.25 * 1.25) - 1, 1e-14);
    CHECK_NEAR2(gradient, -2 * m * 0.5, 2 * (1 - k) * 0.25 / (r * r) + 2 * m * 1.25, 1e-14);
    double alone;
    CHECK_STATUS(pp_particle_potential_2d(square, &pose, point, &alone, NULL), PP_OK);
    CHECK(alone == f);

    FILL(f);
    FILL(gradient);
    CHECK_STATUS(pp_particle_potential_2d(NULL, &pose, point, &f, gradient), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_potential_2d(square, NULL, point, &f, gradient), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_potential_2d(square, &pose, NULL, &f, gradient), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_potential_2d(square, &pose, point, NULL, gradient), PP_NULL_POINTER);
    for (int value = 0; value < 3; value++) {
        for (int j = 0; j < 2; j++) {
            double bad[2] = {0, 0};
            bad[j] = not_finite[value];
            CHECK_STATUS(pp_particle_potential_2d(square, &pose, bad, &f, gradient), PP_BAD_POINT);
        }
    }
    CHECK_UNTOUCHED(f);
    CHECK_UNTOUCHED(gradient);

    CHECK_STATUS(pp_particle_bounding_radius_2d(square, &radius), PP_OK);
    /* Beyond the middle of a side (d + r at most), within the corners of the lines moved out by r/sqrt(1-k). */
    CHECK(radius > core && radius < 1.001 * sqrt(2.0) * (core + r / sqrt(1 - k)));
    FILL(radius);
    CHECK_STATUS(pp_particle_bounding_radius_2d(NULL, &radius), PP_NULL_POINTER);
    CHECK_UNTOUCHED(radius);
    CHECK_STATUS(pp_particle_bounding_radius_2d(square, NULL), PP_NULL_POINTER);
    pp_particle_free_2d(square);
}

/* What pp_contact_detect_2d and pp_contact_length_2d refuse; nothing is written then. */
static void bad_input_is_refused(void) {
    pp_particle_2d *circle = new_circle_2d(1.0);
    const pp_pose_2d home = {.angle = 1.0}, beside = {.position = {1.5, 0}};
    pp_contact_2d good, contact;
    pp_pair_state state;
    double length;
    CHECK_STATUS(pp_contact_detect_2d(circle, &home, circle, &beside, NULL, NULL, &good), PP_OK);
    CHECK_STATUS(pp_contact_length_2d(circle, &home, circle, &beside, &good, &length), PP_OK);
    CHECK_NEAR(length, 2 * sqrt(1 - 0.75 * 0.75), 1e-7);
    CHECK_NEAR2(good.normal, 1, 0, 1e-9);
    CHECK_NEAR2(good.point_on_b, 0.5, 0, 1e-9);
    FILL(contact);
    FILL(state);
    FILL(length);
#define DETECT(a, pose_a, b, pose_b) pp_contact_detect_2d(a, pose_a, b, pose_b, NULL, &state, &contact)
#define LENGTH(a, pose_a, b, pose_b) pp_contact_length_2d(a, pose_a, b, pose_b, &good, &length)
    CHECK_STATUS(DETECT(NULL, &home, circle, &beside), PP_NULL_POINTER);
    CHECK_STATUS(DETECT(circle, NULL, circle, &beside), PP_NULL_POINTER);
    CHECK_STATUS(DETECT(circle, &home, NULL, &beside), PP_NULL_POINTER);
    CHECK_STATUS(DETECT(circle, &home, circle, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_detect_2d(circle, &home, circle, &beside, NULL, &state, NULL), PP_NULL_POINTER);
    CHECK_STATUS(LENGTH(NULL, &home, circle, &beside), PP_NULL_POINTER);
    CHECK_STATUS(LENGTH(circle, NULL, circle, &beside), PP_NULL_POINTER);
    CHECK_STATUS(LENGTH(circle, &home, NULL, &beside), PP_NULL_POINTER);
    CHECK_STATUS(LENGTH(circle, &home, circle, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_length_2d(circle, &home, circle, &beside, NULL, &length), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_length_2d(circle, &home, circle, &beside, &good, NULL), PP_NULL_POINTER);
    for (int value = 0; value < 3; value++) {
        const double origin[2] = {0, 0};
        double f;
        FILL(f);
        for (int j = 0; j < 3; j++) {
            pp_pose_2d bad = home;
            if (j < 2) {
                bad.position[j] = not_finite[value];
            } else {
                bad.angle = not_finite[value];
            }
            pp_status expected = j < 2 ? PP_BAD_POSITION : PP_BAD_ORIENTATION;
            check_case("pose, number %d = %g", j, not_finite[value]);
            CHECK_STATUS(DETECT(circle, &bad, circle, &beside), expected);
            CHECK_STATUS(DETECT(circle, &home, circle, &bad), expected);
            CHECK_STATUS(LENGTH(circle, &bad, circle, &beside), expected);
            CHECK_STATUS(LENGTH(circle, &home, circle, &bad), expected);
            CHECK_STATUS(pp_particle_potential_2d(circle, &bad, origin, &f, NULL), expected);
        }
        const pp_pose_2d turned = {.angle = value == 0 ? 1.1e9 : -1.1e9};
        CHECK_STATUS(DETECT(circle, &turned, circle, &beside), PP_BAD_ORIENTATION);
        CHECK_UNTOUCHED(f);
        for (int j = 0; j < 2; j++) {
            pp_contact_2d spoilt[3] = {good, good, good};
            spoilt[0].normal[j] = spoilt[1].branch_a[j] = spoilt[2].branch_b[j] = not_finite[value];
            for (int field = 0; field < 3; field++) {
                check_case("field %d, component %d = %g", field, j, not_finite[value]);
                CHECK_STATUS(pp_contact_length_2d(circle, &home, circle, &beside, &spoilt[field], &length),
                             PP_BAD_POINT);
            }
        }
    }
    check_case("a contact that was not filled");
    const pp_contact_2d empty = {0};
    CHECK_STATUS(pp_contact_length_2d(circle, &home, circle, &beside, &empty, &length), PP_BAD_POINT);
    check_case("settings");
    pp_settings spoilt = default_settings();
    spoilt.formulation = 2;
    CHECK_STATUS(pp_contact_detect_2d(circle, &home, circle, &beside, &spoilt, &state, &contact),
                 PP_UNKNOWN_FORMULATION);
    spoilt = default_settings();
    spoilt.gap_tolerance = NAN;
    CHECK_STATUS(pp_contact_detect_2d(circle, &home, circle, &beside, &spoilt, &state, &contact), PP_BAD_SETTING);
    check_case("overflow");
    const pp_pose_2d west = {.position = {-1.7e308, 0}}, east = {.position = {1.7e308, 0}};
    CHECK_STATUS(DETECT(circle, &west, circle, &east), PP_SOLVER_FAILED);
    check_case(NULL);
#undef DETECT
#undef LENGTH
    CHECK_UNTOUCHED(contact);
    CHECK_UNTOUCHED(state);
    CHECK_UNTOUCHED(length);
    pp_particle_free_2d(circle);
}

static void state_and_rejection(void) {
    pp_particle_2d *square = new_square_2d(1.0, 0.5, 0.3, 2.0);
    const pp_pose_2d home = { .angle = 0.3 }, beside = { .position = { 2.4, 0.4 }, .angle = -0.2 },
                     far = { .position = { 30, 0 } };
    pp_pair_state state = {0};
    pp_contact_2d cold, warm;
    CHECK_STATUS(pp_contact_detect_2d(square, &home, square, &beside, NULL, &state, &cold), PP_OK);
    CHECK_STATUS(pp_contact_detect_2d(square, &home, square, &beside, NULL, &state, &warm), PP_OK);
    CHECK(cold.kind == PP_OVERLAPPING && warm.kind == PP_OVERLAPPING);
    CHECK((cold.flags & PP_FLAG_WARM) == 0 && (warm.flags & PP_FLAG_WARM) != 0);
    CHECK_NEAR(warm.s, cold.s, warm.gap + cold.gap);
    CHECK_NEAR2(warm.point, cold.point[0], cold.point[1], 1e-9);

    pp_contact_2d apart;
    CHECK_STATUS(pp_contact_detect_2d(square, &home, square, &far, NULL, NULL, &apart), PP_OK);
    CHECK(apart.kind == PP_SEPARATED && (apart.flags & PP_FLAG_REJECTED) && apart.s >= 1);
    CHECK(isnan(apart.weight) && isnan(apart.point_bound) && isnan(apart.normal[0]) && isnan(apart.point[1])
          && isnan(apart.branch_a[0]));
    /* The distance is proved: no more than the true one, and more than nothing at thirty half sizes. */
    CHECK(apart.distance > 20 && apart.distance < 28);
    CHECK(isnan(cold.distance));
    pp_particle_free_2d(square);
}

/* A square with its sides at 1 and corners rounded by r: rectangle, four slabs and a circle. */
static void area_and_outline_of_a_square(void) {
    const double core = 0.75, r = 0.25;
    pp_particle_2d *square = new_square_2d(core, r, 0.0, 0.0);
    const double area = 4 * core * core + 8 * core * r + PI * r * r;
    pp_area_properties found;
    CHECK_STATUS(pp_particle_area_properties_2d(square, 1e-9, &found), PP_OK);
    CHECK_NEAR(found.area, area, 1e-9 * area);
    CHECK_NEAR2(found.centroid, 0.0, 0.0, 1e-9);
    CHECK_NEAR(found.second_moment[0], found.second_moment[1], 1e-8);
    CHECK_NEAR(found.second_moment[2], 0.0, 1e-8);
    CHECK(found.error >= 0.0 && found.error <= 1e-9);

    double points[2000];
    size_t count = 0;
    CHECK_STATUS(pp_particle_outline_2d(square, 1e-3, NULL, 0, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count > 8 && count <= 1000);
    CHECK_STATUS(pp_particle_outline_2d(square, 1e-3, points, 1000, &count), PP_OK);
    double enclosed = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double *here = points + 2 * i, *next = points + 2 * ((i + 1) % count);
        enclosed += 0.5 * (here[0] * next[1] - here[1] * next[0]);
    }
    CHECK(enclosed < area && enclosed > area - 8e-3);

    FILL(found);
    const double refused[4] = {0.0, -1.0, INFINITY, NAN};
    for (int j = 0; j < 4; j++) {
        CHECK_STATUS(pp_particle_area_properties_2d(square, refused[j], &found), PP_BAD_SETTING);
        CHECK_STATUS(pp_particle_outline_2d(square, refused[j], points, 1000, &count), PP_BAD_SETTING);
    }
    CHECK_STATUS(pp_particle_area_properties_2d(NULL, 1e-6, &found), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_area_properties_2d(square, 1e-6, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_outline_2d(square, 1e-3, points, 1000, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(found);
    pp_particle_free_2d(square);
}

/* A triangle of legs 3 and 4 somewhere, its corners in no order and with a point inside; u and v, the distances
 * beyond the two sides of a corner, have u^2 + v^2 = r^2 on its rounding. */
static void polygon_from_points(void) {
    const double points[] = {104.0, 50.0, 101.0, 51.0, 100.0, 53.0, 100.0, 50.0}, r = 0.1;
    const double lost = r * r * (1 - PI / 4) * (1 + 5.0 / 3 + 5.0 / 4);
    pp_particle_2d *triangle = NULL;
    char message[PP_MESSAGE_SIZE];
    CHECK_STATUS(pp_particle_new_polygon_2d(points, 4, r, 0.0, &triangle, message, sizeof message), PP_OK);
    pp_area_properties found;
    CHECK_STATUS(pp_particle_area_properties_2d(triangle, 1e-9, &found), PP_OK);
    CHECK_NEAR(found.area, 6.0 - lost, 1e-7);
    CHECK_NEAR2(found.centroid, 0.0, 0.0, 0.02);
    pp_particle_free_2d(triangle);

    pp_particle_2d *none = (pp_particle_2d *)(uintptr_t)1;
    const double on_a_line[] = {0, 0, 1, 1, 2, 2}, not_finite[] = {0, 0, 1, NAN, 1, 0};
    CHECK_STATUS(pp_particle_new_polygon_2d(on_a_line, 3, r, 0.0, &none, message, sizeof message), PP_UNBOUNDED);
    CHECK(strstr(message, "enclose no area") != NULL);
    CHECK_STATUS(pp_particle_new_polygon_2d(not_finite, 3, r, 0.0, &none, message, sizeof message),
                 PP_PLANE_NOT_FINITE);
    CHECK(strstr(message, "vertex 1") != NULL);
    CHECK_STATUS(pp_particle_new_polygon_2d(points, 4, 2.0, 0.0, &none, message, sizeof message),
                 PP_BAD_ROUNDING_RADIUS);
    memset(message, 'x', sizeof message);
    CHECK_STATUS(pp_particle_new_polygon_2d(points, SIZE_MAX, r, 0.0, &none, message, sizeof message), PP_BAD_INDEX);
    CHECK(strcmp(message, pp_status_message(PP_BAD_INDEX)) == 0);
    CHECK_STATUS(pp_particle_new_polygon_2d(points, 4, r, -1.0, &none, NULL, 0), PP_BAD_SPHERICITY);
    CHECK_STATUS(pp_particle_new_polygon_2d(NULL, 4, r, 0.0, &none, message, sizeof message), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_new_polygon_2d(points, 4, r, 0.0, NULL, NULL, 0), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_new_polygon_2d(NULL, 0, r, 0.0, &none, NULL, 0), PP_UNBOUNDED);
    CHECK(none == (pp_particle_2d *)(uintptr_t)1);
}

void test_planar(void) {
    area_and_outline_of_a_square();
    polygon_from_points();
    layout_is_as_written_down();
    lines_are_checked();
    lines_are_limited_and_null_refused();
    potential_and_radius();
    bad_input_is_refused();
    state_and_rejection();
}
