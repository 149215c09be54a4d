//! What holds for all derivatives: forward and reverse agree, and a motion of both bodies together moves the contact
//! with them.

use kit::truth::pairs;
use nalgebra::{Matrix3, Vector3};
use potential_particles::{
    Contact, ContactDerivatives, ContactWeights, Formulation, Kind, PoseGradient, PoseRow, Settings,
    contact_derivatives, contact_gradient, detect,
};

/// Numbers in (−1, 1) that look like chance.
pub fn scattered(seed: usize) -> impl FnMut() -> f64 {
    let mut state = seed as f64;
    move || {
        state += 1.0;
        2.0 * (1e4 * (12.9898 * state).sin()).rem_euclid(1.0) - 1.0
    }
}

/// Some weights on all that a contact has.
pub fn some_weights(overlaps: bool, closest: bool, mut chance: impl FnMut() -> f64) -> ContactWeights {
    let mut vector = || Vector3::from_fn(|_, _| chance());
    let [normal, point, on_a, on_b, numbers] = [vector(), vector(), vector(), vector(), vector()];
    let surfaces = f64::from(u8::from(overlaps));
    ContactWeights {
        s: numbers.x,
        s_b: if closest { numbers.y } else { 0.0 },
        overlap: surfaces * numbers.z,
        normal,
        point,
        point_on_a: surfaces * on_a,
        point_on_b: surfaces * on_b,
    }
}

/// The weighted sum of the rows.
pub fn weighted(d: &ContactDerivatives, w: &ContactWeights) -> PoseRow {
    let times = |weight: f64, row: &PoseRow| if weight == 0.0 { PoseRow::zeros() } else { row * weight };
    let mut sum = times(w.s, &d.s) + times(w.s_b, &d.s_b) + times(w.overlap, &d.overlap);
    for (weight, rows) in
        [(w.normal, d.normal), (w.point, d.point), (w.point_on_a, d.point_on_a), (w.point_on_b, d.point_on_b)]
    {
        if weight != Vector3::zeros() {
            sum += weight.tr_mul(&rows);
        }
    }
    sum
}

/// Largest difference between forward and reverse beside the largest entry, turns in units of 1/size.
pub fn disagreement(forward: &PoseRow, reverse: &[PoseGradient; 2], size: f64) -> f64 {
    let (mut worst, mut most) = (0.0_f64, 0.0_f64);
    for (column, found) in forward.iter().enumerate() {
        let body = &reverse[column / 6];
        let (expected, unit) =
            if column % 6 < 3 { (body.shift[column % 3], 1.0) } else { (body.turn[column % 3], 1.0 / size) };
        assert!(found.is_finite() && expected.is_finite());
        worst = worst.max(unit * (found - expected).abs());
        most = most.max(unit * found.abs());
    }
    worst / most
}

#[test]
fn forward_and_reverse_agree_and_both_bodies_together_carry_the_contact() {
    let mut worst = [0.0_f64; 2];
    let mut count = 0;
    for (line, pair) in pairs().iter().enumerate() {
        let (a, b) = (pair.shape_a.particle(), pair.shape_b.particle());
        let (pose_a, pose_b) = (pair.a.pose(), pair.b.pose());
        let size = (pose_a.position() - pose_b.position()).norm();
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let settings = Settings::default().with_formulation(formulation).with_solve_separated(true);
            let contact: Contact = detect(&a, &pose_a, &b, &pose_b, &settings, None).unwrap();
            let Ok(found) = contact_derivatives(&a, &pose_a, &b, &pose_b, &contact, &settings) else {
                println!("pair {line} ({}, {formulation}): none, {:?}", pair.family, contact);
                continue;
            };
            let closest = contact.formulation == Formulation::Closest;
            let weights = some_weights(contact.kind == Kind::Overlapping, closest, scattered(100 * line));
            let (poses, flags) =
                contact_gradient(&a, &pose_a, &b, &pose_b, &contact, &settings, &weights, None, None).unwrap();
            assert_eq!(flags, found.flags);
            let off = disagreement(&weighted(&found, &weights), &poses, size);
            if off > 1e-10 {
                println!("pair {line} ({}, {formulation}): {off:e}; {flags}; {contact:?}", pair.family);
            }
            worst[0] = worst[0].max(off);
            // Columns of A and B together: shift and turn about the position of A.
            let turn = |v: &Vector3<f64>| -v.cross_matrix();
            let between = pose_b.position() - pose_a.position();
            let shift = |m: &potential_particles::PoseRows| -> Matrix3<f64> {
                m.fixed_view::<3, 3>(0, 0) + m.fixed_view::<3, 3>(0, 6)
            };
            let about_a = |m: &potential_particles::PoseRows| -> Matrix3<f64> {
                m.fixed_view::<3, 3>(0, 3) + m.fixed_view::<3, 3>(0, 9)
                    - m.fixed_view::<3, 3>(0, 6) * between.cross_matrix()
            };
            // The difference of positions is rounded here.
            let rounded = f64::EPSILON * pose_a.position().norm().max(pose_b.position().norm()) / size;
            // And the point is taken for the contact's, which is known to its bound.
            let known = 1.0 + 1e10 * (rounded + contact.point_bound / size);
            let most = (found.point.amax() + found.normal.amax() * size) * known;
            for off in [
                (shift(&found.point) - Matrix3::identity()).amax(),
                shift(&found.normal).amax() * size,
                (about_a(&found.point) - turn(&contact.branch_a)).amax() / size,
                (about_a(&found.normal) - turn(&contact.normal)).amax(),
            ] {
                if off / most > 1e-9 {
                    println!("pair {line} ({}, {formulation}): {off:e} of {most:e}; {flags}", pair.family);
                }
                worst[1] = worst[1].max(off / most);
            }
            count += 1;
        }
    }
    println!("{count} contacts: forward and reverse differ by {:e}, a common motion by {:e}", worst[0], worst[1]);
    assert!(count > 690 && worst[0] < 1e-9 && worst[1] < 1e-9);
}
