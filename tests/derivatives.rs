//! Derivatives of contacts against differences in 130 digits, closed forms, and each other.

mod support;

#[path = "derivatives/boundaries.rs"]
mod boundaries;
#[path = "derivatives/limits.rs"]
mod limits;
#[path = "derivatives/properties.rs"]
mod properties;
#[path = "derivatives/truth.rs"]
mod truth;
