//! The points on both surfaces, and the overlap between them.

use super::{judged, judged_by};
use kit::stress::ledger::Fault::*;

/// The small body lies deep in the other; the ray from P3 ended at its start, the overlap was that of one body alone.
#[test]
fn surface_points_are_on_their_surface_deep_in_a_sharp_body() {
    judged("deep_in_a_sharp_body", &[OffSurface]);
}

/// s < 1 by a unit in the last place, and the two distances to the surfaces sum up to less than 0.
#[test]
fn two_spheres_that_barely_touch_have_no_negative_overlap() {
    judged("spheres_that_barely_touch", &[Malformed]);
}

/// Told an overlap of 0, with surface points 4e-10 apart.
#[test]
fn surfaces_that_seem_to_have_passed_each_other_meet_half_way() {
    judged("surfaces_4e-10_apart", &[Malformed]);
}

/// The point is 8e-11 outside of a face that the normal meets at 1e-3, and on the surface of a body of r = 1e-9: half
/// way along the normal to where that face is left is 3e-8 from both.
#[test]
fn surfaces_that_have_passed_each_other_meet_across_and_not_along_the_normal() {
    judged("face_along_the_normal", &[OffSurface, Malformed]);
}

/// Far from the origin rounding put a contact point in front of a face that the normal runs along: it was a long way to
/// that face, and the surfaces met there.
#[test]
fn a_point_in_front_of_a_face_along_the_normal_is_beside_its_body() {
    judged_by("in_front_of_a_face_along_the_normal", &[OffSurface], 1, 10_000_003_631_363);
}

/// S_B is 1 to all digits by its quadratic, and 1.0003 where the point came to lie.
#[test]
fn surface_points_are_on_their_surface_after_a_long_step() {
    for name in ["surface_after_a_long_step", "surface_of_a_box_after_a_long_step"] {
        judged(name, &[OffSurface]);
    }
}

/// r is 1e-12, 360,000 from the centre of the other: the rounding of the point is 4e-11, and the ray from there missed
/// the body.
#[test]
fn a_body_thinner_than_the_rounding_of_its_place_has_a_surface() {
    for name in ["thinner_than_its_rounding", "thinner_than_its_rounding_with_a_core"] {
        judged(name, &[NotSolved, OffSurface, Malformed]);
    }
}

/// As thin, and instead of nothing the ray gave a point 40 away where S is 1e25: the overlap was told to be 0.
#[test]
fn a_ray_that_misses_a_sharp_body_is_told_from_one_that_meets_it() {
    judged("ray_that_misses", &[OffSurface, Malformed]);
}

/// The judge looked for the surface along the normal, which meets the face of a plate so aslant that it did not get
/// there.
#[test]
fn a_thin_plate_is_crossed_at_a_slant() {
    judged("thin_plate", &[OffSurface]);
}

/// A needle 1e6 long, 1e12 from the origin, whose faces lie along the normal but for 3e-4: the judge gave up 0.09 along
/// the normal, and the face is 0.1 away, though the rounded point is but 3e-5 off it. Where S is zero it found no
/// number.
#[test]
fn a_needle_is_crossed_however_far_along_the_normal_that_is() {
    for name in ["needle", "needle_with_a_core"] {
        judged(name, &[OffSurface]);
    }
}

/// The line along the normal leaves the body where it meets a plane at an angle of 0.002 to it, which is active by
/// 10⁻¹². The coordinates of the surface point are rounded to 10⁻¹⁰: there the plane is inactive, and the point 9·10⁻¹⁰
/// inside. The judge looked for the surface along the normal only.
#[test]
fn a_plane_along_the_normal_holds_the_surface() {
    judged_by("plane_along_the_normal", &[OffSurface], 178_870_341, 10_000_011_232_814);
}
