//! Numbers, lanes of them, numbers of 32 digits, sine and cosine in them, roots on a bracket, and symmetric 3×3 matrices.

pub(crate) mod double_double;
pub(crate) mod graded_basis;
pub(crate) mod line;
pub(crate) mod number;
pub(crate) mod root;
pub(crate) mod sine_and_cosine;
pub(crate) mod symmetric;
pub(crate) mod wide;
