//! The convex hull of points of doubles in whole numbers: each coordinate is one, times a power of two.

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};

/// A hull, as doubles of exact numbers.
pub struct ExactHull {
    pub volume: f64,
    pub area: f64,
    /// The largest edge of the box about the points.
    pub extent: f64,
    /// A triangle of each face.
    pub faces: Vec<[usize; 3]>,
}

type Whole = [BigInt; 3];

fn minus(a: &Whole, b: &Whole) -> Whole {
    std::array::from_fn(|i| &a[i] - &b[i])
}

fn cross(a: &Whole, b: &Whole) -> Whole {
    std::array::from_fn(|i| &a[(i + 1) % 3] * &b[(i + 2) % 3] - &a[(i + 2) % 3] * &b[(i + 1) % 3])
}

fn dot(a: &Whole, b: &Whole) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// Mantissa and exponent.
fn parts(value: f64) -> (i64, i32) {
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let mantissa = (bits & ((1 << 52) - 1)) as i64 | if exponent == 0 { 0 } else { 1 << 52 };
    (if value < 0.0 { -mantissa } else { mantissa }, exponent.max(1) - 1075)
}

impl ExactHull {
    /// Adds one point after the other: the triangles below it are removed, and those from it to the edges around them
    /// are added.
    pub fn of(points: &[[f64; 3]]) -> Self {
        let least = points.iter().flatten().filter(|c| **c != 0.0).map(|c| parts(*c).1).min().unwrap_or(0);
        let whole =
            |c: f64| if c == 0.0 { BigInt::zero() } else { BigInt::from(parts(c).0) << (parts(c).1 - least) as usize };
        let at: Vec<Whole> = points.iter().map(|point| point.map(whole)).collect();
        let unit = 2f64.powi(least);
        let extent = (0..3)
            .map(|axis| {
                let of = || at.iter().map(|point| &point[axis]);
                (of().max().unwrap() - of().min().unwrap()).to_f64().unwrap() * unit
            })
            .fold(0.0, f64::max);
        let height = |[a, b, c]: [usize; 3], p: usize| {
            dot(&cross(&minus(&at[b], &at[a]), &minus(&at[c], &at[a])), &minus(&at[p], &at[a]))
        };
        let mut hull = Self { volume: 0.0, area: 0.0, extent, faces: Vec::new() };
        let is_line = |a: usize, b: usize, c: usize| {
            cross(&minus(&at[b], &at[a]), &minus(&at[c], &at[a])).iter().all(Zero::is_zero)
        };
        let all = 1..at.len();
        let Some(b) = all.clone().find(|&b| at[b] != at[0]) else { return hull };
        let Some(c) = all.clone().find(|&c| !is_line(0, b, c)) else { return hull };
        let Some(d) = all.clone().find(|&d| !height([0, b, c], d).is_zero()) else { return hull };
        let (b, c) = if height([0, b, c], d).is_negative() { (b, c) } else { (c, b) };
        let mut faces = vec![[0, b, c], [b, 0, d], [c, b, d], [0, c, d]];
        for p in all {
            let (below, mut left): (Vec<[usize; 3]>, Vec<_>) =
                faces.into_iter().partition(|face| height(*face, p).is_positive());
            let edges: Vec<[usize; 2]> = below.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            let around = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a]));
            left.extend(around.map(|[a, b]| [*a, *b, p]));
            faces = left;
        }
        let mut six = BigInt::zero();
        for face in &faces {
            let [a, b, c] = face.map(|i| &at[i]);
            six += dot(&cross(&minus(a, &at[0]), &minus(b, &at[0])), &minus(c, &at[0]));
            let doubled = cross(&minus(b, a), &minus(c, a)).map(|c| c.to_f64().unwrap_or(0.0) * unit * unit);
            hull.area += 0.5 * doubled.iter().map(|c| c * c).sum::<f64>().sqrt();
            let is_known = hull.faces.iter().any(|known| face.iter().all(|&p| height(*known, p).is_zero()));
            if !is_known {
                hull.faces.push(*face);
            }
        }
        hull.volume = six.to_f64().unwrap_or(f64::NAN) * unit * unit * unit / 6.0;
        hull
    }
}
