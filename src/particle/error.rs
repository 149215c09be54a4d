//! Why planes and parameters do not make a particle.

use crate::particle::numbers::LEAST_TOLERANCE;
use crate::particle::plane::MAX_PLANES;
use thiserror::Error;

/// Why planes, r, k, R do not make a particle. Each names the value and the remedy.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum ParticleError {
    #[error("plane {index} is not finite: a={a:?}, b={b:?}, c={c:?}, d={d:?}")]
    PlaneNotFinite { index: usize, a: f64, b: f64, c: f64, d: f64 },
    #[error("plane {index} has a normal of length zero (d={d:?}): give it a direction or remove it")]
    ZeroNormal { index: usize, d: f64 },
    #[error(
        "plane {index} has a normal with a largest component of {length:?}: its square, or the square over r², leaves the range of \
         numbers; scale it to about unit length, and d with it"
    )]
    NormalLength { index: usize, length: f64 },
    #[error("sphericity k={0:?} is outside [0, 1]")]
    Sphericity(f64),
    #[error(
        "rounding radius r={0:?} must be positive and finite, and (1-k)/r² a number (r above 1e-154); it may be anything only when k=1"
    )]
    RoundingRadius(f64),
    #[error("shadow radius R={0:?} must be positive and finite, and k/R² a number; it may be anything only when k=0")]
    ShadowRadius(f64),
    #[error(
        "the centre is not inside: f(0)={f:?} must be negative; plane {worst} (d={d:?}) lies furthest behind \
         the origin: shift the planes so that the origin is inside"
    )]
    CentreOutside { f: f64, worst: usize, d: f64 },
    #[error("the planes do not enclose a volume, and with k=0 nothing else does: add planes or take k>0")]
    Unbounded,
    #[error("{0} planes are more than the {MAX_PLANES} that a particle may have")]
    TooManyPlanes(usize),
    #[error("line {index} is not finite: a={a:?}, b={b:?}, d={d:?}")]
    LineNotFinite { index: usize, a: f64, b: f64, d: f64 },
    #[error("line {index} has a normal of length zero (d={d:?}): give it a direction or remove it")]
    ZeroLineNormal { index: usize, d: f64 },
    #[error(
        "line {index} has a normal with a largest component of {length:?}: its square, or the square over r², leaves the range of \
         numbers; scale it to about unit length, and d with it"
    )]
    LineNormalLength { index: usize, length: f64 },
    #[error(
        "the centre is not inside: f(0)={f:?} must be negative; line {worst} (d={d:?}) lies furthest behind \
         the origin: shift the lines so that the origin is inside"
    )]
    CentreOutsideLines { f: f64, worst: usize, d: f64 },
    #[error("the lines do not enclose an area, and with k=0 nothing else does: add lines or take k>0")]
    OpenLines,
    #[error("{0} lines are more than the {MAX_PLANES} that a particle may have")]
    TooManyLines(usize),
    #[error("vertex {index} is not finite: x={x:?}, y={y:?}")]
    VertexNotFinite { index: usize, x: f64, y: f64 },
    #[error("the {0} vertices enclose no area: give three or more that do not lie on one line")]
    FlatVertices(usize),
    #[error(
        "rounding radius r={r:?} is too large: it must be below {limit:?}, the least distance of a face or side from the centroid"
    )]
    RoundingTooLarge { r: f64, limit: f64 },
    #[error(
        "rounding radius r={r:?} is too small for a particle that reaches {radius:?} from its centre, more than 1e150 times r/√(1−k): \
         take a larger r, or planes that enclose less"
    )]
    RoundingTooSmall { r: f64, radius: f64 },
    #[error(
        "the particle reaches {radius:?} from its centre, which must be from 1e-30 to 1e30: take another unit of length"
    )]
    Size { radius: f64 },
}

/// A tolerance that is out of range, or no number.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("tolerance={given:?} must be {range}")]
pub struct ToleranceError {
    /// As given.
    pub given: f64,
    /// What it has to be.
    pub range: &'static str,
}

impl ToleranceError {
    /// A relative tolerance of a volume or an area, if it is one.
    pub(crate) fn refuse_relative(given: f64) -> Result<(), Self> {
        if (LEAST_TOLERANCE..=1.0).contains(&given) { Ok(()) } else { Err(Self { given, range: "in [1e-12, 1]" }) }
    }
}

impl ParticleError {
    /// The same error for a particle in the plane, whose planes (a, b, 0, d) the caller gave as lines.
    pub(crate) fn of_lines(self) -> Self {
        match self {
            Self::PlaneNotFinite { index, a, b, d, .. } => Self::LineNotFinite { index, a, b, d },
            Self::ZeroNormal { index, d } => Self::ZeroLineNormal { index, d },
            Self::NormalLength { index, length } => Self::LineNormalLength { index, length },
            Self::CentreOutside { f, worst, d } => Self::CentreOutsideLines { f, worst, d },
            Self::Unbounded => Self::OpenLines,
            Self::TooManyPlanes(count) => Self::TooManyLines(count),
            other => other,
        }
    }
}
