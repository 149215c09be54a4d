//! The contact point, its bound, and the normal.

use super::{judged, judged_by};
use kit::stress::ledger::Fault::*;

/// Two ordinary polyhedra, from memory: s and point were right, point_bound was NaN.
#[test]
fn the_bound_of_the_point_is_a_number() {
    judged_by("polyhedra_from_memory", &[Malformed, Warm], 1, 42_893);
}

/// The minimiser runs along nearly parallel faces by 6e-4 within rounding, and its bound was 1e-6; the second pair with
/// the bodies swapped.
#[test]
fn answers_are_within_their_bounds_on_parallel_faces() {
    for name in ["parallel_faces", "parallel_faces_swapped"] {
        judged(name, &[Warm, BoundOfPoint, Swap]);
    }
}

/// k = 1e-10 and r/size = 1e-8, deep: the point was 0.25 off, its bound 3e-12, and the normal at right angles.
#[test]
fn the_normal_of_sharp_bodies_is_known_deep_inside() {
    judged("sharp_bodies_deep_inside", &[BoundOfPoint, Normal]);
}

/// The sensitivity of the point was taken with the weights of one λ and the factor of another, and that to planes came
/// out as 0.
#[test]
fn the_bound_of_the_point_takes_one_lambda_throughout() {
    judged("two_lambdas", &[BoundOfPoint]);
}

/// Face on face with k of 1e-10: a plane at the edge held the point by a force of 1e-8, and the rounding of those that
/// balance was 4e-8. Swapped, the point was 25 away, and both were told to be right to 1e-11.
#[test]
fn the_bound_of_the_point_counts_an_edge_with_a_weak_push() {
    judged("edge_with_a_weak_push", &[Swap, Warm, BoundOfPoint]);
}

/// A first step as long as the body: S of the small one was off by 1e-12 along it, and with S the point where both are
/// equal, while the bound knew of the rounding at either end only.
#[test]
fn the_bound_of_the_point_counts_rounding_along_a_long_step() {
    for name in ["long_first_step", "long_first_step_of_near_spheres", "long_first_step_from_memory"] {
        judged(name, &[BoundOfPoint, Warm, Swap]);
    }
}

/// Two planes on, and a third after the step by 2e-15, where rounding is 4e-15: left out, as S does not tell. The point
/// lay 2e-10 aside, and 1e-3 where the rounding was that of another plane, whose normal is 86 times as long.
#[test]
fn the_bound_of_the_point_counts_a_plane_met_within_rounding() {
    for name in ["plane_met_within_rounding", "plane_met_within_rounding_beside_a_longer_normal"] {
        judged(name, &[Swap, BoundOfPoint]);
    }
}

/// The point was off by 8 % more than its bound.
#[test]
fn the_bound_of_the_point_holds_between_very_stiff_planes() {
    judged_by("very_stiff_planes", &[Swap, BoundOfPoint], 5, 96_615);
}

/// A plane of B was on by 4e-17, where P1 is known to 1e-7 only, since A is 1e8 times as large: along the edge without
/// it the point lay 1.5e-6 off.
#[test]
fn the_bound_of_the_point_counts_a_plane_that_may_go_off() {
    judged_by("plane_on_by_less_than_the_point_is_known", &[BoundOfPoint], 303_443_503, 708_928);
}
