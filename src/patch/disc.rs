//! A patch that is one zone: that of a corner on a face, or of crossed edges.

use super::cap::Third;
use super::local_coordinates::{LocalCoordinates, Place, Vector, Wave, node};
use super::numbers::{AROUND_DISC, Fitted, Limits};
use super::ray::Node;
use super::rules::gauss;
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// The whole patch is one zone: three planes of a body against one, or two against two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    coordinates: LocalCoordinates,
    radii: [f64; 2],
    shape: ExcessSurface,
}

/// The surface on which the excesses over s lie.
#[derive(Clone, Copy, Debug)]
enum ExcessSurface {
    /// With three planes of one body: about an axis, with two directions across it, up to 1 − cos ω = `whole`.
    Sphere { axes: [Vector; 3], whole: f64 },
    /// With two planes of each body: two waves, and the sines of half the angles at which they end.
    Torus { waves: [Wave; 2], ends: [f64; 2] },
}

/// The rule of [`Disc::first`]: distances from the middle, and their weights over the disc. In the square u of the
/// distance it is exact for 1, u, u² and u³, and for √u and u√u, which distances from the middle lead to.
const FIRST: [(f64, f64); 3] = [
    (0.218_242_855_053_144_9, 0.073_261_806_930_278_46),
    (0.599_358_967_604_768, 0.231_317_515_787_878_26),
    (0.914_448_984_910_964_3, 0.195_420_677_281_843_28),
];

/// Its error for u⁴, whose exact integral is ⅒.
const OF_FOURTH: f64 = 5.94e-4;

impl Disc {
    /// `None` where the rim is not reached within the zone.
    pub fn new(coordinates: LocalCoordinates, radii: [f64; 2], third: Third) -> Option<Self> {
        let [r, other] = radii;
        let shape = match third {
            Third::Same => {
                let towards = Vector::from(coordinates.slopes) * -r;
                let size = towards.norm();
                let axis = towards / size;
                let p = axis.cross(&Vector::ith(axis.iamin(), 1.0)).normalize();
                let whole = (size + other - coordinates.c) / size;
                (whole > 0.0 && whole < 1.0)
                    .then_some(ExcessSurface::Sphere { axes: [axis, p, axis.cross(&p)], whole })?
            }
            Third::Other => {
                let [alpha, beta, gamma] = coordinates.slopes;
                let waves = [Wave::new(-alpha * r, -beta * r), Wave::new(other, -gamma * other)];
                let depth = waves[0].size + waves[1].size - coordinates.c;
                // Sines of half angles, since those are the half axes of an ellipse.
                let ends = waves.map(|wave| (0.5 * depth / wave.size).sqrt());
                (depth > 0.0 && ends.iter().all(|end| *end < 0.7)).then_some(ExcessSurface::Torus { waves, ends })?
            }
        };
        Some(Self { coordinates, radii, shape })
    }

    /// A rule of few points, with the errors of ∫ p n and of the area by how fast the powers of the square of the
    /// distance fall.
    pub fn first(&self, mut visit: impl FnMut(Node)) -> Option<[f64; 2]> {
        let points = AROUND_DISC[usize::from(matches!(self.shape, ExcessSurface::Torus { .. }))];
        let mut rings = [[0.0; 4]; 3];
        for ((rho, weight), ring) in FIRST.iter().zip(&mut rings) {
            let weight = 2.0 * weight * TAU / points as f64;
            for direction in &circle(points)[..points] {
                let node = self.node(rho * rho, direction, weight)?;
                let Node { pressure, normal: [n_u, n_v], .. } = node;
                let share = node.weight / weight;
                let stretch = (1.0 + n_u * n_u + n_v * n_v).sqrt();
                let values = [pressure * n_u, pressure * n_v, pressure, stretch].map(|c| share * c);
                ring.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
                visit(node);
            }
        }
        // Coefficients of u³ and u² of the polynomials of the load, which is 0 at u = 1, and of u² of that of the area.
        let [u, v, w] = FIRST.map(|(rho, _)| rho * rho);
        let second = |i: usize| {
            let [f, g, h] = [0, 1, 2].map(|k| rings[k][i]);
            ((h - g) / (w - v) - (g - f) / (v - u)) / (w - u)
        };
        let third = |i: usize| {
            let [g, h] = [rings[1][i], rings[2][i]];
            let last = (-h / (1.0 - w) - (h - g) / (w - v)) / (1.0 - v);
            (last - second(i)) / (1.0 - u)
        };
        let size = |of: [f64; 3]| Vector::from(of).norm();
        let cubic = [0, 1, 2].map(third);
        // The divided difference, less the share of the cubic term.
        let square = [0, 1, 2].map(|i| second(i) - (u + v + w) * cubic[i]);
        let scale = Fitted::OPTIMISM * OF_FOURTH * 2.0 * TAU / points as f64;
        let of_load = size(cubic);
        Some([if of_load > 0.0 { scale * of_load * of_load / size(square) } else { 0.0 }, scale * second(3).abs()])
    }

    /// Gauss' rule in the distance from the middle, equal steps around it.
    pub fn integrate(&self, outwards: usize, around: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        for (rho, weight) in &gauss(outwards).nodes[..outwards] {
            for direction in &circle(around)[..around] {
                visit(self.node(rho * rho, direction, 2.0 * rho * weight * TAU / around as f64)?);
            }
        }
        Some(())
    }

    /// Places on its rim, which must not leave the zone.
    pub fn outline(&self) -> [Vector; 12] {
        std::array::from_fn(|i| self.at(1.0, &circle(12)[i]).0)
    }

    #[inline(always)]
    fn node(&self, u: f64, direction: &(f64, f64), weight: f64) -> Option<Node> {
        let (x, area, s) = self.at(u, direction);
        node(x, area, s, weight)
    }

    /// At the square of the distance, 1 on the rim, in a direction.
    #[inline(always)]
    fn at(&self, u: f64, &(sin_chi, cos_chi): &(f64, f64)) -> Place {
        let [r, other] = self.radii;
        match &self.shape {
            ExcessSurface::Sphere { axes: [axis, p, q], whole } => {
                // 1 − cos ω, which is even over the sphere.
                let versed = whole * u;
                let (cos, sin) = (1.0 - versed, (versed * (2.0 - versed)).sqrt());
                let around = cos_chi * p + sin_chi * q;
                let m = cos * axis + sin * around;
                let by_omega = cos * around - sin * axis;
                let by_chi = cos_chi * q - sin_chi * p;
                let scaled = |v: Vector| [v.x * r, v.y * r, v.z * r];
                let (x, area, s) =
                    self.coordinates.place(scaled(m), [scaled(by_omega), scaled(by_chi)], other, [0.0; 2]);
                (x, *whole * area, s)
            }
            ExcessSurface::Torus { waves, ends } => {
                let half = [ends[0] * u.sqrt() * cos_chi, ends[1] * u.sqrt() * sin_chi];
                let root = half.map(|h| (1.0 - h * h).sqrt());
                let from_peak = |wave: &Wave, i: usize| {
                    let (sin, cos) = (2.0 * half[i] * root[i], 1.0 - 2.0 * half[i] * half[i]);
                    ((wave.b * cos + wave.a * sin) / wave.size, (wave.a * cos - wave.b * sin) / wave.size)
                };
                let ((sin, cos), (sin2, cos2)) = (from_peak(&waves[0], 0), from_peak(&waves[1], 1));
                let (x, area, s) = self.coordinates.place(
                    [r * cos, r * sin, other * sin2],
                    [[-r * sin, r * cos, 0.0], [0.0, 0.0, other * cos2]],
                    other * cos2,
                    [0.0, -other * sin2],
                );
                let scale = 2.0 * ends[0] * ends[1] / (root[0] * root[1]);
                (x, scale * area, s)
            }
        }
    }
}

/// Sine and cosine of so many equal steps around.
fn circle(count: usize) -> &'static [(f64, f64); Limits::AROUND_DISC] {
    type Table = [[(f64, f64); Limits::AROUND_DISC]; Limits::AROUND_DISC];
    static TABLE: LazyLock<Table> = LazyLock::new(|| {
        std::array::from_fn(|n| std::array::from_fn(|i| (TAU * (i as f64 + 0.5) / (n + 1) as f64).sin_cos()))
    });
    &TABLE[count - 1]
}
