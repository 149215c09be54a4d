//! Numbers, lanes of them, and symmetric 3×3 matrices.

pub(crate) mod number;
pub(crate) mod symmetric;
