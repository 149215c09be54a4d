/* The four ways to solve. */
#ifndef ANSWER_H
#define ANSWER_H

#include "potential_particles.h"

/* The four ways to solve, in words for messages. */
typedef struct {
    uint32_t formulation, back_end;
    const char *name;
} way;
enum { WAYS = 4 };
extern const way ways[WAYS];
/* Defaults, but this way and solving to the end. */
pp_settings settings_for(const way *chosen);

#endif
