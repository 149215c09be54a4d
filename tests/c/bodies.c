#include "bodies.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void cube_planes(double core, double planes[4 * CUBE_PLANES]) {
    for (int i = 0; i < CUBE_PLANES; i++) {
        for (int j = 0; j < 3; j++) planes[4 * i + j] = j == i / 2 ? (i % 2 == 0 ? 1.0 : -1.0) : 0.0;
        planes[4 * i + 3] = core;
    }
}

pp_particle *new_particle(const double *planes, size_t count, double r, double k, double shadow_radius) {
    pp_particle *particle = NULL;
    char why[PP_MESSAGE_SIZE] = "";
    if (pp_particle_new(planes, count, r, k, shadow_radius, &particle, why, sizeof why) != PP_OK) {
        printf("a particle of the tests was refused: %s\n", why);
        exit(2);
    }
    return particle;
}

pp_particle *new_sphere(double radius) {
    return new_particle(NULL, 0, 0.0, 1.0, radius);
}

pp_particle *new_cube(double core, double r, double k, double shadow_radius) {
    double planes[4 * CUBE_PLANES];
    cube_planes(core, planes);
    return new_particle(planes, CUBE_PLANES, r, k, shadow_radius);
}

pp_particle *new_pyramid(double r, double k, double shadow_radius) {
    static const double planes[] = {
        0.0, 0.0, -1.0, 0.3, /* base */
        0.8, 0.0, 0.6, 0.4,  0.0, 0.8, 0.6, 0.4, -0.8, 0.0, 0.6, 0.4, 0.0, -0.8, 0.6, 0.4,
    };
    return new_particle(planes, 5, r, k, shadow_radius);
}

pp_pose pose_at(double x, double y, double z) {
    return pose_turned(x, y, z, 1.0, 0.0, 0.0, 0.0);
}

pp_pose pose_turned(double x, double y, double z, double w, double i, double j, double k) {
    return (pp_pose){.position = {x, y, z}, .orientation = {w, i, j, k}};
}

void turn(const pp_pose *pose, const double local[3], double world[3]) {
    const double *q = pose->orientation;
    double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    double w = q[0], x = q[1], y = q[2], z = q[3];
    double rotation[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z},
    };
    for (int i = 0; i < 3; i++) world[i] = dot(rotation[i], local) / square;
}

double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void walk(const double from[3], double scale, const double along[3], double out[3]) {
    for (int i = 0; i < 3; i++) out[i] = from[i] + scale * along[i];
}

pp_settings default_settings(void) {
    pp_settings settings;
    if (pp_settings_default(&settings) != PP_OK) {
        printf("pp_settings_default failed\n");
        exit(2);
    }
    return settings;
}

double random_next(random_numbers *numbers) {
    numbers->state = numbers->state * 6364136223846793005u + 1442695040888963407u;
    return (double)(numbers->state >> 11) / 4503599627370496.0 - 1.0; /* 53 bits over 2^52 */
}
