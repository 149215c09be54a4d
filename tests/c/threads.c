/* Particles shared by many threads at once: every thread gets the very bits that one alone gets. */
#define _POSIX_C_SOURCE 200809L

#include "answer.h"
#include "check.h"
#include "pairs.h"
#include "tests.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS = 8 };

/* The cone-program back end is slow, above all under valgrind: one pair in so many will do. */
enum { CONE_PROGRAM_EVERY = 8 };

/* All that one thread asks about one pair. */
typedef struct {
    pp_contact cold[WAYS], warm[WAYS];
    double area, potential[4], box[6], radius, distance;
    pp_status statuses[2 * WAYS + 5];
} findings;

typedef struct {
    const pair_set *set;
    pthread_barrier_t *start;
    int first_pair;
    findings found[PAIRS];
} worker;

static void ask(const pair_set *set, int index, findings *found) {
    const pair *p = &set->pairs[index];
    memset(found, 0, sizeof *found);
    pp_status *status = found->statuses;
    for (int w = 0; w < WAYS; w++) {
        if (ways[w].back_end == PP_CONE_PROGRAM && index % CONE_PROGRAM_EVERY != 0) continue;
        pp_settings settings = settings_for(&ways[w]);
        pp_pair_state state = {0};
        *status++ = pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, &settings, &state, &found->cold[w]);
        *status++ = pp_contact_detect(p->a, &p->pose_a, p->b, &p->pose_b, &settings, &state, &found->warm[w]);
    }
    *status++ = pp_contact_area(p->a, &p->pose_a, p->b, &p->pose_b, &found->cold[0], 1e-6, &found->area);
    *status++ = pp_particle_potential(p->a, &p->pose_a, p->pose_b.position, found->potential, found->potential + 1);
    *status++ = pp_particle_box(p->a, &p->pose_a, found->box, found->box + 3);
    *status++ = pp_particle_bounding_radius(p->b, &found->radius);
    *status++ = pp_particle_surface_distance(p->b, p->pose_a.orientation, &found->distance);
}

/* Each thread begins elsewhere, so that different threads are in different calls. */
static void *work(void *argument) {
    worker *self = argument;
    pthread_barrier_wait(self->start);
    for (int i = 0; i < PAIRS; i++) {
        int at = (self->first_pair + i) % PAIRS;
        ask(self->set, at, &self->found[at]);
    }
    return NULL;
}

void test_threads(void) {
    pair_set set;
    pairs_new(&set);
    findings *alone = malloc(PAIRS * sizeof *alone);
    worker *workers = calloc(THREADS, sizeof *workers);
    CHECK(alone != NULL && workers != NULL);
    if (alone == NULL || workers == NULL) exit(2);
    for (int i = 0; i < PAIRS; i++) {
        ask(&set, i, &alone[i]);
        for (size_t s = 0; s < sizeof alone->statuses / sizeof(pp_status); s++) {
            CHECK_STATUS(alone[i].statuses[s], PP_OK);
        }
    }

    pthread_t threads[THREADS];
    pthread_barrier_t start;
    CHECK(pthread_barrier_init(&start, NULL, THREADS) == 0);
    for (int t = 0; t < THREADS; t++) {
        workers[t].set = &set;
        workers[t].start = &start;
        workers[t].first_pair = t * PAIRS / THREADS;
        /* The others would wait for a missing one for ever. */
        if (pthread_create(&threads[t], NULL, work, &workers[t]) != 0) exit(2);
    }
    for (int t = 0; t < THREADS; t++) CHECK(pthread_join(threads[t], NULL) == 0);
    pthread_barrier_destroy(&start);

    for (int t = 0; t < THREADS; t++) {
        for (int i = 0; i < PAIRS; i++) {
            check_case("thread %d, pair %d", t, i);
            CHECK_SAME_BYTES(&workers[t].found[i], &alone[i], sizeof alone[i]);
        }
    }
    check_case(NULL);
    free(alone);
    free(workers);
    pairs_free(&set);
}
