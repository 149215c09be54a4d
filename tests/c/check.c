#include "check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static unsigned passed, failed;
static char current_case[256];

void check_case(const char *format, ...) {
    current_case[0] = 0;
    if (format == NULL) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(current_case, sizeof current_case, format, arguments);
    va_end(arguments);
}

/* Counts; on failure begins the line that the caller ends. */
static bool count(bool holds, const char *what, const char *file, int line) {
    if (holds) {
        passed++;
        return true;
    }
    failed++;
    printf("%s:%d: %s%s%s: ", file, line, current_case, current_case[0] ? ": " : "", what);
    return false;
}

void check_that(bool holds, const char *what, const char *file, int line) {
    if (!count(holds, what, file, line)) printf("does not hold\n");
}

bool check_status(pp_status got, pp_status expected, const char *what, const char *file, int line) {
    if (!count(got == expected, what, file, line)) {
        printf("status %d (%s), expected %d (%s)\n", (int)got, pp_status_message(got), (int)expected,
               pp_status_message(expected));
    }
    return got == expected;
}

void check_text(const char *got, const char *expected, const char *what, const char *file, int line) {
    if (!count(strcmp(got, expected) == 0, what, file, line)) printf("\"%s\", expected \"%s\"\n", got, expected);
}

void check_near(double got, double expected, double tolerance, const char *what, const char *file, int line) {
    double error = fabs(got - expected);
    if (!count(error <= tolerance, what, file, line)) {
        printf("%.17g, expected %.17g, error %.3g > %.3g\n", got, expected, error, tolerance);
    }
}

void check_near3(const double got[3], const double expected[3], double tolerance, const char *what,
                 const char *file, int line) {
    bool near = true;
    for (int i = 0; i < 3; i++) near = near && fabs(got[i] - expected[i]) <= tolerance;
    if (!count(near, what, file, line)) {
        printf("(%.17g, %.17g, %.17g), expected (%.17g, %.17g, %.17g) within %.3g\n", got[0], got[1], got[2],
               expected[0], expected[1], expected[2], tolerance);
    }
}

void check_near2(const double got[2], double x, double y, double tolerance, const char *what, const char *file,
                 int line) {
    bool near = fabs(got[0] - x) <= tolerance && fabs(got[1] - y) <= tolerance;
    if (!count(near, what, file, line)) {
        printf("(%.17g, %.17g), expected (%.17g, %.17g) within %.3g\n", got[0], got[1], x, y, tolerance);
    }
}

void check_same_bytes(const void *got, const void *expected, size_t size, const char *what,
                      const char *file, int line) {
    if (!count(memcmp(got, expected, size) == 0, what, file, line)) printf("bytes differ\n");
}

void check_fill(void *object, size_t size) {
    memset(object, PATTERN, size);
}

void check_untouched(const void *object, size_t size, const char *what, const char *file, int line) {
    const unsigned char *bytes = object;
    size_t at = 0;
    while (at < size && bytes[at] == PATTERN) at++;
    if (!count(at == size, what, file, line)) printf("was written at byte %zu by a call that failed\n", at);
}

bool check_has_failed(void) {
    return failed > 0;
}

int check_report(void) {
    printf("%u passed, %u failed\n", passed, failed);
    return failed == 0 ? 0 : 1;
}
