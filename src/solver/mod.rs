//! From a start to a solution with its bounds.

pub(crate) mod call;
pub(crate) mod closest;
pub(crate) mod extended;
pub(crate) mod initial_guess;
pub(crate) mod line_search;
pub(crate) mod newton;
