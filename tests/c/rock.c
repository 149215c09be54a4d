/* A cube cut by three joints, then by a tunnel: all that can be read of it, and what makes no rock mass. */
#include "check.h"
#include "tests.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDES = 6, MOST = 4096 };

/* Half sides 1, about the origin. */
static const double cube[SIDES][4] = { { 1, 0, 0, 1 },  { -1, 0, 0, 1 }, { 0, 1, 0, 1 },
                                       { 0, -1, 0, 1 }, { 0, 0, 1, 1 },  { 0, 0, -1, 1 } };
static const double middle[3] = {0, 0, 0};

static pp_joint joint(double dip, double dip_direction) {
    pp_joint made;
    CHECK_STATUS(pp_joint_from_dip(middle, dip, dip_direction, INFINITY, &made, NULL, 0), PP_OK);
    return made;
}

static pp_rock* cut(const double* region, size_t planes, const pp_slice_settings* settings, pp_rock_progress progress,
                    void* context)
{
    const pp_joint joints[3] = {joint(0, 0), joint(90, 90), joint(90, 0)};
    pp_rock *rock = NULL;
    CHECK_STATUS(pp_rock_new(cube[0], SIDES, joints, 3, NULL, NULL, region, &planes, region ? 1 : 0, settings, progress,
                             context, &rock, NULL, 0),
                 PP_OK);
    return rock;
}

static void joints_have_dip_and_direction(void) {
    pp_joint made = joint(30, 90);
    const double normal[3] = {0.5, 0, sqrt(0.75)};
    CHECK_NEAR3(made.normal, normal, 1e-15);
    CHECK(isinf(made.radius));
    char why[PP_MESSAGE_SIZE];
    FILL(made);
    CHECK_STATUS(pp_joint_from_dip(middle, 91, 0, INFINITY, &made, why, sizeof why), PP_BAD_ROCK);
    CHECK_TEXT(why, "dip = 91 must be an angle from 0 to 90 degrees");
    CHECK_STATUS(pp_joint_from_dip(middle, 9, 0, -1, &made, why, sizeof why), PP_BAD_ROCK);
    CHECK_STATUS(pp_joint_from_dip(NULL, 9, 0, 1, &made, why, sizeof why), PP_NULL_POINTER);
    CHECK_TEXT(why, "point must not be NULL");
    CHECK_UNTOUCHED(made);
}

/* The square cuts the right half alone; threads change nothing. */
static void polygons_cut_what_they_reach(void) {
    const double square[4][3] = {{0.2, -0.5, 0}, {0.8, -0.5, 0}, {0.8, 0.5, 0}, {0.2, 0.5, 0}};
    pp_joint joints[2] = {joint(90, 90)};
    char why[PP_MESSAGE_SIZE];
    CHECK_STATUS(pp_joint_from_corners(square[0], 4, &joints[1], why, sizeof why), PP_OK);
    const double normal[3] = {0, 0, 1}, place[3] = {0.5, 0, 0};
    CHECK_NEAR3(joints[1].normal, normal, 1e-15);
    CHECK_NEAR3(joints[1].point, place, 1e-15);
    CHECK_NEAR(joints[1].radius, sqrt(0.34), 1e-15);
    const size_t corners[2] = {0, 4}, few[2] = {0, 2}, huge[2] = {SIZE_MAX, 2};
    pp_slice_settings settings = {.threads = 3};
    pp_rock *rock = NULL;
    pp_rock_summary sum;
    CHECK_STATUS(pp_rock_new(cube[0], SIDES, joints, 2, square[0], corners, NULL, NULL, 0, &settings, NULL, NULL, &rock,
                             why, sizeof why),
                 PP_OK);
    CHECK_STATUS(pp_rock_get_summary(rock, &sum), PP_OK);
    CHECK(sum.blocks == 3 && sum.missing == 0);
    pp_rock_free(rock);
    settings.least_width = 1.01;
    CHECK_STATUS(pp_rock_new(cube[0], SIDES, joints, 2, NULL, NULL, NULL, NULL, 0, &settings, NULL, NULL, &rock, why,
                             sizeof why),
                 PP_OK);
    CHECK_STATUS(pp_rock_get_summary(rock, &sum), PP_OK);
    CHECK(sum.blocks == 1 && sum.too_small == 2);
    pp_rock_free(rock);
    CHECK_STATUS(
        pp_rock_new(cube[0], SIDES, joints, 2, square[0], few, NULL, NULL, 0, NULL, NULL, NULL, &rock, why, sizeof why),
        PP_BAD_ROCK);
    CHECK(strstr(why, "the corners of joint 1 must be three or more") != NULL);
    CHECK_STATUS(pp_rock_new(cube[0], SIDES, joints, 2, square[0], huge, NULL, NULL, 0, NULL, NULL, NULL, &rock, why,
                             sizeof why),
                 PP_BAD_INDEX);
    CHECK_STATUS(pp_joint_from_corners(square[0], 2, &joints[1], why, sizeof why), PP_BAD_ROCK);
    CHECK_STATUS(pp_joint_from_corners(NULL, 4, &joints[1], why, sizeof why), PP_NULL_POINTER);
}

static void sets_have_their_spacing(void) {
    pp_joint_set set = {.dip = 40, .dip_direction = 200, .spacing = 0.5, .fisher = INFINITY, .radius = INFINITY};
    pp_joint joints[16];
    size_t count = 0;
    CHECK_STATUS(pp_joint_set_joints(&set, middle, 2.1, NULL, 0, &count, NULL, 0), PP_BUFFER_TOO_SMALL);
    CHECK(count == 9);
    CHECK_STATUS(pp_joint_set_joints(&set, middle, 2.1, joints, 16, &count, NULL, 0), PP_OK);
    double apart = 0;
    for (int i = 0; i < 3; i++) apart += (joints[1].point[i] - joints[0].point[i]) * joints[0].normal[i];
    CHECK_NEAR(apart, 0.5, 1e-14);
    char why[PP_MESSAGE_SIZE];
    set.spacing = 0;
    CHECK_STATUS(pp_joint_set_joints(&set, middle, 2.1, joints, 16, &count, why, sizeof why), PP_BAD_ROCK);
    CHECK_TEXT(why, "spacing = 0 must be above 0");
    set.spacing = 0.5;
    set.reserved = 1;
    CHECK_STATUS(pp_joint_set_joints(&set, middle, 2.1, joints, 16, &count, NULL, 0), PP_BAD_SETTING);
    CHECK_STATUS(pp_joint_set_joints(NULL, middle, 2.1, joints, 16, &count, NULL, 0), PP_NULL_POINTER);
}

/* A corner with the legs a, b, c has the products V a b/80 of x and y, and so on, in the order of all tensors: its
 * principal axes are those of pp_principal_axes, which takes that order. */
static void the_products_of_inertia_have_the_order_of_all_tensors(void) {
    const double legs[3] = { 1.0, 0.6, 0.3 }, volume = legs[0] * legs[1] * legs[2] / 6;
    const double planes[4][4] = {
        { -1, 0, 0, 0 }, { 0, -1, 0, 0 }, { 0, 0, -1, 0 }, { 1 / legs[0], 1 / legs[1], 1 / legs[2], 1 }
    };
    pp_rock *rock = NULL;
    char why[PP_MESSAGE_SIZE];
    CHECK_STATUS(pp_rock_new(planes[0], 4, NULL, 0, NULL, NULL, NULL, NULL, 0, NULL, NULL, NULL, &rock, why, sizeof why),
                 PP_OK);
    pp_block block;
    size_t count;
    CHECK_STATUS(pp_rock_blocks(rock, &block, 1, &count), PP_OK);
    CHECK_NEAR(block.volume, volume, 1e-14);
    for (int i = 0; i < 3; i++)
        CHECK_NEAR(block.inertia[3 + i], volume * legs[i] * legs[(i + 1) % 3] / 80, 1e-15);
    pp_rock_free(rock);
}

static void a_grid_of_eight(void) {
    pp_rock *rock = cut(NULL, 0, NULL, NULL, NULL);
    pp_rock_summary sum;
    CHECK_STATUS(pp_rock_get_summary(rock, &sum), PP_OK);
    CHECK(sum.blocks == 8 && sum.faces == 48 && sum.corners == 192 && sum.partners == 12 && sum.joints == 3);
    CHECK(sum.missing == 0 && sum.too_small == 0 && sum.unclosed == 0);
    pp_block blocks[8];
    pp_block_face faces[48];
    double corners[192][3];
    pp_face_partners partners[12];
    size_t count;
    CHECK_STATUS(pp_rock_blocks(rock, blocks, 7, &count), PP_BUFFER_TOO_SMALL);
    CHECK(count == 8);
    CHECK_STATUS(pp_rock_blocks(rock, blocks, 8, &count), PP_OK);
    CHECK_STATUS(pp_rock_faces(rock, faces, 48, &count), PP_OK);
    CHECK_STATUS(pp_rock_corners(rock, corners[0], 192, &count), PP_OK);
    CHECK_STATUS(pp_rock_partners(rock, partners, 12, &count), PP_OK);
    CHECK(count == 12);
    int of_joints = 0;
    for (size_t i = 0; i < 8; i++) {
        CHECK_NEAR(blocks[i].volume, 1, 1e-14);
        for (int axis = 0; axis < 3; axis++) {
            CHECK_NEAR(fabs(blocks[i].centroid[axis]), 0.5, 1e-14);
            CHECK_NEAR(blocks[i].inertia[axis], 1.0 / 6, 1e-14);
            CHECK_NEAR(blocks[i].inertia[3 + axis], 0, 1e-14);
        }
        CHECK(blocks[i].face_count == 6 && blocks[i].first_face == 6 * i && blocks[i].parent == i
              && blocks[i].region == -1);
        for (size_t j = 6 * i; j < 6 * i + 6; j++) {
            CHECK(faces[j].jointed_area == (faces[j].of == PP_FACE_OF_JOINT ? faces[j].area : 0.0));
            CHECK(faces[j].block == i && faces[j].corner_count == 4);
            CHECK_NEAR(faces[j].area, 1, 1e-14);
            of_joints += faces[j].of == PP_FACE_OF_JOINT;
            CHECK(faces[j].index < (faces[j].of == PP_FACE_OF_JOINT ? 3 : SIDES));
            for (size_t k = faces[j].first_corner; k < faces[j].first_corner + 4; k++) {
                double height = -faces[j].plane[3];
                for (int axis = 0; axis < 3; axis++) height += faces[j].plane[axis] * corners[k][axis];
                CHECK_NEAR(height, 0, 1e-14);
            }
        }
    }
    CHECK(of_joints == 24);
    for (int i = 0; i < 12; i++) {
        const pp_block_face *a = &faces[partners[i].faces[0]], *b = &faces[partners[i].faces[1]];
        CHECK(a->index == b->index && a->block != b->block);
        CHECK_NEAR(partners[i].area, 1, 1e-14);
        for (int axis = 0; axis < 3; axis++) CHECK_NEAR(a->plane[axis], -b->plane[axis], 1e-15);
    }
    pp_rock_free(rock);
}

static void a_tunnel_parts_what_it_meets(void) {
    /* Along y, half sides 0.25. */
    const double tunnel[4][4] = {{1, 0, 0, 0.25}, {-1, 0, 0, 0.25}, {0, 0, 1, 0.25}, {0, 0, -1, 0.25}};
    pp_rock *rock = cut(tunnel[0], 4, NULL, NULL, NULL);
    pp_block blocks[32];
    pp_block_face *faces = calloc(MOST, sizeof *faces);
    size_t count, face_count;
    CHECK_STATUS(pp_rock_blocks(rock, blocks, 32, &count), PP_OK);
    CHECK_STATUS(pp_rock_faces(rock, faces, MOST, &face_count), PP_OK);
    CHECK(count == 24);
    double inside = 0, parents[8] = {0};
    int of_region = 0;
    for (size_t i = 0; i < count; i++) {
        inside += blocks[i].region == 0 ? blocks[i].volume : 0;
        parents[blocks[i].parent] += blocks[i].volume;
    }
    for (size_t i = 0; i < face_count; i++)
        of_region += faces[i].of == PP_FACE_OF_REGION && faces[i].index < 4 && faces[i].region == 0;
    CHECK_NEAR(inside, 0.5, 1e-14);
    for (int i = 0; i < 8; i++) CHECK_NEAR(parents[i], 1, 1e-14);
    CHECK(of_region > 16);
    free(faces);
    pp_rock_free(rock);
}

static int32_t enough(void *context, uint64_t joints, uint64_t blocks) {
    *(uint64_t *)context = blocks;
    return joints == 2;
}

static void limits_and_an_end(void) {
    uint64_t seen = 0;
    pp_rock *rock = cut(NULL, 0, NULL, enough, &seen);
    pp_rock_summary sum;
    CHECK_STATUS(pp_rock_get_summary(rock, &sum), PP_OK);
    CHECK(sum.joints == 2 && sum.blocks == 4 && seen == 4);
    pp_rock_free(rock);

    pp_slice_settings settings = {.least_volume = 1.5};
    rock = cut(NULL, 0, &settings, NULL, NULL);
    CHECK_STATUS(pp_rock_get_summary(rock, &sum), PP_OK);
    CHECK(sum.blocks == 4 && sum.too_small == 4 && sum.missing == 1);
    uint64_t missing = 9;
    size_t count;
    CHECK_STATUS(pp_rock_missing_joints(rock, &missing, 1, &count), PP_OK);
    CHECK(missing == 2 && count == 1);
    pp_rock_free(rock);
    pp_rock_free(NULL);
}

static void bad_values_are_told(void) {
    char why[PP_MESSAGE_SIZE];
    pp_rock *rock;
    FILL(rock);
    const pp_joint joints[3] = {joint(0, 0), joint(90, 90), joint(90, 0)};
    const size_t one = 1, huge[2] = {SIZE_MAX, SIZE_MAX};
    const double none[4] = {0, 0, 0, 1};
    pp_slice_settings settings = {.most_blocks = 5};
#define NEW(planes, count, joints, joint_count, region, counts, regions, settings)                                     \
    pp_rock_new(planes, count, joints, joint_count, NULL, NULL, region, counts, regions, settings, NULL, NULL, &rock,  \
                why, sizeof why)
    CHECK_STATUS(NEW(cube[0], 5, joints, 3, NULL, NULL, 0, NULL), PP_BAD_ROCK);
    CHECK(strstr(why, "the domain is open") != NULL);
    CHECK_STATUS(NEW(cube[0], SIDES, joints, 3, NULL, NULL, 0, &settings), PP_BAD_ROCK);
    CHECK(strstr(why, "some 8 blocks or more are expected, more than most_blocks = 5") != NULL);
    settings.least_volume = NAN;
    CHECK_STATUS(NEW(cube[0], SIDES, joints, 3, NULL, NULL, 0, &settings), PP_BAD_ROCK);
    CHECK(strstr(why, "least_volume = NaN") != NULL);
    CHECK_STATUS(NEW(cube[0], SIDES, joints, 3, none, &one, 1, NULL), PP_BAD_ROCK);
    CHECK(strstr(why, "plane 0 of region 0") != NULL);
    CHECK_STATUS(NEW(cube[0], SIDES, joints, 3, NULL, &one, 1, NULL), PP_NULL_POINTER);
    CHECK_STATUS(NEW(NULL, SIDES, joints, 3, NULL, NULL, 0, NULL), PP_NULL_POINTER);
    CHECK_TEXT(why, "planes must not be NULL");
    CHECK_STATUS(NEW(cube[0], SIDES, NULL, 3, NULL, NULL, 0, NULL), PP_NULL_POINTER);
    CHECK_STATUS(NEW(cube[0], SIDES, joints, 3, cube[0], huge, 2, NULL), PP_BAD_INDEX);
#undef NEW
    CHECK_UNTOUCHED(rock);
    size_t count;
    CHECK_STATUS(pp_rock_blocks(NULL, NULL, 0, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_rock_faces(NULL, NULL, 0, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_rock_corners(NULL, NULL, 0, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_rock_partners(NULL, NULL, 0, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_rock_missing_joints(NULL, NULL, 0, &count), PP_NULL_POINTER);
    CHECK_STATUS(pp_rock_get_summary(NULL, NULL), PP_NULL_POINTER);
}

void test_rock(void) {
    joints_have_dip_and_direction();
    polygons_cut_what_they_reach();
    sets_have_their_spacing();
    the_products_of_inertia_have_the_order_of_all_tensors();
    a_grid_of_eight();
    a_tunnel_parts_what_it_meets();
    limits_and_an_end();
    bad_values_are_told();
}
