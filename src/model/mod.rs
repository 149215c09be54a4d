//! Both potentials as quadratics at a point, and the exact optimum of these two quadratics.
//!
//! With the active sets of a point x held fixed, S_A and S_B become quadratics q_A and q_B. Every formulation
//! minimises, for a weight θ,
//!
//! ```text
//! φ_θ = a q_A + b q_B,    a, b ≥ 0 linear in θ:   H v = −g,   H = aH_A + bH_B,   g = ag_A + bg_B
//! ```
//!
//! and seeks the θ at which the *mismatch* of the formulation vanishes: S_A − S_B for midway, 1 − S_B or 1 − S_A for a
//! closest point. On a boundary a = 1, b = 0 and no θ is sought. As θ changes, v runs along the *dual path*, whose
//! Taylor series follows from one factorisation of H; its reversion multiplies the number of correct digits by five at
//! each step. Weights are passed on as the ratio λ = b/a.
//!
//! The optimum of the quadratics is that of the potentials if the active sets are the same at x + v. The *KKT check*
//! decides: all active depths ≥ 0 and no plane entering (optimal); a plane entering (the dual value is still a lower
//! bound); an active plane with a negative multiplier (excluded if it was active by rounding only, otherwise the point
//! has to move first).
//!
//! Sections 2 and 3 of docs/theory.md derive the problems, the series and the check; 4.6 the rounding of a depth after
//! a step. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `problem` | the formulations: weights, merit, dual value, both sides of the optimality equation |
//! | `dual_path` | the minimiser of φ_θ as a curve in θ, and its series |
//! | `dual_search` | the search for λ along it; both closest points at once |
//! | `kkt_check` | what a step does to the active set of a body |
//! | `local_model` | both quadratics at a point, in the axes that keep their precision; the step to their optimum |

pub(crate) mod dual_path;
pub(crate) mod dual_search;
pub(crate) mod kkt_check;
pub(crate) mod local_model;
pub(crate) mod problem;
