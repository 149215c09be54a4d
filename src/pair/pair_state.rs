//! What one ordered pair keeps from call to call.

use crate::linalg::number::smaller;
use crate::linalg::symmetric::Symmetric;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::Vector3;

/// The state of one ordered pair (A, B), of two particles or of one and a boundary: the last solution, from which the
/// next call starts, and, with [`crate::Settings::carry_tolerance`] above 0, both potentials as quadratics about the
/// last contact, from which the next contact may follow without a solution from the planes. Empty by default.
///
/// The solution is a hint and can be saved ([`Self::into_raw`]): any content, even of another pair, leaves the answer
/// within its gap. The quadratics are no hint and are never saved: only the library writes them, and uses them for the
/// two particles for which they were written.
///
/// ```
/// use potential_particles::{Flags, PairState, Particle, Pose, Settings, detect};
/// let ball = Particle::sphere(1.0)?;
/// let here = Pose::at([0.0, 0.0, 0.0])?;
/// let mut state = PairState::default();
/// for step in 0..3 {
///     let there = Pose::at([1.5, 0.0, 1e-3 * f64::from(step)])?;
///     let contact = detect(&ball, &here, &ball, &there, &Settings::default(), Some(&mut state))?;
///     assert_eq!(contact.flags.contains(Flags::WARM), step > 0);
/// }
/// // As numbers, to save with a simulation.
/// assert_eq!(PairState::from_raw(state.into_raw()).into_raw(), state.into_raw());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct PairState {
    /// As of [`Self::into_raw`]: whatever is here is checked when it is read.
    solution: [f64; 8],
    pub(crate) last_contact: LastContact,
}

/// The solution of midway, or what comes near it where closest was found without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remembered {
    /// P3 in the local frame of B.
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    pub how: How,
    /// For [`How::Balanced`] the planes, as [`crate::pair::minimum_norm_point::MinimumNorm::places`]. Else the ratios
    /// of the λ of P1 and P2 to the ones that `solver::closest::from_between` predicts; used where the products are in
    /// the range of λ.
    pub closest: [f64; 2],
}

/// How a pair was found; the sixth number of [`PairState::into_raw`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum How {
    Apart = 0,
    /// Most separation tests are left out at the next call.
    Overlapping = 1,
    /// Apart by planes in balance.
    Balanced = 2,
}

impl How {
    /// Of a solution whose particles overlap or do not.
    #[inline(always)]
    pub fn solved(overlapping: bool) -> Self {
        if overlapping { Self::Overlapping } else { Self::Apart }
    }
}

/// Both potentials about the last contact that was solved.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(crate) struct LastContact {
    /// Serial numbers of A and B; 0 where nothing is known.
    pub of: [u64; 2],
    pub pieces: [KnownPiece; 2],
    /// Bounds that the contact had when it was solved.
    pub gap: f64,
    pub point_bound: f64,
    /// S, and bounds on the rounding of S_A and S_B, when it was solved.
    pub square: f64,
    pub roundings: [f64; 2],
    /// Bound on the growth of the rounding since the solve, and how often the pieces were recentred.
    pub growth: f64,
    pub recentrings: f64,
    /// `gap_tolerance` and `flat_regularisation` with which it was solved.
    pub precision: [f64; 2],
}

/// S about a point, in the frame of its body or in that of B.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(crate) struct KnownPiece {
    pub from: Vector3<f64>,
    pub value: f64,
    pub gradient: Vector3<f64>,
    pub hessian: Symmetric,
    /// Distance from there within which no plane switches and points are rounded by no more than three times as much,
    /// length.
    pub validity_radius: f64,
}

/// A guess of λ lies in this range: beyond it one particle's weight is lost in rounding altogether (chosen).
pub(crate) const LAMBDA_RANGE: (f64, f64) = (1e-30, 1e30);

/// A solution lies no further from the centre of B than that of A does and so many times both bounding radii: midway is
/// within both bodies where they overlap, and near the line of centres where they do not (chosen).
const REACH: f64 = 8.0;

impl PairState {
    /// Marks a solution that is there; all-zero bytes are an empty state (chosen).
    const FILLED: f64 = 1.0;

    /// A state from the eight numbers of [`Self::into_raw`]. Numbers that are no solution count as an empty state.
    pub fn from_raw(solution: [f64; 8]) -> Self {
        Self { solution, last_contact: LastContact::default() }
    }

    /// The remembered solution as eight numbers: 1 if there is one, else 0; x, y, z of the midway point in the local
    /// frame of B, length; λ = u/(1−u); 1 if the pair overlapped, 2 if planes kept it apart, else 0; factors on λ for
    /// P1 and P2, or which planes. Of a boundary: x, y, z is the point of its plane, in the local frame of the
    /// particle, and λ and the factors are 1.
    pub fn into_raw(self) -> [f64; 8] {
        self.solution
    }

    /// The remembered solution, if there is one that these two bodies can have had.
    #[inline(always)]
    pub(crate) fn remembered(&self, a: (&Particle, &Pose), b: (&Particle, &Pose)) -> Option<Remembered> {
        let [filled, x, y, z, lambda, ..] = self.solution;
        let between = (b.1.position() - a.1.position()).amax();
        let reach = smaller(between + REACH * (a.0.bounding_radius() + b.0.bounding_radius()), f64::MAX);
        // Written so that what is not a number fails. The factors are checked with the λ that they give.
        let usable = filled == Self::FILLED
            && [x, y, z].iter().all(|c| c.abs() <= reach)
            && lambda >= LAMBDA_RANGE.0
            && lambda <= LAMBDA_RANGE.1;
        usable.then(|| self.unpacked())
    }

    /// Where the last search on the plane of a boundary ended, in the local frame of the particle: any place that is
    /// not too far away to tell something.
    pub(crate) fn remembered_on_boundary(&self, a: &Particle) -> Option<Vector3<f64>> {
        let [filled, x, y, z, ..] = self.solution;
        let reach = smaller(REACH * a.bounding_radius(), f64::MAX);
        // Written so that what is not a number fails.
        let usable = filled == Self::FILLED && [x, y, z].iter().all(|c| c.abs() <= reach);
        usable.then(|| Vector3::new(x, y, z))
    }

    /// The remembered solution of a state that was found to have one.
    #[inline(always)]
    pub(crate) fn unpacked(&self) -> Remembered {
        let [_, x, y, z, lambda, how, of_p1, of_p2] = self.solution;
        let how = match how {
            1.0 => How::Overlapping,
            2.0 => How::Balanced,
            _ => How::Apart,
        };
        Remembered { x: Vector3::new(x, y, z), lambda, how, closest: [of_p1, of_p2] }
    }

    #[inline(always)]
    pub(crate) fn remember(&mut self, remembered: Remembered) {
        let Remembered { x, lambda, how, closest: [of_p1, of_p2] } = remembered;
        self.solution = [Self::FILLED, x.x, x.y, x.z, lambda, f64::from(how as u8), of_p1, of_p2];
    }
}

/// What `solve` gives with the memory, if there is one; if that fails, without. The memory may be of any other pair,
/// and `solve` does not converge from every start.
#[inline(always)]
pub(crate) fn from_memory_or_anew<T, E>(remembers: bool, mut solve: impl FnMut(bool) -> Result<T, E>) -> Result<T, E> {
    match solve(remembers) {
        Err(_) if remembers => solve(false),
        found => found,
    }
}

impl LastContact {
    /// Whether it is of these two particles, with finite bounds.
    #[inline(always)]
    pub fn is_of(&self, a: &Particle, b: &Particle) -> bool {
        // Other fields that are not finite make S not finite.
        let bounds = (self.pieces[0].validity_radius + self.pieces[1].validity_radius) + (self.gap + self.point_bound);
        self.of == [a.serial(), b.serial()] && bounds.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Contact, Formulation, Kind, Settings, detect};
    use proptest::prelude::*;

    /// A number of any size, or none.
    fn any_number() -> impl Strategy<Value = f64> {
        prop_oneof![
            4 => (any::<bool>(), -3.0..3.0_f64).prop_map(signed_power),
            2 => (any::<bool>(), -308.0..308.0_f64).prop_map(signed_power),
            1 => any::<u64>().prop_map(f64::from_bits),
            1 => prop_oneof![Just(0.0), Just(1.0), Just(f64::NAN), Just(f64::INFINITY), Just(f64::MAX)],
        ]
    }

    fn signed_power((negative, log): (bool, f64)) -> f64 {
        if negative { -10_f64.powf(log) } else { 10_f64.powf(log) }
    }

    fn pairs() -> [(Particle, Particle); 3] {
        let cube = |half| Particle::cube(half, 0.1, 0.02, 3.0 * half);
        let sharp = Particle::cube(0.5, 1e-4, 0.0, 1.0);
        [(cube(0.4), cube(0.4)), (sharp.clone(), cube(20.0)), (sharp, Particle::sphere(0.7).unwrap())]
    }

    /// The same but for both bounds, which still tell something.
    fn assert_agree(warm: &Contact, cold: &Contact) {
        let both = warm.gap + cold.gap + 4.0 * f64::EPSILON * cold.s;
        assert!(warm.kind == cold.kind || (cold.s - 1.0).abs() <= both.min(1e-9), "{warm:?}\n{cold:?}");
        if warm.kind == Kind::Overlapping && cold.kind == Kind::Overlapping {
            // A carried point is known to the carry tolerance, and s rises by 1/r along the normal of the sharpest
            // body.
            let most = if warm.flags.contains(crate::Flags::CARRIED) { 1e-9 / 1e-4 } else { 1e-6 };
            assert!((warm.s - cold.s).abs() <= both && warm.gap <= most + 10.0 * cold.gap, "{warm:?}\n{cold:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn no_remembered_solution_changes_an_answer(
            which in 0..3_usize,
            closest: bool,
            solve_separated: bool,
            direction in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
            share in 0.0..1.1_f64,
            turn in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
            numbers in proptest::array::uniform8(any_number()),
            filled in prop::bool::weighted(0.9),
        ) {
            let (a, b) = &pairs()[which];
            let towards = Vector3::from(direction);
            prop_assume!(towards.norm() > 0.1);
            let at = share * (a.bounding_radius() + b.bounding_radius()) * towards.normalize();
            let pose_a = Pose::new([0.0; 3], [1.0, turn[2], turn[0], turn[1]]).unwrap();
            let pose_b = Pose::new(at.into(), [1.0, turn[0], turn[1], turn[2]]).unwrap();
            let formulation = if closest { Formulation::Closest } else { Formulation::Midway };
            let settings = Settings { formulation, carry_tolerance: 1e-9, ..Settings::default() };
            let settings = settings.with_solve_separated(solve_separated);
            let look = |state: Option<&mut PairState>| detect(a, &pose_a, b, &pose_b, &settings, state);
            let cold = look(None).unwrap();
            let mut solution = numbers;
            if filled {
                solution[0] = PairState::FILLED;
            }
            let mut state = PairState::from_raw(solution);
            assert_agree(&look(Some(&mut state)).unwrap(), &cold);
            // What it has written, with one number spoilt.
            for (i, number) in numbers.into_iter().enumerate() {
                let mut spoilt = state;
                spoilt.solution[i] = number;
                assert_agree(&look(Some(&mut spoilt)).unwrap(), &cold);
            }
        }
    }

    #[test]
    fn a_contact_in_numbers_that_are_not_finite_is_not_carried_on() {
        let (a, b) = &pairs()[0];
        let (pose_a, pose_b) =
            (Pose::at([0.0; 3]).unwrap(), Pose::new([0.3, 0.2, 0.85], [1.0, 0.1, 0.2, 0.3]).unwrap());
        let settings = Settings { carry_tolerance: 1e-9, ..Settings::default() };
        let mut state = PairState::default();
        let look = |state: &mut PairState| detect(a, &pose_a, b, &pose_b, &settings, Some(state)).unwrap();
        // From nothing it may be solved on the edge of a piece, of which nothing is carried on.
        let solved = [(); 2].map(|()| look(&mut state))[0];
        assert!(look(&mut state).flags.contains(crate::Flags::CARRIED));
        let spoil: [fn(&mut LastContact) -> &mut f64; 7] = [
            |last| &mut last.pieces[0].from.z,
            |last| &mut last.pieces[1].value,
            |last| &mut last.pieces[0].gradient.x,
            |last| &mut last.pieces[1].hessian.zy,
            |last| &mut last.pieces[0].validity_radius,
            |last| &mut last.gap,
            |last| &mut last.point_bound,
        ];
        for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for spoil in spoil {
                let mut spoilt = state;
                *spoil(&mut spoilt.last_contact) = number;
                let contact = look(&mut spoilt);
                assert!(!contact.flags.contains(crate::Flags::CARRIED), "{contact:?}");
                assert_agree(&contact, &solved);
            }
        }
    }
}
