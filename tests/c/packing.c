/* pp_pack: bodies arrive as they find their places, until there are enough or the caller has enough. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

enum { MOST = 64 };

typedef struct {
    pp_placement bodies[MOST];
    size_t count, calls, enough;
} packed;

static int32_t receive(void *context, const pp_placement *placements, size_t count) {
    packed *all = context;
    all->calls++;
    for (size_t i = 0; i < count && all->count < MOST; i++) all->bodies[all->count++] = placements[i];
    return all->count >= all->enough;
}

static pp_packing box_of_balls(uint64_t number) {
    pp_packing how = {0};
    how.container = PP_BOX;
    how.arrangement = PP_SETTLED;
    how.shares = PP_BY_NUMBER;
    how.threads = 2;
    for (int axis = 0; axis < 3; axis++) how.upper[axis] = 4;
    how.seed = 1;
    how.number = number;
    return how;
}

static double distance(const pp_placement *a, const pp_placement *b) {
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) sum += pow(a->pose.position[axis] - b->pose.position[axis], 2);
    return sqrt(sum);
}

static void balls_lie_apart_in_the_container(uint32_t container) {
    const pp_particle *shapes[] = {new_sphere(0.5)};
    const double sizes[][2] = {{0.8, 0.5}, {1.0, 0.5}};
    pp_packing how = box_of_balls(24);
    how.container = container;
    packed all = {.enough = MOST};
    CHECK_STATUS(pp_pack(shapes, 1, sizes[0], 2, &how, receive, &all, NULL, 0), PP_OK);
    CHECK(all.count == 24 && all.calls > 1);
    int large = 0;
    for (size_t i = 0; i < all.count; i++) {
        const pp_placement *a = &all.bodies[i];
        const double radius = 0.5 * a->scale;
        CHECK(a->shape == 0 && a->reserved == 0);
        large += a->scale > 0.9;
        for (int axis = 0; axis < 3; axis++) {
            CHECK(a->pose.position[axis] - radius >= 0 && a->pose.position[axis] + radius <= 4);
        }
        if (container == PP_CYLINDER) {
            CHECK(hypot(a->pose.position[0] - 2, a->pose.position[1] - 2) + radius <= 2);
        }
        for (size_t j = 0; j < i; j++) CHECK(distance(a, &all.bodies[j]) > radius + 0.5 * all.bodies[j].scale);
    }
    CHECK(large >= 11 && large <= 13);
    pp_particle_free((pp_particle *)shapes[0]);
}

static void the_caller_may_end_it(void) {
    const pp_particle *shapes[] = {new_cube(0.4, 0.1, 0.05, 0.9)};
    const pp_packing how = box_of_balls(0);
    packed some = {.enough = 7}, all = {.enough = MOST};
    CHECK_STATUS(pp_pack(shapes, 1, NULL, 0, &how, receive, &some, NULL, 0), PP_OK);
    CHECK_STATUS(pp_pack(shapes, 1, NULL, 0, &how, receive, &all, NULL, 0), PP_OK);
    CHECK(some.count >= 7 && some.count < all.count && all.count < MOST);
    CHECK_SAME_BYTES(some.bodies, all.bodies, some.count * sizeof(pp_placement));
    pp_particle_free((pp_particle *)shapes[0]);
}

static void bad_arguments_hand_nothing_over(void) {
    const pp_particle *shapes[] = {new_sphere(0.5)}, *none[] = {NULL};
    const double bad_sizes[] = {-1, 1}, sizes[] = {1, 1};
    const pp_packing good = box_of_balls(5);
    packed all = {.enough = MOST};
    char why[PP_MESSAGE_SIZE];
#define PACK(shapes, count, sizes, rows, how, placed) \
    pp_pack(shapes, count, sizes, rows, how, placed, &all, why, sizeof why)
    CHECK_STATUS(PACK(NULL, 1, NULL, 0, &good, receive), PP_NULL_POINTER);
    CHECK_TEXT(why, "shapes must not be NULL");
    CHECK_STATUS(PACK(none, 1, NULL, 0, &good, receive), PP_NULL_POINTER);
    CHECK_TEXT(why, "each of shapes must not be NULL");
    CHECK_STATUS(PACK(shapes, 1, NULL, 1, &good, receive), PP_NULL_POINTER);
    CHECK_STATUS(PACK(shapes, 1, NULL, 0, NULL, receive), PP_NULL_POINTER);
    CHECK_STATUS(PACK(shapes, 1, NULL, 0, &good, NULL), PP_NULL_POINTER);
    CHECK_STATUS(PACK(NULL, 0, NULL, 0, &good, receive), PP_BAD_PACKING);
    CHECK(strstr(why, "no shape") != NULL);
    CHECK_STATUS(PACK(shapes, 1, bad_sizes, 1, &good, receive), PP_BAD_PACKING);
    CHECK(strstr(why, "size -1.0 (entry 0)") != NULL);
    pp_packing how = good;
    how.container = 7;
    CHECK_STATUS(PACK(shapes, 1, sizes, 1, &how, receive), PP_BAD_PACKING);
    CHECK(strstr(why, "container 7 is unknown") != NULL);
    how = good;
    how.arrangement = 7;
    CHECK_STATUS(PACK(shapes, 1, sizes, 1, &how, receive), PP_BAD_PACKING);
    how = good;
    how.shares = 7;
    CHECK_STATUS(PACK(shapes, 1, sizes, 1, &how, receive), PP_BAD_PACKING);
    how = good;
    how.upper[1] = NAN;
    CHECK_STATUS(PACK(shapes, 1, sizes, 1, &how, receive), PP_BAD_PACKING);
    CHECK(strstr(why, "NaN") != NULL);
    how = good;
    how.margin = INFINITY;
    CHECK_STATUS(PACK(shapes, 1, sizes, 1, &how, receive), PP_BAD_PACKING);
    how = good;
    how.arrangement = PP_SCATTERED;
    how.number = 0;
    CHECK_STATUS(PACK(shapes, 1, sizes, 1, &how, receive), PP_BAD_PACKING);
    CHECK(all.count == 0 && all.calls == 0);
    CHECK_STATUS(PACK(shapes, SIZE_MAX, sizes, 1, &good, receive), PP_BAD_INDEX);
    CHECK(strstr(why, pp_status_message(PP_BAD_INDEX)) != NULL);
#undef PACK
    pp_particle_free((pp_particle *)shapes[0]);
}

/* No memory is asked for that the container could not use. */
static void more_bodies_than_fit(void) {
    const pp_particle *shapes[] = {new_sphere(0.5)};
    const uint64_t numbers[] = {1000000000000, UINT64_MAX};
    for (int i = 0; i < 2; i++) {
        pp_packing how = box_of_balls(numbers[i]);
        how.arrangement = PP_SCATTERED;
        packed all = {.enough = MOST};
        CHECK_STATUS(pp_pack(shapes, 1, NULL, 0, &how, receive, &all, NULL, 0), PP_OK);
        CHECK(all.count >= 16 && all.count < MOST);
    }
    pp_particle_free((pp_particle *)shapes[0]);
}

void test_packing(void) {
    more_bodies_than_fit();
    balls_lie_apart_in_the_container(PP_BOX);
    balls_lie_apart_in_the_container(PP_CYLINDER);
    the_caller_may_end_it();
    bad_arguments_hand_nothing_over();
}
