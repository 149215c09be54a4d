//! Derivatives of a solved contact in the poses and the shapes of both bodies.
//!
//! A contact is a function of poses and shapes by way of the optimality conditions of its formulation, and where no
//! plane switches these are smooth. By the implicit function theorem they are differentiated at the solution; nothing
//! is solved again.
//!
//! **Optimality.** At an optimum x the gradients g_A = |g_A| n and g_B = −|g_B| n are opposed. In axes (T, n), T across
//! n, a change of the potentials at fixed x by δS and δg moves it by δx = T z + ζ n with
//!
//! ```text
//! ζ = c_A η_A + c_B η_B,     η_i = −δS_i/(g_i·n),                                  c_A + c_B = 1
//! TᵀHT z = −Tᵀ (a δg_A + b δg_B + ζ H n),      H = a H_A + b H_B,      a : b = |g_B| : |g_A|
//! ```
//!
//! η is how far a level surface moves along n, and the formulations differ by the share c_A alone: |g_A|/(|g_A| +
//! |g_B|) of midway, 0 of the point P2 on B, 1 of P1 on A. A flat boundary is a body B with S = 0: c_A = 0, a = 1, b =
//! 0, and T has the two, one or no directions of its plane, edge or corner. The normal is that of the gradients at x;
//! the surface points are where S = 1 along it.
//!
//! **Forward and reverse.** A body that moves by v at x and turns by ω has δS = −g·v and δg = ω × g − H v. Six columns
//! of one body give the twelve of both: if both move alike, the contact moves with them. In reverse, weights on the
//! answers become weights σ on δS and Γ on δg, with the same symmetric matrix, and these go to the planes, of which
//! only the active ones count:
//!
//! ```text
//! ∂/∂n_i = 2w ((σ t_i + Γ·n_i) y + t_i Γ)      ∂/∂d_i = −2w (σ t_i + Γ·n_i)      w = (1−k)/r²,   t_i = n_i·y − d_i
//! ```
//!
//! **Digits.** All of it is written for numbers of 16 and of 32 digits. Where depths of planes have lost too many of a
//! double's, the optimum of a pair is refined by Newton's method in double-doubles, among planes whose depth is below
//! the rounding of the point by an active set, and differentiated there.
//!
//! **Where they do not exist.** The second derivative of S jumps where a plane becomes active. There the derivative of
//! s is continuous, all others are one-sided: planes with t ≤ 0 count as inactive. With k = 0 a flat face may leave
//! TᵀHT singular: it is that of the regularised problem whose optimum the contact is. [`DerivativeFlags`] reports both.
//! docs/derivatives.md has examples and measurements. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what derivatives are tuned by |
//! | `answer` | derivatives in the poses, weights on a contact, gradients in the shape |
//! | `field` | a potential at a point, and its derivatives in pose and shape |
//! | `optimum` | how an optimum moves with the potentials, forward and reverse |
//! | `rows` | derivatives of numbers in both poses |
//! | `surface` | the surface points along the normal |
//! | `midway` | derivatives of the contact of midway, and of a boundary |
//! | `closest` | the same of closest |
//! | `contact` | the entries for pairs |
//! | `boundary` | the entries for planes and triangles |
//! | `patch` | derivatives of force and torque of a patch |

mod answer;
mod boundary;
mod closest;
mod contact;
mod field;
mod midway;
mod numbers;
mod optimum;
mod patch;
mod rows;
mod surface;

pub use answer::{
    ContactDerivatives, ContactWeights, DerivativeError, DerivativeFlags, PoseGradient, PoseRow, PoseRows,
    ShapeGradient,
};
pub use boundary::{boundary_derivatives, boundary_gradient};
pub use contact::{contact_derivatives, contact_gradient};
pub use patch::{PatchDerivatives, patch_derivatives};
