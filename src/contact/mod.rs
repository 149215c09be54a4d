//! The entries of the library for pairs: a contact with its point, normal and overlap.
//!
//! [`detect::detect`] is read first; the whole of a call stands in that file:
//!
//! 1. *carried on*, if the settings ask for it: both quadratics of the last contact, or of where the pair was apart,
//!    moved with their bodies, are solved for the new poses without evaluating any plane, or those alone that may have
//!    switched (section 7 of docs/theory.md);
//! 2. *rejected* by a separation test ([`crate::pair::separation`]), with a lower bound on the distance;
//! 3. *solved* for x and λ ([`crate::solver`]), from the remembered solution or a start of its own;
//! 4. *described*, and remembered for the next call.
//!
//! Description, midway: with the gradients at P3 the normal from A to B, and the overlap along the line through P3
//! between both surfaces,
//!
//! ```text
//! n = (ĝ_A − ĝ_B)/|ĝ_A − ĝ_B|,   ĝ = ∇S/|∇S|,    overlap = t₊ + t₋,   S_A(P3 + t₊n) = 1,   S_B(P3 − t₋n) = 1
//! ```
//!
//! Near P3 both S are the known quadratics, so that t₊ and t₋ are roots of quadratic equations; beyond them a ray is
//! cast. Closest: the overlap is |P1 − P2|, and the contact point lies between the two by the weight of the settings.
//!
//! The particles overlap if s < 1. The answer carries |s − s*| ≤ gap and a bound on the distance of the point to the
//! optimum ([`crate::bounds`]). An answer that leaves s < 1 open by more than 10⁻² is an error and never "separated",
//! except where a raised regularisation was asked for, whose gap says so. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `contact`, `error` | the answer, and why there is none |
//! | `geometry` | point, normal and overlap from a solution |
//! | `recentred` | the quadratics of a contact whose point has left their validity radius, about its new place |
//! | `carried` | the last contact carried on to new poses |
//! | `detect` | the whole of a call |
//! | `closest_point` | one closest point alone |
//! | `batch` | many pairs on several threads |

pub(crate) mod batch;
pub(crate) mod carried;
pub(crate) mod closest_point;
pub(crate) mod contact;
pub(crate) mod detect;
pub(crate) mod error;
pub(crate) mod geometry;
pub(crate) mod recentred;
