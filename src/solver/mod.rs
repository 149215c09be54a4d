//! From a start to a solution with its bounds.
//!
//! The problems are those of section 2 of docs/theory.md, with S_A and S_B convex, once continuously differentiable and
//! piecewise quadratic:
//!
//! ```text
//! midway:       minimise max(S_A, S_B)
//! closest:      minimise S_A subject to S_B ≤ 1, and with A and B exchanged
//! on a boundary: minimise S_A over a plane, an edge or a corner
//! ```
//!
//! [`call::Call::solve`] tries three ways in order and returns the first solution that will do:
//!
//! 1. One Newton step: the optimum of the quadratics at the start ([`crate::model`]), if the KKT check confirms its
//!    active set and its bounds ([`crate::bounds`]) meet the tolerance or the rounding floor. This settles nearly all
//!    calls with memory.
//! 2. Newton's method: the same step repeated; one that raises the merit is shortened by an exact line search.
//! 3. The extended tier, in 32 digits: for fixed λ Newton's method minimises a·S_A + b·S_B, a strictly convex function,
//!    and λ is bracketed outside. It is entered where doubles do not settle, where the gap is wider than rounding,
//!    regularisation and tolerance explain, or where it leaves open what was asked: whether s < 1, or whether a
//!    constraint is slack.
//!
//! A call without memory starts from the sharp polyhedra behind both particles, a linear program in x and F = max
//! √w(n·x − d). Both closest points are sought from midway, since all three lie on one dual path.
//!
//! Section 3 of docs/theory.md derives the methods, section 9 measures what each part contributes. Each file uses only
//! those above it:
//!
//! | file | holds |
//! |---|---|
//! | `initial_guess` | the start without memory |
//! | `line_search` | the minimum of the merit along a step |
//! | `newton` | Newton's method in doubles, and when its answer is accepted |
//! | `extended` | the extended tier |
//! | `call` | one call: settings, the order of the three ways, flags and number of iterations |
//! | `closest` | both closest points from midway or from memory |

pub(crate) mod call;
pub(crate) mod closest;
pub(crate) mod extended;
pub(crate) mod initial_guess;
pub(crate) mod line_search;
pub(crate) mod newton;
