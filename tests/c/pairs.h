/* Pairs without any symmetry, the same in every run: for comparisons of the library with itself. */
#ifndef PAIRS_H
#define PAIRS_H

#include "bodies.h"

typedef struct {
    const pp_particle *a, *b;
    pp_pose pose_a, pose_b;
} pair;

enum { PAIRS = 48 };

/* The particles are shared by all pairs; release them together. */
typedef struct {
    pp_particle *particles[5];
    pair pairs[PAIRS];
} pair_set;

void pairs_new(pair_set *set);
void pairs_free(pair_set *set);

#endif
