//! Derivatives of contacts against differences in 130 digits, closed forms, and each other.

mod boundaries;
mod limits;
mod properties;
mod truth;
