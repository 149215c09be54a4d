/* Every function that takes a pose refuses the same poses, and takes the same others. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <float.h>
#include <math.h>
#include <string.h>

static pp_particle *body;
static pp_pose other = {.position = {0.5, 0.25, 0.125}, .orientation = {0.8, 0.4, 0.4, 0.2}};

/* One call per pose argument of the interface. Each checks that a refusal writes nothing, and
 * copies what an accepted pose gives to `answer`. */
enum { ANSWER = sizeof(pp_contact) + sizeof(pp_pair_state) };
typedef pp_status (*pose_call)(const pp_pose *pose, unsigned char answer[ANSWER]);

static void deliver(pp_status status, const void *output, size_t size, unsigned char *answer) {
    if (status == PP_OK) {
        memcpy(answer, output, size);
    } else {
        check_untouched(output, size, "output", __FILE__, __LINE__);
    }
}

static pp_status potential(const pp_pose *pose, unsigned char *answer) {
    const double point[3] = {0.7, -1.3, 2.1};
    double out[4];
    FILL(out);
    pp_status status = pp_particle_potential(body, pose, point, out, out + 1);
    deliver(status, out, sizeof out, answer);
    return status;
}

static pp_status box(const pp_pose *pose, unsigned char *answer) {
    double out[6];
    FILL(out);
    pp_status status = pp_particle_box(body, pose, out, out + 3);
    deliver(status, out, sizeof out, answer);
    return status;
}

static pp_status detect(const pp_pose *pose_a, const pp_pose *pose_b, unsigned char *answer) {
    struct {
        pp_contact contact;
        pp_pair_state state;
    } out;
    FILL(out);
    pp_status status = pp_contact_detect(body, pose_a, body, pose_b, NULL, &out.state, &out.contact);
    deliver(status, &out, sizeof out, answer);
    return status;
}

static pp_status detect_a(const pp_pose *pose, unsigned char *answer) {
    return detect(pose, &other, answer);
}

static pp_status detect_b(const pp_pose *pose, unsigned char *answer) {
    return detect(&other, pose, answer);
}

static pp_status area(const pp_pose *pose_a, const pp_pose *pose_b, unsigned char *answer) {
    const pp_contact contact = {.kind = PP_OVERLAPPING,
                                .normal = {1, 0, 0},
                                .point = {0.25, 0.125, 0.0625},
                                .branch_a = {0.25, 0.125, 0.0625},
                                .branch_b = {-0.25, -0.125, -0.0625}};
    double out;
    FILL(out);
    pp_status status = pp_contact_area(body, pose_a, body, pose_b, &contact, 1e-3, &out);
    deliver(status, &out, sizeof out, answer);
    return status;
}

static pp_status area_a(const pp_pose *pose, unsigned char *answer) {
    return area(pose, &other, answer);
}

static pp_status area_b(const pp_pose *pose, unsigned char *answer) {
    return area(&other, pose, answer);
}

static const struct {
    const char *name;
    pose_call call;
} calls[] = {
    {"pp_particle_potential", potential},    {"pp_particle_box", box},
    {"pp_contact_detect, pose_a", detect_a}, {"pp_contact_detect, pose_b", detect_b},
    {"pp_contact_area, pose_a", area_a},     {"pp_contact_area, pose_b", area_b},
};
enum { CALLS = sizeof calls / sizeof calls[0] };

static void refused(const pp_pose *pose, pp_status expected, const char *why) {
    unsigned char answer[ANSWER];
    for (int i = 0; i < CALLS; i++) {
        check_case("%s, %s", calls[i].name, why);
        CHECK_STATUS(calls[i].call(pose, answer), expected);
    }
    check_case(NULL);
}

/* A quaternion times a power of two is the same rotation, bit for bit. */
static void same_answer(const pp_pose *pose, const pp_pose *unit, const char *why) {
    for (int i = 0; i < CALLS; i++) {
        unsigned char answer[ANSWER] = {0}, expected[ANSWER] = {0};
        check_case("%s, %s", calls[i].name, why);
        CHECK_STATUS(calls[i].call(pose, answer), PP_OK);
        CHECK_STATUS(calls[i].call(unit, expected), PP_OK);
        CHECK_SAME_BYTES(answer, expected, sizeof answer);
    }
    check_case(NULL);
}

void test_pose(void) {
    const double not_finite[] = {NAN, INFINITY, -INFINITY};
    const pp_pose home = pose_turned(0.125, 0.25, 0.5, 0.5, 0.5, 0.5, -0.5);
    body = new_cube(1.0, 0.5, 0.3, 2.0);

    refused(NULL, PP_NULL_POINTER, "no pose");
    for (int value = 0; value < 3; value++) {
        for (int j = 0; j < 3; j++) {
            pp_pose pose = home;
            pose.position[j] = not_finite[value];
            refused(&pose, PP_BAD_POSITION, "position that is not finite");
        }
        for (int j = 0; j < 4; j++) {
            pp_pose pose = home;
            pose.orientation[j] = not_finite[value];
            refused(&pose, PP_BAD_ORIENTATION, "quaternion that is not finite");
        }
    }
    const double bad_lengths[] = {0.0, -0.0, DBL_TRUE_MIN, DBL_MIN, 1e-151, 1e151, DBL_MAX};
    for (size_t i = 0; i < sizeof bad_lengths / sizeof bad_lengths[0]; i++) {
        pp_pose pose = pose_turned(0, 0, 0, bad_lengths[i], 0, 0, 0);
        refused(&pose, PP_BAD_ORIENTATION, "quaternion that cannot be normalised");
    }

    const int exponents[] = {1, -1, 10, -498, 498}; /* 2^498 is 8e149 */
    for (size_t i = 0; i < sizeof exponents / sizeof exponents[0]; i++) {
        pp_pose pose = home;
        for (int j = 0; j < 4; j++) pose.orientation[j] = ldexp(home.orientation[j], exponents[i]);
        same_answer(&pose, &home, "unnormalised quaternion");
    }
    pp_pose opposite = home;
    for (int j = 0; j < 4; j++) opposite.orientation[j] = -home.orientation[j];
    same_answer(&opposite, &home, "opposite quaternion");

    pp_particle_free(body);
    body = NULL;
}
