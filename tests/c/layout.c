/* The structs lie in memory as other languages, which cannot read the header, write them down. */
#include "check.h"
#include "tests.h"

void test_layout(void) {
    CHECK(sizeof(pp_status) == 4);
    CHECK((pp_status)-1 < 0);

    CHECK(sizeof(pp_pose) == 56);
    CHECK(offsetof(pp_pose, position) == 0);
    CHECK(offsetof(pp_pose, orientation) == 24);

    CHECK(sizeof(pp_settings) == 40);
    CHECK(offsetof(pp_settings, formulation) == 0);
    CHECK(offsetof(pp_settings, back_end) == 4);
    CHECK(offsetof(pp_settings, solve_separated) == 8);
    CHECK(offsetof(pp_settings, reserved) == 12);
    CHECK(offsetof(pp_settings, gap_tolerance) == 16);
    CHECK(offsetof(pp_settings, weight_on_a) == 24);
    CHECK(offsetof(pp_settings, flat_regularisation) == 32);

    CHECK(sizeof(pp_memory) == 64);
    CHECK(offsetof(pp_memory, state) == 0);

    CHECK(sizeof(pp_contact) == 224);
    CHECK(offsetof(pp_contact, kind) == 0);
    CHECK(offsetof(pp_contact, formulation) == 4);
    CHECK(offsetof(pp_contact, back_end) == 8);
    CHECK(offsetof(pp_contact, flags) == 12);
    CHECK(offsetof(pp_contact, iterations) == 16);
    CHECK(offsetof(pp_contact, reserved) == 20);
    CHECK(offsetof(pp_contact, s) == 24);
    CHECK(offsetof(pp_contact, s_b) == 32);
    CHECK(offsetof(pp_contact, weight) == 40);
    CHECK(offsetof(pp_contact, gap) == 48);
    CHECK(offsetof(pp_contact, point_bound) == 56);
    CHECK(offsetof(pp_contact, overlap) == 64);
    CHECK(offsetof(pp_contact, normal) == 72);
    CHECK(offsetof(pp_contact, point) == 96);
    CHECK(offsetof(pp_contact, branch_a) == 120);
    CHECK(offsetof(pp_contact, branch_b) == 144);
    CHECK(offsetof(pp_contact, point_on_a) == 168);
    CHECK(offsetof(pp_contact, point_on_b) == 192);
    CHECK(offsetof(pp_contact, distance) == 216);

    CHECK(sizeof(pp_mass_properties) == 80);
    CHECK(offsetof(pp_mass_properties, volume) == 0);
    CHECK(offsetof(pp_mass_properties, centroid) == 8);
    CHECK(offsetof(pp_mass_properties, inertia) == 32);
}
