/* Status codes, their sentences, and the version. */
#include "check.h"
#include "tests.h"

#include <stdio.h>
#include <string.h>

/* The numbers are part of the interface: programs in other languages write them down. */
static const struct {
    pp_status code, number;
} codes[] = {
    {PP_OK, 0},
    {PP_NULL_POINTER, 1},
    {PP_BAD_POSITION, 2},
    {PP_BAD_ORIENTATION, 3},
    {PP_BAD_POINT, 4},
    {PP_UNKNOWN_FORMULATION, 5},
    {PP_UNKNOWN_BACK_END, 6},
    {PP_BAD_SETTING, 7},
    {PP_SOLVER_FAILED, 8},
    {PP_INTERNAL_ERROR, 9},
    {PP_BUFFER_TOO_SMALL, 10},
    {PP_NO_CONE_PROGRAM, 11},
    {PP_BAD_INDEX, 12},
    {PP_DEGENERATE_TRIANGLE, 13},
    {PP_BAD_TOLERANCE, 14},
    {PP_NO_DERIVATIVE, 15},
    {PP_PLANE_NOT_FINITE, 20},
    {PP_PLANE_ZERO_NORMAL, 21},
    {PP_BAD_SPHERICITY, 22},
    {PP_BAD_ROUNDING_RADIUS, 23},
    {PP_BAD_SHADOW_RADIUS, 24},
    {PP_CENTRE_OUTSIDE, 25},
    {PP_UNBOUNDED, 26},
    {PP_TOO_MANY_PLANES, 27},
    {PP_BAD_SIZE, 28},
};
enum { CODES = sizeof codes / sizeof codes[0] };

static const char unknown[] = "unknown status code";

static void every_code_has_its_own_sentence(void) {
    for (int i = 0; i < CODES; i++) {
        check_case("status %d", (int)codes[i].number);
        CHECK(codes[i].code == codes[i].number);
        const char *sentence = pp_status_message(codes[i].code);
        CHECK(sentence != NULL && sentence[0] != 0 && strlen(sentence) < PP_MESSAGE_SIZE);
        CHECK(sentence[strlen(sentence) - 1] != '.');
        CHECK(strcmp(sentence, unknown) != 0);
        CHECK(pp_status_message(codes[i].code) == sentence); /* static text */
        for (int j = 0; j < i; j++) CHECK(strcmp(sentence, pp_status_message(codes[j].code)) != 0);
    }
    check_case(NULL);
    /* What may happen, but must not be mistaken, says so. An internal error cannot be provoked
     * from outside: its sentence is all that can be tested. */
    CHECK(strstr(pp_status_message(PP_SOLVER_FAILED), "does not mean separated") != NULL);
    CHECK(strstr(pp_status_message(PP_INTERNAL_ERROR), "please report it") != NULL);
}

static void other_codes_are_unknown(void) {
    const pp_status others[] = {-1, 17, 19, 29, 33, 33, 1000, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        CHECK_TEXT(pp_status_message(others[i]), unknown);
    }
}

static void version_is_that_of_the_header(void) {
    char expected[32];
    snprintf(expected, sizeof expected, "%d.%d.%d", PP_VERSION_MAJOR, PP_VERSION_MINOR, PP_VERSION_PATCH);
    CHECK_TEXT(pp_version(), expected);
    CHECK(pp_version() == pp_version());
    CHECK(pp_abi_version() == PP_ABI_VERSION);
}

void test_status(void) {
    every_code_has_its_own_sentence();
    other_codes_are_unknown();
    version_is_that_of_the_header();
}
