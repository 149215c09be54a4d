//! What one ordered pair remembers between calls.

use nalgebra::Vector3;

/// The last solution of a pair, from which the next call starts.
///
/// It is a hint only: any content, even of another pair, leaves the answer within its gap.
///
/// ```
/// use potential_particles::{Flags, Memory, Particle, Pose, Settings, detect};
/// let ball = Particle::sphere(1.0)?;
/// let here = Pose::at([0.0, 0.0, 0.0])?;
/// let mut memory = Memory::default();
/// for step in 0..3 {
///     let there = Pose::at([1.5, 0.0, 1e-3 * f64::from(step)])?;
///     let contact = detect(&ball, &here, &ball, &there, &Settings::default(), Some(&mut memory))?;
///     assert_eq!(contact.flags.contains(Flags::WARM), step > 0);
/// }
/// // As numbers, to save with a simulation.
/// assert_eq!(Memory::from_raw(memory.into_raw()), memory);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory {
    pub(crate) last: Option<Remembered>,
}

/// The solution of midway, or what comes near it where closest was found without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remembered {
    /// P3 in the local frame of B.
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    /// Whether the particles overlapped: if so, cheap proofs of separation are hardly worth a try.
    pub overlapping: bool,
    /// By what the λ of P1 and P2 differ from what `dual_path::closest_from_between` makes of the above: factors.
    pub closest: [f64; 2],
}

impl Memory {
    /// Marks a filled memory in its raw form; all-zero bytes are an empty one.
    const FILLED: f64 = 1.0;

    /// From the eight numbers of [`Self::into_raw`]; whatever is not a filled memory is an empty one.
    pub fn from_raw(state: [f64; 8]) -> Self {
        let [tag, x, y, z, lambda, overlapping, of_p1, of_p2] = state;
        let usable =
            tag == Self::FILLED && [x, y, z].iter().all(|v| v.is_finite()) && lambda > 0.0 && lambda.is_finite();
        let (x, overlapping, closest) = (Vector3::new(x, y, z), overlapping == 1.0, [of_p1, of_p2]);
        let remembered = || Remembered { x, lambda, overlapping, closest };
        Self { last: usable.then(remembered) }
    }

    /// To where a contact that was carried on has moved since.
    pub(crate) fn follow(&mut self, x: Vector3<f64>, lambda: f64) {
        if let Some(last) = &mut self.last {
            (last.x, last.lambda) = (x, lambda);
        }
    }

    /// As eight numbers: 1 if filled, else 0; x, y, z of the midway point in the local frame of B, length; λ = u/(1−u); 1 if the pair
    /// overlapped, else 0; factors on λ for P1 and P2.
    pub fn into_raw(self) -> [f64; 8] {
        match self.last {
            Some(Remembered { x, lambda, overlapping, closest: [of_p1, of_p2] }) => {
                [Self::FILLED, x.x, x.y, x.z, lambda, if overlapping { 1.0 } else { 0.0 }, of_p1, of_p2]
            }
            None => [0.0; 8],
        }
    }
}
