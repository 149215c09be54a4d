/* Creation and release of particles: what is accepted, what is refused, and what the refusal says. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cube that is accepted; each refusal spoils one thing in it. */
typedef struct {
    double planes[4 * CUBE_PLANES];
    size_t count;
    double r, k, shadow_radius;
} recipe;

static recipe good_recipe(void) {
    recipe cube = {.count = CUBE_PLANES, .r = 0.5, .k = 0.3, .shadow_radius = 2.0};
    cube_planes(1.0, cube.planes);
    return cube;
}

static void check_refused(const recipe *spoilt, pp_status expected, const char *named) {
    pp_particle *particle;
    char message[PP_MESSAGE_SIZE];
    FILL(particle);
    FILL(message);
    CHECK_STATUS(pp_particle_new(spoilt->planes, spoilt->count, spoilt->r, spoilt->k, spoilt->shadow_radius,
                                 &particle, message, sizeof message),
                 expected);
    CHECK_UNTOUCHED(particle);
    bool ends = memchr(message, 0, sizeof message) != NULL;
    CHECK(ends);
    if (ends && strstr(message, named) == NULL) {
        CHECK_TEXT(message, named); /* fails, and shows both */
    }
}

static void check_accepted(const recipe *good) {
    pp_particle *particle = NULL;
    char message[PP_MESSAGE_SIZE];
    FILL(message);
    CHECK_STATUS(pp_particle_new(good->planes, good->count, good->r, good->k, good->shadow_radius, &particle,
                                 message, sizeof message),
                 PP_OK);
    CHECK(particle != NULL);
    CHECK_UNTOUCHED(message);
    pp_particle_free(particle);
}

static void planes_are_checked(void) {
    const double not_finite[] = {NAN, INFINITY, -INFINITY};
    for (int value = 0; value < 3; value++) {
        for (int plane = 0; plane < CUBE_PLANES; plane++) {
            for (int column = 0; column < 4; column++) {
                recipe spoilt = good_recipe();
                spoilt.planes[4 * plane + column] = not_finite[value];
                char named[] = "plane 0";
                named[6] = (char)('0' + plane);
                check_case("plane %d, column %d = %g", plane, column, not_finite[value]);
                check_refused(&spoilt, PP_PLANE_NOT_FINITE, named);
            }
        }
    }
    check_case("zero normal");
    recipe spoilt = good_recipe();
    spoilt.planes[4 * 3 + 1] = -0.0;
    check_refused(&spoilt, PP_PLANE_ZERO_NORMAL, "plane 3");
    check_case(NULL);
}

static void radii_and_sphericity_are_checked(void) {
    const double bad_k[] = {NAN, INFINITY, -INFINITY, -0.1, 1.0 + DBL_EPSILON, 2.0, -DBL_MIN};
    for (size_t i = 0; i < sizeof bad_k / sizeof bad_k[0]; i++) {
        recipe spoilt = good_recipe();
        spoilt.k = bad_k[i];
        check_case("k = %g", bad_k[i]);
        check_refused(&spoilt, PP_BAD_SPHERICITY, "k=");
    }
    const double bad_radius[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0};
    for (size_t i = 0; i < sizeof bad_radius / sizeof bad_radius[0]; i++) {
        check_case("radius %g", bad_radius[i]);
        recipe spoilt = good_recipe();
        spoilt.r = bad_radius[i];
        check_refused(&spoilt, PP_BAD_ROUNDING_RADIUS, "r=");
        spoilt = good_recipe();
        spoilt.shadow_radius = bad_radius[i];
        check_refused(&spoilt, PP_BAD_SHADOW_RADIUS, "R=");
        /* k = 1 leaves the planes without meaning, k = 0 the sphere. */
        recipe sphere = good_recipe();
        sphere.k = 1.0;
        sphere.r = bad_radius[i];
        check_accepted(&sphere);
        recipe cube = good_recipe();
        cube.k = 0.0;
        cube.shadow_radius = bad_radius[i];
        check_accepted(&cube);
    }
    check_case(NULL);
}

static void centre_must_be_inside(void) {
    recipe spoilt = good_recipe();
    spoilt.planes[4 * 4 + 3] = -0.7; /* further behind the origin than the rounding reaches */
    check_refused(&spoilt, PP_CENTRE_OUTSIDE, "plane 4");
    spoilt.planes[4 * 4 + 3] = -0.5; /* with k = 0 the surface passes through the origin: f(0) = 0 */
    spoilt.k = 0.0;
    check_refused(&spoilt, PP_CENTRE_OUTSIDE, "f(0)=0");
    spoilt.planes[4 * 4 + 3] = -0.4;
    check_accepted(&spoilt);
}

static void polyhedron_must_be_bounded(void) {
    for (size_t count = 0; count < CUBE_PLANES; count++) {
        recipe open = good_recipe();
        open.count = count;
        check_case("%zu planes of a cube", count);
        check_accepted(&open); /* the sphere closes it */
        open.k = 0.0;
        check_refused(&open, PP_UNBOUNDED, "k=0");
    }
    check_case("a prism without ends");
    recipe prism = {.planes = {1, 0, 0, 1, 0, 1, 0, 1, -1, -1, 0, 1}, .count = 3, .r = 0.5};
    check_refused(&prism, PP_UNBOUNDED, "k=0");
    check_case(NULL);
}

static void planes_are_limited(void) {
    size_t most = PP_MAX_PLANES;
    double *planes = calloc(4 * (most + 1), sizeof *planes);
    pp_particle *particle;
    char message[PP_MESSAGE_SIZE];
    CHECK(planes != NULL);
    if (planes == NULL) return;
    FILL(particle);
    CHECK_STATUS(pp_particle_new(planes, most + 1, 0.5, 0.3, 2.0, &particle, message, sizeof message),
                 PP_TOO_MANY_PLANES);
    CHECK(strstr(message, "65537") != NULL && strstr(message, "65536") != NULL);
    CHECK_STATUS(pp_particle_new(planes, SIZE_MAX, 0.5, 0.3, 2.0, &particle, NULL, 0), PP_TOO_MANY_PLANES);
    CHECK_UNTOUCHED(particle);
    /* The limit itself is no excess: these planes are refused for what they are, all zero. */
    CHECK_STATUS(pp_particle_new(planes, most, 0.5, 0.3, 2.0, &particle, NULL, 0), PP_PLANE_ZERO_NORMAL);
    CHECK_UNTOUCHED(particle);
    free(planes);
}

static void null_is_refused_or_means_nothing(void) {
    recipe cube = good_recipe();
    pp_particle *particle;
    char message[PP_MESSAGE_SIZE] = "";
    FILL(particle);
    CHECK_STATUS(pp_particle_new(NULL, CUBE_PLANES, 0.5, 0.3, 2.0, &particle, message, sizeof message),
                 PP_NULL_POINTER);
    CHECK_UNTOUCHED(particle);
    CHECK(strstr(message, "planes") != NULL);
    message[0] = 0;
    CHECK_STATUS(pp_particle_new(cube.planes, cube.count, 0.5, 0.3, 2.0, NULL, message, sizeof message),
                 PP_NULL_POINTER);
    CHECK(strstr(message, "out") != NULL);

    /* Without planes their address does not matter. */
    for (int given = 0; given < 2; given++) {
        particle = NULL;
        CHECK_STATUS(pp_particle_new(given ? cube.planes : NULL, 0, NAN, 1.0, 2.0, &particle, NULL, 0), PP_OK);
        CHECK(particle != NULL);
        pp_particle_free(particle);
    }
    pp_particle_free(NULL);
}

/* The longest message there is: three coefficients whose plain decimals have over 300 digits. */
static pp_status refuse_at_length(char *message, size_t size) {
    const double plane[] = {NAN, -DBL_MAX, -DBL_TRUE_MIN, -DBL_MAX};
    pp_particle *particle;
    FILL(particle);
    pp_status status = pp_particle_new(plane, 1, 0.5, 0.3, 2.0, &particle, message, size);
    CHECK_UNTOUCHED(particle);
    return status;
}

static void messages_fit_their_buffer(void) {
    char whole[4096], message[PP_MESSAGE_SIZE];
    CHECK_STATUS(refuse_at_length(whole, sizeof whole), PP_PLANE_NOT_FINITE);
    CHECK_STATUS(refuse_at_length(message, sizeof message), PP_PLANE_NOT_FINITE);
    CHECK_TEXT(message, whole); /* PP_MESSAGE_SIZE is enough for every message */

    for (size_t size = 1; size <= 40; size++) {
        check_case("message buffer of %zu bytes", size);
        FILL(message);
        CHECK_STATUS(refuse_at_length(message, size), PP_PLANE_NOT_FINITE);
        CHECK(message[size - 1] == 0);
        CHECK_SAME_BYTES(message, whole, size - 1);
        check_untouched(message + size, sizeof message - size, "beyond the message", __FILE__, __LINE__);
    }
    check_case("message buffer of no bytes");
    FILL(message);
    CHECK_STATUS(refuse_at_length(message, 0), PP_PLANE_NOT_FINITE);
    CHECK_UNTOUCHED(message);
    check_case("no message buffer");
    CHECK_STATUS(refuse_at_length(NULL, 0), PP_PLANE_NOT_FINITE);
    CHECK_STATUS(refuse_at_length(NULL, PP_MESSAGE_SIZE), PP_PLANE_NOT_FINITE);
    check_case(NULL);
}

void test_particle(void) {
    recipe good = good_recipe();
    check_accepted(&good);
    planes_are_checked();
    radii_and_sphericity_are_checked();
    centre_must_be_inside();
    polyhedron_must_be_bounded();
    planes_are_limited();
    null_is_refused_or_means_nothing();
    messages_fit_their_buffer();
}
