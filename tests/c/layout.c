/* The structs lie in memory as other languages, which cannot read the header, write them down. */
#include "check.h"
#include "tests.h"
#include <stdio.h>
#include <string.h>

/* The library was compiled with the same structs as this program. */
#define SIZE(name) CHECK(pp_struct_size(#name) == sizeof(name))

static void sizes_are_those_of_the_library(void) {
    SIZE(pp_pose); SIZE(pp_settings); SIZE(pp_pair_state);
    SIZE(pp_contact); SIZE(pp_closest); SIZE(pp_mass_properties);
    SIZE(pp_flat_contact);
    SIZE(pp_patch); SIZE(pp_patch_point);
    SIZE(pp_patch_state);
    SIZE(pp_derivatives); SIZE(pp_contact_weights);
    SIZE(pp_shape_gradient); SIZE(pp_pose_gradient); SIZE(pp_patch_derivatives);
    SIZE(pp_built);
    CHECK(pp_struct_size("pp_particle") == 0 && pp_struct_size("") == 0 && pp_struct_size(NULL) == 0);
}

/* Reads the rows of fields: each begins where the one before ends, and the last ends with the struct. */
static void fields_fill(const char *name, size_t size) {
    const char *row = pp_struct_fields(name);
    char field[64], kind;
    size_t width, count, place, end = 0;
    int read;
    CHECK(row != NULL);
    for (; row && *row; row += read) {
        read = 0;
        if (sscanf(row, "%63s %c%zu %zu %zu\n%n", field, &kind, &width, &count, &place, &read) != 5 || read == 0) break;
        CHECK(place == end);
        end = place + width * count;
    }
    CHECK(row && *row == 0);
    CHECK(end == size);
}

static void fields_are_those_of_the_library(void) {
    fields_fill("pp_contact", sizeof(pp_contact));
    fields_fill("pp_closest", sizeof(pp_closest));
    fields_fill("pp_flat_contact", sizeof(pp_flat_contact));
    fields_fill("pp_settings", sizeof(pp_settings));
    char row[64];
    snprintf(row, sizeof row, "\nnormal f8 3 %zu\n", offsetof(pp_contact, normal));
    CHECK(strstr(pp_struct_fields("pp_contact"), row) != NULL);
    CHECK(pp_struct_fields("pp_pose") == NULL && pp_struct_fields(NULL) == NULL);
}

void test_layout(void) {
    sizes_are_those_of_the_library();
    fields_are_those_of_the_library();
    CHECK(sizeof(pp_status) == 4);
    CHECK((pp_status)-1 < 0);

    CHECK(sizeof(pp_pose) == 56);
    CHECK(offsetof(pp_pose, position) == 0);
    CHECK(offsetof(pp_pose, orientation) == 24);

    CHECK(sizeof(pp_pair_state) == 384);
    CHECK(offsetof(pp_pair_state, solution) == 0);
    CHECK(offsetof(pp_pair_state, last_contact) == 64);

    CHECK(sizeof(pp_derivatives) == 8 + 8 * 12 * 15);
    CHECK(offsetof(pp_derivatives, flags) == 0);
    CHECK(offsetof(pp_derivatives, s) == 8);
    CHECK(offsetof(pp_derivatives, s_b) == 104);
    CHECK(offsetof(pp_derivatives, overlap) == 200);
    CHECK(offsetof(pp_derivatives, normal) == 296);
    CHECK(offsetof(pp_derivatives, point) == 584);
    CHECK(offsetof(pp_derivatives, point_on_a) == 872);
    CHECK(offsetof(pp_derivatives, point_on_b) == 1160);

    CHECK(sizeof(pp_contact_weights) == 120);
    CHECK(offsetof(pp_contact_weights, overlap) == 16);
    CHECK(offsetof(pp_contact_weights, normal) == 24);
    CHECK(offsetof(pp_contact_weights, point) == 48);
    CHECK(offsetof(pp_contact_weights, point_on_a) == 72);
    CHECK(offsetof(pp_contact_weights, point_on_b) == 96);
    CHECK(sizeof(pp_pose_gradient) == 48);
    CHECK(offsetof(pp_pose_gradient, turn) == 24);
    CHECK(sizeof(pp_patch_derivatives) == 8 * 12 * 9);
    CHECK(offsetof(pp_patch_derivatives, torque_on_a) == 288);
    CHECK(offsetof(pp_patch_derivatives, torque_on_b) == 576);

    CHECK(sizeof(pp_patch) == 280);
    CHECK(offsetof(pp_patch, flags) == 0);
    CHECK(offsetof(pp_patch, error) == 8);
    CHECK(offsetof(pp_patch, length) == 24);
    CHECK(offsetof(pp_patch, force) == 32);
    CHECK(offsetof(pp_patch, torque) == 56);
    CHECK(offsetof(pp_patch, pressure_centre) == 80);
    CHECK(offsetof(pp_patch, branch_a) == 104);
    CHECK(offsetof(pp_patch, branch_b) == 128);
    CHECK(offsetof(pp_patch, couple) == 152);
    CHECK(offsetof(pp_patch, area) == 160);
    CHECK(offsetof(pp_patch, centroid) == 168);
    CHECK(offsetof(pp_patch, second_moment) == 192);
    CHECK(offsetof(pp_patch, polar_moment) == 240);
    CHECK(offsetof(pp_patch, twist_lever) == 248);
    CHECK(offsetof(pp_patch, mean_depth) == 256);
    CHECK(offsetof(pp_patch, energy) == 272);
    CHECK(sizeof(pp_patch_point) == 64);
    CHECK(sizeof(pp_patch_state) == 896);

    CHECK(sizeof(pp_mass_properties) == 88);
    CHECK(offsetof(pp_mass_properties, volume) == 0);
    CHECK(offsetof(pp_mass_properties, centroid) == 8);
    CHECK(offsetof(pp_mass_properties, inertia) == 32);
    CHECK(offsetof(pp_mass_properties, error) == 80);
}
