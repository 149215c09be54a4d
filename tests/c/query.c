/* What can be asked of one particle, against closed forms. Refused poses are in pose.c. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double not_finite[] = {NAN, INFINITY, -INFINITY};

/* The quaternion (4, 2, 2, 1)/5: a rotation without symmetry, exact in decimals. */
static pp_pose skew_pose(void) {
    return pose_turned(10.0, -20.0, 30.0, 0.8, 0.4, 0.4, 0.2);
}

static void world_point(const pp_pose *pose, const double local[3], double world[3]) {
    double turned[3];
    turn(pose, local, turned);
    walk(pose->position, 1.0, turned, world);
}

static void potential_is_its_definition(void) {
    const double core = 1.0, r = 0.5, k = 0.3, big = 2.0;
    const double points[][3] = {{0, 0, 0}, {0.5, -0.5, 0.9}, {1.2, 0.3, -1.4}, {-3.0, 4.0, 5.0}, {1.0, 1.0, 1.0}};
    pp_particle *cube = new_cube(core, r, k, big);
    pp_pose pose = skew_pose();
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        const double *x = points[i];
        double expected = -1.0, local_gradient[3], expected_gradient[3], world[3];
        for (int j = 0; j < 3; j++) {
            double beyond = copysign(fmax(fabs(x[j]) - core, 0.0), x[j]);
            expected += (1 - k) / (r * r) * beyond * beyond + k / (big * big) * x[j] * x[j];
            local_gradient[j] = 2 * (1 - k) / (r * r) * beyond + 2 * k / (big * big) * x[j];
        }
        turn(&pose, local_gradient, expected_gradient);
        world_point(&pose, x, world);
        double scale = 1e-12 * (1 + fabs(expected));
        double f, gradient[3], again;
        check_case("potential at point %zu", i);
        CHECK_STATUS(pp_particle_potential(cube, &pose, world, &f, gradient), PP_OK);
        CHECK_NEAR(f, expected, scale);
        CHECK_NEAR3(gradient, expected_gradient, scale);
        CHECK_STATUS(pp_particle_potential(cube, &pose, world, &again, NULL), PP_OK);
        CHECK(again == f);
    }
    check_case(NULL);
    pp_particle_free(cube);
}

static void potential_refuses(void) {
    pp_particle *cube = new_cube(1.0, 0.5, 0.3, 2.0);
    pp_pose pose = skew_pose();
    double point[3] = {1, 2, 3}, f, gradient[3];
    FILL(f);
    FILL(gradient);
    CHECK_STATUS(pp_particle_potential(NULL, &pose, point, &f, gradient), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_potential(cube, NULL, point, &f, gradient), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_potential(cube, &pose, NULL, &f, gradient), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_potential(cube, &pose, point, NULL, gradient), PP_NULL_POINTER);
    for (int j = 0; j < 3; j++) {
        for (int value = 0; value < 3; value++) {
            double bad[3] = {1, 2, 3};
            bad[j] = not_finite[value];
            CHECK_STATUS(pp_particle_potential(cube, &pose, bad, &f, gradient), PP_BAD_POINT);
        }
    }
    CHECK_UNTOUCHED(f);
    CHECK_UNTOUCHED(gradient);
    pp_particle_free(cube);
}

/* With k = 0 the planes of a cube make exactly the cube of half size core, padded by a ball of r:
 * its reach along a direction n is core * (|n_x| + |n_y| + |n_z|) + r. */
static double reach(double core, double r, const double n[3]) {
    return core * (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) + r * sqrt(dot(n, n));
}

/* Bounds must hold the particle. How much larger they may be: than the sharp cube around the
 * padded one, or the sphere itself, hardly at all. */
static const double looseness = 1e-4;

static void check_bound(double bound, double least, double most) {
    CHECK(bound >= least * (1 - 1e-14));
    CHECK(bound <= most * (1 + looseness));
}

static void box_holds_the_particle(void) {
    const double core = 1.0, r = 0.25;
    pp_particle *cube = new_cube(core, r, 0.0, 0.0), *sphere = new_sphere(3.0);
    pp_pose pose = skew_pose();
    double lower[3], upper[3];
    CHECK_STATUS(pp_particle_box(cube, &pose, lower, upper), PP_OK);
    for (int j = 0; j < 3; j++) {
        /* Row j of the rotation, from its columns: the world axis j seen in the local frame. */
        double row[3];
        for (int i = 0; i < 3; i++) {
            double axis[3] = {i == 0, i == 1, i == 2}, column[3];
            turn(&pose, axis, column);
            row[i] = column[j];
        }
        check_bound(upper[j] - pose.position[j], reach(core, r, row), reach(core + r, 0.0, row));
        check_bound(pose.position[j] - lower[j], reach(core, r, row), reach(core + r, 0.0, row));
    }
    CHECK_STATUS(pp_particle_box(sphere, &pose, lower, upper), PP_OK);
    for (int j = 0; j < 3; j++) {
        check_bound(upper[j] - pose.position[j], 3.0, 3.0);
        check_bound(pose.position[j] - lower[j], 3.0, 3.0);
    }

    FILL(lower);
    FILL(upper);
    CHECK_STATUS(pp_particle_box(NULL, &pose, lower, upper), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box(cube, NULL, lower, upper), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box(cube, &pose, NULL, upper), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_box(cube, &pose, lower, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(lower);
    CHECK_UNTOUCHED(upper);
    pp_particle_free(cube);
    pp_particle_free(sphere);
}

static void bounding_radius_holds_the_particle(void) {
    pp_particle *cube = new_cube(1.0, 0.25, 0.0, 0.0), *sphere = new_sphere(3.0);
    double radius;
    CHECK_STATUS(pp_particle_bounding_radius(cube, &radius), PP_OK);
    check_bound(radius, sqrt(3.0) + 0.25, sqrt(3.0) * 1.25);
    CHECK_STATUS(pp_particle_bounding_radius(sphere, &radius), PP_OK);
    check_bound(radius, 3.0, 3.0);

    FILL(radius);
    CHECK_STATUS(pp_particle_bounding_radius(NULL, &radius), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_bounding_radius(cube, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(radius);
    pp_particle_free(cube);
    pp_particle_free(sphere);
}

static void open_planes_are_told(void) {
    const double planes[6][4] = { { 1, 0, 0, 0.9 },  { -1, 0, 0, 0.9 }, { 0, 1, 0, 0.9 },
                                  { 0, -1, 0, 0.9 }, { 0, 0, -1, 0.9 }, { 0, 0, 1, 0.9 } };
    for (size_t count = 0; count <= 6; count++) {
        pp_particle *particle;
        int32_t enclose = -1;
        CHECK_STATUS(pp_particle_new(&planes[0][0], count, 0.1, 0.1, 2.0, &particle, NULL, 0), PP_OK);
        CHECK_STATUS(pp_particle_planes_enclose(particle, &enclose), PP_OK);
        CHECK(enclose == (count == 6));
        pp_particle_free(particle);
    }
    pp_particle *cube = new_cube(1.0, 0.25, 0.0, 0.0);
    int32_t enclose = -1;
    CHECK_STATUS(pp_particle_planes_enclose(NULL, &enclose), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_planes_enclose(cube, NULL), PP_NULL_POINTER);
    CHECK(enclose == -1);
    pp_particle_free(cube);
}

static void corners_hold_the_particle(void) {
    const double core = 1.0, r = 0.25;
    pp_particle *cube = new_cube(core, r, 0.0, 0.0);
    size_t count = 0;
    CHECK_STATUS(pp_particle_corners(cube, NULL, 0, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count >= 4);
    double *corners = malloc((3 * count + 1) * sizeof *corners);
    CHECK(corners != NULL);
    if (corners == NULL) return;

    /* One row too few: the size is told, the rows stay. */
    size_t needed = 0;
    check_fill(corners, (3 * count + 1) * sizeof *corners);
    CHECK_STATUS(pp_particle_corners(cube, corners, count - 1, &needed), PP_BUFFER_TOO_SMALL);
    CHECK(needed == count);
    check_untouched(corners, 3 * count * sizeof *corners, "corners", __FILE__, __LINE__);

    needed = 0;
    CHECK_STATUS(pp_particle_corners(cube, corners, count, &needed), PP_OK);
    CHECK(needed == count);
    check_untouched(corners + 3 * count, sizeof *corners, "beyond the corners", __FILE__, __LINE__);
    random_numbers numbers = {1};
    for (int i = 0; i < 50; i++) {
        double n[3], furthest = -INFINITY;
        for (int j = 0; j < 3; j++) n[j] = random_next(&numbers);
        for (size_t c = 0; c < count; c++) furthest = fmax(furthest, dot(n, corners + 3 * c));
        CHECK(furthest >= reach(core, r, n) * (1 - 1e-12));
    }

    FILL(needed);
    check_fill(corners, 3 * count * sizeof *corners);
    CHECK_STATUS(pp_particle_corners(NULL, corners, count, &needed), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_corners(cube, NULL, count, &needed), PP_NULL_POINTER);
    /* Whether what there is would have fitted or not. */
    CHECK_STATUS(pp_particle_corners(cube, NULL, 1, &needed), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_corners(cube, NULL, 10 * count, &needed), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_corners(cube, corners, count, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(needed);
    check_untouched(corners, 3 * count * sizeof *corners, "corners", __FILE__, __LINE__);
    free(corners);
    pp_particle_free(cube);
}

/* A cube reaches to its faces and, at most, to its sharp corners; twice as large it reaches twice as far. */
static void support_bounds_and_scales(void) {
    const double core = 1.0, r = 0.1, face[3] = {0, 0, 5}, corner[3] = {1, 1, 1}, none[3] = {0, 0, 0};
    pp_particle *cube = new_cube(core, r, 0.0, 1.0), *large = NULL;
    double reach, of_large, k;
    CHECK_STATUS(pp_particle_support(cube, face, &reach), PP_OK);
    CHECK(reach >= core + r && reach < (core + r) * (1 + 3e-5));
    CHECK_STATUS(pp_particle_support(cube, corner, &reach), PP_OK);
    CHECK(reach >= (sqrt(3.0) * core + r) && reach < sqrt(3.0) * (core + r) * (1 + 3e-5));
    char message[PP_MESSAGE_SIZE];
    CHECK_STATUS(pp_particle_scaled(cube, 2.0, &large, message, sizeof message), PP_OK);
    CHECK_STATUS(pp_particle_support(large, corner, &of_large), PP_OK);
    CHECK_NEAR(of_large, 2 * reach, 1e-12);
    CHECK_STATUS(pp_particle_rounding_radius(large, &k), PP_OK);
    CHECK(k == 2 * r);
    pp_particle_free(large);
    large = NULL;
    CHECK_STATUS(pp_particle_scaled(cube, -1.0, &large, message, sizeof message), PP_BAD_ROUNDING_RADIUS);
    CHECK(large == NULL && strlen(message) > 10);
    CHECK_STATUS(pp_particle_scaled(NULL, 2.0, &large, message, sizeof message), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_support(cube, none, &reach), PP_BAD_POINT);
    CHECK_STATUS(pp_particle_support(NULL, face, &reach), PP_NULL_POINTER);
    pp_particle_free(cube);
}

static void surface_distance_ends_on_the_surface(void) {
    const double core = 1.0, r = 0.25;
    pp_particle *cube = new_cube(core, r, 0.0, 0.0), *round_cube = new_cube(core, r, 0.3, 2.0);
    pp_pose home = pose_at(0, 0, 0);
    double distance;
    const double lengths[] = {1.0, 1e-3, 1e5, 1e-200, 1e200, DBL_MAX, DBL_MIN}; /* "any length" */
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        check_case("direction of length %g", lengths[i]);
        const double face[3] = {0, -lengths[i], 0}, diagonal[3] = {lengths[i], lengths[i], lengths[i]};
        CHECK_STATUS(pp_particle_surface_distance(cube, face, &distance), PP_OK);
        CHECK_NEAR(distance, core + r, 1e-13);
        CHECK_STATUS(pp_particle_surface_distance(cube, diagonal, &distance), PP_OK);
        CHECK_NEAR(distance, sqrt(3.0) * core + r, 1e-13);
    }
    random_numbers numbers = {2};
    for (int i = 0; i < 20; i++) {
        double n[3], point[3], f, gradient[3];
        check_case("random direction %d", i);
        for (int j = 0; j < 3; j++) n[j] = random_next(&numbers);
        CHECK_STATUS(pp_particle_surface_distance(round_cube, n, &distance), PP_OK);
        for (int j = 0; j < 3; j++) point[j] = n[j] / sqrt(dot(n, n)) * distance;
        CHECK_STATUS(pp_particle_potential(round_cube, &home, point, &f, gradient), PP_OK);
        CHECK_NEAR(f, 0.0, 1e-12);
    }
    check_case(NULL);

    const double direction[3] = {1, 0, 0}, none[3] = {0.0, -0.0, 0.0};
    FILL(distance);
    CHECK_STATUS(pp_particle_surface_distance(NULL, direction, &distance), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance(cube, NULL, &distance), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance(cube, direction, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_surface_distance(cube, none, &distance), PP_BAD_POINT);
    for (int j = 0; j < 3; j++) {
        for (int value = 0; value < 3; value++) {
            double bad[3] = {1, 2, 3};
            bad[j] = not_finite[value];
            CHECK_STATUS(pp_particle_surface_distance(cube, bad, &distance), PP_BAD_POINT);
        }
    }
    CHECK_UNTOUCHED(distance);
    pp_particle_free(cube);
    pp_particle_free(round_cube);
}

static void mass_properties_of_sphere_and_padded_cube(void) {
    const double radius = 2.0, d = 1.0, r = 0.5;
    const double centre[3] = {0, 0, 0};
    pp_particle *sphere = new_sphere(radius), *cube = new_cube(d, r, 0.0, 0.0);
    pp_mass_properties mass;
    CHECK_STATUS(pp_particle_mass_properties(sphere, 1e-6, &mass), PP_OK);
    double volume = 4.0 / 3.0 * PI * radius * radius * radius, inertia = 0.4 * volume * radius * radius;
    CHECK_NEAR(mass.volume, volume, 1e-6 * volume);
    CHECK_NEAR3(mass.centroid, centre, 1e-6 * radius);
    for (int j = 0; j < 3; j++) {
        CHECK_NEAR(mass.inertia[j], inertia, 1e-6 * inertia);
        CHECK_NEAR(mass.inertia[3 + j], 0.0, 1e-6 * inertia);
    }

    /* Steiner: cube, slabs on its faces, quarter cylinders on its edges, ball octants on its corners. */
    CHECK_STATUS(pp_particle_mass_properties(cube, 1e-6, &mass), PP_OK);
    volume = 8 * d * d * d + 24 * d * d * r + 6 * PI * d * r * r + 4.0 / 3.0 * PI * r * r * r;
    CHECK_NEAR(mass.volume, volume, 1e-6 * volume);
    CHECK(mass.error >= 0.0 && mass.error <= 1e-6);
    CHECK_NEAR3(mass.centroid, centre, 1e-6);
    for (int j = 0; j < 3; j++) {
        CHECK_NEAR(mass.inertia[j], mass.inertia[0], 1e-6 * mass.inertia[0]);
        CHECK_NEAR(mass.inertia[3 + j], 0.0, 1e-6 * mass.inertia[0]);
    }
    CHECK(mass.inertia[0] > volume * 2.0 / 3.0 * d * d); /* more than the bare cube's */

    FILL(mass);
    CHECK_STATUS(pp_particle_mass_properties(NULL, 1e-6, &mass), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_mass_properties(cube, 1e-6, NULL), PP_NULL_POINTER);
    const double refused[4] = {0.0, -1e-6, 2.0, NAN};
    for (int j = 0; j < 4; j++) CHECK_STATUS(pp_particle_mass_properties(cube, refused[j], &mass), PP_BAD_SETTING);
    CHECK_UNTOUCHED(mass);
    pp_particle_free(sphere);
    pp_particle_free(cube);
}

void test_query(void) {
    potential_is_its_definition();
    potential_refuses();
    box_holds_the_particle();
    bounding_radius_holds_the_particle();
    open_planes_are_told();
    corners_hold_the_particle();
    support_bounds_and_scales();
    surface_distance_ends_on_the_surface();
    mass_properties_of_sphere_and_padded_cube();
}
