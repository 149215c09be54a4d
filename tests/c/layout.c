/* The structs lie in memory as other languages, which cannot read the header, write them down. */
#include "check.h"
#include "tests.h"

/* The library was compiled with the same structs as this program. */
static void sizes_are_those_of_the_library(void) {
    CHECK(pp_struct_size(PP_STRUCT_POSE) == sizeof(pp_pose));
    CHECK(pp_struct_size(PP_STRUCT_SETTINGS) == sizeof(pp_settings));
    CHECK(pp_struct_size(PP_STRUCT_PAIR_STATE) == sizeof(pp_pair_state));
    CHECK(pp_struct_size(PP_STRUCT_CONTACT) == sizeof(pp_contact));
    CHECK(pp_struct_size(PP_STRUCT_CLOSEST) == sizeof(pp_closest));
    CHECK(pp_struct_size(PP_STRUCT_MASS_PROPERTIES) == sizeof(pp_mass_properties));
    CHECK(pp_struct_size(PP_STRUCT_AREA_PROPERTIES) == sizeof(pp_area_properties));
    CHECK(pp_struct_size(PP_STRUCT_POSE_2D) == sizeof(pp_pose_2d));
    CHECK(pp_struct_size(PP_STRUCT_CONTACT_2D) == sizeof(pp_contact_2d));
    CHECK(pp_struct_size(PP_STRUCT_CLOSEST_2D) == sizeof(pp_closest_2d));
    CHECK(pp_struct_size(PP_STRUCT_FLAT_CONTACT) == sizeof(pp_flat_contact));
    CHECK(pp_struct_size(PP_STRUCT_PACKING) == sizeof(pp_packing));
    CHECK(pp_struct_size(PP_STRUCT_PLACEMENT) == sizeof(pp_placement));
    CHECK(pp_struct_size(PP_STRUCT_PATCH) == sizeof(pp_patch));
    CHECK(pp_struct_size(PP_STRUCT_PATCH_POINT) == sizeof(pp_patch_point));
    CHECK(pp_struct_size(PP_STRUCT_PATCH_2D) == sizeof(pp_patch_2d));
    CHECK(pp_struct_size(PP_STRUCT_PATCH_POINT_2D) == sizeof(pp_patch_point_2d));
    CHECK(pp_struct_size(PP_STRUCT_PATCH_STATE) == sizeof(pp_patch_state));
    CHECK(pp_struct_size(PP_STRUCT_JOINT) == sizeof(pp_joint));
    CHECK(pp_struct_size(PP_STRUCT_JOINT_SET) == sizeof(pp_joint_set));
    CHECK(pp_struct_size(PP_STRUCT_SLICE_SETTINGS) == sizeof(pp_slice_settings));
    CHECK(pp_struct_size(PP_STRUCT_ROCK_SUMMARY) == sizeof(pp_rock_summary));
    CHECK(pp_struct_size(PP_STRUCT_BLOCK) == sizeof(pp_block));
    CHECK(pp_struct_size(PP_STRUCT_BLOCK_FACE) == sizeof(pp_block_face));
    CHECK(pp_struct_size(PP_STRUCT_FACE_PARTNERS) == sizeof(pp_face_partners));
    CHECK(pp_struct_size(PP_STRUCT_DERIVATIVES) == sizeof(pp_derivatives));
    CHECK(pp_struct_size(PP_STRUCT_CONTACT_WEIGHTS) == sizeof(pp_contact_weights));
    CHECK(pp_struct_size(PP_STRUCT_SHAPE_GRADIENT) == sizeof(pp_shape_gradient));
    CHECK(pp_struct_size(PP_STRUCT_POSE_GRADIENT) == sizeof(pp_pose_gradient));
    CHECK(pp_struct_size(PP_STRUCT_PATCH_DERIVATIVES) == sizeof(pp_patch_derivatives));
    CHECK(pp_struct_size(PP_STRUCT_BUILT) == sizeof(pp_built));
    CHECK(pp_struct_size(PP_STRUCT_RIGID_BODY) == sizeof(pp_rigid_body));
    CHECK(pp_struct_size(PP_STRUCT_RIGID_CONTACT) == sizeof(pp_rigid_contact));
    CHECK(pp_struct_size(PP_STRUCT_EQUILIBRIUM_RESULT) == sizeof(pp_equilibrium_result));
    /* 3, 10 and 11 were structs of an older interface. */
    const uint32_t unknown[] = {0, 3, 10, 11, 38, UINT32_MAX};
    for (int i = 0; i < 6; i++) CHECK(pp_struct_size(unknown[i]) == 0);
}

void test_layout(void) {
    sizes_are_those_of_the_library();
    CHECK(sizeof(pp_status) == 4);
    CHECK((pp_status)-1 < 0);

    CHECK(sizeof(pp_pose) == 56);
    CHECK(offsetof(pp_pose, position) == 0);
    CHECK(offsetof(pp_pose, orientation) == 24);

    CHECK(sizeof(pp_settings) == 48);
    CHECK(offsetof(pp_settings, formulation) == 0);
    CHECK(offsetof(pp_settings, back_end) == 4);
    CHECK(offsetof(pp_settings, solve_separated) == 8);
    CHECK(offsetof(pp_settings, reserved) == 12);
    CHECK(offsetof(pp_settings, gap_tolerance) == 16);
    CHECK(offsetof(pp_settings, weight_on_a) == 24);
    CHECK(offsetof(pp_settings, flat_regularisation) == 32);
    CHECK(offsetof(pp_settings, carry_tolerance) == 40);

    CHECK(sizeof(pp_pair_state) == 384);
    CHECK(offsetof(pp_pair_state, solution) == 0);
    CHECK(offsetof(pp_pair_state, last_contact) == 64);

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

    CHECK(sizeof(pp_closest) == 104);
    CHECK(offsetof(pp_closest, slack) == 0);
    CHECK(offsetof(pp_closest, reserved) == 4);
    CHECK(offsetof(pp_closest, s) == 8);
    CHECK(offsetof(pp_closest, gap) == 16);
    CHECK(offsetof(pp_closest, point_bound) == 24);
    CHECK(offsetof(pp_closest, point) == 32);
    CHECK(offsetof(pp_closest, branch_a) == 56);
    CHECK(offsetof(pp_closest, branch_b) == 80);

    CHECK(sizeof(pp_flat_contact) == 176);
    CHECK(offsetof(pp_flat_contact, kind) == 0);
    CHECK(offsetof(pp_flat_contact, feature) == 4);
    CHECK(offsetof(pp_flat_contact, flags) == 8);
    CHECK(offsetof(pp_flat_contact, iterations) == 12);
    CHECK(offsetof(pp_flat_contact, s) == 16);
    CHECK(offsetof(pp_flat_contact, gap) == 24);
    CHECK(offsetof(pp_flat_contact, point_bound) == 32);
    CHECK(offsetof(pp_flat_contact, overlap) == 40);
    CHECK(offsetof(pp_flat_contact, distance) == 48);
    CHECK(offsetof(pp_flat_contact, normal) == 56);
    CHECK(offsetof(pp_flat_contact, point) == 80);
    CHECK(offsetof(pp_flat_contact, branch) == 104);
    CHECK(offsetof(pp_flat_contact, on_boundary) == 128);
    CHECK(offsetof(pp_flat_contact, on_particle) == 152);

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

    CHECK(sizeof(pp_area_properties) == 56);
    CHECK(offsetof(pp_area_properties, area) == 0);
    CHECK(offsetof(pp_area_properties, centroid) == 8);
    CHECK(offsetof(pp_area_properties, second_moment) == 24);
    CHECK(offsetof(pp_area_properties, error) == 48);

    CHECK(sizeof(pp_packing) == 88);
    CHECK(offsetof(pp_packing, container) == 0);
    CHECK(offsetof(pp_packing, arrangement) == 4);
    CHECK(offsetof(pp_packing, shares) == 8);
    CHECK(offsetof(pp_packing, threads) == 12);
    CHECK(offsetof(pp_packing, lower) == 16);
    CHECK(offsetof(pp_packing, upper) == 40);
    CHECK(offsetof(pp_packing, margin) == 64);
    CHECK(offsetof(pp_packing, seed) == 72);
    CHECK(offsetof(pp_packing, number) == 80);

    CHECK(sizeof(pp_joint) == 56);
    CHECK(offsetof(pp_joint, normal) == 24);
    CHECK(offsetof(pp_joint, radius) == 48);
    CHECK(sizeof(pp_joint_set) == 56);
    CHECK(offsetof(pp_joint_set, seed) == 40);
    CHECK(offsetof(pp_joint_set, exponential) == 48);
    CHECK(sizeof(pp_slice_settings) == 48);
    CHECK(offsetof(pp_slice_settings, most_blocks) == 32);
    CHECK(sizeof(pp_rock_summary) == 64);
    CHECK(offsetof(pp_rock_summary, partners) == 24);
    CHECK(offsetof(pp_rock_summary, unclosed) == 56);
    CHECK(sizeof(pp_rigid_body) == 128);
    CHECK(offsetof(pp_rigid_body, live_torque) == 96);
    CHECK(offsetof(pp_rigid_body, held) == 120);
    CHECK(sizeof(pp_rigid_contact) == 80);
    CHECK(offsetof(pp_rigid_contact, normal) == 24);
    CHECK(offsetof(pp_rigid_contact, tension) == 72);
    CHECK(sizeof(pp_equilibrium_result) == 32);
    CHECK(offsetof(pp_equilibrium_result, factor) == 8);
    CHECK(sizeof(pp_block) == 112);
    CHECK(offsetof(pp_block, centroid) == 8);
    CHECK(offsetof(pp_block, inertia) == 32);
    CHECK(offsetof(pp_block, first_face) == 80);
    CHECK(offsetof(pp_block, region) == 104);
    CHECK(sizeof(pp_block_face) == 88);
    CHECK(offsetof(pp_block_face, index) == 8);
    CHECK(offsetof(pp_block_face, plane) == 16);
    CHECK(offsetof(pp_block_face, area) == 48);
    CHECK(offsetof(pp_block_face, jointed_area) == 56);
    CHECK(offsetof(pp_block_face, block) == 80);
    CHECK(sizeof(pp_face_partners) == 24);
    CHECK(offsetof(pp_face_partners, area) == 16);

    CHECK(sizeof(pp_placement) == 72);
    CHECK(offsetof(pp_placement, pose) == 0);
    CHECK(offsetof(pp_placement, scale) == 56);
    CHECK(offsetof(pp_placement, shape) == 64);
    CHECK(offsetof(pp_placement, reserved) == 68);
}
