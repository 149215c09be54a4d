#include "answer.h"
#include "bodies.h"
#include "check.h"

#include <float.h>
#include <math.h>

const way ways[WAYS] = {
    {PP_MIDWAY, PP_FAST, "midway, fast"},
    {PP_MIDWAY, PP_CONE_PROGRAM, "midway, cone program"},
    {PP_CLOSEST, PP_FAST, "closest, fast"},
    {PP_CLOSEST, PP_CONE_PROGRAM, "closest, cone program"},
};

pp_settings settings_for(const way *chosen) {
    pp_settings settings = default_settings();
    settings.formulation = chosen->formulation;
    settings.back_end = chosen->back_end;
    settings.solve_separated = 1;
    return settings;
}

/* The cone-program back end stops at an interior point: its points are good to about the root of its
 * gap, and directions lose as much again to curvature. The fast one ends in Newton steps, at rounding. */
accuracy accuracy_of(uint32_t back_end, double size) {
    return back_end == PP_FAST ? (accuracy){1e-11, 1e-9, 1e-9, size} : (accuracy){1e-6, 1e-4, 1e-3, size};
}

static bool all_nan(const double v[3]) {
    return isnan(v[0]) && isnan(v[1]) && isnan(v[2]);
}

void check_consistent(const pp_contact *contact, const pp_pose *pose_a, const pp_pose *pose_b,
                      const pp_settings *settings) {
    CHECK(contact->reserved == 0);
    CHECK((contact->flags & ~(PP_FLAG_FREE | PP_FLAG_DEEP)) < 2 * PP_FLAG_ROUNDING_LIMITED);
    CHECK((contact->flags & PP_FLAG_REJECTED) == 0);
    CHECK(contact->back_end == settings->back_end);
    CHECK(contact->formulation == (contact->flags & PP_FLAG_SLACK ? PP_MIDWAY : settings->formulation));
    CHECK(contact->kind == (contact->s < 1 ? PP_OVERLAPPING : PP_SEPARATED));
    CHECK(contact->gap >= 0 && contact->gap < 0.1);
    CHECK(contact->weight >= 0 && contact->weight <= 1);
    CHECK(isnan(contact->s_b) == (contact->formulation == PP_MIDWAY));
    if (contact->kind == PP_OVERLAPPING) {
        CHECK(contact->overlap > 0 && isnan(contact->distance));
    } else {
        CHECK(isnan(contact->overlap) && all_nan(contact->point_on_a) && all_nan(contact->point_on_b));
        CHECK(contact->distance >= 0 && isfinite(contact->distance));
        CHECK(contact->formulation != PP_MIDWAY || contact->s - contact->gap <= 1 || contact->distance > 0);
    }
    CHECK_NEAR(dot(contact->normal, contact->normal), 1.0, 1e-14);
    double largest = 1.0;
    for (int j = 0; j < 3; j++) {
        largest = fmax(largest, fmax(fabs(pose_a->position[j]), fabs(pose_b->position[j])));
    }
    for (int j = 0; j < 3; j++) {
        CHECK_NEAR(contact->branch_a[j], contact->point[j] - pose_a->position[j], 4 * DBL_EPSILON * largest);
        CHECK_NEAR(contact->branch_b[j], contact->point[j] - pose_b->position[j], 4 * DBL_EPSILON * largest);
    }
}

void check_answer(const pp_contact *contact, const pp_pose *pose_a, const pp_pose *pose_b,
                  const pp_settings *settings, const answer *expected, double size) {
    accuracy allowed = accuracy_of(settings->back_end, size);
    double length = allowed.length * allowed.size, point[3];
    check_consistent(contact, pose_a, pose_b, settings);
    /* The distance between rounded positions is off by as much as they are rounded. */
    CHECK_NEAR(contact->s, expected->s, contact->gap + 16 * DBL_EPSILON * fmax(1.0, expected->s));
    CHECK(contact->gap <= allowed.s * fmax(1.0, expected->s));
    if (isnan(expected->s_b)) {
        CHECK(isnan(contact->s_b));
    } else {
        CHECK_NEAR(contact->s_b, expected->s_b, allowed.s * fmax(1.0, expected->s_b));
    }
    if (!isnan(expected->weight)) CHECK_NEAR(contact->weight, expected->weight, allowed.direction);
    CHECK_NEAR3(contact->normal, expected->normal, allowed.direction);
    if (expected->on_a > expected->on_b) {
        CHECK_NEAR(contact->overlap, expected->on_a - expected->on_b, length);
    }
    walk(pose_a->position, expected->point, expected->normal, point);
    CHECK_NEAR3(contact->point, point, length);
    if (contact->kind == PP_SEPARATED) return;
    walk(pose_a->position, expected->on_a, expected->normal, point);
    CHECK_NEAR3(contact->point_on_a, point, length);
    walk(pose_a->position, expected->on_b, expected->normal, point);
    CHECK_NEAR3(contact->point_on_b, point, length);
}

void check_rejected(const pp_contact *contact, double s) {
    CHECK(contact->kind == PP_SEPARATED);
    CHECK(contact->flags & PP_FLAG_REJECTED);
    CHECK(contact->s >= 1 && contact->s <= s * (1 + 4 * DBL_EPSILON));
    CHECK(contact->distance >= 0 && isfinite(contact->distance));
    CHECK(isnan(contact->s_b) && isnan(contact->weight) && isnan(contact->overlap));
    CHECK(all_nan(contact->normal) && all_nan(contact->point));
    CHECK(all_nan(contact->branch_a) && all_nan(contact->branch_b));
    CHECK(all_nan(contact->point_on_a) && all_nan(contact->point_on_b));
}
