//! Point, normal and overlap from a solution.

pub(crate) mod batch;
pub(crate) mod carried;
pub(crate) mod closest_point;
pub(crate) mod contact;
pub(crate) mod detect;
pub(crate) mod geometry;
