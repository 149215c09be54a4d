//! Why nothing can be packed.

use crate::particle::error::ParticleError;
use thiserror::Error;

/// Why there is no packing. Each names the value and the remedy.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum PackError {
    #[error(
        "the container from {lower:?} to {upper:?} has no volume: each of the upper coordinates must be finite and lie \
         above the lower one"
    )]
    EmptyContainer { lower: [f64; 3], upper: [f64; 3] },
    #[error("a cylinder of radius {radius:?} and height {height:?} has no volume: both must be positive and finite")]
    EmptyCylinder { radius: f64, height: f64 },
    #[error("there is no shape to pack: give at least one")]
    NoShapes,
    #[error("shape {0} lies in the plane: give a particle of planes")]
    InPlane(usize),
    #[error("there are no sizes: give at least one of them with its share")]
    NoSizes,
    #[error("size {size:?} (entry {index}) must be positive and finite")]
    Size { index: usize, size: f64 },
    #[error("share {share:?} (entry {index}) must lie in [0, 1]")]
    Share { index: usize, share: f64 },
    #[error("the shares add up to {0:?}: they must add up to 1")]
    SharesDoNotAddUp(f64),
    #[error(
        "a grading curve needs sizes that grow, and what passes them must grow from 0 to 1: entry {index} does not"
    )]
    GradingCurve { index: usize },
    #[error("margin={0:?} must be a distance: finite, and 0 or more")]
    Margin(f64),
    #[error("trials={0} must be 1 or more: as many random poses are tried for a body")]
    Trials(usize),
    #[error("a prism of {0} corners has no volume: give three or more in order around it, no two in a row alike")]
    Polygon(usize),
    #[error(
        "number={number} bodies are more than the {most} that a packing may have: take fewer, larger bodies or a smaller container"
    )]
    TooMany { number: f64, most: usize },
    #[error("shape {index}, scaled by {scale:?}, is no particle: {reason}")]
    Scaled { index: usize, scale: f64, reason: ParticleError },
    #[error(
        "no body fits: the container is {widths:?} wide, and the smallest body fills a ball of diameter {diameter:.6} \
         (with half the margin about it): take smaller bodies or a larger container"
    )]
    NothingFits { widths: [f64; 3], diameter: f64 },
}
