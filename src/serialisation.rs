//! What can be written down and read back with serde: particles, planes, poses, settings, states of pairs and contacts.
//! Other answers derive it field by field.
//!
//! Each type passes through a plain twin of its own, and reading goes through the checks of the constructor, so that no
//! file makes a particle, a pose or settings that the program could not. Numbers that do not apply (NaN) are written as
//! nothing, since JSON has no NaN; an infinite number is lost in JSON in the same way.

use crate::pose::Turn;
use crate::settings::Written;
use crate::{PairState, Particle, Plane, Pose, Settings};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Serialize and Deserialize of a type through its twin; `$back` makes the type of the twin, or says why not.
macro_rules! through {
    ($type:ty, $twin:ty, $to:expr, $back:expr) => {
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let to: fn(&$type) -> $twin = $to;
                to(self).serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let back: fn($twin) -> Result<$type, String> = $back;
                back(<$twin>::deserialize(deserializer)?).map_err(D::Error::custom)
            }
        }
    };
}

/// (a, b, c, d).
type PlaneTwin = [f64; 4];

through!(
    Plane,
    PlaneTwin,
    |plane| [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset],
    |row| Ok(row.into())
);

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParticleTwin {
    planes: Vec<Plane>,
    r: f64,
    k: f64,
    shadow_radius: f64,
    /// Whether the planes are (a, b, 0, d) of lines in the plane.
    #[serde(default)]
    in_plane: bool,
}

through!(
    Particle,
    ParticleTwin,
    |particle| ParticleTwin {
        planes: particle.planes().collect(),
        r: particle.rounding_radius(),
        k: particle.sphericity(),
        shadow_radius: particle.shadow_radius(),
        in_plane: particle.is_in_plane(),
    },
    |ParticleTwin { planes, r, k, shadow_radius, in_plane }| {
        let lines = || planes.iter().map(|plane| [plane.normal.x, plane.normal.y, plane.offset]).collect::<Vec<_>>();
        let made = if in_plane {
            Particle::in_plane(&lines(), r, k, shadow_radius)
        } else {
            Particle::new(&planes, r, k, shadow_radius)
        };
        made.map_err(|error| error.to_string())
    }
);

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PoseTwin {
    position: [f64; 3],
    /// (w, x, y, z), as it was given.
    orientation: [f64; 4],
    /// Of a pose in the plane, which counts by its angle, as it was given.
    #[serde(default)]
    angle: Option<f64>,
}

through!(
    Pose,
    PoseTwin,
    |pose| PoseTwin {
        position: (*pose.position()).into(),
        orientation: pose.orientation(),
        angle: if let Turn::Angle(angle) = pose.turn() { Some(angle) } else { None },
    },
    |PoseTwin { position, orientation, angle }| {
        let made = match (angle, position) {
            (Some(angle), [x, y, 0.0]) => Pose::in_plane([x, y], angle),
            _ => Pose::new(position, orientation),
        };
        made.map_err(|error| error.to_string())
    }
);

through!(Settings, Written, |settings| (*settings).into(), |written| {
    let settings = Settings::from(written);
    settings.validate().map_err(|error| error.to_string())?;
    Ok(settings)
});

/// 0 or 1 as false or true.
pub(crate) mod switch {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer>(on: &u32, serializer: S) -> Result<S::Ok, S::Error> {
        (*on != 0).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
        bool::deserialize(deserializer).map(u32::from)
    }
}

// Of a state its remembered solution alone: whatever the numbers are, it is a hint.
through!(PairState, [Number; 8], |state| state.into_raw().map(Number), |raw| Ok(PairState::from_raw(raw.map(|n| n.0))));

/// A number, or nothing for NaN.
#[derive(Clone, Copy)]
pub(crate) struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Some(self.0).filter(|number| !number.is_nan()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(Self(Option::deserialize(deserializer)?.unwrap_or(f64::NAN)))
    }
}

/// How the fields of an answer are written: a number that does not apply as nothing, a vector as a row of such numbers.
pub(crate) mod field {
    use super::Number;
    use crate::{BackEnd, Feature, Flags, Formulation, Kind};
    use nalgebra::SVector;
    use serde::de::{DeserializeOwned, Error};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// What is written in place of a field.
    pub(crate) trait Written: Copy {
        type As: Serialize + DeserializeOwned;

        fn to(self) -> Self::As;
        fn back(written: Self::As) -> Option<Self>;
    }

    pub(crate) fn serialize<T: Written, S: Serializer>(field: &T, serializer: S) -> Result<S::Ok, S::Error> {
        field.to().serialize(serializer)
    }

    pub(crate) fn deserialize<'de, T: Written, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
        let wrong = || D::Error::custom("a vector has another number of components");
        T::back(T::As::deserialize(deserializer)?).ok_or_else(wrong)
    }

    impl Written for f64 {
        type As = Number;

        fn to(self) -> Number {
            Number(self)
        }

        fn back(written: Number) -> Option<Self> {
            Some(written.0)
        }
    }

    impl<const N: usize> Written for SVector<f64, N> {
        type As = Vec<Number>;

        fn to(self) -> Vec<Number> {
            self.iter().map(|&number| Number(number)).collect()
        }

        fn back(written: Vec<Number>) -> Option<Self> {
            (written.len() == N).then(|| Self::from_fn(|i, _| written[i].0))
        }
    }

    /// What is written as it is.
    macro_rules! as_it_is {
        ($($field:ty),+) => {
            $(impl Written for $field {
                type As = Self;

                fn to(self) -> Self {
                    self
                }

                fn back(written: Self) -> Option<Self> {
                    Some(written)
                }
            })+
        };
    }

    as_it_is!(u32, Kind, Feature, Formulation, BackEnd, Flags);
}
