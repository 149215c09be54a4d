//! Why input makes no shape.

use crate::particle::error::ParticleError;
use crate::rock::RockError;
use thiserror::Error;

/// Why input makes no shape. Each names the value and the remedy.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ShapeError {
    /// A number is not finite or outside its range.
    #[error("{name}={value:?} must be {range}")]
    OutOfRange {
        /// Which number.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it has to be.
        range: &'static str,
    },
    /// A point is not finite.
    #[error("point {0} is not finite")]
    PointNotFinite(usize),
    /// Fewer than four points.
    #[error("{0} points enclose no volume: at least 4 are needed")]
    TooFewPoints(usize),
    /// All points lie in a plane, to a share of 1e-6 of their extent, at which neighbouring faces are one, or as far as their coordinates tell.
    #[error(
        "the {0} points are flat: all lie in one plane, to 1e-6 of their extent or to the last digit of their coordinates; give points that are \
         farther apart, or, if they are, nearer to the origin"
    )]
    Flat(usize),
    /// A half-space has no normal, or numbers that are not finite.
    #[error("plane {0} is none: its normal must have a length, and its numbers must be finite")]
    NoPlane(usize),
    /// No point lies inside all half-spaces.
    #[error(
        "no point lies inside all planes: turn their normals outwards, or move them apart; a body more than 1e8 times its size away from the \
         origin has to be given about an origin near it"
    )]
    Empty,
    /// The half-spaces leave a side open.
    #[error(
        "the planes enclose no volume: add the planes that are missing, or, if none is, take a body that reaches less than 1e4 times as far as \
         its planes are from the origin"
    )]
    Open,
    /// There is no regular solid of so many faces.
    #[error("faces={0}: regular solids have 4, 6, 8, 12 or 20")]
    NoRegularSolid(usize),
    /// Fewer sides than a prism has.
    #[error("sides={0} must be at least 3")]
    TooFewSides(usize),
    /// A triangle names a point that is not there.
    #[error("triangle {triangle} names point {point}, and there are {points}, counted from 0")]
    NoSuchPoint {
        /// Which triangle.
        triangle: usize,
        /// As given.
        point: u32,
        /// How many there are.
        points: usize,
    },
    /// Edges of a surface that do not join two triangles.
    #[error(
        "the surface is open, or no single one: {edges} edges do not belong to two triangles, the first from point {from} to point {to}; the \
         convex hull of its points is another way"
    )]
    OpenSurface {
        /// How many.
        edges: usize,
        /// A point of the first.
        from: u32,
        /// Its other point.
        to: u32,
    },
    /// A point or triangle of a surface lies inside its convex hull.
    #[error(
        "the surface is not convex, or crosses itself: triangle {triangle} lies {depth:.3e} inside the convex hull; that hull is another way"
    )]
    Concave {
        /// Which triangle.
        triangle: usize,
        /// How far inside, length.
        depth: f64,
    },
    /// A surface that covers its convex hull more or less than once.
    #[error("the surface crosses itself: its triangles cover its convex hull {0:.4} times")]
    Covers(f64),
    /// The centre of the shadow sphere does not settle at the centroid.
    #[error("{}", no_centre(*k, *shadow_radius))]
    NoCentre {
        /// Sphericity.
        k: f64,
        /// Radius of the shadow sphere, length.
        shadow_radius: f64,
    },
    /// The particle is refused.
    #[error(transparent)]
    Particle(#[from] ParticleError),
}

impl From<RockError> for ShapeError {
    /// Of what a block without joints is refused for.
    fn from(error: RockError) -> Self {
        match error {
            RockError::NoPlane(plane) => Self::NoPlane(plane),
            RockError::Open => Self::Open,
            _ => Self::Empty,
        }
    }
}

/// At k = 0 the shape does not depend on the centre: its centroid is then not found for want of digits.
fn no_centre(k: f64, shadow_radius: f64) -> String {
    if k == 0.0 {
        return "the centroid cannot be found to the digits of a double: take a larger r, or a body that is less flat or long".into();
    }
    format!(
        "no centre is its own centroid, to which k={k} with R={shadow_radius} leads: take a smaller k, or a larger R"
    )
}

/// The number, if it is finite and in its range.
pub(super) fn within(value: f64, is_inside: bool, name: &'static str, range: &'static str) -> Result<f64, ShapeError> {
    if value.is_finite() && is_inside { Ok(value) } else { Err(ShapeError::OutOfRange { name, value, range }) }
}

/// The number, if it is finite and above 0.
pub(super) fn positive(value: f64, name: &'static str) -> Result<f64, ShapeError> {
    within(value, value > 0.0, name, "finite and above 0")
}
