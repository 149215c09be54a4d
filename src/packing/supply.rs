//! The bodies that are to be placed, one after the other.

use super::numbers::{LEAST_ENLARGEMENT, TYPICAL_OF};
use crate::linalg::root::{Bracket, halved};
use crate::packing::error::PackError;
use crate::packing::sizes::Sizes;
use crate::particle::mass_properties::{self, MASS_TOLERANCE};
use crate::particle::particle::Particle;
use crate::random::Random;
use std::f64::consts::PI;

/// A body that looks for its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// Counted from 0.
    pub number: u64,
    /// Which shape.
    pub shape: usize,
    /// By which the shape is scaled.
    pub scale: f64,
}

/// Shapes, the sizes in which they are wanted, and the distance that they keep: measured once, for any number of
/// packings.
#[derive(Clone, Debug)]
pub struct Supply {
    shapes: Vec<Measured>,
    sizes: Sizes,
    /// Half the least distance between two bodies.
    half_margin: f64,
}

#[derive(Clone, Debug)]
struct Measured {
    shape: Particle,
    /// Diameter of a ball of the same volume; 1 where sizes do not matter.
    size: f64,
    /// Radius of a ball about the centre within the shape.
    inner: f64,
}

/// The golden ratio less 1: its multiples fill [0, 1) more evenly than random numbers.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

impl Supply {
    /// margin: least distance between two bodies, length; that of a body to the container and to obstacles is half of
    /// it. Bodies are a millionth of their size apart in any case.
    ///
    /// # Errors
    /// No shapes, one in the plane, a margin that is no distance, shapes that are no particles once they are scaled.
    pub fn new(shapes: &[Particle], sizes: &Sizes, margin: f64) -> Result<Self, PackError> {
        if shapes.is_empty() {
            return Err(PackError::NoShapes);
        }
        if let Some(index) = shapes.iter().position(Particle::is_in_plane) {
            return Err(PackError::InPlane(index));
        }
        if !(margin >= 0.0 && margin.is_finite()) {
            return Err(PackError::Margin(margin));
        }
        let measure = |shape: &Particle| {
            let size = sizes.range().map_or(1.0, |_| size_of(shape));
            Measured { shape: shape.clone(), size, inner: inner_radius(shape) }
        };
        let (shapes, sizes) = (shapes.iter().map(measure).collect(), sizes.clone());
        let supply = Self { shapes, sizes, half_margin: 0.5 * margin };
        supply.check()?;
        Ok(supply)
    }

    /// Shape and scale of the bodies of a seed from number `first` on, without end, in the order in which
    /// [`Arrangement::InSequence`](crate::packing::Arrangement::InSequence) places them.
    pub fn sequence(&self, seed: u64, first: u64) -> impl Iterator<Item = (usize, f64)> {
        self.bodies(seed, first).map(|wanted| (wanted.shape, wanted.scale))
    }

    /// Bodies without end: sizes by equal steps around their distribution, shapes at random.
    pub(crate) fn bodies(&self, seed: u64, first: u64) -> impl Iterator<Item = Wanted> {
        // Stream 0 is that of the supply, body n has stream n + 1.
        let mut random = Random::new(seed, 0);
        let begin = random.uniform();
        for _ in 0..first {
            random.below(self.shapes.len());
        }
        (first..).map(move |number| {
            let shape = random.below(self.shapes.len());
            let share = (begin + GOLDEN * number as f64).fract();
            let scale = self.sizes.at(share).map_or(1.0, |size| size / self.shapes[shape].size);
            Wanted { number, shape, scale }
        })
    }

    /// A body as it is packed: enlarged about its centre, such that it holds all points within half the margin of it.
    ///
    /// If K holds a ball of radius ρ about the origin, (1 + h/ρ) K holds K and all points within h of it.
    pub(crate) fn enlarged(&self, wanted: &Wanted) -> Result<Particle, PackError> {
        let Measured { shape, inner, .. } = &self.shapes[wanted.shape];
        let scale = wanted.scale + (self.half_margin / *inner).max(LEAST_ENLARGEMENT * wanted.scale);
        let (index, scale) = (wanted.shape, scale);
        shape.scaled(scale).map_err(|reason| PackError::Scaled { index, scale, reason })
    }

    /// Radius of a ball about the centre within a body.
    pub(crate) fn inner(&self, wanted: &Wanted) -> f64 {
        wanted.scale * self.shapes[wanted.shape].inner
    }

    /// Diameter of the ball about a body.
    pub(crate) fn width(&self, wanted: &Wanted) -> f64 {
        2.0 * wanted.scale * self.shapes[wanted.shape].shape.bounding_radius()
    }

    /// Mean diameter of the balls about the bodies, of a few of them.
    pub(crate) fn typical_width(&self) -> f64 {
        self.bodies(0, 0).take(TYPICAL_OF).map(|wanted| self.width(&wanted)).sum::<f64>() / TYPICAL_OF as f64
    }

    /// Diameter of the ball within the smallest body, with half the margin about it.
    pub(crate) fn least_diameter(&self) -> f64 {
        let least = self.extremes().map(|(i, scale)| scale * self.shapes[i].inner).fold(f64::INFINITY, f64::min);
        2.0 * (least + self.half_margin)
    }

    /// Each shape in its smallest and its largest size.
    fn extremes(&self) -> impl Iterator<Item = (usize, f64)> {
        let scales = |size: f64| self.sizes.range().map_or([1.0; 2], |(low, high)| [low / size, high / size]);
        self.shapes.iter().enumerate().flat_map(move |(i, shape)| scales(shape.size).map(|scale| (i, scale)))
    }

    /// That the smallest and the largest of each shape are particles.
    fn check(&self) -> Result<(), PackError> {
        let body = |(shape, scale)| self.enlarged(&Wanted { number: 0, shape, scale });
        self.extremes().try_for_each(|extreme| body(extreme).map(|_| ()))
    }
}

/// Diameter of a ball of the same volume.
fn size_of(shape: &Particle) -> f64 {
    (6.0 / PI * mass_properties::of(shape, MASS_TOLERANCE).volume).cbrt()
}

/// Radius ρ of a ball about the origin within the particle: by Cauchy's inequality S(x) is at most
/// (1−k)/r² Σ⟨ρ|n_i| − d_i⟩² + k/R² ρ² there, which is made 1.
pub(crate) fn inner_radius(shape: &Particle) -> f64 {
    let at_most = |rho: f64| {
        let excess = |i: usize| (rho * shape.normal(i).norm() - shape.offset(i)).max(0.0);
        let planes: f64 = (0..shape.plane_count()).map(|i| excess(i).powi(2)).sum();
        shape.plane_weight * planes + shape.sphere_weight * rho * rho
    };
    halved(Bracket { low: 0.0, high: shape.bounding_radius() }, |rho| !(at_most(rho) <= 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn the_inner_ball_is_that_of_the_closed_form() {
        assert!((inner_radius(&Particle::sphere(2.0).unwrap()) - 2.0).abs() < 1e-12);
        // Six planes count at once in the bound: 6 (ρ − 0.9)² = 0.1².
        let cube = Particle::cube(0.9, 0.1, 0.0, 1.0);
        assert!((inner_radius(&cube) - (0.9 + 0.1 / 6.0_f64.sqrt())).abs() < 1e-12);
    }

    #[test]
    fn an_enlarged_body_keeps_the_margin() {
        let shapes = [Particle::cube(0.9, 0.1, 0.05, 2.0)];
        let (sizes, margin) = (Sizes::as_given(), 0.2);
        let supply = Supply::new(&shapes, &sizes, margin).unwrap();
        let wanted = supply.bodies(3, 0).next().unwrap();
        let enlarged = supply.enlarged(&wanted).unwrap();
        let mut random = Random::new(1, 1);
        for _ in 0..2000 {
            let (direction, away) = (random.direction(), random.direction());
            let surface = shapes[0].surface_distance(&Vector3::zeros(), &direction).unwrap() * direction;
            assert!(enlarged.potential(&(surface + 0.5 * margin * away)) <= 0.0);
        }
    }
}
