//! Why a rock mass cannot be cut.

use thiserror::Error;

/// Why a rock mass cannot be cut.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RockError {
    /// A number is not finite or outside its range.
    #[error("{name} = {} must be {range}", number(*value))]
    OutOfRange {
        /// Which number.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it has to be.
        range: &'static str,
    },
    /// A plane of the domain has a normal of length 0, or numbers that are not finite.
    #[error("plane {0} of the domain is none: its normal must have a length, and its numbers must be finite")]
    NoPlane(usize),
    /// A joint has a normal of length 0, or numbers that are not finite.
    #[error("joint {0} is none: its normal must have a length, and its numbers must be finite")]
    NoJoint(usize),
    /// A plane of a region has a normal of length 0, or numbers that are not finite.
    #[error("plane {plane} of region {region} is none: its normal must have a length, and its numbers must be finite")]
    NoRegion {
        /// Index of the region.
        region: usize,
        /// Index of the plane.
        plane: usize,
    },
    /// Corners that make no joint, and what they must do.
    #[error("the corners of a joint must {0}")]
    NoPolygon(String),
    /// The planes of the domain enclose no volume.
    #[error("the domain is empty: no point lies inside of all its planes; normals have to point outwards")]
    Empty,
    /// Volumes and moments of the blocks of a domain of that half extent would not be doubles with all their digits.
    #[error("half extent of the domain = {0:?}: it must lie between 1e-50 and 1e50")]
    Extent(f64),
    /// The planes of the domain leave a side open.
    #[error("the domain is open: its planes leave a direction in which it never ends")]
    Open,
    /// More blocks than allowed would be made: reported before the first joint cuts.
    #[error(
        "some {} blocks or more are expected, more than most_blocks = {most}: fewer joints, larger spacings or a larger most_blocks",
        number(expected.round())
    )]
    TooManyExpected {
        /// Blocks that planes in general position would make at least; of many joints an estimate.
        expected: f64,
        /// The limit.
        most: usize,
    },
    /// More blocks than were allowed.
    #[error("joint {joint} makes more than {most} blocks: fewer joints, a larger least_volume or a larger most_blocks")]
    TooManyBlocks {
        /// Index of the joint.
        joint: usize,
        /// The limit.
        most: usize,
    },
}

/// A number as it is written: with a power of ten where its digits would fill lines.
fn number(value: f64) -> String {
    let plain = value.to_string();
    if plain.len() < 20 { plain } else { format!("{value:e}") }
}

/// The number, if it is in its range.
pub(super) fn within(value: f64, is_inside: bool, name: &'static str, range: &'static str) -> Result<f64, RockError> {
    if value.is_finite() && is_inside { Ok(value) } else { Err(RockError::OutOfRange { name, value, range }) }
}
