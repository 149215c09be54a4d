/* pp_equilibrium: a block on a floor, pushed. It turns over at width/height or slides at the friction, whichever is
 * less. */
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

static const double floor_polygon[4][3] = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};

typedef struct {
    pp_rigid_body bodies[2];
    pp_rigid_contact contact;
} scene;

/* A block of width and depth 1, of this height and of weight 1, on a held body. */
static scene block_on_floor(double height, double friction) {
    scene made;
    memset(&made, 0, sizeof made);
    made.bodies[0].held = 1;
    made.bodies[0].centre[2] = -1;
    made.bodies[1].centre[2] = 0.5 * height;
    made.bodies[1].dead_force[2] = -1;
    made.bodies[1].live_force[0] = 1;
    made.contact.bodies[1] = 1;
    made.contact.corner_count = 4;
    made.contact.normal[2] = 2;
    made.contact.area = 1;
    made.contact.friction = friction;
    return made;
}

static pp_status ask(const scene *of, uint32_t question, pp_equilibrium_result *result, double *forces,
                     double *velocities, char *why) {
    return pp_equilibrium(question, 0, of->bodies, 2, &of->contact, 1, floor_polygon[0], 4, result, forces,
                          velocities, why, PP_MESSAGE_SIZE);
}

static void answers_are_those_of_the_closed_form(void) {
    char why[PP_MESSAGE_SIZE];
    const double cases[][2] = {{0.7, 0.4}, {2.6, 0.6}};
    for (int i = 0; i < 2; i++) {
        const double height = cases[i][0], friction = cases[i][1];
        scene pushed = block_on_floor(height, friction);
        pp_equilibrium_result result;
        double forces[12], velocities[12], sum[3] = {0};
        CHECK_STATUS(ask(&pushed, PP_LOAD_FACTOR, &result, forces, velocities, why), PP_OK);
        CHECK(result.stands == 1 && result.solves > 0 && fabs(result.bound - result.factor) < 1e-5 && result.unbalanced < 1e-6 && result.excess < 1e-4);
        CHECK_NEAR(result.factor, fmin(friction, 1 / height), 1e-5);
        for (int corner = 0; corner < 4; corner++) {
            for (int axis = 0; axis < 3; axis++) sum[axis] += forces[3 * corner + axis];
        }
        CHECK_NEAR3(sum, ((double[]){-result.factor, 0, 1}), 1e-5);
        /* It slides, or turns about the edge at x = 1/2. */
        CHECK(velocities[0] == 0 && velocities[6] > 0.1 && (velocities[10] > 0.1) == (height > 1));
        CHECK_STATUS(ask(&pushed, PP_STANDS, &result, NULL, NULL, why), PP_OK);
        CHECK(result.stands == 1 && result.factor == 0 && result.may_stand == 1);
        /* The same push as a load that is there: the factor of safety against sliding. */
        pushed.bodies[1].dead_force[0] = 0.2;
        CHECK_STATUS(ask(&pushed, PP_STRENGTH_FACTOR, &result, forces, velocities, why), PP_OK);
        CHECK_NEAR(result.factor, friction / 0.2, 1e-5);
        pushed.bodies[1].dead_force[0] = 2;
        CHECK_STATUS(ask(&pushed, PP_STANDS, &result, forces, velocities, why), PP_OK);
        CHECK(result.stands == 0 && velocities[6] > 0.1);
        CHECK_NEAR3(forces, ((double[]){0, 0, 0}), 0);
    }
}

static void bad_scenes_are_named(void) {
    char why[PP_MESSAGE_SIZE];
    pp_equilibrium_result result;
    FILL(result);
    scene bad = block_on_floor(1, -0.5);
    CHECK_STATUS(ask(&bad, PP_STANDS, &result, NULL, NULL, why), PP_BAD_EQUILIBRIUM);
    CHECK_TEXT(why, "friction of contact 0 is -0.5: it must be 0 or above, and finite");
    bad = block_on_floor(1, 0.5);
    bad.contact.bodies[1] = UINT64_MAX;
    CHECK_STATUS(ask(&bad, PP_STANDS, &result, NULL, NULL, why), PP_BAD_EQUILIBRIUM);
    bad = block_on_floor(1, 0.5);
    bad.bodies[1].live_force[0] = 0;
    CHECK_STATUS(ask(&bad, PP_LOAD_FACTOR, &result, NULL, NULL, why), PP_BAD_EQUILIBRIUM);
    CHECK_TEXT(why, "no free body has a live load, so that no load factor exists: give live loads");
    bad.contact.corner_count = 5;
    CHECK_STATUS(ask(&bad, PP_STANDS, &result, NULL, NULL, why), PP_BAD_INDEX);
    bad.contact.corner_count = 3;
    CHECK_STATUS(ask(&bad, PP_STANDS, &result, NULL, NULL, why), PP_BAD_INDEX);
    bad = block_on_floor(1, 0.5);
    CHECK_STATUS(ask(&bad, 3, &result, NULL, NULL, why), PP_BAD_SETTING);
    bad.bodies[0].held = 2;
    CHECK_STATUS(ask(&bad, PP_STANDS, &result, NULL, NULL, why), PP_BAD_SETTING);
    CHECK_STATUS(ask(&bad, PP_STANDS, NULL, NULL, NULL, why), PP_NULL_POINTER);
    bad = block_on_floor(1, 0.5);
    CHECK_STATUS(pp_equilibrium(PP_STANDS, 2, bad.bodies, 2, &bad.contact, 1, floor_polygon[0], 4, &result, NULL,
                                NULL, NULL, 0),
                 PP_BAD_SETTING);
    CHECK_STATUS(pp_equilibrium(PP_STANDS, 0, NULL, 2, &bad.contact, 1, floor_polygon[0], 4, &result, NULL, NULL,
                                why, sizeof why),
                 PP_NULL_POINTER);
    CHECK_UNTOUCHED(result);
}

void test_equilibrium(void) {
    answers_are_those_of_the_closed_form();
    bad_scenes_are_named();
}
