//! What one ordered pair remembers between calls.

use nalgebra::Vector3;

/// The last solution of a pair, from which the next call starts.
///
/// It is a hint only: any content, even of another pair, leaves the answer within its gap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory {
    /// Solution point of midway in the local frame of B, and the ratio of weights λ = u/(1−u); `None`
    /// when nothing is known.
    pub(crate) last: Option<(Vector3<f64>, f64)>,
}

impl Memory {
    /// Marks a filled memory in its raw form; all-zero bytes are an empty one.
    const FILLED: f64 = 1.0;

    /// From the eight numbers of the C interface; whatever is not a filled memory is an empty one.
    pub fn from_raw(state: [f64; 8]) -> Self {
        let [tag, x, y, z, lambda, ..] = state;
        let usable =
            tag == Self::FILLED && [x, y, z].iter().all(|v| v.is_finite()) && lambda > 0.0 && lambda.is_finite();
        Self { last: usable.then(|| (Vector3::new(x, y, z), lambda)) }
    }

    /// To the eight numbers of the C interface.
    pub fn into_raw(self) -> [f64; 8] {
        match self.last {
            Some((x, lambda)) => [Self::FILLED, x.x, x.y, x.z, lambda, 0.0, 0.0, 0.0],
            None => [0.0; 8],
        }
    }
}
