//! Two bodies in one frame, each with its active set at a point, and what is known of a pair before it is solved.
//!
//! All solvers work in the local frame of B, where a point x is seen by A as y and has the potential
//!
//! ```text
//! y = Qᵀ(x − c),   Q = R_Bᵀ R_A,   c = R_Bᵀ(p_A − p_B)
//! S_A(x) = w Σ ⟨n·y − d⟩² + m|y|²
//! ```
//!
//! The positions are subtracted before anything is rotated, so that a pair far from the origin of the world loses no
//! more than the rounding of its own positions. A plane is *active* where n·y − d > −blur; *blur* bounds the rounding
//! of n·y − d, *shift* that of y. Sections 4.2 and 4.3 of docs/theory.md derive both, 4.9 the same for 32 digits.
//!
//! A part of a boundary (a plane, an edge, a corner) takes the place of B as a body with S_B = 0, in whose frame a
//! point has two, one or no coordinates (section 8). At k = 0, S may be least on a whole patch; m is then raised to
//! k₀/ρ², the regularisation of section 2, and each body states what that adds to S.
//!
//! Before a pair is solved, tests of one side are tried: each proves that the bodies share no point, with a lower bound
//! on their distance, or says nothing (section 4.8). Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `role` | A or B |
//! | `local_point` | a point as one body sees it, with its rounding and the planes excluded from the active set |
//! | `boundary_part` | plane, edge or corner of a boundary, with its frame in doubles and in 32 digits |
//! | `pair` | the relative pose (Q, c) of two particles, or of a particle and a part of a boundary |
//! | `body` | a particle in the frame of the pair: S, its quadratic at a point, bounds on their rounding |
//! | `extended_body` | the same in 32 digits, about a point of reference |
//! | `separation` | separation tests by balls, faces and tangents |
//! | `minimum_norm_point` | planes of both particles in balance, and the separation test by them |
//! | `pair_state` | what an ordered pair keeps from call to call |

pub mod body;
pub mod boundary_part;
pub mod extended_body;
pub mod local_point;
pub mod minimum_norm_point;
pub mod pair;
pub mod pair_state;
pub mod role;
pub mod separation;

/// Numbers in (−1, 1) that look like chance, for tests.
#[cfg(test)]
pub fn scattered(seed: usize) -> impl FnMut() -> f64 {
    let mut state = seed as f64;
    move || {
        state += 1.0;
        2.0 * (1e4 * (12.9898 * state).sin()).rem_euclid(1.0) - 1.0
    }
}
