//! What else is to be known about an answer.

/// What all sets of flags have: their bits, and the names of those that are set, by `NAMES`.
macro_rules! flag_set {
    ($flags:ident) => {
        impl $flags {
            /// The bits, as in the C interface.
            pub const fn bits(self) -> u32 {
                self.0
            }

            /// Whether all bits of `other` are set.
            pub const fn contains(self, other: Self) -> bool {
                self.0 & other.0 == other.0
            }

            /// Adds the bits of `other` where `on`.
            pub(crate) fn set(&mut self, other: Self, on: bool) {
                self.0 |= if on { other.0 } else { 0 };
            }
        }

        /// The names of the flags that are set, with commas between them; "none" where none is.
        impl std::fmt::Display for $flags {
            fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                let mut names = Self::NAMES.iter().filter(|(flag, _)| self.contains(*flag)).map(|(_, name)| *name);
                f.write_str(names.next().unwrap_or("none"))?;
                names.try_for_each(|name| write!(f, ", {name}"))
            }
        }
    };
}
pub(crate) use flag_set;

/// What else is to be known about an answer; a set of bits.
///
/// ```
/// use potential_particles::Flags;
/// let flags = Flags::REJECTED | Flags::BY_FACE;
/// assert!(flags.contains(Flags::BY_FACE) && !flags.contains(Flags::WARM));
/// assert_eq!(flags.to_string(), "rejected, by face");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
#[repr(transparent)]
pub struct Flags(u32);

impl Flags {
    pub(crate) const NONE: Self = Self(0);

    /// "closest" was asked for and has no answer: the centre (for k = 0, the core) of one particle lies inside
    /// the other, or may do so within rounding, and |P1 - P2| is no overlap then. All fields are those of midway.
    pub const SLACK: Self = Self(1);
    /// Separation was proved without solving to the end: s is a proved lower bound >= 1; of the geometry only
    /// distance is set.
    pub const REJECTED: Self = Self(2);
    /// Both gradients vanish at the contact point, as when the centres coincide: no normal is right, and
    /// the one given is the line of centres, or the x axis of B.
    pub const NORMAL_BY_CENTRES: Self = Self(4);
    /// Started from the solution that the pair remembers ([`PairState`](crate::PairState)).
    pub const WARM: Self = Self(8);
    /// Answered in extended precision (about 32 digits): doubles did not settle it, or not to the gap asked for.
    pub const EXTENDED: Self = Self(16);
    /// Carried on from the last contact, without a solution from the planes (carry_tolerance); with
    /// [`Flags::REJECTED`] from where the pair was last solved apart.
    pub const CARRIED: Self = Self(32);
    /// The gap is above the tolerance asked for: rounding allows no better. It is still a bound.
    pub const ROUNDING_LIMITED: Self = Self(64);

    /// Rejected by balls: two that hold the particles do not meet.
    pub const BY_SPHERES: Self = Self(128);
    /// Rejected by a face: one particle lies beyond a face of the other.
    pub const BY_FACE: Self = Self(256);
    /// Rejected from memory: what separated the pair at the last call still does.
    pub const BY_MEMORY: Self = Self(512);
    /// flat_regularisation was raised, and its default value was used in this call instead: the raised one
    /// would have left open whether the particles overlap.
    pub const DEFAULT_REGULARISATION: Self = Self(1024);
    /// The gradient vanishes on a flat boundary, as when the centre of the particle lies on it: the normal is the
    /// boundary's own.
    pub const NORMAL_BY_BOUNDARY: Self = Self(2048);

    /// Closest: both points are free to move along flat faces (k = 0), so that the overlap, their distance, has a
    /// part along these, up to what the faces have in common; or they are farther apart along the surface than
    /// across it, as with faces that are nearly flat. It is the answer by definition, but not a depth: midway's
    /// overlap is.
    pub const FREE: Self = Self(4096);

    /// The overlap is larger than the depth length of one of the particles (r for k = 0, R for a sphere): the bodies
    /// are deeper in each other than the potential is made for, and normal and overlap may jump.
    pub const DEEP: Self = Self(8192);

    /// Every flag with its name, in the order of the bits.
    const NAMES: [(Self, &'static str); 14] = [
        (Self::SLACK, "slack"),
        (Self::REJECTED, "rejected"),
        (Self::NORMAL_BY_CENTRES, "normal by centres"),
        (Self::WARM, "warm"),
        (Self::EXTENDED, "extended"),
        (Self::CARRIED, "carried"),
        (Self::ROUNDING_LIMITED, "rounding limited"),
        (Self::BY_SPHERES, "by spheres"),
        (Self::BY_FACE, "by face"),
        (Self::BY_MEMORY, "by memory"),
        (Self::DEFAULT_REGULARISATION, "default regularisation"),
        (Self::NORMAL_BY_BOUNDARY, "normal by boundary"),
        (Self::FREE, "free"),
        (Self::DEEP, "deep"),
    ];

    /// The bits of both.
    pub(crate) const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl std::ops::BitOr for Flags {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        self.with(other)
    }
}

flag_set!(Flags);
