/* Contact areas with a closed form, and what pp_contact_area refuses besides poses. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>

static const double tolerances[] = {1e-2, 1e-4, 1e-6, 1e-9};
enum { TOLERANCES = sizeof tolerances / sizeof tolerances[0] };

/* Detects the contact by default settings, and compares its area at every tolerance. */
static void check_area(const pp_particle *a, const pp_pose *pose_a, const pp_particle *b, const pp_pose *pose_b,
                       double expected) {
    pp_contact contact;
    CHECK_STATUS(pp_contact_detect(a, pose_a, b, pose_b, NULL, NULL, &contact), PP_OK);
    for (int i = 0; i < TOLERANCES; i++) {
        double area = NAN;
        CHECK_STATUS(pp_contact_area(a, pose_a, b, pose_b, &contact, tolerances[i], &area), PP_OK);
        CHECK_NEAR(area, expected, (tolerances[i] + 1e-10) * expected);
    }
}

/* Through the midway point both spheres show concentric discs; the smaller one is the contact. */
static void discs_of_spheres(void) {
    const double radius_a = 1.0, radius_b = 2.0;
    pp_particle *a = new_sphere(radius_a), *b = new_sphere(radius_b);
    const double parts[] = {0.5, 0.9, 0.9999};
    for (int i = 0; i < 3; i++) {
        double t = parts[i];
        pp_pose pose_a = pose_at(-1, 2, 3), pose_b = pose_at(-1, 2, 3 + t * (radius_a + radius_b));
        check_case("spheres at %g of touching", t);
        check_area(a, &pose_a, b, &pose_b, PI * radius_a * radius_a * (1 - t) * (1 + t));
    }
    pp_pose pose_a = pose_at(0, 0, 0), pose_b = pose_at(0, 4, 0);
    check_case("separated spheres");
    check_area(a, &pose_a, b, &pose_b, 0.0);
    check_case(NULL);
    pp_particle_free(a);
    pp_particle_free(b);
}

static void null_is_refused(void) {
    pp_particle *sphere = new_sphere(1.0);
    pp_pose pose_a = pose_at(0, 0, 0), pose_b = pose_at(1.5, 0, 0);
    pp_contact contact;
    double area;
    CHECK_STATUS(pp_contact_detect(sphere, &pose_a, sphere, &pose_b, NULL, NULL, &contact), PP_OK);
    FILL(area);
    CHECK_STATUS(pp_contact_area(NULL, &pose_a, sphere, &pose_b, &contact, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_area(sphere, NULL, sphere, &pose_b, &contact, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, NULL, &pose_b, &contact, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, NULL, &contact, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, NULL, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, &contact, 1e-6, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(area);
    pp_particle_free(sphere);
}

static void tolerance_and_contact_are_checked(void) {
    pp_particle *sphere = new_sphere(1.0);
    pp_pose pose_a = pose_at(0, 0, 0), pose_b = pose_at(1.5, 0, 0);
    pp_contact contact;
    double area;
    CHECK_STATUS(pp_contact_detect(sphere, &pose_a, sphere, &pose_b, NULL, NULL, &contact), PP_OK);
    FILL(area);
    const double bad[] = {NAN, INFINITY, -INFINITY, 0.0, -1e-6, 0.99e-12, 0.1001};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        check_case("relative_tolerance = %g", bad[i]);
        CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, &contact, bad[i], &area), PP_BAD_SETTING);
    }
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, &contact, 0.1, &area), PP_OK);
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, &contact, 1e-12, &area), PP_OK);

    /* The cut is where the branches end, across the normal. */
    const double not_finite[] = {NAN, INFINITY, -INFINITY};
    FILL(area);
    for (int value = 0; value < 3; value++) {
        for (int j = 0; j < 3; j++) {
            pp_contact spoilt[3] = {contact, contact, contact};
            spoilt[0].normal[j] = not_finite[value];
            spoilt[1].branch_a[j] = not_finite[value];
            spoilt[2].branch_b[j] = not_finite[value];
            for (int field = 0; field < 3; field++) {
                check_case("field %d, component %d = %g", field, j, not_finite[value]);
                CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, &spoilt[field], 1e-6, &area),
                             PP_BAD_POINT);
            }
        }
    }
    check_case("normal without length");
    pp_contact flat = contact;
    flat.normal[0] = flat.normal[1] = flat.normal[2] = 0.0;
    CHECK_STATUS(pp_contact_area(sphere, &pose_a, sphere, &pose_b, &flat, 1e-6, &area), PP_BAD_POINT);
    check_case(NULL);
    CHECK_UNTOUCHED(area);
    pp_particle_free(sphere);
}

void test_area(void) {
    discs_of_spheres();
    null_is_refused();
    tolerance_and_contact_are_checked();
}
