//! The reference back end: the paper's second-order cone programs, solved by clarabel.
//!
//! # The programs (paper eqs 34–44, written in the frame of B; eqs 19–31 are the same without z)
//!
//! ```text
//! unknowns   head (t, or s of the objective), x_A, x_B (both local), p_A,i, p_B,i
//! closest    minimise s_A  subject to  s_B ≤ 1               (34), and with A and B swapped
//! midway     minimise t    subject to  s_A ≤ t, s_B ≤ t      (44)
//! cones      ‖(p_A,c , x_A,c)‖ ≤ s_A,  ‖(p_B,c , x_B,c)‖ ≤ s_B       (35, 36)   dimension 1 + N + 3
//!            p_c,i = √(1−k)/r · p_i,   x_c = √k/R · x
//! ties       Q x_A + c = x_B,  Q, c the pose of A in the frame of B    (37–39)
//! planes     n_i·x − d_i ≤ p_i,  p_i ≥ 0                              (40–43)
//! ```
//!
//! (44) has an equality, s_A = s_B. Where the two can be equal at the optimum, the inequalities give the same point;
//! where one s is below the other even at the minimum of the other, they give that minimum, which the equality would
//! exclude. The concise programs follow from zero weights: for k = 0 the cone loses x_c (dimension 1 + N), for k = 1 it
//! loses p_c and the particle its rows (1 + 3). Local points x are kept as unknowns instead of x_c, so that k = 0 needs
//! no case of its own.
//!
//! # Scaling by successive corrections
//!
//! An interior-point method is accurate to some 1e-9 of the largest number in the program. With lengths of order 1 and
//! r = 1e-8 that is an error of s of order 0.1. Therefore the program is solved several times, each time as a
//! correction to the point found before:
//!
//! 1. once for the whole particles, about their centres, lengths in units of the smaller bounding
//!    radius; this gives the initial point;
//! 2. then with x = x₀ + h·δ, δ unknown, inside the box |δ_B| ≤ 1. Right-hand sides become the slacks d_i − n_i·x₀ at
//!    the last point, which are small and accurate for the planes that can be active. A plane that no point of the box
//!    can reach has p_i = 0 in all of it and is left out. If the correction ends near the boundary of its box, the box
//!    is moved and enlarged; otherwise h shrinks, down to the distance over which s changes by a tenth (some tenth of r
//!    or R/√k, times s), or until s no longer changes.
//!
//! In every pass p_c and s are counted in units of s at the last point (1 for the constrained
//! particle), which makes the entries of the cones of order 1; rows are divided by |n_i|. clarabel's
//! own equilibration undoes part of this and costs two digits, so that it is off at first. Its
//! static regularisation is lowered to 1e-9 for the same reason. No single setting solves every pair, hence a list of
//! settings and box sizes that are tried in turn.
//!
//! # Acceptance
//!
//! The program is convex, so that an optimum in the interior of its box is the optimum of the whole program,
//! whatever the initial point. An answer is returned only if
//! - clarabel reports the pass as solved or almost solved;
//! - s = √S at the returned point, clarabel's objective and its dual objective agree to 1e-8 or better,
//!   and the constraint holds to the same; s as returned is always that of the definition;
//! - one of the passes bounds s from below to 1e-5, also for points outside its box: the dual objective less the most
//!   by which the duals of the box and the dual residual can lower it between the box and the far end of the pair. This
//!   is a worst case that detects an optimum in the wrong place; measured errors of s are 1e-9 and below, or what the
//!   rounding of x does to s (ε·size·√(1−k)/r) where that is more.
//!
//! Otherwise the answer is a [`ConeProgramError`].
//!
//! `solution` holds the answers, `goal` what is minimised, `program` one cone program, `corrections` their sequence.

mod corrections;
mod goal;
mod numbers;
mod program;
mod solution;

use crate::pair::pair::Pair;
use corrections::solve;
use goal::Goal;
pub use solution::{ConeProgramError, ConeProgramSolution, Role};

/// Midway: the point of least t with s_A ≤ t and s_B ≤ t (P3, paper eqs 4, 44).
///
/// # Errors
/// See [`ConeProgramError`].
pub fn midway(pair: &Pair) -> Result<ConeProgramSolution, ConeProgramError> {
    solve(pair, Goal::Midway)
}

/// Closest: the point of the particle `constrained` where s of the other is least (paper eqs 34–43).
///
/// [`Role::B`] gives P2 with s = s_A, [`Role::A`] gives P1 with s = s_B. The constraint may be slack: then the
/// point is a minimiser of the other particle's S, inside the constrained one, with s = 0.
///
/// # Errors
/// See [`ConeProgramError`].
pub fn closest(pair: &Pair, constrained: Role) -> Result<ConeProgramSolution, ConeProgramError> {
    solve(pair, Goal::Constrained(constrained))
}

#[cfg(test)]
mod tests;
