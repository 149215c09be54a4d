//! A patch that is one zone: that of a corner on a face, or of crossed edges.

use super::cap::Third;
use super::chart::{Chart, Place, Vector, Wave, node};
use super::ray::Node;
use super::rules::gauss;
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// The whole patch is one zone: three planes of a body against one, or two against two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub chart: Chart,
    pub radii: [f64; 2],
    pub third: Third,
}

impl Disc {
    /// Gauss' rule in the distance from the middle, equal steps around it.
    pub fn integrate(&self, outwards: usize, around: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        for (rho, weight) in &gauss(outwards).nodes[..outwards] {
            for direction in &circle(around)[..around] {
                let (x, area, s) = self.at(rho * rho, direction)?;
                visit(node(x, area, s, 2.0 * rho * weight * TAU / around as f64)?);
            }
        }
        Some(())
    }

    /// Places on its rim, which must not leave the zone.
    pub fn outline(&self) -> Option<[Vector; 12]> {
        let mut places = [Vector::zeros(); 12];
        for (i, place) in places.iter_mut().enumerate() {
            *place = self.at(1.0, &circle(12)[i])?.0;
        }
        Some(places)
    }

    /// At the square of the distance, 1 on the rim, in a direction.
    fn at(&self, u: f64, &(sin_chi, cos_chi): &(f64, f64)) -> Option<Place> {
        match self.third {
            Third::Same => self.on_sphere(u, sin_chi, cos_chi),
            Third::Other => self.on_torus(u, sin_chi, cos_chi),
        }
    }

    fn on_sphere(&self, u: f64, sin_chi: f64, cos_chi: f64) -> Option<Place> {
        let [r, other] = self.radii;
        let towards = Vector::from(self.chart.slopes) * -r;
        let size = towards.norm();
        let axis = towards / size;
        let p = axis.cross(&Vector::ith(axis.iamin(), 1.0)).normalize();
        let q = axis.cross(&p);
        // 1 − cos ω, which is even over the sphere.
        let whole = (size + other - self.chart.c) / size;
        if !(whole > 0.0 && whole < 1.0) {
            return None;
        }
        let versed = whole * u;
        let (cos, sin) = (1.0 - versed, (versed * (2.0 - versed)).sqrt());
        let around = cos_chi * p + sin_chi * q;
        let m = cos * axis + sin * around;
        let by_omega = cos * around - sin * axis;
        let by_chi = cos_chi * q - sin_chi * p;
        let scaled = |v: Vector| [v.x * r, v.y * r, v.z * r];
        let (x, area, s) = self.chart.place(scaled(m), [scaled(by_omega), scaled(by_chi)], other, [0.0; 2]);
        Some((x, whole * area, s))
    }

    fn on_torus(&self, u: f64, sin_chi: f64, cos_chi: f64) -> Option<Place> {
        let [r, other] = self.radii;
        let [alpha, beta, gamma] = self.chart.slopes;
        let first = Wave::new(-alpha * r, -beta * r);
        let second = Wave::new(other, -gamma * other);
        let depth = first.size + second.size - self.chart.c;
        // Half angles, whose sines are those of an ellipse.
        let axes = [first, second].map(|wave| (0.5 * depth / wave.size).sqrt());
        if !(depth > 0.0 && axes.iter().all(|axis| *axis < 0.7)) {
            return None;
        }
        let half = [axes[0] * u.sqrt() * cos_chi, axes[1] * u.sqrt() * sin_chi];
        let root = half.map(|h| (1.0 - h * h).sqrt());
        let from_peak = |wave: &Wave, i: usize| {
            let (sin, cos) = (2.0 * half[i] * root[i], 1.0 - 2.0 * half[i] * half[i]);
            ((wave.b * cos + wave.a * sin) / wave.size, (wave.a * cos - wave.b * sin) / wave.size)
        };
        let ((sin, cos), (sin2, cos2)) = (from_peak(&first, 0), from_peak(&second, 1));
        let (x, area, s) = self.chart.place(
            [r * cos, r * sin, other * sin2],
            [[-r * sin, r * cos, 0.0], [0.0, 0.0, other * cos2]],
            other * cos2,
            [0.0, -other * sin2],
        );
        let scale = 2.0 * axes[0] * axes[1] / (root[0] * root[1]);
        Some((x, scale * area, s))
    }
}

/// Most points around a disc.
const MOST_AROUND: usize = 24;

/// Sine and cosine of so many equal steps around.
fn circle(count: usize) -> &'static [(f64, f64); MOST_AROUND] {
    type Table = [[(f64, f64); MOST_AROUND]; MOST_AROUND];
    static TABLE: LazyLock<Table> = LazyLock::new(|| {
        std::array::from_fn(|n| std::array::from_fn(|i| (TAU * (i as f64 + 0.5) / (n + 1) as f64).sin_cos()))
    });
    &TABLE[count - 1]
}
