//! Every back end and formulation against solutions known to 40 digits.

mod support;

use potential_particles::{BackEnd, Contact, Flags, Formulation, Kind, Settings, detect};
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
        if midway {
            self.point = self.point.max((contact.branch_b - vector(&truth.x4)).norm() / size);
        } else if overlapping {
            let p2 = contact.point_on_b - pair.b.pose().position - vector(truth.p2.as_ref().expect("not slack"));
            self.point = self.point.max(p2.norm() / size);
        }
        if midway && contact.formulation == Formulation::Midway && !(truth.ok1 && truth.ok2) && overlapping {
            let asked_closest = contact.flags.contains(Flags::SLACK);
            let _ = asked_closest;
        }
    }
}

fn table(title: &str, families: &BTreeMap<String, Worst>) {
    println!(
        "\n{title}\n{:16} {:>5} {:>9} {:>9} {:>9} {:>9} {:>5} {:>6} {:>5} {:>5} flags",
        "family", "pairs", "s error", "point", "gap", "err/gap", "iter", "mean", "wrong", "fail"
    );
    for (family, w) in families {
        println!(
            "{family:16} {:5} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:5} {:6.1} {:5} {:5} {:#b}",
            w.pairs,
            w.s,
            w.point,
            w.gap,
            w.beyond_gap,
            w.iterations,
            f64::from(w.total_iterations) / w.pairs as f64,
            w.wrong_side,
            w.failures,
            w.flags
        );
    }
}

fn check(back_end: BackEnd, formulation: Formulation) {
    let families = sweep(back_end, formulation);
    table(&format!("{back_end:?} {formulation:?}"), &families);
    for (family, worst) in &families {
        assert_eq!(worst.failures, 0, "{family}: failures");
        assert_eq!(worst.wrong_side, 0, "{family}: pairs on the wrong side of contact");
        assert!(worst.beyond_gap <= 1.0, "{family}: an error of s exceeds its gap {} times", worst.beyond_gap);
    }
}

#[test]
fn fast_midway() {
    check(BackEnd::Fast, Formulation::Midway);
}

#[test]
fn fast_closest() {
    check(BackEnd::Fast, Formulation::Closest);
}

#[test]
fn conic_midway() {
    check(BackEnd::Conic, Formulation::Midway);
}

#[test]
fn conic_closest() {
    check(BackEnd::Conic, Formulation::Closest);
}
