/* Every function and every status of potential_particles.h, as a C caller meets them; with arguments, only the parts
 * that they name. */
#include "check.h"
#include "tests.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define ENTRY(name) {#name, test_##name},
static const struct {
    const char *name;
    void (*run)(void);
} parts[] = {PARTS(ENTRY)};
static const int count_of_parts = sizeof parts / sizeof *parts;

static bool run(const char *name) {
    for (int i = 0; i < count_of_parts; i++) {
        if (strcmp(parts[i].name, name) != 0) continue;
        parts[i].run();
        return true;
    }
    fprintf(stderr, "%s: there is no such part\n", name);
    return false;
}

int main(int count, char **arguments) {
    /* In order with what a library writes to stderr, should it panic. */
    setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
    for (int i = 1; i < count; i++) {
        if (!run(arguments[i])) return 2;
    }
    for (int i = 0; count == 1 && i < count_of_parts; i++) {
        parts[i].run();
        /* With other structs than the library has, nothing after the layout is safe. */
        if (i == 0 && check_has_failed()) break;
    }
    return check_report();
}
