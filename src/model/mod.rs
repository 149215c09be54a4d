//! Both potentials as quadratics at a point, and their exact optimum.

pub(crate) mod dual_path;
pub(crate) mod dual_search;
pub(crate) mod kkt_check;
pub(crate) mod local_model;
pub(crate) mod problem;
