/* Particles and poses that the tests share. */
#ifndef BODIES_H
#define BODIES_H

#include "potential_particles.h"

#define PI 3.14159265358979323846

/* Six planes x, y, z = +-core. */
#define CUBE_PLANES 6
void cube_planes(double core, double planes[4 * CUBE_PLANES]);

/* Each ends the program when the library refuses: nothing could be tested then. */
pp_particle *new_particle(const double *planes, size_t count, double r, double k, double shadow_radius);
pp_particle *new_sphere(double radius);
pp_particle *new_cube(double core, double r, double k, double shadow_radius);
/* Five planes: a base and four sides, the centre inside. */
pp_particle *new_pyramid(double r, double k, double shadow_radius);

pp_pose pose_at(double x, double y, double z);
pp_pose pose_turned(double x, double y, double z, double w, double i, double j, double k);
/* Local to world, without the position. */
void turn(const pp_pose *pose, const double local[3], double world[3]);

double dot(const double a[3], const double b[3]);
/* out = from + scale * along. */
void walk(const double from[3], double scale, const double along[3], double out[3]);

pp_settings default_settings(void);

/* A fixed sequence of numbers in [-1, 1), the same on every platform. */
typedef struct {
    uint64_t state;
} random_numbers;
double random_next(random_numbers *numbers);

#endif
