//! Every tolerance and choice of the library, in one place.

use crate::answer::{Field, Row, is_full, row, words};
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

/// The settings from the list of them: their defaults, of numbers the range and the method that changes one, and how
/// they are written to files.
macro_rules! settings {
    (
        $(#[doc = $about:literal])*
        pub struct Settings {
            $(
                $(#[doc = $doc:literal])*
                $(#[within($range:literal, $with:ident, |$x:ident| $is_in:expr)])?
                $(#[written($($written:tt)+)])?
                $vis:vis $field:ident: $type:ty = $default:expr,
            )+
        }
    ) => {
        $(#[doc = $about])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        #[repr(C)]
        pub struct Settings {
            $($(#[doc = $doc])* $vis $field: $type,)+
        }

        const _: () = assert!(is_full(Settings::LAYOUT, size_of::<Settings>()));

        impl Settings {
            /// What [`Settings::default`] gives.
            pub const DEFAULT: Self = Self { $($field: $default,)+ };

            /// Every field.
            pub const LAYOUT: &'static [Row] = &[$(row!($field: $type, $($doc)*),)+];

            /// The settings that are numbers: the name, and the method that changes it.
            pub const NUMBERS: &'static [(&'static str, fn(Self, f64) -> Self)] =
                &[$($((stringify!($field), Self::$with),)?)+];

            /// The number of this name; nothing where there is none.
            pub fn numbers(&self, field: &str) -> &[f64] {
                match field {
                    $(stringify!($field) => Field::numbers(&self.$field),)+
                    _ => &[],
                }
            }

            $($(
                #[doc = concat!("The same with [`Settings::", stringify!($field), "`].")]
                #[must_use]
                pub const fn $with(self, $field: f64) -> Self {
                    Self { $field, ..self }
                }
            )?)+

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
                $($(
                    let $x = self.$field;
                    if !$is_in {
                        return Err(SettingsError::Number { name: stringify!($field), value: $x, range: $range });
                    }
                )?)+
                Ok(())
            }
        }

        /// As they are written; what is missing has its default.
        #[cfg(feature = "serde")]
        #[derive(serde::Serialize, serde::Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub(crate) struct Written {
            $($(#[serde($($written)+)])? $field: $type,)+
        }

        #[cfg(feature = "serde")]
        impl From<Settings> for Written {
            fn from(settings: Settings) -> Self {
                Self { $($field: settings.$field,)+ }
            }
        }

        #[cfg(feature = "serde")]
        impl From<Written> for Settings {
            fn from(written: Written) -> Self {
                Self { $($field: written.$field,)+ }
            }
        }
    };
}

settings! {
    /// How to solve: the defaults, changed where needed. In C pp_settings_default fills them in, and a NULL pointer
    /// in place of a pp_settings means the defaults.
    pub struct Settings {
        /// [`Formulation::Midway`] (default) or [`Formulation::Closest`].
        pub formulation: Formulation = Formulation::Midway,
        /// [`BackEnd::Fast`] (default) or [`BackEnd::ConeProgram`].
        pub back_end: BackEnd = BackEnd::Fast,
        /// 0 (default): a separated pair may be answered by a proof of separation alone
        /// ([`Flags::REJECTED`](crate::Flags)). 1: always solve, so that s, point and normal are set.
        #[written(with = "crate::serialisation::switch")]
        pub(crate) solve_separated: u32 = 0,
        /// Must be 0.
        #[written(skip)]
        pub(crate) reserved: u32 = 0,
        /// Relative gap of s^2 at which the solver may stop; in (0, 0.1], default 1e-12, a decade above what
        /// rounding leaves for well-conditioned pairs. Where rounding leaves more, the answer has
        /// [`Flags::ROUNDING_LIMITED`](crate::Flags). Below 1e-13 the solver goes on in extended precision (some
        /// 10 us) until the gap is what was asked for: 1e-14 gives s, and points, to the last digits of a double.
        #[within("(0, 0.1]", with_gap_tolerance, |x| (x > 0.0 && x <= 0.1))]
        pub gap_tolerance: f64 = 1e-12,
        /// Weight of the point on A in the contact point of [`Formulation::Closest`]: point = w*P1 + (1-w)*P2, in
        /// [0, 1], default 0.5 (equal stiffness). Paper: relative stiffness of the particles.
        #[within("[0, 1]", with_weight_on_a, |x| (0.0..=1.0).contains(&x))]
        pub weight_on_a: f64 = 0.5,
        /// Where k is below this, the contact point on a flat face is chosen as if k were this value (about a sphere
        /// of the bounding radius); shape, s and overlap stay those of the given k within the gap, which grows by at
        /// most this value. In [0, 0.1], default 1e-13, the smallest whose pull on a flat face of unit size exceeds
        /// rounding; smaller values count as 1e-13. For exactly parallel faces any value gives the point nearest to
        /// the centres. Raise it to 1e-4, say, when points on flat faces jump from step to step. It never decides
        /// whether particles overlap: where it would, the default is used
        /// ([`Flags::DEFAULT_REGULARISATION`](crate::Flags)).
        #[within("[0, 0.1]", with_flat_regularisation, |x| (0.0..=0.1).contains(&x))]
        pub flat_regularisation: f64 = 1e-13,
        /// 0 (default): every contact is solved. Above 0: a contact may be carried on from the last one of its
        /// pair and not solved ([`Flags::CARRIED`](crate::Flags)), where no plane can have switched and its point is
        /// known to this share of the smaller bounding radius; a separated pair, as long as s is surely above 1. In
        /// [0, 0.1]; 1e-9 is a good choice. Needs a [`PairState`](crate::PairState); contacts of
        /// [`Formulation::Closest`] and by [`BackEnd::ConeProgram`] are always solved.
        #[within("[0, 0.1]", with_carry_tolerance, |x| (0.0..=0.1).contains(&x))]
        pub carry_tolerance: f64 = 0.0,
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

#[cfg(feature = "serde")]
impl Default for Written {
    fn default() -> Self {
        Settings::DEFAULT.into()
    }
}

/// Why settings are refused, with the value at fault.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// A number is out of range.
    #[error("{name}={value:?} must lie in {range}")]
    Number {
        /// Its name.
        name: &'static str,
        /// The value.
        value: f64,
        /// Where it may lie.
        range: &'static str,
    },
    /// [`BackEnd::ConeProgram`] is asked for in a build without it.
    #[error(
        "the cone-program back end is not part of this build: use the fast one, or build with the Cargo feature cone-program"
    )]
    NoConeProgram,
}

/// Smallest `gap_tolerance` at which the rounding of doubles is taken for an answer. Chosen: below it most gaps of
/// doubles are wider.
pub(crate) const LEAST_OF_DOUBLES: f64 = 1e-13;

/// Share of a smaller `gap_tolerance` that the regularisation of flat faces may take (chosen).
const SHARE_OF_REGULARISATION: f64 = 1e-5;

impl Settings {
    /// The same with [`Settings::formulation`].
    #[must_use]
    pub const fn with_formulation(self, formulation: Formulation) -> Self {
        Self { formulation, ..self }
    }

    /// The same with [`Settings::back_end`].
    #[must_use]
    pub const fn with_back_end(self, back_end: BackEnd) -> Self {
        Self { back_end, ..self }
    }

    /// The same, where separated pairs are solved to the end as well, instead of stopping at a proof of separation.
    #[must_use]
    pub const fn with_solve_separated(self, solve_separated: bool) -> Self {
        Self { solve_separated: solve_separated as u32, ..self }
    }

    /// Whether separated pairs are solved to the end as well.
    pub const fn solve_separated(&self) -> bool {
        self.solve_separated != 0
    }

    /// Whether more is asked for than doubles give.
    pub(crate) fn is_precise(&self) -> bool {
        self.gap_tolerance < LEAST_OF_DOUBLES
    }

    /// Sphericity that replaces smaller ones: the regularisation of flat faces, or less where it would add more to the
    /// gap than is asked for. A raised one is a choice that stays.
    pub(crate) fn least_sphericity(&self) -> f64 {
        if self.is_precise() && !self.raises_regularisation() {
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
}
