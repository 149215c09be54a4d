/* A contact that is carried on from pose to pose is the one that is solved there, within the bounds of both. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

static const double TOLERANCE = 1e-9;

static pp_contact detect(const pp_particle *a, const pp_pose *at_a, const pp_particle *b, const pp_pose *at_b,
                         double tolerance, pp_pair_state *state) {
    pp_settings settings = default_settings();
    settings.carry_tolerance = tolerance;
    pp_contact contact;
    FILL(contact);
    CHECK_STATUS(pp_contact_detect(a, at_a, b, at_b, &settings, state, &contact), PP_OK);
    return contact;
}

static bool is_carried(const pp_contact *contact) {
    return (contact->flags & PP_FLAG_CARRIED) != 0;
}

static void check_within_bounds(const pp_contact *carried, const pp_contact *solved) {
    CHECK(carried->kind == PP_OVERLAPPING && solved->kind == PP_OVERLAPPING);
    CHECK_NEAR(carried->s, solved->s, carried->gap + solved->gap);
    double square = 0;
    for (int j = 0; j < 3; j++) square += pow(carried->branch_b[j] - solved->branch_b[j], 2);
    CHECK(sqrt(square) <= carried->point_bound + solved->point_bound);
    CHECK_NEAR3(carried->normal, solved->normal, 1e-6);
    CHECK_NEAR(carried->overlap, solved->overlap, 1e-7);
}

/* A little nearer to the other one, aside and turned in each step. */
static pp_pose step_of_walk(int step) {
    const double t = 1e-5 * step;
    return pose_turned(0.3 + 2 * t, 0.2, 2.9 - t, 1, 0.1 + t, 0.2, 0.05 - t);
}

static pp_pose pose_of_a(void) {
    return pose_turned(0.01, -0.02, 0.03, 1, 0.02, 0.05, 0.1);
}

static void a_walk(const pp_particle *a, const pp_particle *b) {
    const pp_pose at_a = pose_of_a();
    pp_pair_state state = {0};
    int count = 0;
    for (int step = 0; step < 100; step++) {
        check_case("step %d", step);
        const pp_pose at_b = step_of_walk(step);
        const pp_contact carried = detect(a, &at_a, b, &at_b, TOLERANCE, &state);
        pp_contact solved;
        CHECK_STATUS(pp_contact_detect(a, &at_a, b, &at_b, NULL, NULL, &solved), PP_OK);
        check_within_bounds(&carried, &solved);
        count += is_carried(&carried);
    }
    check_case(NULL);
    CHECK(count > 90);
    /* Apart: nothing is carried on to there, nor from there. */
    const pp_pose away = pose_at(0, 0, 9), back = step_of_walk(100);
    pp_contact contact = detect(a, &at_a, b, &away, TOLERANCE, &state);
    CHECK(contact.kind == PP_SEPARATED && !is_carried(&contact));
    contact = detect(a, &at_a, b, &back, TOLERANCE, &state);
    CHECK(contact.kind == PP_OVERLAPPING && !is_carried(&contact));
}

/* An empty state, that of other particles or of the pair the other way round, and a tolerance of 0. */
static void what_is_not_carried_on(const pp_particle *a, const pp_particle *b, const pp_particle *other) {
    const pp_pose at_a = pose_of_a(), at_b = step_of_walk(0);
    pp_pair_state state = {0}, state_of_solved = {0};
    /* With a tolerance of 0, and from the remembered solution alone, bit for bit what is solved. */
    for (int time = 0; time < 4; time++) {
        pp_contact solved;
        FILL(solved);
        CHECK_STATUS(pp_contact_detect(a, &at_a, b, &at_b, NULL, &state_of_solved, &solved), PP_OK);
        if (time == 3) {
            pp_pair_state loaded = {0};
            memcpy(loaded.solution, state.solution, sizeof loaded.solution);
            state = loaded;
        }
        pp_contact contact = detect(a, &at_a, b, &at_b, time == 3 ? TOLERANCE : 0, &state);
        CHECK_SAME_BYTES(&contact, &solved, sizeof solved);
    }
    pp_contact contact = detect(a, &at_a, b, &at_b, TOLERANCE, &state);
    CHECK(is_carried(&contact));
    contact = detect(a, &at_a, b, &at_b, 0, &state);
    CHECK(!is_carried(&contact));
    contact = detect(a, &at_a, b, &at_b, TOLERANCE, NULL);
    CHECK(!is_carried(&contact));
    state = (pp_pair_state){0};

    const struct {
        const pp_particle *a, *b;
        const pp_pose *at_a, *at_b;
    } pairs[] = {{a, b, &at_a, &at_b}, {other, b, &at_a, &at_b}, {b, other, &at_b, &at_a}, {a, b, &at_a, &at_b}};
    for (int i = 0; i < 4; i++) {
        check_case("pair %d", i);
        /* From nothing it may be solved on the edge of a piece, of which nothing is to be carried on. */
        memset(state.solution, 0, sizeof state.solution);
        contact = detect(pairs[i].a, pairs[i].at_a, pairs[i].b, pairs[i].at_b, TOLERANCE, &state);
        CHECK(!is_carried(&contact));
        detect(pairs[i].a, pairs[i].at_a, pairs[i].b, pairs[i].at_b, TOLERANCE, &state);
        contact = detect(pairs[i].a, pairs[i].at_a, pairs[i].b, pairs[i].at_b, TOLERANCE, &state);
        CHECK(is_carried(&contact));
    }
    check_case(NULL);

    const struct {
        uint32_t formulation, back_end;
    } others[] = {{PP_CLOSEST, PP_FAST}, {PP_MIDWAY, PP_CONE_PROGRAM}};
    for (int i = 0; i < 2; i++) {
        pp_settings settings = default_settings();
        settings.formulation = others[i].formulation;
        settings.back_end = others[i].back_end;
        settings.carry_tolerance = TOLERANCE;
        state = (pp_pair_state){0};
        for (int time = 0; time < 2; time++) {
            CHECK_STATUS(pp_contact_detect(a, &at_a, b, &at_b, &settings, &state, &contact), PP_OK);
            CHECK(!is_carried(&contact));
        }
    }
}

void test_carried(void) {
    pp_particle *a = new_cube(1.4, 0.1, 0.1, 2.0), *b = new_cube(1.4, 0.1, 0.1, 2.0);
    pp_particle *other = new_cube(1.4, 0.12, 0.1, 2.0);
    a_walk(a, b);
    what_is_not_carried_on(a, b, other);
    pp_particle_free(a);
    pp_particle_free(b);
    pp_particle_free(other);
}
