//! Random particles whose volume, centroid and inertia are held against closed forms, or against their own at a far
//! finer tolerance: an error above the estimate of it is a failure, whatever its size.

use crate::random::Random;
use crate::stress::cases::stream;
use crate::stress::ledger::{Fault, Finding, Ledger};
use crate::stress::shapes::{Hull, Recipe, Sphericity, flattened, particle};
use nalgebra::{Matrix2, Matrix3, Rotation3, SVector, Vector2, Vector3};
use potential_particles::{Particle, Plane, SurfaceMesh};
use std::f64::consts::PI;

/// Tolerances that are asked for, and the one of the reference; that of particles of more planes than [`FEW`] is
/// coarser.
const ASKED: [f64; 3] = [1e-3, 1e-4, 1e-6];
const FINE: f64 = 1e-8;
const FINE_OF_MANY: f64 = 1e-7;
const FEW: usize = 40;

/// Rounding of the answers and of the closed forms, relative.
const ROUNDING: f64 = 1e-13;

/// Volume (or area), centroid, ∫x xᵀ and the estimated error. Of the plane the third axis has the moment 1.
struct Moments {
    volume: f64,
    centroid: Vector3<f64>,
    second: Matrix3<f64>,
    error: f64,
}

impl Moments {
    fn of_plane(volume: f64, centroid: Vector2<f64>, second: Matrix2<f64>, error: f64) -> Self {
        let mut all = Matrix3::from_diagonal(&Vector3::z());
        all.fixed_view_mut::<2, 2>(0, 0).copy_from(&second);
        Self { volume, centroid: centroid.push(0.0), second: all, error }
    }
}

/// The largest relative difference of volumes, centroids and second moments, in the measure in which the estimates are
/// documented: in units of the radii of gyration of the reference.
fn difference(found: &Moments, reference: &Moments) -> f64 {
    let second = reference.second / reference.volume;
    let root = second.cholesky().and_then(|root| root.l().solve_lower_triangular(&Matrix3::identity()));
    let Some(unscaled) = root else { return f64::NAN };
    let volume = (found.volume / reference.volume - 1.0).abs();
    let centroid = (unscaled * (found.centroid - reference.centroid)).norm();
    let change = unscaled * (found.second - reference.second) * unscaled.transpose() / reference.volume;
    volume.max(centroid).max(change.norm())
}

/// Particle `index` at every tolerance: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let mut random = stream(seed, 11, index);
    let made = match index % 8 {
        0 => rounded_box(&mut random),
        1 => ellipsoid(index, &mut random),
        2 => rounded_rectangle(&mut random),
        3 => outline(&mut random),
        _ => Some(("any shape", any(&mut random), None)),
    };
    let Some((family, particle, reference)) = made else { return };
    let planes = if particle.is_in_plane() { 1 } else { particle.plane_count() };
    let of = |tolerance| of_particle(&particle, tolerance);
    *ledger.families.entry(family.into()).or_default() += 1;
    let reference = reference.unwrap_or_else(|| of(if planes > FEW { FINE_OF_MANY } else { FINE }));
    for asked in ASKED {
        let found = of(asked);
        let off = difference(&found, &reference);
        let allowed = found.error + reference.error + ROUNDING;
        ledger.judged += 1;
        // Also for NaN. Of those with a closed form the tolerance is reached.
        let is_reached = found.error <= asked || !["rounded box", "ellipsoid", "rounded rectangle"].contains(&family);
        if !(off <= allowed && is_reached) {
            let detail = format!(
                "{planes} planes, asked {asked:e}: off by {off:e}, estimated {:e} and {:e}",
                found.error, reference.error
            );
            let (family, case) = (family.into(), serde_json::Value::Null);
            ledger.find(Finding { fault: Fault::Mass, family, seed, index, detail, case, planes });
        }
    }
}

/// A particle to judge: its family, and what is known of it or found by another way.
type Made = (&'static str, Particle, Option<Moments>);

fn of_particle(particle: &Particle, tolerance: f64) -> Moments {
    let found = particle.mass_properties(tolerance).unwrap();
    let i = found.inertia;
    if particle.is_in_plane() {
        let second = Matrix2::new(i.m22, -i.m12, -i.m12, i.m11);
        // A sheet: what leaves the plane is nothing.
        let is_sheet = i.m13 == 0.0 && i.m23 == 0.0 && (i.m11 + i.m22 - i.m33).abs() <= 1e-14 * i.m33;
        let volume = if is_sheet && found.centroid.z == 0.0 { found.volume } else { f64::NAN };
        return Moments::of_plane(volume, found.centroid.xy(), second, found.error);
    }
    let second = Matrix3::from_diagonal_element(0.5 * i.trace()) - i;
    Moments { volume: found.volume, centroid: found.centroid, second, error: found.error }
}

/// Any shape: a hull of `shapes` with some of what makes integration hard.
fn any(random: &mut Random) -> Particle {
    loop {
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
            return particle;
        }
    }
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
fn of_turn(half: &[f64]) -> f64 {
    let [most, least] = [f64::max, f64::min].map(|of| half.iter().copied().reduce(of).unwrap_or(1.0));
    16.0 * f64::EPSILON * (most / least).powi(2)
}

fn turn(random: &mut Random) -> Rotation3<f64> {
    Rotation3::new(PI * random.uniform() * random.direction())
}

/// A box whose edges are rounded by r, about any centre.
fn rounded_box(random: &mut Random) -> Option<Made> {
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
    let made = Particle::new(&planes, r, 0.0, 1.0).ok()?;
    let (volume, second) = steiner::<3>(half.map(|h| h - r), r);
    let second = turn.matrix() * Matrix3::from_diagonal(&second) * turn.matrix().transpose();
    let reference = Moments {
        volume,
        centroid: centre,
        second: second + volume * centre * centre.transpose(),
        error: of_turn(half.as_slice()),
    };
    Some(("rounded box", made, Some(reference)))
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
fn ellipsoid(index: u64, random: &mut Random) -> Option<Made> {
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
    let made = Particle::new(&planes, r, k, shadow).ok()?;
    let volume = 4.0 / 3.0 * PI * axes.product();
    let second =
        turn.matrix() * Matrix3::from_diagonal(&axes.map(|a| volume * a * a / 5.0)) * turn.matrix().transpose();
    let reference = Moments { volume, centroid: Vector3::zeros(), second, error: of_turn(axes.as_slice()) };
    Some(("ellipsoid", made, Some(reference)))
}

/// Rounded rectangles of the plane.
fn rounded_rectangle(random: &mut Random) -> Option<Made> {
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
    let made = Particle::in_plane(&lines, r, 0.0, 1.0).ok()?;
    let (area, second) = steiner::<2>(half.map(|h| h - r), r);
    let second = turn * Matrix2::from_diagonal(&second) * turn.transpose() + area * centre * centre.transpose();
    let reference = Moments::of_plane(area, centre, second, of_turn(half.as_slice()));
    Some(("rounded rectangle", made, Some(reference)))
}

/// What any shape cuts out of the plane.
fn outline(random: &mut Random) -> Option<Made> {
    let made = flattened(&any(random)).filter(|made| made.plane_count() > 0)?;
    let reference = of_outline(&made);
    Some(("outline", made, Some(reference)))
}

/// By the polygon of an outline, whose sides are nowhere further from the boundary than its tolerance.
fn of_outline(particle: &Particle) -> Moments {
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
    Moments::of_plane(area, first / area, second, error)
}
