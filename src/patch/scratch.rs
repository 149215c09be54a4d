//! What the integration of a patch works in.

use super::cell::RayPlane;
use super::cells::CellScratch;
use super::fan::Sector;
use super::field::FramePlane;
use super::pieces::PieceScratch;
use super::ray::{Node, Ray};

/// Buffers that a caller keeps from patch to patch, so that nothing is allocated once they have grown.
///
/// One for each thread. After a call it holds the points of quadrature of the last patch ([`crate::Patch::points`]).
#[derive(Debug, Default)]
pub struct PatchScratch {
    pub(super) planes: Vec<FramePlane>,
    pub(super) ray_planes: Vec<RayPlane>,
    pub(super) nodes: Vec<Node>,
    pub(super) points: Vec<Node>,
    pub(super) pieces: PieceScratch,
    pub(super) cells: CellScratch,
    pub(super) rays: Vec<Ray>,
    pub(super) sectors: Vec<Sector>,
    pub(super) stack: Vec<(usize, usize, u32)>,
}

impl PatchScratch {
    /// Empty buffers.
    pub fn new() -> Self {
        Self::default()
    }
}
