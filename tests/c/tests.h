/* The parts of the harness, in the order in which they run; CMakeLists.txt reads them here. Each is a function
 * test_NAME, in the file of its name. */
#ifndef TESTS_H
#define TESTS_H

#define PARTS(PART) \
    PART(layout) \
    PART(status) \
    PART(particle) \
    PART(query) \
    PART(surface) \
    PART(definition) \
    PART(pose) \
    PART(settings) \
    PART(area) \
    PART(closest) \
    PART(pair_state) \
    PART(flat) \
    PART(hostile) \
    PART(threads) \
    PART(batch) \
    PART(in_plane) \
    PART(patch) \
    PART(derivatives) \
    PART(builder)

#define DECLARED(name) void test_##name(void);
PARTS(DECLARED)
#undef DECLARED

#endif
