/* One pair, called again and again from its last solution: seconds a call, printed for each of the rounds. */
#define _POSIX_C_SOURCE 199309L
#include <potential_particles.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double now(void) {
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

int main(int count, char **words) {
    const double planes[6][4] = { { 1, 0, 0, 0.9 },  { -1, 0, 0, 0.9 }, { 0, 1, 0, 0.9 },
                                  { 0, -1, 0, 0.9 }, { 0, 0, 1, 0.9 },  { 0, 0, -1, 0.9 } };
    const pp_pose lower = {{0, 0, 0}, {1, 0, 0, 0}}, upper = {{0.3, 0.1, 1.9}, {1, 0.1, 0.05, 0.2}};
    const long calls = count > 1 ? atol(words[1]) : 100000, rounds = count > 2 ? atol(words[2]) : 5;
    pp_particle *cube = NULL;
    pp_pair_state state = {{0}, {0}};
    pp_settings settings;
    pp_contact contact;
    char why[PP_MESSAGE_SIZE];
    if (pp_particle_new(&planes[0][0], 6, 0.1, 0.01, 2.0, &cube, why, sizeof why) != PP_OK) {
        puts(why);
        return 1;
    }
    pp_settings_default(&settings);
    for (long round = 0; round < rounds; round++) {
        const double begin = now();
        for (long i = 0; i < calls; i++)
            if (pp_contact_detect(cube, &lower, cube, &upper, &settings, &state, &contact) != PP_OK)
                return 1;
        printf("%.9e\n", (now() - begin) / (double)calls);
    }
    pp_particle_free(cube);
    return 0;
}
