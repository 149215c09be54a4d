//! What an answer is worth: bounds on the error of s and of the point, made from the answer's own numbers.
//!
//! The dual value of any weights is a lower bound of the optimal S, the merit of any point an upper one
//! ([`dual_bound`]). What remains between them is rounding ([`rounding`]); how far it can move the point is a matter of
//! the sensitivity of the optimum to its data ([`sensitivity`], [`point_bound`]). docs/theory.md derives each bound.

pub(crate) mod dual_bound;
pub(crate) mod external_solution;
pub(crate) mod point_bound;
pub(crate) mod rounding;
pub(crate) mod scale;
pub(crate) mod sensitivity;
pub(crate) mod solution;
