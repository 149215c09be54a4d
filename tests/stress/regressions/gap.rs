//! The scale s and its gap, which holds and is no wider than rounding explains; and on which side of contact a pair is.

use super::{judged, judged_by};
use kit::stress::ledger::Fault::*;

/// Planes of r/size = 6e-8 that push or pull by less than their depth is known; once more with k = 1e-10.
#[test]
fn weak_planes_count_in_the_bounds() {
    for name in [
        "weak_planes",
        "weak_planes_after_a_step",
        "weak_planes_hardly_a_sphere",
        "weak_planes_hardly_a_sphere_after_a_step",
    ] {
        judged(name, &[BoundOfS, BoundOfPoint, Warm]);
    }
}

/// A small body at the corner of a box, 500 away from its centre: the rotation of that arm rounds more than the
/// distances to the planes near the corner.
#[test]
fn the_gap_counts_the_arm_of_a_corner_far_from_its_centre() {
    judged("corner_far_from_its_centre", &[BoundOfS]);
}

/// Told separated by 1.3e-11 with a gap far below that, and they overlap by 3.6e-11.
#[test]
fn a_kissing_pair_is_on_its_side_of_contact_beyond_the_gap() {
    judged("kissing", &[WrongSide, BoundOfS]);
}

/// Midway proves an overlap of 2e-16; closest, whose gap leaves it open, answered apart.
#[test]
fn closest_is_on_the_side_of_contact_that_midway_proves() {
    judged("proved_by_midway_alone", &[WrongSide]);
}

/// With default settings s is said to be a lower bound; it was an estimate, above the optimum by 1e-13.
#[test]
fn a_separation_proved_on_the_way_gives_a_lower_bound() {
    judged("separated_on_the_way", &[Reject]);
}

/// With default settings the first answer is loose, and the next one a proof of separation: overlapping was told, with
/// a gap of 130.
#[test]
fn a_separation_proved_after_a_loose_answer_is_the_answer() {
    judged("separated_after_a_loose_answer", &[Reject, NotSolved, Warm]);
}

/// A plane that may pull by more than it is in doubt, as it seems to pull already.
#[test]
fn a_weak_pull_counts_in_full() {
    judged("weak_pull", &[Reject]);
}

/// k = 0, aligned: s is least at the far end of faces that are tilted by 2e-16, and the gap was that of the middle.
#[test]
fn faces_that_look_parallel_are_tilted_by_rounding() {
    judged("faces_tilted_by_rounding", &[BoundOfS]);
}

/// A sharp body (r/size = 1e-8) around the centre of a sphere: s is 0 to all digits, and was known to 0.05 only.
#[test]
fn the_gap_is_small_for_a_sharp_body_in_a_sphere() {
    judged("sharp_body_in_a_sphere", &[LooseBound]);
}

/// A tiny, sharp body in the flank of a large one, λ = 1e14: s of the sharp body changes by all of itself within the
/// rounding of a length, but the point follows, and the other s hardly changes.
#[test]
fn the_gap_is_small_for_a_tiny_sharp_body_in_a_flank() {
    for name in ["tiny_in_a_flank", "tiny_in_a_flank_far_from_both_centres", "tiny_in_a_flank_without_a_sphere"] {
        judged(name, &[LooseBound]);
    }
}

/// A point that gives way along an edge of two planes meets a third one: the gap was 0.25.
#[test]
fn the_gap_is_small_at_a_corner_of_a_sharp_body() {
    judged("corner_of_a_sharp_body", &[LooseBound]);
}

/// The square of that rounding over r² was counted, although nothing pulls that way.
#[test]
fn the_gap_is_small_where_r_is_below_the_rounding_of_a_distance() {
    judged("r_below_rounding", &[LooseBound]);
}

/// Solved over a long step, from where the planes are known to no more than 1e-4 of s; surface points were off by as
/// much.
#[test]
fn the_gap_is_not_that_of_a_long_step() {
    for name in ["long_step", "long_step_to_an_overlap_of_nothing"] {
        judged(name, &[LooseBound, OffSurface, Malformed]);
    }
}

/// λ was off by a tenth after a long step, and no search from nearby gets to the right one.
#[test]
fn the_gap_is_small_where_a_long_step_misses_the_weight() {
    judged("weight_off_by_a_tenth", &[LooseBound]);
}

/// k = 1e-10: a weak pull was counted as if nothing but the spheres resisted it.
#[test]
fn the_gap_is_small_where_a_pull_cannot_be_told_from_a_push() {
    judged("pull_or_push", &[LooseBound]);
}

/// s of 1e11: the rounding of forces 1e10 times as large as at a contact was counted as if the spheres alone resisted
/// it.
#[test]
fn the_gap_is_small_far_from_both_bodies() {
    for name in ["far_from_both_bodies", "far_from_both_bodies_at_their_edges"] {
        judged(name, &[LooseBound]);
    }
}

/// k = 1e-9: what is left of the slope across the face was counted as if it lay along it.
#[test]
fn the_gap_is_small_on_a_face_with_hardly_a_sphere() {
    judged("face_with_hardly_a_sphere", &[LooseBound]);
}

/// Two bodies next to each other whose point of equal s is 7e5 away from both: the judge knew of the lengths of the
/// bodies only.
#[test]
fn the_gap_is_small_for_equal_scales_far_from_both_centres() {
    judged("equal_scales_far_from_both", &[LooseBound]);
}

/// The normal of one is 43 times as long as that of the other: the rounding of each plane is that of its own normal.
#[test]
fn the_gap_is_small_for_two_planes_in_one_place() {
    for name in ["two_planes_in_one_place", "two_planes_in_one_place_again"] {
        judged(name, &[LooseBound]);
    }
}

/// Three planes on, and a normal 98 times as long that is not among them: the signs of the depths were doubted by its
/// length.
#[test]
fn the_gap_is_small_beside_a_long_normal() {
    for name in [
        "beside_a_long_normal",
        "beside_a_long_normal_again",
        "beside_long_normals_of_both",
        "beside_a_far_plane_of_long_normal",
    ] {
        judged(name, &[LooseBound]);
    }
}

/// s of 1e11: a normal 86 times as long pushes with 4e5 by a depth of 1e-11.
#[test]
fn the_gap_is_small_where_a_short_and_a_long_normal_push() {
    judged("short_and_long_normal", &[LooseBound]);
}

/// k = 0, and the contact is 3e6 from the centre of the other: the gap was 0.24.
#[test]
fn the_gap_is_small_for_a_contact_far_from_one_centre() {
    judged("contact_far_from_one_centre", &[LooseBound]);
}

/// k = 0, face on face, and a plane at the edge whose push is within rounding: without it a step went 1e5 along the
/// face.
#[test]
fn the_gap_is_small_on_a_face_held_by_a_weak_push() {
    judged("face_held_by_a_weak_push", &[LooseBound, BoundOfS]);
}

/// A plane whose push is below rounding was dropped and met again without end, at the optimum; the gap was 0.005.
#[test]
fn the_gap_is_small_where_a_wall_holds_by_less_than_rounding() {
    judged_by("wall_held_by_less_than_rounding", &[LooseBound, BoundOfS], 1, 10_000_028_366_232);
}

/// On the way to a better point another plane is met, past which S rises to 1e14; or λ comes to an end of its range.
#[test]
fn the_gap_is_small_where_the_way_meets_other_planes() {
    for name in ["plane_on_the_way", "plane_on_the_way_along_an_edge", "plane_on_the_way_at_an_extreme_weight"] {
        judged(name, &[LooseBound, BoundOfS]);
    }
}

/// A needle 1e6 long touches with its tip, and both sides of it push, 2e-6 from parallel: what rounding does to s there
/// is not of first order, of which alone the judge knew.
#[test]
fn the_gap_is_small_at_the_tip_of_a_wedge() {
    judged("tip_of_a_wedge", &[LooseBound]);
}

/// Without a plane on one side, or with faces that all but oppose each other, bodies have their optimum 10⁴ to 10¹⁴
/// sizes away. The rounding of a turn moves it in proportion to that lever arm; the judge counted the distance of the
/// centres only.
#[test]
fn s_is_that_of_the_pair_turned_however_far_the_point() {
    judged_by("far_point_of_edges", &[RigidMotion], 178_870_341, 10_000_028_219_586);
    judged_by("far_point_of_open_planes", &[RigidMotion], 178_870_341, 10_000_044_776_449);
    judged_by("far_point_of_two_plates", &[RigidMotion], 178_870_341, 10_000_036_594_833);
}

/// k = 0: at the minimum for one λ a plane's depth is below the last of 32 digits. Taken for off, it came on at the
/// first part of every step, and the search ended there with a gap of 0.14, and of 13 beside s of 1.7e6.
#[test]
fn the_gap_is_small_where_a_plane_is_at_its_switch() {
    judged_by("a_plane_at_its_switch", &[LooseBound], 870_677_402, 168_837);
    judged_by("a_plane_at_its_switch_far_apart", &[LooseBound], 22_896_182, 104_192);
}

/// A plane comes on at the very start of the step, so that the line search ran out of halvings at 10⁻¹⁸ of it. That is
/// still above the rounding of 32 digits: the step counted as progress and was repeated up to the limit of steps. The
/// gaps were 3·10⁻⁶ and 9·10⁻⁵.
#[test]
fn the_gap_is_small_where_a_plane_comes_on_below_the_last_trial() {
    judged_by("search_below_the_last_trial", &[LooseBound], 178_870_341, 10_000_084_502_295);
    judged_by("search_below_the_last_trial_on_a_plate", &[LooseBound], 178_870_341, 10_000_086_003_342);
}
