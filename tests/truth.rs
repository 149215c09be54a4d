//! Every back end and formulation against solutions known to 40 digits.

use kit::truth;
use kit::truth::{distance, minus, number, pairs, vector};
use potential_particles::{BackEnd, Contact, Formulation, Kind, Role, Settings, closest_point, detect};
use std::collections::BTreeMap;

/// Worst figures of one family.
#[derive(Default)]
struct Worst {
    pairs: usize,
    s: f64,
    point: f64,
    iterations: u32,
    total_iterations: u32,
    gap: f64,
    beyond_gap: f64,
    beyond_bound: f64,
    gap_over_error: Vec<f64>,
    bound_over_error: Vec<f64>,
    wrong_side: usize,
    failures: usize,
    flags: u32,
}

fn sweep(back_end: BackEnd, formulation: Formulation) -> BTreeMap<String, Worst> {
    let settings = Settings::default().with_back_end(back_end).with_formulation(formulation).with_solve_separated(true);
    let mut families: BTreeMap<String, Worst> = BTreeMap::new();
    for (line, pair) in pairs().iter().enumerate() {
        let (a, b) = (pair.shape_a.particle(), pair.shape_b.particle());
        let (pose_a, pose_b) = (pair.a.pose(), pair.b.pose());
        let worst = families.entry(pair.family.clone()).or_default();
        worst.pairs += 1;
        let contact = match detect(&a, &pose_a, &b, &pose_b, &settings, None) {
            Ok(contact) => contact,
            Err(error) => {
                worst.failures += 1;
                println!("pair {} ({}): {error}", line + 1, pair.family);
                continue;
            }
        };
        worst.record(&contact, pair, a.bounding_radius().min(b.bounding_radius()), line);
    }
    families
}

impl Worst {
    fn record(&mut self, contact: &Contact, pair: &truth::Pair, size: f64, line: usize) {
        let truth = &pair.truth;
        let midway = contact.formulation == Formulation::Midway;
        let s = if midway { number(&truth.s4) } else { number(truth.s_a.as_ref().expect("not slack")) };
        let error = (contact.s - s).abs();
        self.s = self.s.max(error / s);
        self.iterations = self.iterations.max(contact.iterations);
        self.total_iterations += contact.iterations;
        self.gap = self.gap.max(contact.gap / s);
        self.beyond_gap = self.beyond_gap.max(error / contact.gap);
        self.flags |= contact.flags.bits();
        if error > contact.gap {
            println!("pair {} ({}): s = {s} off by {error:e}, gap {:e}", line + 1, pair.family, contact.gap);
        }
        let overlapping = number(&truth.s4) < 1.0;
        if (number(&truth.s4) - 1.0).abs() > 1e-9 && overlapping != (contact.kind == Kind::Overlapping) {
            self.wrong_side += 1;
        }
        let off = if midway {
            (contact.branch_b - vector(&truth.x4)).norm()
        } else if overlapping {
            // Through the world frame, with the rounding of the position of B.
            let position = *pair.b.pose().position();
            let p2 = contact.point_on_b - position - vector(truth.p2.as_ref().expect("not slack"));
            (p2.norm() - f64::EPSILON * position.norm()).max(0.0)
        } else {
            return;
        };
        self.point = self.point.max(off / size);
        self.beyond_bound = self.beyond_bound.max(off / contact.point_bound);
        if off > contact.point_bound {
            println!("pair {} ({}): point off by {off:e}, bound {:e}", line + 1, pair.family, contact.point_bound);
        }
        self.gap_over_error.push(contact.gap / error.max(f64::EPSILON * s));
        self.bound_over_error.push(contact.point_bound / off.max(f64::EPSILON * size));
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

fn table(title: &str, families: &BTreeMap<String, Worst>) {
    println!(
        "\n{title}\n{:16} {:>5} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>5} {:>6} {:>5} {:>5} flags",
        "family",
        "pairs",
        "s error",
        "point",
        "gap",
        "err/gap",
        "off/bound",
        "gap/err",
        "bnd/off",
        "iter",
        "mean",
        "wrong",
        "fail"
    );
    for (family, w) in families {
        println!(
            "{family:16} {:5} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:8.0e} {:8.0e} {:5} {:6.1} {:5} {:5} {:#b}",
            w.pairs,
            w.s,
            w.point,
            w.gap,
            w.beyond_gap,
            w.beyond_bound,
            median(&w.gap_over_error),
            median(&w.bound_over_error),
            w.iterations,
            f64::from(w.total_iterations) / w.pairs as f64,
            w.wrong_side,
            w.failures,
            w.flags
        );
    }
}

fn check(back_end: BackEnd, formulation: Formulation) -> BTreeMap<String, Worst> {
    let families = sweep(back_end, formulation);
    table(&format!("{back_end:?} {formulation:?}"), &families);
    for (family, worst) in &families {
        assert_eq!(worst.failures, 0, "{family}: failures");
        assert_eq!(worst.wrong_side, 0, "{family}: pairs on the wrong side of contact");
        assert!(worst.beyond_gap <= 1.0, "{family}: an error of s exceeds its gap {} times", worst.beyond_gap);
        assert!(worst.beyond_bound <= 1.0, "{family}: a point lies {} times beyond its bound", worst.beyond_bound);
    }
    families
}

/// The bounds must say something: over all pairs, the median bound is within 1000 of the true error.
fn check_not_vacuous(families: &BTreeMap<String, Worst>) {
    let all = |of: fn(&Worst) -> &Vec<f64>| families.values().flat_map(|w| of(w).iter().copied()).collect::<Vec<_>>();
    let (gap, bound) = (median(&all(|w| &w.gap_over_error)), median(&all(|w| &w.bound_over_error)));
    println!("median over all pairs: gap / error {gap:.0}, bound / distance {bound:.0}");
    assert!(gap < 1000.0 && bound < 1000.0);
}

#[test]
fn fast_midway() {
    check_not_vacuous(&check(BackEnd::Fast, Formulation::Midway));
}

#[test]
fn fast_closest() {
    check_not_vacuous(&check(BackEnd::Fast, Formulation::Closest));
}

#[test]
fn cone_program_midway() {
    check(BackEnd::ConeProgram, Formulation::Midway);
}

#[test]
fn cone_program_closest() {
    check(BackEnd::ConeProgram, Formulation::Closest);
}

/// Worst figures of one family for one gap_tolerance: s over max(s*, 1), points over the smaller shadow radius.
#[derive(Default)]
struct Accuracy {
    pairs: usize,
    s: [f64; 2],
    gap: [f64; 2],
    point: [f64; 2],
}

const MIDWAY: usize = 0;
const CLOSEST: usize = 1;

impl Accuracy {
    fn record(&mut self, formulation: usize, (s, gap): (f64, f64), truth: &str) {
        let (error, unit) = (minus(s, truth).abs(), number(truth).max(1.0));
        assert!(error <= gap, "s = {s} is {error:e} off, its gap is {gap:e}");
        self.s[formulation] = self.s[formulation].max(error / unit);
        self.gap[formulation] = self.gap[formulation].max(gap / unit);
    }
}

/// Both formulations, every pair, at one tolerance.
fn accuracy(gap_tolerance: f64) -> BTreeMap<String, Accuracy> {
    let midway = Settings::default().with_gap_tolerance(gap_tolerance).with_solve_separated(true);
    let closest = midway.with_formulation(Formulation::Closest);
    let mut families: BTreeMap<String, Accuracy> = BTreeMap::new();
    for pair in &pairs() {
        let (a, b, truth) = (pair.shape_a.particle(), pair.shape_b.particle(), &pair.truth);
        let (pose_a, pose_b) = (pair.a.pose(), pair.b.pose());
        let unit = pair.shape_a.shadow_radius.min(pair.shape_b.shadow_radius);
        let worst = families.entry(pair.family.clone()).or_default();
        worst.pairs += 1;
        let solve = |settings| detect(&a, &pose_a, &b, &pose_b, settings, None).expect("an answer");

        let contact = solve(&midway);
        worst.record(MIDWAY, (contact.s, contact.gap), &truth.s4);
        let off = distance(&contact.branch_b, &truth.x4);
        assert!(off <= contact.point_bound, "a point is {off:e} off, its bound is {:e}", contact.point_bound);
        worst.point[MIDWAY] = worst.point[MIDWAY].max(off / unit);

        let halves = [(truth.ok1, Role::A, &truth.s_b, &truth.p1), (truth.ok2, Role::B, &truth.s_a, &truth.p2)];
        for (known, on, s, point) in halves {
            let found = closest_point(&a, &pose_a, &b, &pose_b, on, &closest).expect("an answer");
            assert_eq!(found.is_some(), known, "a slack constraint");
            let (Some(found), Some(s), Some(point)) = (found, s, point) else { continue };
            worst.record(CLOSEST, (found.s, found.gap), s);
            let off = distance(&found.branch_b, point);
            assert!(off <= found.point_bound, "a point is {off:e} off, its bound is {:e}", found.point_bound);
            worst.point[CLOSEST] = worst.point[CLOSEST].max(off / unit);
        }
        if let (true, true, Some(s_a), Some(s_b)) = (truth.ok1, truth.ok2, &truth.s_a, &truth.s_b) {
            let contact = solve(&closest);
            worst.record(CLOSEST, (contact.s, contact.gap), s_a);
            worst.record(CLOSEST, (contact.s_b, contact.gap), s_b);
        }
    }
    println!(
        "\ngap_tolerance = {gap_tolerance:e}: worst of each family, midway and closest; the table of docs/pairs.md"
    );
    println!("| family | pairs | error of s | | gap | | point | |\n|---|---|---|---|---|---|---|---|");
    for (family, Accuracy { pairs, s, gap, point }) in &families {
        let columns = [s, gap, point].map(|of| format!("{:.1e} | {:.1e}", of[MIDWAY], of[CLOSEST]));
        println!("| {family} | {pairs} | {} |", columns.join(" | "));
    }
    families
}

/// With default settings the bounds hold; how wide they are is printed.
#[test]
fn every_error_is_within_its_bound() {
    accuracy(Settings::default().gap_tolerance);
}

#[test]
fn fourteen_digits_for_the_asking() {
    for (family, worst) in accuracy(1e-14) {
        for formulation in [MIDWAY, CLOSEST] {
            let (s, gap, point) = (worst.s[formulation], worst.gap[formulation], worst.point[formulation]);
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
