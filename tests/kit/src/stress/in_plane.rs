//! Particles in the plane against 32 digits, in which sine and cosine of an angle are those of the angle as given.

use crate::random::Random;
use crate::stress::cases::stream;
use crate::stress::ledger::{Fault, Finding, Ledger};
use crate::stress::reference::{Body, Optimum, Wanted, optimum};
use crate::wide::{Wide, Wide3};
use nalgebra::{Vector2, Vector3};
use potential_particles::{Contact, Flags, Formulation, Kind, Particle, ParticleError, Pose, Settings, detect};
use serde::Serialize;

const EPS: f64 = f64::EPSILON;

/// A gap that says nothing where it leaves open whether they touch.
const MOST_GAP: f64 = 1e-2;

#[derive(Clone, Copy, Debug, Serialize)]
struct Place {
    position: [f64; 2],
    angle: f64,
}

#[derive(Serialize)]
struct Shape {
    lines: Vec<[f64; 3]>,
    r: f64,
    k: f64,
    #[serde(rename = "R")]
    shadow_radius: f64,
}

#[derive(Serialize)]
struct Written {
    #[serde(rename = "A")]
    a: Shape,
    #[serde(rename = "B")]
    b: Shape,
    #[serde(rename = "a")]
    at_a: Place,
    #[serde(rename = "b")]
    at_b: Place,
    settings: String,
    answer: String,
}

const KINDS: [&str; 5] = ["rectangles", "regular polygons", "random lines", "slender", "circles"];

/// A rectangle about the origin.
fn rectangle(width: f64, height: f64, r: f64, k: f64) -> Result<Particle, ParticleError> {
    let (x, y) = (0.5 * width, 0.5 * height);
    Particle::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]], r, k)
}

/// The first corner lies on the x axis.
fn regular_polygon(sides: usize, radius: f64, r: f64, k: f64) -> Result<Particle, ParticleError> {
    let corner = |i: usize| (std::f64::consts::TAU * i as f64 / sides as f64).sin_cos();
    let corners: Vec<[f64; 2]> = (0..sides).map(corner).map(|(sin, cos)| [radius * cos, radius * sin]).collect();
    Particle::polygon(&corners, r, k)
}

fn particle(kind: usize, random: &mut Random) -> Particle {
    loop {
        let size = random.power(-1.0, 1.0);
        let k = match random.whole(0, 6) {
            0 | 1 => 0.0,
            2 => random.power(-14.0, -4.0),
            3 => 1.0 - random.power(-16.0, 0.0),
            _ => random.power(-4.0, -0.1),
        };
        let rounding = random.power(-9.0, -0.35);
        let made = match kind {
            0 => {
                let (width, height) = (size, size * random.power(-0.7, 0.7));
                rectangle(width, height, 0.5 * rounding * width.min(height), k)
            }
            1 => regular_polygon(random.whole(3, 13), size, 0.4 * rounding * size, k),
            2 => {
                let count = random.whole(3, 12);
                let r = rounding * 0.5 * size;
                let lines: Vec<[f64; 3]> = (0..count)
                    .map(|_| {
                        let angle = std::f64::consts::TAU * random.uniform();
                        let length = if random.uniform() < 0.2 { random.power(-2.0, 2.0) } else { 1.0 };
                        let offset = size * (0.6 + 0.4 * random.uniform()) - r;
                        [length * angle.cos(), length * angle.sin(), length * offset]
                    })
                    .collect();
                Particle::in_plane(&lines, r, k, size * random.power(-0.3, 0.3))
            }
            3 => {
                let height = size * random.power(-3.0, -1.0);
                rectangle(size, height, 0.5 * rounding * height, k)
            }
            _ => Particle::in_plane(&[], 0.0, 1.0, size),
        };
        if let Ok(particle) = made {
            return particle;
        }
    }
}

/// A point of the boundary and the outward normal there.
fn touched(particle: &Particle, random: &mut Random) -> (Vector2<f64>, Vector2<f64>) {
    let lines: Vec<Vector2<f64>> = particle.planes().map(|plane| plane.normal.xy()).collect();
    let corners: Vec<Vector2<f64>> = particle.bounding_corners().iter().map(|corner| corner.xy()).collect();
    let angle = std::f64::consts::TAU * random.uniform();
    let way = match random.whole(0, 4) {
        0 | 1 if !lines.is_empty() => lines[random.whole(0, lines.len())],
        2 if !corners.is_empty() => corners[random.whole(0, corners.len())],
        _ => Vector2::new(angle.cos(), angle.sin()),
    };
    let way = way.try_normalize(0.0).unwrap_or_else(Vector2::x);
    let to = particle.surface_distance(&Vector3::zeros(), &way.push(0.0)).unwrap_or(particle.bounding_radius());
    let point = to * way;
    (point, particle.gradient(&point.push(0.0)).xy().try_normalize(0.0).unwrap_or(way))
}

fn turned(v: &Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// Surface point on surface point with opposite normals, then into each other or apart; or anywhere.
fn places(a: &Particle, b: &Particle, random: &mut Random) -> [Place; 2] {
    let small = a.bounding_radius().min(b.bounding_radius());
    let turns = if random.uniform() < 0.2 { random.whole(0, 1_000_000) as f64 } else { 0.0 };
    let angle_a = match random.whole(0, 4) {
        0 => 0.0,
        1 => std::f64::consts::FRAC_PI_2 * random.whole(0, 4) as f64,
        _ => std::f64::consts::TAU * (random.uniform() + turns),
    };
    let ((on_a, out_a), (on_b, out_b)) = (touched(a, random), touched(b, random));
    let normal = turned(&out_a, angle_a);
    let tilt = [0.0, 1e-16, 1e-15, 1e-12, 1e-9, 1e-6][random.whole(0, 6)] * random.normal();
    let free = random.uniform() < 0.2;
    let angle_b = if free {
        std::f64::consts::TAU * random.uniform()
    } else {
        (-normal.y).atan2(-normal.x) - out_b.y.atan2(out_b.x) + tilt
    };
    let sign = if random.uniform() < 0.7 { -1.0 } else { 1.0 };
    let apart = sign * small * random.power(-15.0, 0.0);
    let aside = if random.uniform() < 0.5 { small * (random.uniform() - 0.5) } else { 0.0 };
    let relative =
        turned(&on_a, angle_a) - turned(&on_b, angle_b) + apart * normal + aside * Vector2::new(-normal.y, normal.x);
    let direction = std::f64::consts::TAU * random.uniform();
    let far = match random.whole(0, 3) {
        0 => 0.0,
        1 => small * random.power(-1.0, 1.0),
        _ => small * random.power(3.0, 6.0),
    };
    let origin = far * Vector2::new(direction.cos(), direction.sin());
    [Place { position: origin.into(), angle: angle_a }, Place { position: (origin + relative).into(), angle: angle_b }]
}

/// π/2 to three doubles.
const QUARTER: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Terms of the series: the last is below 1e-40 for angles up to π/4.
const TERMS: i32 = 36;

/// Sine and cosine of an angle as given, to 32 digits: reduced by quarters of a turn, then summed.
pub fn sine_and_cosine(angle: f64) -> (Wide, Wide) {
    let quarters = (angle / QUARTER[0]).round();
    let rest = QUARTER.iter().fold(Wide::from(angle), |rest, part| rest - Wide::product(quarters, *part));
    let (mut sine, mut cosine, mut term) = (Wide::ZERO, Wide::ZERO, Wide::ONE);
    for n in 0..TERMS {
        let sum = if n % 2 == 0 { &mut cosine } else { &mut sine };
        *sum += if n % 4 < 2 { term } else { -term };
        term = term * rest / Wide::from(f64::from(n + 1));
    }
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

fn body<'a>(particle: &'a Particle, at: &Place, origin: &Place) -> Body<'a> {
    let (sine, cosine) = sine_and_cosine(at.angle);
    let rows = [
        Wide3([cosine, -sine, Wide::ZERO]),
        Wide3([sine, cosine, Wide::ZERO]),
        Wide3([Wide::ZERO, Wide::ZERO, Wide::ONE]),
    ];
    let raised = |p: [f64; 2]| [p[0], p[1], 0.0];
    Body::turned(particle, raised(at.position), rows, raised(origin.position))
}

/// A pair at its places.
struct Case {
    particles: [Particle; 2],
    at: [Place; 2],
    settings: Settings,
    family: String,
}

impl Case {
    fn of(seed: u64, index: u64) -> Self {
        let mut random = stream(seed, 16, index);
        let kinds = [random.whole(0, KINDS.len()), random.whole(0, KINDS.len())];
        let particles = kinds.map(|kind| particle(kind, &mut random));
        let at = places(&particles[0], &particles[1], &mut random);
        let default = Settings::default().with_solve_separated(true);
        let (settings, name) = match random.whole(0, 4) {
            0 => (default.with_formulation(Formulation::Closest).with_weight_on_a(0.0), "closest"),
            1 => (default.with_gap_tolerance(1e-14), "midway, to 1e-14"),
            2 => {
                let closest = Formulation::Closest;
                (default.with_formulation(closest).with_weight_on_a(0.0).with_gap_tolerance(1e-14), "closest, to 1e-14")
            }
            _ => (default, "midway"),
        };
        let flat = particles.iter().any(|p| p.sphericity() == 0.0);
        let family = format!("{} | {name}", if flat { "k = 0" } else { "k > 0" });
        Self { particles, at, settings, family }
    }

    fn written(&self, answer: String) -> serde_json::Value {
        let shape = |p: &Particle| Shape {
            lines: p.planes().map(|line| [line.normal.x, line.normal.y, line.offset]).collect(),
            r: p.rounding_radius(),
            k: p.sphericity(),
            shadow_radius: p.shadow_radius(),
        };
        let [a, b] = &self.particles;
        let [at_a, at_b] = self.at;
        let settings = format!("{:?}", self.settings);
        serde_json::to_value(Written { a: shape(a), b: shape(b), at_a, at_b, settings, answer }).unwrap_or_default()
    }

    /// k as small as the solver may raise it to, for the points of flat sides.
    fn levels(&self) -> Vec<f64> {
        let default = Settings::default().flat_regularisation;
        if self.settings.gap_tolerance < 1e-13 {
            vec![1e-5 * self.settings.gap_tolerance, default]
        } else {
            vec![default]
        }
    }
}

/// Case `index`: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let case = Case::of(seed, index);
    let [a, b] = &case.particles;
    let pose = |p: &Place| Pose::in_plane(p.position, p.angle).expect("finite");
    let [at_a, at_b] = case.at.each_ref().map(pose);
    *ledger.families.entry(case.family.clone()).or_default() += 1;
    ledger.judged += 1;
    let mut faults = Vec::new();
    let answer = detect(a, &at_a, b, &at_b, &case.settings, None);
    match &answer {
        Ok(contact) => {
            well_formed(contact, &mut faults);
            if !contact.flags.contains(Flags::REJECTED) && contact.s.is_finite() {
                judge(&case, contact, &mut faults, ledger);
            }
        }
        Err(error) => faults.push((Fault::NotSolved, error.to_string())),
    }
    for (fault, detail) in faults {
        let planes = a.plane_count() + b.plane_count();
        let (family, written) = (case.family.clone(), case.written(format!("{answer:?}")));
        ledger.find(Finding { fault, family, seed, index, detail, case: written, planes });
    }
}

fn well_formed(c: &Contact, faults: &mut Vec<(Fault, String)>) {
    let finite = |v: &Vector3<f64>| v.iter().all(|c| c.is_finite());
    let overlapping = c.kind == Kind::Overlapping;
    let fine = c.s.is_finite()
        && c.gap >= 0.0
        && c.gap.is_finite()
        && c.point_bound >= 0.0
        && (c.normal.norm() - 1.0).abs() < 1e-14
        && [c.point, c.branch_a, c.branch_b].iter().all(finite)
        && [c.point, c.normal, c.branch_a, c.branch_b].iter().all(|v| v.z == 0.0)
        && overlapping == (c.s < 1.0)
        && (c.s_b.is_nan() || overlapping == (c.s_b < 1.0))
        && overlapping == c.overlap.is_finite()
        && overlapping == finite(&c.point_on_a);
    if !fine {
        faults.push((Fault::Malformed, format!("{c:?}")));
    }
    // Either scale of closest tells whether they touch.
    let is_open = |s: f64| !((s - 1.0).abs() >= c.gap);
    if c.gap > MOST_GAP && is_open(c.s) && is_open(c.s_b) {
        faults.push((Fault::SaysNothing, format!("s={:e}, {:e} ± {:e}", c.s, c.s_b, c.gap)));
    }
}

fn judge(case: &Case, c: &Contact, faults: &mut Vec<(Fault, String)>, ledger: &mut Ledger) {
    let [a, b] = &case.particles;
    let bodies = [body(a, &case.at[0], &case.at[1]), body(b, &case.at[1], &case.at[1])];
    let lambda = c.weight / (1.0 - c.weight);
    let closest = c.formulation == Formulation::Closest;
    // With weight 0 on A the contact point is P2, on B.
    let wanted = if closest { Wanted::OnB } else { Wanted::Midway };
    let start = c.branch_b;
    let mut settled = true;
    for (wanted, s) in [(wanted, c.s), (Wanted::OnA, c.s_b)].into_iter().take(if closest { 2 } else { 1 }) {
        let from = if wanted == Wanted::OnA && c.kind == Kind::Overlapping {
            c.point_on_a - Vector2::from(case.at[1].position).push(0.0)
        } else {
            start
        };
        let Some(truth) = optimum(&bodies[0], &bodies[1], wanted, &from, lambda) else {
            settled = false;
            continue;
        };
        let off = (s - truth.most).max(truth.least - s);
        if !(off <= c.gap + EPS * s) {
            let detail = format!(
                "{wanted:?}: s={s:e} ± {:e}, truth {:e} (± {:e}): {:.3e} gaps off",
                c.gap,
                truth.most,
                truth.most - truth.least,
                off / c.gap
            );
            faults.push((Fault::Gap, detail));
        }
        settled &= is_settled(&truth, c.gap);
        let known = c.gap.min(MOST_GAP);
        if c.kind == Kind::Separated && truth.most < 1.0 - known {
            faults.push((Fault::LostContact, format!("s={s:e} ± {:e}, truth {:e}", c.gap, truth.most)));
        }
        if c.kind == Kind::Overlapping && truth.least > 1.0 + known {
            faults.push((Fault::InventedContact, format!("s={s:e} ± {:e}, truth {:e}", c.gap, truth.least)));
        }
    }
    ledger.unsettled += u64::from(!settled);
    // The point of flat sides is that of the particles as they are regularised.
    let digits = 8.0 * EPS * start.norm();
    let mut least = f64::INFINITY;
    for level in case.levels() {
        let rounder = [0, 1].map(|i| bodies[i].rounder(level / case.particles[i].bounding_radius().powi(2)));
        let Some(truth) = optimum(&rounder[0], &rounder[1], wanted, &start, lambda) else { return };
        if !is_known(&truth, c) {
            return;
        }
        let off = truth.x.minus(&Wide3::from(start)).norm().f64();
        if off <= c.point_bound + truth.doubt + digits {
            return;
        }
        least = least.min(off);
    }
    faults.push((
        Fault::PointBound,
        format!("{least:e} off, bound {:e}, {:.2e} of it", c.point_bound, least / c.point_bound),
    ));
}

/// Whether the interval of an optimum is narrow enough to judge an answer with this gap, but for the last digit of s.
fn is_settled(truth: &Optimum, gap: f64) -> bool {
    truth.most - truth.least <= 0.1 * gap + EPS * truth.most
}

/// Whether 32 digits tell the point well enough to judge it.
fn is_known(truth: &Optimum, c: &Contact) -> bool {
    is_settled(truth, c.gap) && truth.doubt < 0.05 * c.point_bound
}
