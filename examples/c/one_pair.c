/* SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * The contact of two cubes with rounded edges, one turned and lying on the other.
 *
 *     cc one_pair.c $(pkg-config --cflags --libs potential-particles) -o one_pair
 */
#include <potential_particles.h>
#include <stdio.h>

int main(void) {
    /* Faces at 1: offsets are reduced by the rounding radius, which brings the faces back out. */
    const double r = 0.1, k = 0.0, R = 1.8, d = 1.0 - r;
    const double planes[6][4] = {{1, 0, 0, d}, {-1, 0, 0, d}, {0, 1, 0, d}, {0, -1, 0, d}, {0, 0, 1, d}, {0, 0, -1, d}};

    char why[PP_MESSAGE_SIZE];
    pp_particle *cube;
    if (pp_abi_version() != PP_ABI_VERSION) {
        fprintf(stderr, "one_pair: the library has interface %u, this program was compiled for %u\n",
                (unsigned)pp_abi_version(), (unsigned)PP_ABI_VERSION);
        return 1;
    }
    if (pp_particle_new(&planes[0][0], 6, r, k, R, &cube, why, sizeof why) != PP_OK) {
        fprintf(stderr, "one_pair: %s\n", why);
        return 1;
    }

    /* World = rotation(w, x, y, z) * local + position; the length of the quaternion does not matter. */
    const pp_pose lower = {{0, 0, 0}, {1, 0, 0, 0}}, upper = {{0.3, 0, 1.95}, {1, 0, 0, 0.2}};
    pp_pair_state state = {0}; /* one for each pair: the next call starts from the last solution */
    pp_contact contact;
    const pp_status status = pp_contact_detect(cube, &lower, cube, &upper, NULL, &state, &contact);
    if (status != PP_OK) { /* never the same as "apart" */
        fprintf(stderr, "one_pair: %s\n", pp_status_message(status));
        pp_particle_free(cube);
        return 1;
    }
    if (contact.kind == PP_OVERLAPPING) {
        double area;
        printf("overlap %g, s = %.12g within %.0e\n", contact.overlap, contact.s, contact.gap);
        printf("normal  %g %g %g, from the lower cube to the upper\n", contact.normal[0], contact.normal[1],
               contact.normal[2]);
        printf("point   %g %g %g\n", contact.point[0], contact.point[1], contact.point[2]);
        if (pp_contact_area(cube, &lower, cube, &upper, &contact, 1e-6, &area) == PP_OK)
            printf("area    %g\n", area);
    } else {
        printf("apart by at least %g\n", contact.distance);
    }
    pp_particle_free(cube);
    return 0;
}
