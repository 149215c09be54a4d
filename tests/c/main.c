/* Every function and every status of potential_particles.h, as a C caller meets them; with the argument
 * "threads", only what many threads do at once, with "batch", only the threads of the library. */
#include "check.h"
#include "tests.h"

#include <stdio.h>
#include <string.h>

int main(int count, char **arguments) {
    /* In order with what a library writes to stderr, should it panic. */
    setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
    if (count > 1 && strcmp(arguments[1], "threads") == 0) {
        test_threads();
        return check_report();
    }
    if (count > 1 && strcmp(arguments[1], "batch") == 0) {
        test_batch();
        return check_report();
    }
    test_layout();
    /* With other structs than the library has, nothing below is safe. */
    if (check_has_failed()) return check_report();
    test_status();
    test_particle();
    test_query();
    test_surface();
    test_definition();
    test_pose();
    test_settings();
    test_area();
    test_closest();
    test_pair_state();
    test_flat();
    test_hostile();
    test_threads();
    test_batch();
    test_in_plane();
    test_patch();
    test_derivatives();
    test_builder();
    return check_report();
}
