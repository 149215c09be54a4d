/* Counted checks: a failed one prints where it stands and what it saw, and the run goes on.
 *
 * Not thread-safe: threads collect results, and the main thread checks them. */
#ifndef CHECK_H
#define CHECK_H

#include "potential_particles.h"
#include <stdbool.h>
#include <stddef.h>

/* What every byte of an output holds before a call that must not write it. */
#define PATTERN 0xA5

#define CHECK(condition) check_that((condition), #condition, __FILE__, __LINE__)
/* Has the value whether it held, for checks that make sense only then. */
#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)
#define CHECK_TEXT(value, expected) check_text((value), (expected), #value, __FILE__, __LINE__)
/* |value - expected| <= tolerance; NaN fails. */
#define CHECK_NEAR(value, expected, tolerance) \
    check_near((value), (expected), (tolerance), #value, __FILE__, __LINE__)
#define CHECK_NEAR3(value, expected, tolerance) \
    check_near3((value), (expected), (tolerance), #value, __FILE__, __LINE__)
/* Of two coordinates. */
#define CHECK_NEAR2(value, x, y, tolerance) \
    check_near2((value), (x), (y), (tolerance), #value, __FILE__, __LINE__)
#define CHECK_SAME_BYTES(value, expected, size) \
    check_same_bytes((value), (expected), (size), #value, __FILE__, __LINE__)

#define FILL(object) check_fill(&(object), sizeof(object))
#define CHECK_UNTOUCHED(object) check_untouched(&(object), sizeof(object), #object, __FILE__, __LINE__)

void check_that(bool holds, const char *what, const char *file, int line);
bool check_status(pp_status got, pp_status expected, const char *what, const char *file, int line);
void check_text(const char *got, const char *expected, const char *what, const char *file, int line);
void check_near(double got, double expected, double tolerance, const char *what, const char *file, int line);
void check_near3(const double got[3], const double expected[3], double tolerance, const char *what,
                 const char *file, int line);
void check_near2(const double got[2], double x, double y, double tolerance, const char *what, const char *file,
                 int line);
void check_same_bytes(const void *got, const void *expected, size_t size, const char *what,
                      const char *file, int line);
void check_fill(void *object, size_t size);
void check_untouched(const void *object, size_t size, const char *what, const char *file, int line);

/* Says in what case the checks that follow stand (printed with a failure); NULL ends it. */
void check_case(const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 1, 2)))
#endif
    ;

/* Whether a check has failed so far. */
bool check_has_failed(void);

/* Prints "N passed, N failed"; the exit code of the program. */
int check_report(void);

#endif
