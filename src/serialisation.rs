//! What can be written down and read back with serde: planes, poses, settings, states of pairs and contacts.
//!
//! Each type passes through a plain twin of its own, and reading goes through the checks of the constructor, so that no
//! file makes a pose or settings that the program could not. Numbers that do not apply (NaN) are written as nothing, since
//! JSON has no NaN; an infinite number is lost in JSON in the same way.

use crate::{BackEnd, Contact, Flags, Formulation, Kind, PairState, Plane, Pose, Settings};
use nalgebra::Vector3;
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
struct PoseTwin {
    position: [f64; 3],
    /// (w, x, y, z), as it was given.
    orientation: [f64; 4],
}

through!(
    Pose,
    PoseTwin,
    |pose| PoseTwin { position: (*pose.position()).into(), orientation: pose.orientation() },
    |twin| Pose::new(twin.position, twin.orientation).map_err(|error| error.to_string())
);

/// What is missing has its default.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct SettingsTwin {
    formulation: Formulation,
    back_end: BackEnd,
    solve_separated: bool,
    gap_tolerance: f64,
    weight_on_a: f64,
    flat_regularisation: f64,
    carry_tolerance: f64,
}

impl Default for SettingsTwin {
    fn default() -> Self {
        Self::from(&Settings::default())
    }
}

impl From<&Settings> for SettingsTwin {
    fn from(settings: &Settings) -> Self {
        let &Settings {
            formulation,
            back_end,
            solve_separated,
            gap_tolerance,
            weight_on_a,
            flat_regularisation,
            carry_tolerance,
        } = settings;
        Self {
            formulation,
            back_end,
            solve_separated,
            gap_tolerance,
            weight_on_a,
            flat_regularisation,
            carry_tolerance,
        }
    }
}

through!(Settings, SettingsTwin, |settings| settings.into(), |twin| {
    let settings = Settings {
        formulation: twin.formulation,
        back_end: twin.back_end,
        solve_separated: twin.solve_separated,
        gap_tolerance: twin.gap_tolerance,
        weight_on_a: twin.weight_on_a,
        flat_regularisation: twin.flat_regularisation,
        carry_tolerance: twin.carry_tolerance,
    };
    settings.validate().map_err(|error| error.to_string())?;
    Ok(settings)
});

// Of a state its remembered solution alone: whatever the numbers are, it is a hint.
through!(PairState, [Number; 8], |state| state.into_raw().map(Number), |raw| Ok(PairState::from_raw(raw.map(|n| n.0))));

/// A number, or nothing for NaN.
#[derive(Clone, Copy)]
struct Number(f64);

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

type Triple = [Number; 3];

fn triple(v: &Vector3<f64>) -> Triple {
    [v.x, v.y, v.z].map(Number)
}

fn vector(v: Triple) -> Vector3<f64> {
    v.map(|number| number.0).into()
}

#[derive(Serialize, Deserialize)]
struct ContactTwin {
    kind: Kind,
    formulation: Formulation,
    back_end: BackEnd,
    flags: Flags,
    iterations: u32,
    s: Number,
    s_b: Number,
    weight: Number,
    gap: Number,
    point_bound: Number,
    overlap: Number,
    distance: Number,
    normal: Triple,
    point: Triple,
    branch_a: Triple,
    branch_b: Triple,
    point_on_a: Triple,
    point_on_b: Triple,
}

through!(
    Contact,
    ContactTwin,
    |contact| ContactTwin {
        kind: contact.kind,
        formulation: contact.formulation,
        back_end: contact.back_end,
        flags: contact.flags,
        iterations: contact.iterations,
        s: Number(contact.s),
        s_b: Number(contact.s_b),
        weight: Number(contact.weight),
        gap: Number(contact.gap),
        point_bound: Number(contact.point_bound),
        overlap: Number(contact.overlap),
        distance: Number(contact.distance),
        normal: triple(&contact.normal),
        point: triple(&contact.point),
        branch_a: triple(&contact.branch_a),
        branch_b: triple(&contact.branch_b),
        point_on_a: triple(&contact.point_on_a),
        point_on_b: triple(&contact.point_on_b),
    },
    |twin| Ok(Contact {
        kind: twin.kind,
        formulation: twin.formulation,
        back_end: twin.back_end,
        flags: twin.flags,
        iterations: twin.iterations,
        s: twin.s.0,
        s_b: twin.s_b.0,
        weight: twin.weight.0,
        gap: twin.gap.0,
        point_bound: twin.point_bound.0,
        overlap: twin.overlap.0,
        distance: twin.distance.0,
        normal: vector(twin.normal),
        point: vector(twin.point),
        branch_a: vector(twin.branch_a),
        branch_b: vector(twin.branch_b),
        point_on_a: vector(twin.point_on_a),
        point_on_b: vector(twin.point_on_b),
    })
);
