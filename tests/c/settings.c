/* What pp_contact_detect refuses besides poses, and that a refusal leaves no trace. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>

static pp_particle *body;
static const pp_pose pose_a = {.orientation = {1, 0, 0, 0}};
static const pp_pose pose_b = {.position = {2.5, 0.25, 0.125}, .orientation = {0.8, 0.4, 0.4, 0.2}};

static void check_refused(const pp_settings *settings, pp_status expected) {
    pp_contact contact;
    pp_pair_state state;
    FILL(contact);
    FILL(state);
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, &pose_b, settings, &state, &contact), expected);
    CHECK_UNTOUCHED(contact);
    CHECK_UNTOUCHED(state);
}

static void check_accepted(const pp_settings *settings) {
    pp_contact contact;
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, &pose_b, settings, NULL, &contact), PP_OK);
}

static void defaults_are_those_of_the_header(void) {
    pp_settings settings;
    FILL(settings);
    CHECK_STATUS(pp_settings_default(&settings), PP_OK);
    CHECK(settings.formulation == PP_MIDWAY);
    CHECK(settings.back_end == PP_FAST);
    CHECK(settings.solve_separated == 0);
    CHECK(settings.reserved == 0);
    CHECK(settings.gap_tolerance == 1e-12);
    CHECK(settings.weight_on_a == 0.5);
    CHECK(settings.flat_regularisation == 1e-13);
    CHECK(settings.carry_tolerance == 0);
    CHECK_STATUS(pp_settings_default(NULL), PP_NULL_POINTER);

    /* NULL means these. */
    pp_contact with, without;
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, &pose_b, &settings, NULL, &with), PP_OK);
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, &pose_b, NULL, NULL, &without), PP_OK);
    CHECK_SAME_BYTES(&with, &without, sizeof with);
}

static void unknown_codes_are_refused(void) {
    const uint32_t codes[] = {2, 3, 255, INT32_MAX, UINT32_MAX};
    for (size_t i = 0; i < sizeof codes / sizeof codes[0]; i++) {
        pp_settings settings = default_settings();
        settings.formulation = codes[i];
        check_refused(&settings, PP_UNKNOWN_FORMULATION);
        settings = default_settings();
        settings.back_end = codes[i];
        check_refused(&settings, PP_UNKNOWN_BACK_END);
        settings = default_settings();
        settings.solve_separated = codes[i];
        check_refused(&settings, PP_BAD_SETTING);
        settings = default_settings();
        settings.reserved = codes[i];
        check_refused(&settings, PP_BAD_SETTING);
    }
    pp_settings settings = default_settings();
    settings.reserved = 1;
    check_refused(&settings, PP_BAD_SETTING);
}

/* The bounds as documented, each with the values just inside and just outside. */
static void ranges_are_checked(void) {
    static const struct {
        const char *name;
        size_t offset;
        double inside[3], outside[3];
    } ranges[] = {
        {"gap_tolerance", offsetof(pp_settings, gap_tolerance), {0.1, 1e-6, 1e-15}, {0.0, -1e-12, 0.1001}},
        {"weight_on_a", offsetof(pp_settings, weight_on_a), {0.0, 0.25, 1.0}, {-DBL_MIN, 1 + DBL_EPSILON, 2.0}},
        {"flat_regularisation",
         offsetof(pp_settings, flat_regularisation),
         {0.0, 1e-4, 0.1},
         {-DBL_MIN, 0.1001, 1.0}},
        {"carry_tolerance",
         offsetof(pp_settings, carry_tolerance),
         {0.0, 1e-9, 0.1},
         {-DBL_MIN, 0.1001, 1.0}},
    };
    const double never[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        for (int j = 0; j < 3; j++) {
            pp_settings settings = default_settings();
            double *field = (double *)((char *)&settings + ranges[i].offset);
            *field = ranges[i].inside[j];
            check_case("%s = %g", ranges[i].name, *field);
            check_accepted(&settings);
            *field = ranges[i].outside[j];
            check_case("%s = %g", ranges[i].name, *field);
            check_refused(&settings, PP_BAD_SETTING);
            *field = never[j];
            check_case("%s = %g", ranges[i].name, *field);
            check_refused(&settings, PP_BAD_SETTING);
        }
    }
    check_case(NULL);
}

static void null_is_refused(void) {
    pp_contact contact;
    pp_pair_state state;
    FILL(contact);
    FILL(state);
    CHECK_STATUS(pp_contact_detect(NULL, &pose_a, body, &pose_b, NULL, &state, &contact), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_detect(body, NULL, body, &pose_b, NULL, &state, &contact), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_detect(body, &pose_a, NULL, &pose_b, NULL, &state, &contact), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, NULL, NULL, &state, &contact), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, &pose_b, NULL, &state, NULL), PP_NULL_POINTER);
    CHECK_UNTOUCHED(contact);
    CHECK_UNTOUCHED(state);
    /* settings and state may be NULL. */
    CHECK_STATUS(pp_contact_detect(body, &pose_a, body, &pose_b, NULL, NULL, &contact), PP_OK);
}

void test_settings(void) {
    body = new_cube(1.0, 0.5, 0.3, 2.0);
    defaults_are_those_of_the_header();
    unknown_codes_are_refused();
    ranges_are_checked();
    null_is_refused();
    pp_particle_free(body);
    body = NULL;
}
