//! Every tolerance and choice of the library, in one place.

use crate::answer::words;
use std::fmt;
use thiserror::Error;

/// Which of the paper's two problems defines the contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
#[repr(u32)]
pub enum Formulation {
    /// Minimise t with s_A ≤ t and s_B ≤ t (paper eqs 4, 44).
    #[default]
    Midway,
    /// Minimise s_A with s_B ≤ 1, and the swap (paper eqs 3, 9, 34–43).
    Closest,
}

impl fmt::Display for Formulation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Self::Midway => "midway",
            Self::Closest => "closest",
        })
    }
}

/// Who solves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
#[repr(u32)]
pub enum BackEnd {
    /// This library's solver: Newton's method in doubles, and in extended precision where those do not settle a pair.
    #[default]
    Fast,
    /// The paper's second-order cone programs through clarabel; only with the Cargo feature `cone-program`.
    #[cfg_attr(feature = "serde", serde(alias = "conic"))] // its name in files of earlier builds
    ConeProgram,
}

words!(
    Formulation, "u4", |formulation| (formulation as u32);
    BackEnd, "u4", |back_end| (back_end as u32);
);

impl fmt::Display for BackEnd {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Self::Fast => "fast",
            Self::ConeProgram => "cone_program",
        })
    }
}

/// How to solve: the defaults, changed where needed. In C pp_settings_default fills them in, and a NULL pointer
/// in place of a pp_settings means the defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[repr(C)]
pub struct Settings {
    /// PP_MIDWAY (default) or PP_CLOSEST.
    pub formulation: Formulation,
    /// PP_FAST (default) or PP_CONE_PROGRAM.
    pub back_end: BackEnd,
    /// 0 (default): a separated pair may be answered by a proof of separation alone
    /// (PP_FLAG_REJECTED). 1: always solve, so that s, point and normal are set.
    pub(crate) solve_separated: u32,
    /// Must be 0.
    pub(crate) reserved: u32,
    /// Relative gap of s^2 at which the solver may stop; in (0, 0.1], default 1e-12, a decade above what
    /// rounding leaves for well-conditioned pairs. Where rounding leaves more, the answer has
    /// PP_FLAG_ROUNDING_LIMITED. Below 1e-13 the solver goes on in extended precision (some 10 us) until the gap
    /// is what was asked for: 1e-14 gives s, and points, to the last digits of a double.
    pub gap_tolerance: f64,
    /// Weight of the point on A in the contact point of PP_CLOSEST: point = w*P1 + (1-w)*P2, in [0, 1], default
    /// 0.5 (equal stiffness). Paper: relative stiffness of the particles.
    pub weight_on_a: f64,
    /// Where k is below this, the contact point on a flat face is chosen as if k were this value (about a sphere
    /// of the bounding radius); shape, s and overlap stay those of the given k within the gap, which grows by at
    /// most this value. In [0, 0.1], default 1e-13, the smallest whose pull on a flat face of unit size exceeds
    /// rounding; smaller values count as 1e-13. For exactly parallel faces any value gives the point nearest to
    /// the centres. Raise it to 1e-4, say, when points on flat faces jump from step to step. It never decides
    /// whether particles overlap: where it would, the default is used (PP_FLAG_DEFAULT_REGULARISATION).
    pub flat_regularisation: f64,
    /// 0 (default): every contact is solved. Above 0: a contact may be carried on from the last one of its
    /// pair and not solved (PP_FLAG_CARRIED), where no plane can have switched and its point is known to this
    /// share of the smaller bounding radius; a separated pair, as long as s is surely above 1. In [0, 0.1]; 1e-9
    /// is a good choice. Needs a pp_pair_state; contacts of PP_CLOSEST and by PP_CONE_PROGRAM are always solved.
    pub carry_tolerance: f64,
}

/// Smallest `gap_tolerance` at which the rounding of doubles is taken for an answer.
pub(crate) const LEAST_OF_DOUBLES: f64 = 1e-13;

/// Share of a smaller `gap_tolerance` that the regularisation of flat faces may take.
const SHARE_OF_REGULARISATION: f64 = 1e-5;

impl Settings {
    /// What [`Settings::default`] gives.
    pub const DEFAULT: Self = Self {
        formulation: Formulation::Midway,
        back_end: BackEnd::Fast,
        solve_separated: 0,
        reserved: 0,
        gap_tolerance: 1e-12,
        weight_on_a: 0.5,
        flat_regularisation: 1e-13,
        carry_tolerance: 0.0,
    };
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Why settings are refused, with the value at fault.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// [`Settings::gap_tolerance`] is out of range.
    #[error("gap_tolerance={0} must lie in (0, 0.1]")]
    GapTolerance(f64),
    /// [`Settings::weight_on_a`] is out of range.
    #[error("weight_on_a={0} must lie in [0, 1]")]
    WeightOnA(f64),
    /// [`Settings::flat_regularisation`] is out of range.
    #[error("flat_regularisation={0} must lie in [0, 0.1]")]
    FlatRegularisation(f64),
    /// [`Settings::carry_tolerance`] is out of range.
    #[error("carry_tolerance={0} must lie in [0, 0.1]")]
    CarryTolerance(f64),
    /// [`BackEnd::ConeProgram`] is asked for in a build without it.
    #[error(
        "the cone-program back end is not part of this build: use the fast one, or build with the Cargo feature cone-program"
    )]
    NoConeProgram,
}

/// The same settings with another number of this name.
macro_rules! with {
    ($($with:ident $field:ident: $kind:ty),*) => {
        impl Settings {
            $(
                #[doc = concat!("The same with [`Settings::", stringify!($field), "`].")]
                #[must_use]
                pub const fn $with(self, $field: $kind) -> Self {
                    Self { $field, ..self }
                }
            )*
        }
    };
}

with!(
    with_formulation formulation: Formulation,
    with_back_end back_end: BackEnd,
    with_gap_tolerance gap_tolerance: f64,
    with_weight_on_a weight_on_a: f64,
    with_flat_regularisation flat_regularisation: f64,
    with_carry_tolerance carry_tolerance: f64
);

impl Settings {
    /// The same, where separated pairs are solved to the end as well, instead of stopping at a proof of separation.
    #[must_use]
    pub const fn with_solve_separated(self, solve_separated: bool) -> Self {
        Self { solve_separated: solve_separated as u32, ..self }
    }

    /// Whether separated pairs are solved to the end as well.
    pub const fn solve_separated(&self) -> bool {
        self.solve_separated != 0
    }

    /// Sphericity that replaces smaller ones: the regularisation of flat faces, or less where it would add more to the
    /// gap than is asked for. A raised one is a choice that stays.
    pub(crate) fn least_sphericity(&self) -> f64 {
        let precise = self.gap_tolerance < LEAST_OF_DOUBLES;
        if precise && !self.raises_regularisation() {
            // s itself is rounded by as much.
            SHARE_OF_REGULARISATION * self.gap_tolerance.max(f64::EPSILON)
        } else {
            self.regularisation()
        }
    }

    /// The regularisation of flat faces as it counts in doubles: the default at least.
    pub(crate) fn regularisation(&self) -> f64 {
        self.flat_regularisation.max(Self::default().flat_regularisation)
    }

    /// Whether the regularisation of flat faces is more than the default: it then shapes the answer on purpose.
    pub(crate) fn raises_regularisation(&self) -> bool {
        self.flat_regularisation > Self::default().flat_regularisation
    }

    /// Whether a contact may be carried on.
    #[inline(always)]
    pub(crate) fn carries_on(&self) -> bool {
        self.carry_tolerance > 0.0 && self.formulation == Formulation::Midway && self.back_end == BackEnd::Fast
    }

    /// Checks every range, and that the back end was built in.
    ///
    /// ```
    /// use potential_particles::{Formulation, Settings};
    /// let settings = Settings::default().with_formulation(Formulation::Closest).with_weight_on_a(0.3);
    /// assert!(settings.validate().is_ok());
    /// assert!(settings.with_weight_on_a(1.3).validate().is_err());
    /// ```
    ///
    /// # Errors
    /// The first setting outside its range.
    #[inline]
    pub fn validate(&self) -> Result<(), SettingsError> {
        if self.back_end == BackEnd::ConeProgram && cfg!(not(feature = "cone-program")) {
            return Err(SettingsError::NoConeProgram);
        }
        if !(self.gap_tolerance > 0.0 && self.gap_tolerance <= 0.1) {
            return Err(SettingsError::GapTolerance(self.gap_tolerance));
        }
        if !(0.0..=1.0).contains(&self.weight_on_a) {
            return Err(SettingsError::WeightOnA(self.weight_on_a));
        }
        if !(0.0..=0.1).contains(&self.flat_regularisation) {
            return Err(SettingsError::FlatRegularisation(self.flat_regularisation));
        }
        if !(0.0..=0.1).contains(&self.carry_tolerance) {
            return Err(SettingsError::CarryTolerance(self.carry_tolerance));
        }
        Ok(())
    }
}
