/* Two cubes face to face: by symmetry their contact lies on the line of centres, where the
 * potential is a quadratic of one variable, for every k from polyhedron to sphere. */
#include "answer.h"
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>

static const double core = 1.0, r = 0.25, shadow_radius = 2.0;

/* S at a distance x >= 0 from the centre, across a face. */
static double potential(double k, double x) {
    double beyond = fmax(x - core, 0.0) / r, out = x / shadow_radius;
    return (1 - k) * beyond * beyond + k * out * out;
}

/* Where S = 1 across a face. */
static double surface(double k) {
    if (k == 1.0) return shadow_radius;
    if (k == 0.0) return core + r;
    double a = (1 - k) / (r * r) + k / (shadow_radius * shadow_radius), b = (1 - k) / (r * r) * core;
    double c = (1 - k) / (r * r) * core * core - 1;
    return (b + sqrt(b * b - a * c)) / a; /* a x^2 - 2 b x + c = 0, the larger root */
}

static void one_pair(double k, double distance, const way *chosen) {
    pp_particle *cube = new_cube(core, r, k, shadow_radius);
    pp_settings settings = settings_for(chosen);
    /* Any point of two exactly flat faces is as good as another, and the tilt of a rounded rotation
     * chooses among them; the second rotation, which permutes the axes, is exact. */
    pp_pose pose_a = k > 0 ? pose_turned(-1, 2, 3, 0.8, 0.4, 0.4, 0.2) : pose_turned(-1, 2, 3, 0.5, 0.5, 0.5, 0.5);
    pp_pose pose_b = pose_a;
    const double axis[3] = {0, 1, 0};
    double half = surface(k);
    bool midway = chosen->formulation == PP_MIDWAY;
    answer expected = {.s = sqrt(potential(k, midway ? distance / 2 : distance - half)),
                       .weight = midway ? 0.5 : NAN,
                       .on_a = half,
                       .on_b = distance - half,
                       .point = distance / 2};
    expected.s_b = midway ? NAN : expected.s;
    turn(&pose_a, axis, expected.normal);
    walk(pose_a.position, distance, expected.normal, pose_b.position);
    pp_contact contact;
    check_case("cubes with k = %g, distance %g, %s", k, distance, chosen->name);
    if (CHECK_STATUS(pp_contact_detect(cube, &pose_a, cube, &pose_b, &settings, NULL, &contact), PP_OK)) {
        CHECK((contact.flags & (PP_FLAG_SLACK | PP_FLAG_NORMAL_BY_CENTRES)) == 0);
        check_answer(&contact, &pose_a, &pose_b, &settings, &expected, 2 * half);
    }
    check_case(NULL);
    pp_particle_free(cube);
}

static void cubes_from_polyhedron_to_sphere(void) {
    const double sphericities[] = {0.0, 1e-6, 1e-3, 0.1, 0.5, 0.9, 1.0};
    const double parts[] = {0.95, 0.999, 1.001, 1.2};
    for (size_t i = 0; i < sizeof sphericities / sizeof sphericities[0]; i++) {
        double k = sphericities[i];
        for (size_t j = 0; j < sizeof parts / sizeof parts[0]; j++) {
            for (int w = 0; w < WAYS; w++) one_pair(k, parts[j] * 2 * surface(k), &ways[w]);
        }
    }
}

/* With k = 0 the potential is flat inside the core. Midway lies in both cores, where both gradients
 * vanish, and the line of centres gives the normal; the points of closest lie on the surfaces. */
static void overlapping_cores(void) {
    pp_particle *cube = new_cube(core, r, 0.0, 0.0);
    pp_pose pose_a = pose_turned(-1, 2, 3, 0.8, 0.4, 0.4, 0.2), pose_b = pose_a;
    const double axis[3] = {0, 1, 0};
    double normal[3], distance = 1.5 * core;
    turn(&pose_a, axis, normal);
    walk(pose_a.position, distance, normal, pose_b.position);
    for (int w = 0; w < WAYS; w++) {
        pp_settings settings = settings_for(&ways[w]);
        accuracy allowed = accuracy_of(settings.back_end, 2 * (core + r));
        pp_contact contact;
        check_case("overlapping cores, %s", ways[w].name);
        if (!CHECK_STATUS(pp_contact_detect(cube, &pose_a, cube, &pose_b, &settings, NULL, &contact), PP_OK)) {
            continue;
        }
        check_consistent(&contact, &pose_a, &pose_b, &settings);
        /* The regularised gradients point along the line of centres: no fallback is needed. */
        CHECK((contact.flags & PP_FLAG_NORMAL_BY_CENTRES) == 0);
        CHECK_NEAR(contact.s, 0.0, contact.gap);
        CHECK_NEAR3(contact.normal, normal, allowed.direction);
        CHECK_NEAR(contact.overlap, 2 * (core + r) - distance, allowed.length * allowed.size);
    }
    check_case(NULL);
    pp_particle_free(cube);
}

void test_cube_contact(void) {
    cubes_from_polyhedron_to_sphere();
    overlapping_cores();
}
