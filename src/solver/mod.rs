//! From a start to a certified optimum.

pub(crate) mod anchor;
pub(crate) mod anchored;
pub(crate) mod initial_guess;
pub(crate) mod line_search;
pub(crate) mod newton;
pub(crate) mod search;
