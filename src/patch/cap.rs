//! The part of a patch beyond the end of a strip, where a third plane is active.

use super::local_coordinates::{LocalCoordinates, Place, Vector, Wave, node, turn};
use super::ray::Node;
use super::rules::{gauss, tapering};
use super::strip::Strip;

/// Place of the single point that gives the load of a quarter of a paraboloid.
const SINGLE: f64 = 0.407;

/// Which body the third plane of a cap belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Third {
    /// The body of the first two: three planes against one.
    Same,
    /// The other body: two planes against two.
    Other,
}

/// The excesses of a corner's planes over s as functions of two angles, and the relation that gives s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    pub coordinates: LocalCoordinates,
    /// Excess over s: of the first two planes, and of the last.
    pub radii: [f64; 2],
    pub third: Third,
    pub start: f64,
    width: f64,
}

impl Cap {
    /// Beyond the end of a strip.
    pub fn new(coordinates: LocalCoordinates, strip: &Strip, third: Third) -> Option<Self> {
        let mut cap = Self { coordinates, radii: strip.radii, third, start: strip.start, width: 0.0 };
        let wave = Wave::new(-coordinates.slopes[0] * cap.radii[0], -coordinates.slopes[1] * cap.radii[0]);
        cap.width = wave.fallen_to(coordinates.c - cap.radii[1], strip.sign).0 - cap.start;
        // Within a quarter turn of the second angle it ends as well; else the patch goes on over another face.
        let (constant, wave) = cap.across(cap.start);
        (cap.width.is_finite() && coordinates.c >= constant + wave.b).then_some(cap)
    }

    /// F as a constant and a wave in the second angle.
    #[inline(always)]
    fn across(&self, theta: f64) -> (f64, Wave) {
        let [r, other] = self.radii;
        let (sin, cos, _) = turn(theta);
        let first = -(self.coordinates.slopes[0] * cos + self.coordinates.slopes[1] * sin) * r;
        match self.third {
            Third::Same => (other, Wave::new(first, -self.coordinates.slopes[2] * r)),
            Third::Other => (first, Wave::new(other, -self.coordinates.slopes[2] * other)),
        }
    }

    /// By how much F rises beyond the border with the strip, over its value there: a part of the patch is then missing.
    pub fn rise(&self) -> f64 {
        let Wave { a, b, size } = self.across(self.start).1;
        if b > 0.0 { (size - a) / self.coordinates.c.abs() } else { 0.0 }
    }

    fn height(&self, theta: f64) -> f64 {
        let (constant, wave) = self.across(theta);
        wave.fallen_to(self.coordinates.c - constant, 1.0).0.max(0.0)
    }

    /// The place at which the cap begins.
    pub fn corner(&self) -> Vector {
        self.at(self.start, 0.0).0
    }

    /// Places on its rim, from that at the start on.
    pub fn outline(&self) -> [Vector; 3] {
        [0.0, 0.5, 0.8].map(|part| {
            let theta = self.start + part * self.width;
            self.at(theta, self.height(theta)).0
        })
    }

    #[inline(always)]
    fn at(&self, theta: f64, psi: f64) -> Place {
        let ((sin, cos, rate), (sin2, cos2, rate2)) = (turn(theta), turn(psi));
        let [r, other] = self.radii;
        // The coordinates over s and their changes, and the same of the last plane.
        let (a, by_theta, by_psi, last, last_by_psi) = match self.third {
            Third::Same => (
                [r * cos2 * cos, r * cos2 * sin, r * sin2],
                [-r * cos2 * sin, r * cos2 * cos, 0.0],
                [-r * sin2 * cos, -r * sin2 * sin, r * cos2],
                other,
                0.0,
            ),
            Third::Other => (
                [r * cos, r * sin, other * sin2],
                [-r * sin, r * cos, 0.0],
                [0.0, 0.0, other * cos2],
                other * cos2,
                -other * sin2,
            ),
        };
        let (x, area, s) = self.coordinates.place(a, [by_theta, by_psi], last, [0.0, last_by_psi]);
        (x, rate * rate2 * area, s)
    }

    /// Gauss' rule of so many points in both angles.
    pub fn integrate(&self, points: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        // Near its end x = 0 the height goes like √x or like x: with x = rest² it is smooth.
        for (rest, weight) in if points == 1 { &[(1.0 - SINGLE, 1.0)] } else { tapering(points) } {
            let theta = self.start + self.width * (1.0 - rest * rest);
            let height = self.height(theta);
            let share = weight * (2.0 * rest * self.width).abs() * height;
            for (nu, weight) in &gauss(points).nodes[..points] {
                let (x, area, s) = self.at(theta, nu * height);
                visit(node(x, area, s, share * weight)?);
            }
        }
        Some(())
    }
}
