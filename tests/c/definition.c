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

void test_definition(void) {
    definition_in_space();
}
