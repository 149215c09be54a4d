//! Why input makes no shape.

use super::numbers::Limits;
use crate::particle::error::ParticleError;
use crate::particle::plane::MAX_PLANES;
use crate::rock::{EXTENTS, RockError};
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
    /// All points lie in a plane, to a share of 1e-6 of their extent, at which neighbouring faces are one, or as far as
    /// their coordinates tell.
    #[error(
        "the {0} points are flat: all lie in one plane, to 1e-6 of their extent or to the last digit of their coordinates; give points that are \
         farther apart, or, if they are, nearer to the origin"
    )]
    Flat(usize),
    /// The extent of a body, the largest edge of the box about it, is out of range.
    #[error("the extent of the body is {0:?}, and must lie between 1e-50 and 1e50: take another unit of length")]
    Extent(f64),
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
        "the planes enclose no volume: add the planes that are missing, or, if none is, take a body that reaches less than 1e8 times as far as \
         its planes are from the origin"
    )]
    Open,
    /// More faces than are rounded.
    #[error(
        "{0} faces are more than the {most} that are rounded: take fewer, as fitted() or planes= do",
        most = Limits::ROUNDED_PLANES
    )]
    TooManyFaces(usize),
    /// The half-spaces enclose a body that is flat: all of it lies within 1e-6 of its extent of one of its faces, at
    /// which faces are one.
    #[error("the planes enclose a body that is flat, to 1e-6 of its extent: move them apart")]
    Thin,
    /// There is no regular solid of so many faces.
    #[error("faces={0}: regular solids have 4, 6, 8, 12 or 20")]
    NoRegularSolid(usize),
    /// Fewer sides than a prism has, or, with its ends, more than a particle may have.
    #[error("sides={0} must lie between 3 and {most}", most = MAX_PLANES - 2)]
    Sides(usize),
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
    /// Edges of a surface that belong to one triangle alone.
    #[error(
        "the surface is open: {edges} edges belong to one triangle alone, the first from {} to {}; close it, or take the convex hull of its points",
        place(from),
        place(to)
    )]
    OpenSurface {
        /// How many.
        edges: usize,
        /// An end of the first, length.
        from: [f64; 3],
        /// Its other end, length.
        to: [f64; 3],
    },
    /// Edges of a surface that belong to more than two triangles.
    #[error(
        "the surface is no single surface: {edges} edges belong to more than two triangles, the first from {} to {}; divide it, or take the convex \
         hull of its points",
        place(from),
        place(to)
    )]
    BranchedSurface {
        /// How many.
        edges: usize,
        /// An end of the first, length.
        from: [f64; 3],
        /// Its other end, length.
        to: [f64; 3],
    },
    /// A point or triangle of a surface lies inside its convex hull.
    #[error(
        "the surface is not convex, or crosses itself: the {what} at {} lies {} inside the convex hull; take the convex hull of its points",
        place(at), short(*depth)
    )]
    Concave {
        /// "point" or "triangle".
        what: &'static str,
        /// Where, length.
        at: [f64; 3],
        /// How far inside, length.
        depth: f64,
    },
    /// A surface that covers its convex hull more or less than once.
    #[error("the surface crosses itself: its triangles cover its convex hull {} times", short(*.0))]
    Covers(f64),
    /// A rounding radius that leaves nothing of the largest ball within.
    #[error(
        "r={r:?} is a length and must lie between 0 and {}, half the diameter of the largest ball that fits inside: rounding gives it as a share of \
         that diameter", short(*limit)
    )]
    RadiusTooLarge {
        /// As given, length.
        r: f64,
        /// The radius of the ball, length.
        limit: f64,
    },
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
            RockError::Extent(half) => Self::Extent(2.0 * half),
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

/// With six digits.
fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

fn place(point: &[f64; 3]) -> String {
    let [x, y, z] = point.map(short);
    format!("({x}, {y}, {z})")
}

/// The number, if it is finite and in its range.
pub(super) fn within(value: f64, is_inside: bool, name: &'static str, range: &'static str) -> Result<f64, ShapeError> {
    if value.is_finite() && is_inside { Ok(value) } else { Err(ShapeError::OutOfRange { name, value, range }) }
}

/// The number, if it is a length above 0 whose powers are numbers.
pub(super) fn positive(value: f64, name: &'static str) -> Result<f64, ShapeError> {
    let range = if value > 0.0 && value.is_finite() { "from 1e-50 to 1e50" } else { "finite and above 0" };
    within(value, EXTENTS.contains(&value), name, range)
}

/// The extent of a body, if its powers are numbers.
pub(super) fn refuse_extent(extent: f64) -> Result<(), ShapeError> {
    if EXTENTS.contains(&extent) { Ok(()) } else { Err(ShapeError::Extent(extent)) }
}
