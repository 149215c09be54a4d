/* Two spheres: everything about their contact is known in closed form. */
#include "answer.h"
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>

/* Directions from A to B; unit, so that a distance along them is one. */
static const double directions[][3] = {{1, 0, 0}, {0, -1, 0}, {0.48, 0.64, -0.6}, {-2.0 / 3, 1.0 / 3, 2.0 / 3}};
enum { DIRECTIONS = sizeof directions / sizeof directions[0] };

static answer midway(double radius_a, double radius_b, double distance) {
    double t = distance / (radius_a + radius_b);
    return (answer){.s = t,
                    .s_b = NAN,
                    .weight = radius_b / (radius_a + radius_b),
                    .on_a = radius_a,
                    .on_b = distance - radius_b,
                    .point = radius_a * t};
}

static answer closest(double radius_a, double radius_b, double distance, double weight_on_a) {
    /* |grad S_A| and |grad S_B| at P2, halved. */
    double slope_a = (distance - radius_b) / (radius_a * radius_a), slope_b = 1 / radius_b;
    return (answer){.s = (distance - radius_b) / radius_a,
                    .s_b = (distance - radius_a) / radius_b,
                    .weight = slope_a / (slope_a + slope_b),
                    .on_a = radius_a,
                    .on_b = distance - radius_b,
                    .point = weight_on_a * radius_a + (1 - weight_on_a) * (distance - radius_b)};
}

static void one_pair(double radius_a, double radius_b, double distance, const way *chosen, double weight_on_a) {
    pp_particle *a = new_sphere(radius_a), *b = new_sphere(radius_b);
    pp_settings settings = settings_for(chosen);
    settings.weight_on_a = weight_on_a;
    /* closest, where it is defined: neither centre inside the other sphere. */
    bool slack = chosen->formulation == PP_CLOSEST && distance < fmax(radius_a, radius_b);
    answer expected = chosen->formulation == PP_MIDWAY || slack
                          ? midway(radius_a, radius_b, distance)
                          : closest(radius_a, radius_b, distance, weight_on_a);
    for (int i = 0; i < DIRECTIONS; i++) {
        /* No further out than the pair is large: rounded positions would hide the rounding of s. */
        double size = radius_a + radius_b;
        pp_pose pose_a = pose_turned(size, -size, 0, 0.8, 0.4, 0.4, 0.2),
                pose_b = pose_turned(0, 0, 0, 0.5, -0.5, 0.5, 0.5);
        walk(pose_a.position, distance, directions[i], pose_b.position);
        for (int j = 0; j < 3; j++) expected.normal[j] = directions[i][j];
        pp_contact contact;
        check_case("spheres %g and %g, distance %g, direction %d, %s", radius_a, radius_b, distance, i, chosen->name);
        if (!CHECK_STATUS(pp_contact_detect(a, &pose_a, b, &pose_b, &settings, NULL, &contact), PP_OK)) continue;
        CHECK(((contact.flags & PP_FLAG_SLACK) != 0) == slack);
        CHECK((contact.flags & PP_FLAG_NORMAL_BY_CENTRES) == 0);
        check_answer(&contact, &pose_a, &pose_b, &settings, &expected, size);
    }
    check_case(NULL);
    pp_particle_free(a);
    pp_particle_free(b);
}

static void spheres_at_every_distance(void) {
    const double radii[][2] = {{1, 1}, {1, 2}, {0.5, 0.1}, {1e-3, 2e-3}, {1000, 600}};
    /* As parts of the sum of the radii: deep, overlapping, barely, apart. */
    const double parts[] = {0.3, 0.9, 0.999, 1.001, 1.5};
    for (size_t i = 0; i < sizeof radii / sizeof radii[0]; i++) {
        for (size_t j = 0; j < sizeof parts / sizeof parts[0]; j++) {
            for (int w = 0; w < WAYS; w++) {
                one_pair(radii[i][0], radii[i][1], parts[j] * (radii[i][0] + radii[i][1]), &ways[w], 0.5);
            }
        }
    }
    for (int w = 0; w < WAYS; w++) {
        one_pair(1, 2, 2.5, &ways[w], 0.0);
        one_pair(1, 2, 2.5, &ways[w], 0.25);
        one_pair(1, 2, 2.5, &ways[w], 1.0);
    }
}

static void coincident_centres(void) {
    pp_particle *a = new_sphere(1.0), *b = new_sphere(2.0);
    pp_pose pose_a = pose_at(4, 5, 6), pose_b = pose_turned(4, 5, 6, 0.8, 0.4, 0.4, 0.2);
    const double axis[3] = {1, 0, 0};
    double expected[3];
    turn(&pose_b, axis, expected);
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        pp_contact contact;
        check_case("coincident centres, %s", ways[w].name);
        if (!CHECK_STATUS(pp_contact_detect(a, &pose_a, b, &pose_b, &settings, NULL, &contact), PP_OK)) continue;
        check_consistent(&contact, &pose_a, &pose_b, &settings);
        CHECK(contact.flags & PP_FLAG_NORMAL_BY_CENTRES);
        CHECK(((contact.flags & PP_FLAG_SLACK) != 0) == (settings.formulation == PP_CLOSEST));
        CHECK_NEAR(contact.s, 0.0, contact.gap);
        CHECK_NEAR3(contact.normal, expected, 1e-14);
        accuracy allowed = accuracy_of(settings.back_end, 3.0);
        CHECK_NEAR3(contact.point, pose_a.position, allowed.length * allowed.size);
        CHECK_NEAR(contact.overlap, 3.0, allowed.length * allowed.size);
    }
    check_case(NULL);
    pp_particle_free(a);
    pp_particle_free(b);
}

static void far_spheres_are_rejected_cheaply(void) {
    pp_particle *a = new_sphere(1.0), *b = new_sphere(2.0);
    pp_pose pose_a = pose_at(0, 0, 0), pose_b = pose_at(30, 0, 0);
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        pp_contact contact;
        settings.solve_separated = 0;
        check_case("far spheres, %s", ways[w].name);
        if (!CHECK_STATUS(pp_contact_detect(a, &pose_a, b, &pose_b, &settings, NULL, &contact), PP_OK)) continue;
        check_rejected(&contact, settings.formulation == PP_MIDWAY ? 10.0 : 28.0);
    }
    check_case(NULL);
    pp_particle_free(a);
    pp_particle_free(b);
}

/* Positions that are finite one by one, yet whose difference is not: nobody can solve that, and a
 * failed solve is neither "separated" nor an answer. */
static void overflow_is_a_failure(void) {
    pp_particle *a = new_sphere(1.0);
    pp_pose pose_a = pose_at(-1.7e308, 0, 0), pose_b = pose_at(1.7e308, 0, 0);
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        pp_contact contact;
        pp_pair_state state;
        FILL(contact);
        FILL(state);
        check_case("overflow, %s", ways[w].name);
        CHECK_STATUS(pp_contact_detect(a, &pose_a, a, &pose_b, &settings, &state, &contact), PP_SOLVER_FAILED);
        CHECK_UNTOUCHED(contact);
        CHECK_UNTOUCHED(state);
    }
    check_case(NULL);
    pp_particle_free(a);
}

void test_sphere_contact(void) {
    spheres_at_every_distance();
    coincident_centres();
    far_spheres_are_rejected_cheaply();
    overflow_is_a_failure();
}
