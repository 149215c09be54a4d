//! Every back end and formulation against solutions known to 40 digits.

mod support;

use potential_particles::{BackEnd, Contact, Formulation, Kind, Settings, detect};
use std::collections::BTreeMap;
use support::{number, pairs, vector};

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
    let settings = Settings { back_end, formulation, solve_separated: true, ..Settings::default() };
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
    fn record(&mut self, contact: &Contact, pair: &support::Pair, size: f64, line: usize) {
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
fn conic_midway() {
    check(BackEnd::Conic, Formulation::Midway);
}

#[test]
fn conic_closest() {
    check(BackEnd::Conic, Formulation::Closest);
}
