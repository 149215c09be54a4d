//! Derivatives of contacts against differences in 130 digits, closed forms, and each other.

mod support;

#[path = "derivatives/truth.rs"]
mod truth;
#[path = "derivatives/properties.rs"]
mod properties;
#[path = "derivatives/boundaries.rs"]
mod boundaries;
#[path = "derivatives/limits.rs"]
mod limits;
