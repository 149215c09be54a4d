//! The arithmetic below the solver: numbers of 16 and 32 digits, symmetric 3×3 matrices, and searches in one unknown.
//!
//! The Hessian of a·S_A + b·S_B is a sum of planes and spheres, w and m as in section 1 of docs/theory.md:
//!
//! ```text
//! H = Σ 2w n nᵀ + 2m·1 = L D Lᵀ
//! ```
//!
//! The terms may differ by a factor of 10¹⁸. Summed in arbitrary axes, 2m is then lost in the rounding of the planes,
//! and with it the position along every direction that no plane resists. Two measures keep it: axes aligned with the
//! stiffest planes, in which elimination preserves the relative precision of each direction ([`graded_basis`]), and
//! pivots that are never less than the known least curvature ([`symmetric::Factor`]); see "Axes" in section 3 of
//! docs/theory.md. What remains is solved again in double-doubles, of which each operation has the relative error U =
//! 16u², u = 2⁻⁵³.
//!
//! One source serves both tiers: matrices, factors and the search for λ are generic over [`number::Number`], which is a
//! double, two doubles in lanes ([`number::Twin`]), or a double-double. Sections 4.1 and 4.9 of docs/theory.md bound
//! the rounding. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `double_double` | the sum of two doubles as a number of 32 digits |
//! | `number` | what the solver asks of a number, for doubles, lanes and double-doubles |
//! | `wide` | vectors of double-doubles, and differences of positions without rounding |
//! | `sine_and_cosine` | sine and cosine to 32 digits, for rotations of the plane |
//! | `symmetric` | symmetric 3×3 matrices, their L D Lᵀ factors, and a lower bound of the least eigenvalue |
//! | `graded_basis` | axes aligned with the stiffest planes |
//! | `line` | the minimum of a convex, piecewise quadratic function of one variable |
//! | `root` | the root of a function of one variable on a bracket |
//! | `polygon` | a convex polygon, cut by a line |

pub(crate) mod double_double;
pub(crate) mod graded_basis;
pub(crate) mod line;
pub(crate) mod number;
pub(crate) mod polygon;
pub(crate) mod root;
pub(crate) mod sine_and_cosine;
pub(crate) mod symmetric;
pub(crate) mod wide;
