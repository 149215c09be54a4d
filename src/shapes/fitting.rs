//! Few planes for points or surfaces of many, as scans are.
//!
//! The facets of the convex hull are gathered into N groups of like direction, by Lloyd's method on their normals with
//! their areas as weights (the metric L2,1 of Cohen-Steiner, Alliez & Desbrun 2004, Variational shape approximation).
//! From planes with the mean direction of each group the fit begins: directions, offsets and r change until the heights
//! of the particle, along directions all around, are those of the hull (Levenberg and Marquardt). What is missing is
//! taken as a share of the height there, first squared, then to the sixth power, by which the largest comes down. A
//! plane raises the height at a point x by its weight there (`touching`) times what it moves there, n·x − d; what r
//! grows raises it by the sum of these weights times ⟨n·x − d⟩/r. Of several r to begin with the one that comes nearest
//! is taken, and the whole is scaled to the volume that is given.

use super::error::{ShapeError, within};
use super::numbers::{DAMPING, ENOUGH, FIRST_SHARES, LEAST_WEIGHT, Limits, POWERS, SETTLED};
use super::rounding::{Definition, Rounding, Shape, lowered, usual_tolerance};
use super::sharp_body::SharpBody;
use super::touching::{Height, Reached, reached};
use crate::particle::plane::Plane;
use nalgebra::{DMatrix, DVector, Vector3};
use std::f64::consts::{PI, TAU};

/// Of the convex hull of points, as a particle of at most so many planes and with the volume of the hull. Without r in
/// `rounding` ([`Rounding::chosen`]), it is chosen to that end.
///
/// # Errors
/// Those of [`hull`](super::hull); fewer planes than four.
pub fn fitted(points: &[[f64; 3]], planes: usize, rounding: &Rounding) -> Result<Shape, ShapeError> {
    let body = SharpBody::of_points(points, 0.0)?;
    of_hull(&body, body.volume, planes, rounding, None)
}

/// A superquadric about the origin, (|x/a|^(2/e) + |y/b|^(2/e))^(e/n) + |z/c|^(2/n) ≤ 1 with the semi-axes a, b, c and
/// the exponents n and e, from 0.1, nearly a box, over 1, an ellipsoid, to 2, an octahedron: as [`fitted`] to points on
/// it.
///
/// # Errors
/// Those of [`fitted`]; semi-axes and exponents out of range.
pub fn superquadric(axes: [f64; 3], [n, e]: [f64; 2], planes: usize, rounding: &Rounding) -> Result<Shape, ShapeError> {
    for (axis, name) in axes.into_iter().zip(["semi-axis x", "semi-axis y", "semi-axis z"]) {
        super::error::positive(axis, name)?;
    }
    for (exponent, name) in [(n, "exponent n"), (e, "exponent e")] {
        within(exponent, (0.1..=2.0).contains(&exponent), name, "between 0.1 and 2")?;
    }
    let scales = rays(Limits::SURFACE_POINTS).map(|ray| {
        let across = ray.x.abs().powf(2.0 / e) + ray.y.abs().powf(2.0 / e);
        (across.powf(e / n) + ray.z.abs().powf(2.0 / n)).powf(-0.5 * n) * ray
    });
    let points: Vec<[f64; 3]> = scales.map(|at| at.component_mul(&Vector3::from(axes)).into()).collect();
    let volume = axes.iter().product::<f64>() * volume_of(n, e);
    let body = SharpBody::of_points(&points, 0.0)?;
    of_hull(&body, volume, planes, rounding, None)
}

/// The volume with semi-axes 1: 2 n e B(n/2 + 1, n) B(e/2, e/2), B Euler's beta function.
fn volume_of(n: f64, e: f64) -> f64 {
    let beta = |a: f64, b: f64| (ln_gamma(a) + ln_gamma(b) - ln_gamma(a + b)).exp();
    2.0 * n * e * beta(0.5 * n + 1.0, n) * beta(0.5 * e, 0.5 * e)
}

/// ln Γ(x), by Stirling's series beyond 30, to which Γ(x + 1) = x Γ(x) leads.
fn ln_gamma(x: f64) -> f64 {
    if x < 30.0 {
        return ln_gamma(x + 1.0) - x.ln();
    }
    let series = (1.0 / 12.0 - (1.0 / 360.0 - 1.0 / (1260.0 * x * x)) / (x * x)) / x;
    (x - 0.5) * x.ln() - x + 0.5 * TAU.ln() + series
}

/// A hull with fewer planes, and this volume.
pub fn of_hull(
    hull: &SharpBody,
    volume: f64,
    planes: usize,
    rounding: &Rounding,
    tolerance: Option<f64>,
) -> Result<Shape, ShapeError> {
    within(planes as f64, (4..=Limits::FITTED_PLANES).contains(&planes), "planes", "between 4 and 1000")?;
    within(volume, volume > 0.0, "volume", "finite and above 0")?;
    let about: Vec<Vector3<f64>> = hull.corners.iter().map(|corner| corner - hull.centroid).collect();
    let support = |normal: Vector3<f64>| Plane {
        normal,
        offset: about.iter().map(|at| normal.dot(at)).fold(f64::NEG_INFINITY, f64::max),
    };
    let supports: Vec<Plane> = directions(hull, planes).into_iter().map(support).collect();
    let outer = SharpBody::of_planes(&supports)?;
    let outer = SharpBody { origin: hull.centroid + hull.origin, ..outer };
    let samples = rays(Limits::SAMPLES)
        .chain(outer.planes.iter().map(|plane| plane.normal))
        .map(|ray| (ray, support(ray).offset));
    let centre = outer.centroid;
    let samples: Vec<Height> = samples.map(|(ray, height)| (ray, height - ray.dot(&centre))).collect();
    let shape = nearest(&outer, &samples, rounding, tolerance)?;
    let factor = (volume / shape.mass.volume).cbrt();
    Ok(Shape { sharp_volume: volume, ..shape.resized(factor)? })
}

/// The shape of the faces of a body that comes nearest to heights above its centroid.
fn nearest(
    outer: &SharpBody,
    samples: &[Height],
    rounding: &Rounding,
    tolerance: Option<f64>,
) -> Result<Shape, ShapeError> {
    let centre = outer.centroid;
    let size = outer.size()?;
    let shares = match outer.planes.len() {
        _ if !rounding.is_chosen() => &[f64::NAN],
        ..=Limits::TURNED_PLANES => &FIRST_SHARES[..],
        _ => &FIRST_SHARES[1..2],
    };
    let mut best: Option<Fit> = None;
    for share in shares {
        let rounding = if share.is_nan() { *rounding } else { rounding.with_radius(share * size) };
        let (r, k, shadow_radius) = rounding.lengths(size)?;
        let shadow_radius = shadow_radius.unwrap_or_else(|| outer.farthest(&centre));
        let planes = lowered(&outer.heights(&centre), r, k, shadow_radius);
        let fit = Fit::of(Definition { planes, r, k, shadow_radius }, samples, !share.is_nan());
        if best.as_ref().is_none_or(|best| fit.missing < best.missing) {
            best = Some(fit);
        }
    }
    let Some(Fit { definition: found, .. }) = best else { return Err(ShapeError::Empty) };
    let moved = |to: &Vector3<f64>| {
        let shifted = |plane: &Plane| Plane { offset: plane.offset - plane.normal.dot(&(to - centre)), ..*plane };
        Definition { planes: found.planes.iter().map(shifted).collect(), ..found }
    };
    let tolerance = tolerance.unwrap_or_else(|| usual_tolerance(found.planes.len()));
    let shape = Shape::settled(moved, centre, size, tolerance)?;
    Ok(Shape { centroid: shape.centroid + outer.origin, ..shape })
}

/// What a particle is made of, and what is missing to the heights, as a share of them, in the mean of the last power.
struct Fit {
    definition: Definition,
    missing: f64,
}

impl Fit {
    /// `is_free`: r changes, too.
    fn of(mut definition: Definition, samples: &[Height], is_free: bool) -> Self {
        let mut points: Vec<Vector3<f64>> = samples.iter().map(|(ray, height)| *height * ray).collect();
        let mut looked = |definition: &Definition, power: i32| {
            let particle = definition.particle().ok().filter(|made| made.plane_count() == definition.planes.len())?;
            let found = reached(&particle, samples, &mut points)?;
            let shares = found.iter().zip(samples).map(|(one, (_, height))| (one.missing / height).powi(power));
            let mean = (shares.sum::<f64>() / samples.len() as f64).powf(1.0 / f64::from(power));
            Some((found, mean))
        };
        let mut missing = f64::INFINITY;
        for power in POWERS {
            let Some((mut here, mut left)) = looked(&definition, power) else { break };
            let mut damping = DAMPING;
            for _ in 0..Limits::FITTING_STEPS {
                let tried = Step { samples, reached: &here, power, mean: left, is_free }.taken(&definition, damping);
                match looked(&tried, power).filter(|(_, less)| *less < left) {
                    Some((there, less)) => {
                        let is_little = less > ENOUGH * left;
                        (definition, here, left, damping) = (tried, there, less, 0.3 * damping);
                        if is_little {
                            break;
                        }
                    }
                    None => damping *= 10.0,
                }
            }
            missing = left;
        }
        Self { definition, missing }
    }
}

/// A step towards the least sum of a power of what is missing.
struct Step<'a> {
    samples: &'a [Height],
    reached: &'a [Reached],
    power: i32,
    /// What is missing, as a share, in the mean of this power.
    mean: f64,
    is_free: bool,
}

impl Step<'_> {
    /// Planes moved and, if they are not too many, turned; r grown or shrunk, if it is free.
    fn taken(&self, from: &Definition, damping: f64) -> Definition {
        let planes = &from.planes;
        let extent = self.samples.iter().map(|(_, height)| *height).fold(0.0, f64::max);
        let across = |normal: &Vector3<f64>| {
            let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
            [first, normal.cross(&first)].map(|axis| extent * axis)
        };
        let axes: Vec<_> = planes.iter().map(|plane| across(&plane.normal)).collect();
        // Columns: r, then of each plane its offset and, where it turns, two angles.
        let each = if planes.len() > Limits::TURNED_PLANES { 1 } else { 3 };
        let count = 1 + each * planes.len();
        let (mut matrix, mut right) = (DMatrix::<f64>::zeros(count, count), DVector::<f64>::zeros(count));
        for (Reached { at, missing, weights }, (_, height)) in self.reached.iter().zip(self.samples) {
            let beyond = |i: usize| planes[i].normal.dot(at) - planes[i].offset;
            let of_r = weights.iter().map(|&(i, weight)| weight * beyond(i)).sum::<f64>() / from.r;
            // Outwards, and turned so that it recedes at x by x·e over the extent: about the foot of its own height.
            let of_planes = weights.iter().flat_map(|&(i, weight)| {
                let from_foot = (at - planes[i].offset * planes[i].normal) / (extent * extent);
                let [first, second] = axes[i].map(|axis| -weight * axis.dot(&from_foot));
                let own = 1 + each * i;
                [(own, weight), (own + 1, first), (own + 2, second)].into_iter().take(each)
            });
            let rates: Vec<(usize, f64)> = self.is_free.then_some((0, of_r)).into_iter().chain(of_planes).collect();
            let share = missing / (height * self.mean);
            let weight = (share * share + LEAST_WEIGHT).powi(self.power / 2 - 1) / (height * height);
            for &(i, rate) in &rates {
                // Newton's step for a power p is 1/(p − 1) of that for squares with these weights.
                right[i] += weight * rate * missing / f64::from(self.power - 1);
                rates.iter().for_each(|&(j, other)| matrix[(i, j)] += weight * rate * other);
            }
        }
        let added = damping * matrix.trace() / count as f64;
        (0..count).for_each(|i| matrix[(i, i)] += added);
        let change = matrix.cholesky().map_or_else(|| DVector::zeros(count), |factor| factor.solve(&right));
        let moved = |(i, (plane, axes)): (usize, (&Plane, &[Vector3<f64>; 2]))| {
            let own = &change.as_slice()[1 + each * i..][..each];
            let turned = axes.iter().zip(&own[1..]).map(|(axis, turn)| turn / (extent * extent) * axis);
            let normal = (plane.normal + turned.sum::<Vector3<f64>>()).normalize();
            Plane { normal, offset: plane.offset + own[0] }
        };
        let planes = planes.iter().zip(&axes).enumerate().map(moved).collect();
        Definition { planes, r: (from.r + change[0]).clamp(0.5 * from.r, 2.0 * from.r), ..*from }
    }
}

/// At most so many unit normals for the facets of a hull.
fn directions(hull: &SharpBody, count: usize) -> Vec<Vector3<f64>> {
    let facets: Vec<(Vector3<f64>, f64)> = hull
        .triangles
        .iter()
        .map(|triangle| triangle.map(|corner| hull.corners[corner as usize]))
        .map(|[a, b, c]| (b - a).cross(&(c - a)))
        .filter_map(|doubled| Some((doubled.try_normalize(0.0)?, doubled.norm())))
        .collect();
    let largest = |of: &dyn Fn(usize) -> f64| (0..facets.len()).max_by(|&i, &j| of(i).total_cmp(&of(j))).unwrap_or(0);
    // The first ones by area times distance from those that there are.
    let mut normals = vec![facets[largest(&|i| facets[i].1)].0];
    let mut distances = vec![f64::INFINITY; facets.len()];
    loop {
        for (distance, (normal, _)) in distances.iter_mut().zip(&facets) {
            *distance = distance.min((normal - normals[normals.len() - 1]).norm_squared());
        }
        let worst = largest(&|i| facets[i].1 * distances[i]);
        if normals.len() == count || distances[worst] < SETTLED * SETTLED {
            break;
        }
        normals.push(facets[worst].0);
    }
    for _ in 0..Limits::LLOYD_ROUNDS {
        let mut sums = vec![Vector3::zeros(); normals.len()];
        for (normal, area) in &facets {
            let cosine = |i: usize| normal.dot(&normals[i]);
            let group = (0..normals.len()).max_by(|&i, &j| cosine(i).total_cmp(&cosine(j))).unwrap_or(0);
            sums[group] += *area * normal;
        }
        let mut change: f64 = 0.0;
        for (normal, sum) in normals.iter_mut().zip(&sums) {
            let mean = sum.try_normalize(0.0).unwrap_or(*normal);
            change = change.max((mean - *normal).amax());
            *normal = mean;
        }
        if change < SETTLED {
            break;
        }
    }
    normals
}

/// Unit vectors spread evenly: Fibonacci's spiral.
fn rays(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (PI * (3.0 - 5f64.sqrt()) * i as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * cos, across * sin, z)
    })
}
