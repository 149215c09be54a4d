//! Every back end and formulation against solutions known to 40 digits.

use kit::truth::{distance, minus, number, pairs};
use potential_particles::{BackEnd, Formulation, Kind, Role, Settings, closest_point, detect};
use std::collections::BTreeMap;

const MIDWAY: usize = 0;
const CLOSEST: usize = 1;

/// Of one family and back end, midway and closest.
#[derive(Default)]
struct Accuracy {
    pairs: usize,
    /// Worst: s over max(s*, 1), points over the smaller shadow radius.
    s: [f64; 2],
    gap: [f64; 2],
    point: [f64; 2],
    /// Each: bound over error.
    gap_over_error: [Vec<f64>; 2],
    bound_over_error: [Vec<f64>; 2],
}

impl Accuracy {
    fn record(&mut self, formulation: usize, (s, gap): (f64, f64), truth: &str) {
        let (error, unit) = (minus(s, truth).abs(), number(truth).max(1.0));
        assert!(error <= gap, "s = {s} is {error:e} off, its gap is {gap:e}");
        self.s[formulation] = self.s[formulation].max(error / unit);
        self.gap[formulation] = self.gap[formulation].max(gap / unit);
        self.gap_over_error[formulation].push(gap / error.max(f64::EPSILON * number(truth)));
    }

    fn point(&mut self, formulation: usize, off: f64, bound: f64, unit: f64) {
        assert!(off <= bound, "a point is {off:e} off, its bound is {bound:e}");
        self.point[formulation] = self.point[formulation].max(off / unit);
        self.bound_over_error[formulation].push(bound / off.max(f64::EPSILON * unit));
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Both formulations, every pair, at one tolerance: all errors are within their bounds, and all pairs on their side.
fn accuracy(back_end: BackEnd, gap_tolerance: f64) -> BTreeMap<String, Accuracy> {
    let midway =
        Settings::default().with_gap_tolerance(gap_tolerance).with_solve_separated(true).with_back_end(back_end);
    let closest = midway.with_formulation(Formulation::Closest);
    let mut families: BTreeMap<String, Accuracy> = BTreeMap::new();
    for pair in &pairs() {
        let (a, b, truth) = (pair.shape_a.particle(), pair.shape_b.particle(), &pair.truth);
        let (pose_a, pose_b) = (pair.a.pose(), pair.b.pose());
        let unit = pair.shape_a.shadow_radius.min(pair.shape_b.shadow_radius);
        let worst = families.entry(pair.family.clone()).or_default();
        worst.pairs += 1;
        let solve = |settings| {
            let contact = detect(&a, &pose_a, &b, &pose_b, settings, None).expect("an answer");
            let is_told = (number(&truth.s4) - 1.0).abs() > 1e-9;
            assert!(!is_told || (number(&truth.s4) < 1.0) == (contact.kind == Kind::Overlapping), "{contact:?}");
            contact
        };

        let contact = solve(&midway);
        worst.record(MIDWAY, (contact.s, contact.gap), &truth.s4);
        worst.point(MIDWAY, distance(&contact.branch_b, &truth.x4), contact.point_bound, unit);

        let halves = [(truth.ok1, Role::A, &truth.s_b, &truth.p1), (truth.ok2, Role::B, &truth.s_a, &truth.p2)];
        for (known, on, s, point) in halves {
            let found = closest_point(&a, &pose_a, &b, &pose_b, on, &closest).expect("an answer");
            assert_eq!(found.is_some(), known, "a slack constraint");
            let (Some(found), Some(s), Some(point)) = (found, s, point) else { continue };
            worst.record(CLOSEST, (found.s, found.gap), s);
            worst.point(CLOSEST, distance(&found.branch_b, point), found.point_bound, unit);
        }
        let contact = solve(&closest);
        if let (true, true, Some(s_a), Some(s_b), Some(p2)) = (truth.ok1, truth.ok2, &truth.s_a, &truth.s_b, &truth.p2)
        {
            worst.record(CLOSEST, (contact.s, contact.gap), s_a);
            worst.record(CLOSEST, (contact.s_b, contact.gap), s_b);
            if contact.kind == Kind::Overlapping {
                // Through the world frame, with the rounding of the position of B.
                let off = distance(&(contact.point_on_b - pose_b.position()), p2);
                let rounding = f64::EPSILON * pose_b.position().norm();
                worst.point(CLOSEST, (off - rounding).max(0.0), contact.point_bound, unit);
            }
        }
    }
    println!(
        "\n{back_end:?}, gap_tolerance = {gap_tolerance:e}: worst of each family, midway and closest; docs/pairs.md"
    );
    println!("| family | pairs | error of s | | gap | | point | |\n|---|---|---|---|---|---|---|---|");
    for (family, Accuracy { pairs, s, gap, point, .. }) in &families {
        let columns = [s, gap, point].map(|of| format!("{:.1e} | {:.1e}", of[MIDWAY], of[CLOSEST]));
        println!("| {family} | {pairs} | {} |", columns.join(" | "));
    }
    families
}

/// With default settings the bounds hold, and say something: over all pairs, the median bound is within 1000 of the
/// true error.
#[test]
fn every_error_is_within_its_bound() {
    let families = accuracy(BackEnd::Fast, Settings::default().gap_tolerance);
    for of in [MIDWAY, CLOSEST] {
        let all = |each: fn(&Accuracy) -> &[Vec<f64>; 2]| -> Vec<f64> {
            families.values().flat_map(|worst| each(worst)[of].iter().copied()).collect()
        };
        let medians =
            [all(|worst| &worst.gap_over_error), all(|worst| &worst.bound_over_error)].map(|all| median(&all));
        assert!(medians.iter().all(|median| *median < 1000.0), "{medians:?}");
    }
}

#[test]
fn every_error_of_the_cone_programs_is_within_its_bound() {
    accuracy(BackEnd::ConeProgram, Settings::default().gap_tolerance);
}

#[test]
fn fourteen_digits_for_the_asking() {
    for (family, worst) in accuracy(BackEnd::Fast, 1e-14) {
        for of in [MIDWAY, CLOSEST] {
            let (s, gap, point) = (worst.s[of], worst.gap[of], worst.point[of]);
            assert!(s <= 1e-14 && gap <= 1e-13 && point <= 1e-13, "{family}: s {s:e}, gap {gap:e}, points {point:e}");
        }
    }
}

/// The subtraction that these tests judge by.
#[test]
fn differences_have_digits_of_their_own() {
    // 0.1 as a double is 0.1000000000000000055511151231257827...
    assert!((minus(0.1, "0.1") / 5.551_115_123_125_783e-18 - 1.0).abs() < 1e-15);
    assert!((minus(-1e9, "-1000000000.0000000000000000001") / 1e-19 - 1.0).abs() < 1e-15);
    assert_eq!(minus(0.0, "-2.5e-06"), 2.5e-6);
    assert_eq!(minus(2.5e-6, "0.0"), 2.5e-6);
    assert_eq!(minus(1.5, "1.5"), 0.0);
}
