//! What rounding does to an optimum.

pub(crate) mod ceiling;
pub(crate) mod certificate;
pub(crate) mod remnant;
pub(crate) mod rounding;
pub(crate) mod sensitivity;
pub(crate) mod solution;
