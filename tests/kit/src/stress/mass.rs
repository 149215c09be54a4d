//! Random particles whose volume, centroid and inertia are held against closed forms, or against their own at a far
//! finer tolerance: an error above the estimate of it is a failure, whatever its size.

use crate::random::Random;
use crate::stress::cases::stream;
use crate::stress::shapes::{Hull, Recipe, Sphericity, particle};
use indicatif::ProgressBar;
use nalgebra::{Matrix2, Matrix3, Rotation3, SMatrix, SVector, Vector2, Vector3};
use potential_particles::{Particle, Plane, SurfaceMesh};
use serde::Serialize;
use std::f64::consts::PI;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

/// Tolerances that are asked for, and the one of the reference; that of particles of more planes than [`FEW`] is
/// coarser.
const ASKED: [f64; 3] = [1e-3, 1e-4, 1e-6];
const FINE: f64 = 1e-8;
const FINE_OF_MANY: f64 = 1e-7;
const FEW: usize = 40;

/// Rounding of the answers and of the closed forms, relative.
const ROUNDING: f64 = 1e-13;

/// What was found.
#[derive(Default, Serialize)]
pub struct Tally {
    pub particles: u64,
    /// Answers whose error is above the estimate, by family.
    pub too_small: std::collections::BTreeMap<&'static str, u64>,
    /// Answers of at most [`FEW`] planes whose estimate is above the tolerance.
    pub not_reached: u64,
    /// The largest error over estimate.
    pub worst: f64,
    /// The longest call at the tolerances asked for, s.
    pub slowest: f64,
    /// The first failures: seed, index and numbers.
    pub found: Vec<String>,
}

/// Failures that are described.
const DESCRIBED: usize = 20;

/// Volume (or area), centroid, ∫x xᵀ and the estimated error.
struct Moments<const D: usize> {
    volume: f64,
    centroid: SVector<f64, D>,
    second: SMatrix<f64, D, D>,
    error: f64,
}

impl Tally {
    pub fn failures(&self) -> u64 {
        self.too_small.values().sum()
    }

    pub fn print(&self) {
        if self.particles > 0 {
            let Self { particles, not_reached, worst, slowest, .. } = self;
            println!(
                "mass properties of {particles} particles: {} with too small an estimate {:?}, {not_reached} above the tolerance, \
                 error over estimate at most {worst:.2}, {:.0} ms at most",
                self.failures(),
                self.too_small,
                1e3 * slowest
            );
            self.found.iter().for_each(|failure| println!("  {failure}"));
        }
    }

    fn merge(&mut self, other: Self) {
        self.particles += other.particles;
        self.not_reached += other.not_reached;
        self.worst = self.worst.max(other.worst);
        self.slowest = self.slowest.max(other.slowest);
        for (family, count) in other.too_small {
            *self.too_small.entry(family).or_default() += count;
        }
        let room = DESCRIBED.saturating_sub(self.found.len());
        self.found.extend(other.found.into_iter().take(room));
    }

    /// Holds one answer against the reference, whose own estimate counts, too.
    fn judge<const D: usize>(&mut self, found: &Moments<D>, reference: &Moments<D>, case: &Case) {
        let off = difference(found, reference);
        let allowed = found.error + reference.error + ROUNDING;
        // Also for NaN.
        if !(off <= allowed) {
            *self.too_small.entry(case.family).or_default() += 1;
            self.found.push(format!(
                "seed {} index {}, {}, {} planes, asked {:e}: off by {off:e}, estimated {:e} and {:e}",
                case.seed, case.index, case.family, case.planes, case.asked, found.error, reference.error
            ));
        }
        self.worst = self.worst.max(off / allowed);
        self.not_reached += u64::from(case.planes <= FEW && !(found.error <= case.asked));
    }
}

struct Case {
    seed: u64,
    index: u64,
    family: &'static str,
    planes: usize,
    asked: f64,
}

/// The largest relative difference of volumes, centroids and second moments, in the measure in which the estimates are
/// documented: in units of the radii of gyration of the reference.
fn difference<const D: usize>(found: &Moments<D>, reference: &Moments<D>) -> f64 {
    let second = reference.second / reference.volume;
    let root = second.cholesky().and_then(|root| root.l().solve_lower_triangular(&SMatrix::identity()));
    let Some(unscaled) = root else { return f64::NAN };
    let volume = (found.volume / reference.volume - 1.0).abs();
    let centroid = (unscaled * (found.centroid - reference.centroid)).norm();
    let change = unscaled * (found.second - reference.second) * unscaled.transpose() / reference.volume;
    volume.max(centroid).max(change.norm())
}

pub fn run(seed: u64, count: u64, threads: usize, stop: &AtomicBool, progress: &ProgressBar) -> Tally {
    let total = Mutex::new(Tally::default());
    let next = AtomicU64::new(0);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count || stop.load(Ordering::Relaxed) {
                        break;
                    }
                    let tally = one(seed, index);
                    total.lock().expect("no thread panics while it holds the sum").merge(tally);
                    progress.inc(1);
                }
            });
        }
    });
    total.into_inner().expect("no thread panics while it holds the sum")
}

/// Judges one particle again and prints what is found; whether it passed.
pub fn replay(seed: u64, index: u64) -> bool {
    let tally = one(seed, index);
    tally.print();
    tally.failures() == 0
}

/// One particle at every tolerance.
pub fn one(seed: u64, index: u64) -> Tally {
    let mut random = stream(seed, 11, index);
    match index % 8 {
        0 => rounded_box(seed, index, &mut random),
        1 => ellipsoid(seed, index, &mut random),
        2 => plane_closed(seed, index, &mut random),
        3 => plane_any(seed, index, &mut random),
        _ => any(seed, index, &mut random),
    }
}

fn of_space(particle: &Particle, tolerance: f64) -> Moments<3> {
    let found = particle.mass_properties(tolerance).unwrap();
    let second = Matrix3::from_diagonal_element(0.5 * found.inertia.trace()) - found.inertia;
    Moments { volume: found.volume, centroid: found.centroid, second, error: found.error }
}

fn of_plane(particle: &Particle, tolerance: f64) -> Moments<2> {
    let found = particle.mass_properties(tolerance).unwrap();
    let inertia = found.inertia;
    let second = Matrix2::new(inertia.m22, -inertia.m12, -inertia.m12, inertia.m11);
    Moments { volume: found.volume, centroid: found.centroid.xy(), second, error: found.error }
}

fn compared<const D: usize>(
    (seed, index, family, planes): (u64, u64, &'static str, usize),
    reference: Option<Moments<D>>,
    of: impl Fn(f64) -> Moments<D>,
) -> Tally {
    let mut tally = Tally { particles: 1, ..Tally::default() };
    let reference = reference.unwrap_or_else(|| of(if planes > FEW { FINE_OF_MANY } else { FINE }));
    for asked in ASKED {
        let begin = Instant::now();
        let found = of(asked);
        tally.slowest = tally.slowest.max(begin.elapsed().as_secs_f64());
        tally.judge(&found, &reference, &Case { seed, index, family, planes, asked });
    }
    tally
}

/// Any shape: a hull of `shapes` with some of what makes integration hard.
fn any(seed: u64, index: u64, random: &mut Random) -> Tally {
    let made = loop {
        let recipe = Recipe {
            hull: Hull::Any,
            rounding: (-9.0, -0.3),
            sphericity: if random.uniform() < 0.5 { Sphericity::Flat } else { Sphericity::Between(-13.0, 0.0) },
            size: (-1.0, 1.0),
        };
        let base = particle(&recipe, random);
        let mut planes: Vec<Plane> = base.planes().collect();
        let (r, k, shadow) = (base.rounding_radius(), base.sphericity(), base.shadow_radius());
        if !planes.is_empty() {
            altered(&mut planes, base.bounding_radius(), random);
        }
        if let Ok(particle) = Particle::new(&planes, r, k, shadow) {
            break particle;
        }
    };
    let planes = made.plane_count();
    compared((seed, index, "any shape", planes), None, |tolerance| of_space(&made, tolerance))
}

fn altered(planes: &mut Vec<Plane>, radius: f64, random: &mut Random) {
    // Corners cut off, little or much.
    if random.uniform() < 0.4 {
        for _ in 0..random.whole(1, 6) {
            let normal = random.direction();
            let Ok(here) = Particle::new(planes, 1e-6 * radius, 0.0, 1.0) else { break };
            let Some(reach) = here.support(&normal) else { break };
            planes.push(Plane { normal, offset: reach * (1.0 - random.power(-6.0, -0.5)) });
        }
    }
    // Planes nearly given twice.
    if random.uniform() < 0.3 {
        for _ in 0..random.whole(1, 6) {
            let Plane { normal, offset } = planes[random.whole(0, planes.len())];
            let tilt = if random.uniform() < 0.3 { 0.0 } else { random.power(-16.0, -1.0) };
            let shift = if random.uniform() < 0.3 { 0.0 } else { random.power(-16.0, -2.0) };
            let normal = normal + tilt * normal.norm() * random.direction();
            planes.push(Plane { normal, offset: offset * (1.0 - shift) });
        }
    }
    // A centre far from the centroid.
    if random.uniform() < 0.4 {
        let direction = random.direction();
        let along = |plane: &Plane| plane.normal.dot(&direction) / plane.offset;
        let most = planes.iter().map(along).fold(0.0, f64::max);
        if most > 0.0 {
            let way = (1.0 - random.power(-6.0, -0.1)) / most * direction;
            planes.iter_mut().for_each(|plane| plane.offset -= plane.normal.dot(&way));
        }
    }
    // Normals of any length.
    if random.uniform() < 0.3 {
        for plane in planes {
            let factor = random.power(-2.0, 2.0);
            *plane = Plane { normal: factor * plane.normal, offset: factor * plane.offset };
        }
    }
}

/// What rounding of its normals and of its moments, when it is turned, does to a body with these half axes.
fn of_turn<const D: usize>(half: &SVector<f64, D>) -> f64 {
    16.0 * f64::EPSILON * (half.max() / half.min()).powi(2)
}

fn turn(random: &mut Random) -> Rotation3<f64> {
    Rotation3::new(PI * random.uniform() * random.direction())
}

/// A box whose edges are rounded by r, about any centre.
fn rounded_box(seed: u64, index: u64, random: &mut Random) -> Tally {
    let half = Vector3::from_fn(|_, _| random.power(-2.0, 1.0));
    let r = half.amin() * if random.uniform() < 0.1 { 1.0 } else { random.power(-9.0, 0.0) };
    let turn = if random.uniform() < 0.2 { Rotation3::identity() } else { turn(random) };
    let far = if random.uniform() < 0.5 { 0.0 } else { 1.0 - random.power(-5.0, 0.0) };
    let centre = turn * (far * half.map(|h| (h - r) * (2.0 * random.uniform() - 1.0)));
    let mut planes = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let normal = turn * Vector3::ith(axis, sign);
            planes.push(Plane { normal, offset: half[axis] - r + normal.dot(&centre) });
        }
    }
    // Planes given twice, with normals of any length, count once.
    if random.uniform() < 0.2 {
        let share = random.power(-2.0, 2.0);
        let again = planes.iter().map(|p| Plane { normal: share * p.normal, offset: share * p.offset });
        planes.extend(again.collect::<Vec<_>>());
    }
    let Ok(made) = Particle::new(&planes, r, 0.0, 1.0) else { return Tally::default() };
    let (volume, second) = steiner::<3>(half.map(|h| h - r), r);
    let second = turn.matrix() * Matrix3::from_diagonal(&second) * turn.matrix().transpose();
    let reference = Moments {
        volume,
        centroid: centre,
        second: second + volume * centre * centre.transpose(),
        error: of_turn(&half),
    };
    compared((seed, index, "rounded box", planes.len()), Some(reference), |tolerance| of_space(&made, tolerance))
}

/// Volume and ∫x_i² of the Minkowski sum of a box with half edges a and a ball: the sum over slabs of the box times
/// parts of a ball (Steiner).
fn steiner<const D: usize>(a: SVector<f64, D>, r: f64) -> (f64, SVector<f64, D>) {
    let (mut volume, mut second) = (0.0, SVector::zeros());
    for outside in 0..1 << D {
        let free = |axis: usize| outside >> axis & 1 == 1;
        let boxed: f64 = (0..D).filter(|&axis| !free(axis)).map(|axis| 2.0 * a[axis]).product();
        // Volume, and integrals of |s| and s² along an axis, of the ball of the dimension that is left.
        let (ball, first, square) = match (0..D).filter(|&axis| free(axis)).count() {
            0 => (1.0, 0.0, 0.0),
            1 => (2.0 * r, r * r, 2.0 * r.powi(3) / 3.0),
            2 => (PI * r * r, 4.0 * r.powi(3) / 3.0, PI * r.powi(4) / 4.0),
            _ => (4.0 * PI * r.powi(3) / 3.0, PI * r.powi(4) / 2.0, 4.0 * PI * r.powi(5) / 15.0),
        };
        volume += boxed * ball;
        for axis in 0..D {
            let a = a[axis];
            second[axis] +=
                boxed * if free(axis) { a * a * ball + 2.0 * a * first + square } else { a * a / 3.0 * ball };
        }
    }
    (volume, second)
}

/// With all offsets 0, planes n and −n give (n·x)²: an ellipsoid; of three equal weights, a sphere.
fn ellipsoid(seed: u64, index: u64, random: &mut Random) -> Tally {
    let turn = turn(random);
    let equal = random.power(-1.0, 1.0);
    let weights = Vector3::from_fn(|_, _| random.power(-1.5, 1.5)).map(|w| if index % 3 == 0 { equal } else { w });
    let k = if random.uniform() < 0.5 { 0.0 } else { random.power(-6.0, 0.0) };
    let (r, shadow) = (random.power(-1.0, 1.0), random.power(-1.0, 1.0));
    let mut planes = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            planes.push(Plane { normal: turn * Vector3::ith(axis, sign * weights[axis]), offset: 0.0 });
        }
    }
    let axes = weights.map(|w| 1.0 / (w * w * (1.0 - k) / (r * r) + k / (shadow * shadow)).sqrt());
    // Planes that are never reached.
    for _ in 0..random.whole(0, 5) {
        planes.push(Plane { normal: random.direction(), offset: axes.amax() * random.power(0.01, 2.0) });
    }
    let Ok(made) = Particle::new(&planes, r, k, shadow) else { return Tally::default() };
    let volume = 4.0 / 3.0 * PI * axes.product();
    let second =
        turn.matrix() * Matrix3::from_diagonal(&axes.map(|a| volume * a * a / 5.0)) * turn.matrix().transpose();
    let reference = Moments { volume, centroid: Vector3::zeros(), second, error: of_turn(&axes) };
    compared((seed, index, "ellipsoid", planes.len()), Some(reference), |tolerance| of_space(&made, tolerance))
}

/// Rounded rectangles of the plane.
fn plane_closed(seed: u64, index: u64, random: &mut Random) -> Tally {
    let half = Vector2::from_fn(|_, _| random.power(-2.0, 1.0));
    let r = half.amin() * random.power(-9.0, 0.0);
    let angle = PI * random.uniform();
    let turn = Matrix2::new(angle.cos(), -angle.sin(), angle.sin(), angle.cos());
    let centre = turn * half.map(|h| (h - r) * (2.0 * random.uniform() - 1.0));
    let mut lines = Vec::new();
    for axis in 0..2 {
        for sign in [1.0, -1.0] {
            let normal = turn * Vector2::ith(axis, sign);
            lines.push([normal.x, normal.y, half[axis] - r + normal.dot(&centre)]);
        }
    }
    let Ok(made) = Particle::in_plane(&lines, r, 0.0, 1.0) else { return Tally::default() };
    let (area, second) = steiner::<2>(half.map(|h| h - r), r);
    let second = turn * Matrix2::from_diagonal(&second) * turn.transpose() + area * centre * centre.transpose();
    let reference = Moments { volume: area, centroid: centre, second, error: of_turn(&half) };
    compared((seed, index, "rounded rectangle", 4), Some(reference), |tolerance| of_plane(&made, tolerance))
}

/// Any particle of the plane.
fn plane_any(seed: u64, index: u64, random: &mut Random) -> Tally {
    let made = loop {
        let half = Vector2::new(random.power(-2.0, 0.0), 1.0);
        let count = random.power(0.5, 1.7) as usize;
        let mut lines = Vec::new();
        for _ in 0..count {
            let angle = 2.0 * PI * random.uniform();
            let normal = Vector2::new(angle.cos(), angle.sin());
            let offset = normal.component_mul(&half).norm() * (0.7 + 0.3 * random.uniform());
            lines.push((normal, offset));
        }
        // Nearly given twice.
        if random.uniform() < 0.3 {
            let (normal, offset) = lines[0];
            let tilt = random.power(-16.0, -1.0) * Vector2::new(random.normal(), random.normal());
            lines.push((normal + tilt, offset * (1.0 - random.power(-16.0, -2.0))));
        }
        let nearest = lines.iter().map(|line| line.1).fold(f64::INFINITY, f64::min);
        let r = nearest * random.power(-9.0, -0.1);
        // A centre far from the centroid.
        if random.uniform() < 0.4 {
            let angle = 2.0 * PI * random.uniform();
            let way = Vector2::new(angle.cos(), angle.sin());
            let most = lines.iter().map(|line| line.0.dot(&way) / line.1).fold(0.0, f64::max);
            let way = (1.0 - random.power(-6.0, -0.1)) / most.max(0.1) * way;
            lines.iter_mut().for_each(|line| line.1 -= line.0.dot(&way));
        }
        if random.uniform() < 0.3 {
            for line in &mut lines {
                let factor = random.power(-2.0, 2.0);
                *line = (factor * line.0, factor * line.1);
            }
        }
        let k = [0.0, 0.0, random.power(-13.0, 0.0)][random.whole(0, 3)];
        let rows: Vec<[f64; 3]> = lines.iter().map(|(normal, offset)| [normal.x, normal.y, *offset]).collect();
        if let Ok(particle) = Particle::in_plane(&rows, r, k, random.power(-0.5, 0.5)) {
            break particle;
        }
    };
    let reference = of_outline(&made);
    compared((seed, index, "any of the plane", 1), Some(reference), |tolerance| of_plane(&made, tolerance))
}

/// By the polygon of an outline, whose sides are nowhere further from the boundary than its tolerance.
fn of_outline(particle: &Particle) -> Moments<2> {
    let mesh = SurfaceMesh::of(particle, 1e-9).unwrap();
    let tolerance = 1e-9 * particle.bounding_radius();
    let points: Vec<Vector2<f64>> = mesh.vertices.iter().map(|vertex| vertex.xy()).collect();
    let (mut area, mut first, mut second) = (0.0, Vector2::zeros(), Matrix2::zeros());
    let sides = || points.iter().zip(points.iter().cycle().skip(1));
    for (from, to) in sides() {
        let (part, sum) = (0.5 * from.perp(to), from + to);
        area += part;
        first += part / 3.0 * sum;
        second += part / 12.0 * (from * from.transpose() + to * to.transpose() + sum * sum.transpose());
    }
    let root = (second / area).cholesky().and_then(|root| root.l().try_inverse());
    let error = root.map_or(f64::NAN, |unscaled| {
        let of_side = |(from, to): (&Vector2<f64>, &Vector2<f64>)| {
            let far = (unscaled * from).norm().max((unscaled * to).norm());
            (to - from).norm() * (1.0 + far).max(far * far)
        };
        tolerance * sides().map(of_side).sum::<f64>() / area
    });
    Moments { volume: area, centroid: first / area, second, error }
}
