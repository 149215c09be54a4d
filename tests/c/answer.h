/* A contact as it ought to be, and the comparison with what the library gave. */
#ifndef ANSWER_H
#define ANSWER_H

#include "potential_particles.h"

/* Closed forms, by distance along the line from A to B; NaN where the contact must hold NaN. */
typedef struct {
    double s, s_b;
    double weight; /* of B; NaN: not told by the closed form, not compared */
    double on_a, on_b, point; /* from the centre of A, along the normal */
    double normal[3];
} answer;

/* How far an answer may be off: lengths relative to `size`, s beyond its own gap. */
typedef struct {
    double s, length, direction, size;
} accuracy;
accuracy accuracy_of(uint32_t back_end, double size);

/* What holds for every solved contact, whatever the pair. */
void check_consistent(const pp_contact *contact, const pp_pose *pose_a, const pp_pose *pose_b,
                      const pp_settings *settings);

/* check_consistent, and every field against `expected`. */
void check_answer(const pp_contact *contact, const pp_pose *pose_a, const pp_pose *pose_b,
                  const pp_settings *settings, const answer *expected, double size);

/* A pair proved apart without a solution: s is a lower bound, 1 or more, the rest is NaN. */
void check_rejected(const pp_contact *contact, double s);

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
