//! The closest points.

use super::{judged, judged_by, solved};
use kit::stress::ledger::Fault::*;
use potential_particles::Formulation;

/// r/size of 1e-10 against 1e-4: midway was answered, closest was not.
#[test]
fn closest_points_of_sharp_bodies_have_an_answer() {
    judged("closest_of_sharp_bodies", &[NotSolved]);
}

/// P1 on a sphere, where λ = 1e-10.
#[test]
fn the_bound_of_closest_points_on_a_sphere_counts_their_rounding() {
    judged("closest_on_a_sphere", &[BoundOfPoint]);
}

/// s_A = 846, and the gap was that of a pair that touches; s_B = 1.8e8 was off by 2 %.
#[test]
fn the_gap_of_closest_far_apart_counts_its_rounding() {
    for name in ["closest_at_s_of_846", "closest_at_s_of_2e8"] {
        judged(name, &[BoundOfS]);
    }
}

/// s_A is 6e10, and a judge that took a point far outside B for a proof held it for 8e9.
#[test]
fn closest_of_sharp_bodies_far_apart_is_the_optimum() {
    judged("closest_at_s_of_6e10", &[BoundOfS]);
}

/// P2 was off by a size of the body, far beyond its bound.
#[test]
fn a_closest_point_is_within_its_bound_after_a_long_step() {
    judged("closest_off_by_a_size", &[BoundOfPoint, OffSurface]);
}

/// Rounding moves the minimum of each λ anew along soft directions: the search for λ stalled, and the side that was
/// left open by a thousand times its rounding was not counted in the bound of P2.
#[test]
fn a_closest_point_with_soft_directions_is_within_its_bound() {
    judged("closest_with_soft_directions", &[BoundOfPoint]);
}

/// The judge gave up at S_A = 0.09 instead of 1, and trusted its point to nine digits.
#[test]
fn a_judge_that_misses_its_constraint_says_so() {
    judged("constraint_missed_by_the_judge", &[BoundOfPoint]);
}

/// The extended tier starts some hundred times as far from the point as the centre of B is: rounded before the two were
/// summed, the step put the point 6e-16 off, where its bound is 4e-17.
#[test]
fn a_step_from_afar_is_rounded_with_the_point() {
    judged("step_from_afar", &[BoundOfPoint, Swap, Warm]);
    judged_by("step_from_afar", &[BoundOfPoint, Swap, Warm], 302_736_744, 2616);
}

/// From memory the right point came with a bound wider than the scale, and the constraint passed for slack.
#[test]
fn closest_from_memory_is_not_slack_for_want_of_a_bound() {
    judged_by("closest_from_memory_deep_in_a_core", &[Warm], 11, 32_611);
    judged_by("closest_from_memory_at_a_large_body", &[Warm], 11, 53_360);
    judged_by("closest_from_memory_without_a_core", &[Warm], 1, 355_952);
    judged_by("a_plane_at_its_switch_from_memory", &[Warm], 555_473_478, 656_280);
}

/// P1 lies in the core of a sharp body, at planes that push with 10⁻²⁴ of its size; in the others both bodies are deep
/// inside each other besides, with forces of 10⁻⁹ of those expected.
#[test]
fn closest_points_in_the_core_of_a_sharp_body_are_known() {
    for name in ["closest_in_a_core", "closest_deep_in_each_other", "closest_deep_in_each_other_again"] {
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let contact = solved(name, formulation);
            assert!(contact.gap < 1e-9, "{name}, {formulation:?}: {contact:?}");
        }
    }
}

/// λ lies where forces are but rounding: P2 was 10⁻³ off its surface, and its scale 3·10⁻¹⁰ instead of 9·10⁻⁶.
#[test]
fn a_closest_point_whose_weight_is_lost_in_rounding_is_on_its_surface() {
    let name = "closest_at_s_of_9e-6";
    judged_by(name, &[OffSurface, BoundOfS], 1, 10_000_063_291_695);
    let contact = solved(name, Formulation::Closest);
    assert!((contact.s - 9.3376e-6).abs() < 1e-9 + contact.gap && contact.gap < 1e-6, "{contact:?}");
}

/// B has a size of 10⁻⁴ and r = 10⁻¹², A a size of 1. The judge's search ended at an infeasible point, outside A, where
/// S of B is 1; at P1 it is 10⁷. From the smaller value it bounded the distance to P1, which made its lower bound of s
/// too high. The cone program agrees with the answer.
#[test]
fn the_judge_bounds_the_distance_by_a_feasible_point() {
    judged_by("small_body_far_from_the_point_on_a", &[BoundOfS], 875_949_039, 20_881);
}

/// B is a plate with r = 5·10⁻¹⁶, and the rounding of a point of A, 10⁻¹⁵, moves P1 across that rounding: s_B there is
/// 4·10⁻⁴ or 0.86. The bound took S_B to be the same quadratic on that way, on which a plane of B comes on.
#[test]
fn the_bound_counts_planes_of_one_body_within_the_rounding_of_the_other() {
    judged_by("plate_whose_face_lies_within_the_rounding_of_the_other_body", &[BoundOfS], 635_189_490, 874_165);
}
