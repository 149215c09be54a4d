#include "pairs.h"

enum { PARTICLES = sizeof((pair_set *)0)->particles / sizeof(pp_particle *) };

/* Distances that leave some pairs deep in each other, many near contact, and some apart. */
void pairs_new(pair_set *set) {
    set->particles[0] = new_pyramid(0.1, 0.2, 1.0);
    set->particles[1] = new_pyramid(0.05, 0.02, 1.0);
    set->particles[2] = new_cube(0.5, 0.1, 0.3, 1.0);
    set->particles[3] = new_cube(0.3, 0.2, 0.7, 0.8);
    set->particles[4] = new_sphere(0.6);
    random_numbers numbers = {20231};
    for (int i = 0; i < PAIRS; i++) {
        pair *p = &set->pairs[i];
        p->a = set->particles[i % PARTICLES];
        p->b = set->particles[(i / PARTICLES + i) % PARTICLES];
        pp_pose *poses[2] = {&p->pose_a, &p->pose_b};
        for (int body = 0; body < 2; body++) {
            for (int j = 0; j < 3; j++) poses[body]->position[j] = (body == 0 ? 5.0 : 0.9) * random_next(&numbers);
            for (int j = 0; j < 4; j++) poses[body]->orientation[j] = random_next(&numbers);
        }
        walk(p->pose_b.position, 1.0, p->pose_a.position, p->pose_b.position);
    }
}

void pairs_free(pair_set *set) {
    for (int i = 0; i < PARTICLES; i++) pp_particle_free(set->particles[i]);
}
