/* Contacts with planes and triangles: closed forms of a sphere, and what is refused. */
#include "bodies.h"
#include "check.h"
#include "tests.h"

#include <math.h>
#include <string.h>

static const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 2};
static const double vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static void a_sphere_on_a_plane(void) {
    pp_particle *ball = new_sphere(1.0);
    const double heights[] = {0.75, -0.75, 1.5};
    for (int i = 0; i < 3; i++) {
        double height = heights[i];
        pp_pose pose = pose_turned(3, -4, height, 0.8, 0.4, 0.4, 0.2);
        pp_flat_contact contact;
        double area;
        check_case("height %g", height);
        if (!CHECK_STATUS(pp_contact_plane(ball, &pose, origin, up, NULL, NULL, &contact), PP_OK)) continue;
        CHECK_STATUS(pp_flat_contact_area(ball, &pose, &contact, 1e-6, &area), PP_OK);
        if (height > 1) {
            CHECK(contact.kind == PP_SEPARATED && area == 0);
            CHECK(contact.flags == (PP_FLAG_REJECTED | PP_FLAG_BY_SPHERES));
            CHECK_NEAR(contact.distance, height - 1, 1e-4);
            CHECK(isnan(contact.overlap));
            continue;
        }
        const double down[3] = {0, 0, height > 0 ? -1 : 1}, on[3] = {3, -4, 0};
        const double point[3] = {3, -4, -0.125 * height / 0.75}, branch[3] = {0, 0, point[2] - height};
        const double surface[3] = {3, -4, 2 * point[2]};
        CHECK(contact.kind == PP_OVERLAPPING && contact.feature == PP_ON_INTERIOR && contact.flags == 0);
        CHECK_NEAR(contact.s, 0.75, contact.gap);
        CHECK_NEAR(contact.overlap, 0.25, 1e-15);
        CHECK(isnan(contact.distance));
        CHECK_NEAR3(contact.normal, down, 0);
        CHECK_NEAR3(contact.on_boundary, on, 1e-15);
        CHECK_NEAR3(contact.point, point, 1e-15);
        CHECK_NEAR3(contact.branch, branch, 1e-15);
        CHECK_NEAR3(contact.on_particle, surface, 1e-15);
        CHECK_NEAR(area, PI * (1 - 0.875 * 0.875), 1e-13);
    }
    check_case(NULL);
    pp_particle_free(ball);
}

/* Both answers are the same within their bounds; one is told to be from memory. */
static void check_same_contact(const pp_flat_contact *with, const pp_flat_contact *without, uint32_t warm) {
    CHECK(with->kind == without->kind && with->feature == without->feature);
    CHECK(with->flags == (without->flags | warm));
    CHECK_NEAR(with->s, without->s, with->gap + without->gap);
    CHECK_NEAR(with->overlap, without->overlap, 1e-14);
    CHECK_NEAR3(with->on_boundary, without->on_boundary, with->point_bound + without->point_bound);
}

/* Whatever a state holds makes no difference beyond the bounds; what the last call has left is used. */
static void a_state_is_where_a_search_begins(void) {
    pp_particle *ball = new_sphere(1.0);
    pp_pose pose = pose_at(0.25, 0.25, 0.75);
    pp_pair_state state;
    FILL(state);
    pp_flat_contact with, without;
    for (int time = 0; time < 2; time++) {
        for (int call = 0; call < 2; call++) {
            uint32_t warm = call ? PP_FLAG_WARM : 0;
            CHECK_STATUS(pp_contact_plane(ball, &pose, origin, up, NULL, NULL, &without), PP_OK);
            CHECK_STATUS(pp_contact_plane(ball, &pose, origin, up, NULL, &state, &with), PP_OK);
            check_same_contact(&with, &without, warm);
        }
        CHECK_STATUS(pp_contact_triangle(ball, &pose, vertices, NULL, NULL, &without), PP_OK);
        CHECK_STATUS(pp_contact_triangle(ball, &pose, vertices, NULL, &state, &with), PP_OK);
        check_same_contact(&with, &without, PP_FLAG_WARM);
        state = (pp_pair_state){0};
    }
    pp_particle_free(ball);
}

/* Of a ball beside an edge: least on the edge, from where it falls into the triangle below the centre. */
static void a_seam_falls_towards_the_centre(void) {
    const double across[9] = {1, 0, 0, 0, 0, 0, 0, -1, 0};
    pp_particle *ball = new_sphere(1.0);
    pp_pose pose = pose_at(0.25, -0.25, 0.75);
    double share = 0.9;
    int32_t sense = 7;
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_EDGE, across, NULL, &share, &sense), PP_OK);
    CHECK(sense == -1);
    CHECK_NEAR(share, 0.25, 1e-12);
    pose = pose_at(0.25, 0.25, 0.75);
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_EDGE, across, NULL, &share, &sense), PP_OK);
    CHECK(sense == 0);
    sense = 7;
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_INTERIOR, across, NULL, &share, &sense), PP_BAD_POINT);
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_VERTEX + 3, across, NULL, &share, &sense), PP_BAD_POINT);
    CHECK_STATUS(pp_seam_slope(NULL, &pose, vertices, PP_ON_EDGE, across, NULL, &share, &sense), PP_NULL_POINTER);
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_EDGE, NULL, NULL, &share, &sense), PP_NULL_POINTER);
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_EDGE, across, NULL, NULL, &sense), PP_NULL_POINTER);
    share = NAN;
    CHECK_STATUS(pp_seam_slope(ball, &pose, vertices, PP_ON_EDGE, across, NULL, &share, &sense), PP_BAD_POINT);
    CHECK(sense == 7);
    pp_particle_free(ball);
}

static void bad_input_is_refused_and_nothing_written(void) {
    pp_particle *ball = new_sphere(1.0);
    pp_pose pose = pose_at(0, 0, 0.5), bad_pose = pose_at(0, NAN, 0), no_turn = pose_turned(0, 0, 0, 0, 0, 0, 0);
    pp_settings settings;
    pp_settings_default(&settings);
    settings.gap_tolerance = 0;
    pp_flat_contact out, unfilled;
    FILL(out);
    FILL(unfilled);
    const double not_a_point[3] = {0, INFINITY, 0}, on_a_line[9] = {0, 0, 0, 1, 1, 1, 3, 3, 3};
    double with_nan[9], area = 7;
    memcpy(with_nan, vertices, sizeof with_nan);
    with_nan[5] = NAN;
    CHECK_STATUS(pp_contact_plane(NULL, &pose, origin, up, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_plane(ball, NULL, origin, up, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_plane(ball, &pose, NULL, up, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_plane(ball, &pose, origin, NULL, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_plane(ball, &pose, origin, up, NULL, NULL, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_plane(ball, &bad_pose, origin, up, NULL, NULL, &out), PP_BAD_POSITION);
    CHECK_STATUS(pp_contact_plane(ball, &no_turn, origin, up, NULL, NULL, &out), PP_BAD_ORIENTATION);
    CHECK_STATUS(pp_contact_plane(ball, &pose, not_a_point, up, NULL, NULL, &out), PP_BAD_POINT);
    CHECK_STATUS(pp_contact_plane(ball, &pose, origin, origin, NULL, NULL, &out), PP_BAD_POINT);
    CHECK_STATUS(pp_contact_plane(ball, &pose, origin, up, &settings, NULL, &out), PP_BAD_SETTING);
    CHECK_STATUS(pp_contact_triangle(NULL, &pose, vertices, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_triangle(ball, NULL, vertices, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_triangle(ball, &pose, NULL, NULL, NULL, &out), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_triangle(ball, &pose, vertices, NULL, NULL, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_contact_triangle(ball, &pose, with_nan, NULL, NULL, &out), PP_BAD_POINT);
    CHECK_STATUS(pp_contact_triangle(ball, &pose, on_a_line, NULL, NULL, &out), PP_DEGENERATE_TRIANGLE);
    CHECK_STATUS(pp_contact_triangle(ball, &bad_pose, vertices, NULL, NULL, &out), PP_BAD_POSITION);
    CHECK_STATUS(pp_contact_triangle(ball, &pose, vertices, &settings, NULL, &out), PP_BAD_SETTING);
    CHECK_UNTOUCHED(out);
    CHECK_STATUS(pp_contact_plane(ball, &pose, origin, up, NULL, NULL, &out), PP_OK);
    CHECK_STATUS(pp_flat_contact_area(NULL, &pose, &out, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_flat_contact_area(ball, NULL, &out, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_flat_contact_area(ball, &pose, NULL, 1e-6, &area), PP_NULL_POINTER);
    CHECK_STATUS(pp_flat_contact_area(ball, &pose, &out, 1e-6, NULL), PP_NULL_POINTER);
    CHECK_STATUS(pp_flat_contact_area(ball, &pose, &out, NAN, &area), PP_BAD_SETTING);
    CHECK_STATUS(pp_flat_contact_area(ball, &pose, &unfilled, 1e-6, &area), PP_BAD_POINT);
    CHECK(area == 7);
    pp_particle_free(ball);
}

void test_flat(void) {
    a_sphere_on_a_plane();
    a_state_is_where_a_search_begins();
    a_seam_falls_towards_the_centre();
    bad_input_is_refused_and_nothing_written();
}
