//! Limits of a rock mass.

use crate::rock::error::{RockError, within};

/// Limits of a rock mass, and on how many threads it is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceSettings {
    /// A joint leaves a block whole if one of its parts would have less than this volume.
    pub least_volume: f64,
    /// Or be thinner than this in the mean, 2V/A of volume and surface: of a wide slab its thickness, of a cube a third
    /// of its edge.
    pub least_thickness: f64,
    /// Or if the largest ball in a part would have a smaller diameter than this, the paper's limit on size.
    pub least_width: f64,
    /// Or if its extent along x, y or z would exceed this multiple of that diameter.
    pub largest_aspect: f64,
    /// More blocks than this are an error: where none of the limits above is set, it is told before the first joint
    /// cuts if more are expected.
    pub most_blocks: usize,
    /// How many threads cut, the calling one among them; 0 is 1. The blocks and their order are, to the last bit, the
    /// same for any number.
    pub threads: usize,
}

impl Default for SliceSettings {
    fn default() -> Self {
        Self {
            least_volume: 0.0,
            least_thickness: 0.0,
            least_width: 0.0,
            largest_aspect: f64::INFINITY,
            most_blocks: 1_000_000,
            threads: 1,
        }
    }
}

impl SliceSettings {
    /// Whether parts may be too small to be made.
    pub(super) fn leaves_out(&self) -> bool {
        self.least_volume > 0.0
            || self.least_thickness > 0.0
            || self.least_width > 0.0
            || self.largest_aspect.is_finite()
    }

    pub(super) fn validate(&self) -> Result<(), RockError> {
        within(self.least_volume, self.least_volume >= 0.0, "least_volume", "a volume of 0 or above")?;
        within(self.least_thickness, self.least_thickness >= 0.0, "least_thickness", "a length of 0 or above")?;
        within(self.least_width, self.least_width >= 0.0, "least_width", "a length of 0 or above")?;
        if !(self.largest_aspect >= 1.0) {
            let value = self.largest_aspect;
            return Err(RockError::OutOfRange { name: "largest_aspect", value, range: "1 or above" });
        }
        Ok(())
    }
}
