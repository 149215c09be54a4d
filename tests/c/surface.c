/* The surface mesh: its corners against the definition, its size asked first, refusals. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <stdlib.h>

static void corners_lie_on_the_surface(void) {
    pp_particle *cube = new_cube(1.0, 0.5, 0.3, 2.0);
    pp_pose here = pose_at(0, 0, 0);
    size_t points = 0, faces = 0;
    double error, radius;
    CHECK_STATUS(pp_particle_mesh(cube, 1e-2, NULL, NULL, 0, &points, NULL, 0, &faces, NULL), PP_BUFFER_TOO_SMALL);
    /* Euler's formula for a closed mesh of triangles. */
    CHECK(points > 8 && faces == 2 * points - 4);
    double *vertices = malloc(points * sizeof(double[3])), *normals = malloc(points * sizeof(double[3]));
    uint32_t *triangles = malloc(faces * sizeof(uint32_t[3]));
    if (!vertices || !normals || !triangles) exit(2);
    CHECK_STATUS(pp_particle_mesh(cube, 1e-2, vertices, normals, points, &points, triangles, faces, &faces, &error),
                 PP_OK);
    CHECK_STATUS(pp_particle_bounding_radius(cube, &radius), PP_OK);
    CHECK(error > 0 && error <= 1e-2 * radius);
    for (size_t i = 0; i < points; i++) {
        double f, gradient[3];
        CHECK_STATUS(pp_particle_potential(cube, &here, &vertices[3 * i], &f, gradient), PP_OK);
        double length = sqrt(dot(gradient, gradient)), unit[3] = {0, 0, 0};
        walk(unit, 1 / length, gradient, unit);
        CHECK(fabs(f) <= 1e-12 * length);
        CHECK_NEAR3(&normals[3 * i], unit, 1e-12);
    }
    for (size_t i = 0; i < 3 * faces; i++) CHECK(triangles[i] < points);
    /* Normals may be left out; a buffer that is too small is not written. */
    CHECK_STATUS(pp_particle_mesh(cube, 1e-2, vertices, NULL, points, &points, triangles, faces, &faces, NULL), PP_OK);
    double first[3];
    FILL(first);
    CHECK_STATUS(pp_particle_mesh(cube, 1e-2, first, NULL, 1, &points, triangles, faces, &faces, NULL),
                 PP_BUFFER_TOO_SMALL);
    CHECK_UNTOUCHED(first);
    free(vertices);
    free(normals);
    free(triangles);
    pp_particle_free(cube);
}

static void bad_input_is_refused(void) {
    pp_particle *ball = new_sphere(1.0);
    size_t points, faces;
    FILL(points);
    FILL(faces);
    CHECK_STATUS(pp_particle_mesh(NULL, 0.1, NULL, NULL, 0, &points, NULL, 0, &faces, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_mesh(ball, 0.1, NULL, NULL, 0, NULL, NULL, 0, &faces, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_mesh(ball, 0.1, NULL, NULL, 0, &points, NULL, 0, NULL, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_mesh(ball, 0.1, NULL, NULL, 1000, &points, NULL, 1000, &faces, NULL), PP_NULL_POINTER);
    /* Whether what there is would have fitted or not; the other buffer is asked for its size. */
    CHECK_STATUS(pp_particle_mesh(ball, 0.1, NULL, NULL, 1, &points, NULL, 0, &faces, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_particle_mesh(ball, 0.1, NULL, NULL, 0, &points, NULL, 1, &faces, NULL), PP_NULL_POINTER);
    const double bad[] = {0.0, -1.0, 1e-6, 2.0, NAN, INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        CHECK_STATUS(pp_particle_mesh(ball, bad[i], NULL, NULL, 0, &points, NULL, 0, &faces, NULL), PP_BAD_TOLERANCE);
    CHECK_UNTOUCHED(points);
    CHECK_UNTOUCHED(faces);
    pp_particle_free(ball);
}

void test_surface(void) {
    corners_lie_on_the_surface();
    bad_input_is_refused();
}
