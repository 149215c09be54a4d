//! The curve on the patch where a plane goes on, walked over in the plane itself from rim to rim.

use super::cell::Cell;
use super::field::Owner;
use super::half_plane::HalfPlane;
use super::ray::{CellEnd, RIM, Walker};

/// Most cells on the way to the rim.
const MOST_CELLS: usize = 64;

/// The part of a walk in one cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Number of the plane that goes on or off at its end, or [`RIM`].
    pub id: u32,
    pub end: [f64; 3],
    pub middle: [f64; 3],
    /// The active planes, a bit each, without that of the curve.
    pub active: u128,
}

/// Why a walk did not get to the rim.
#[derive(Clone, Copy, Debug)]
pub(super) enum Trouble {
    /// Planes beyond this distance are not loaded.
    Far(f64),
    /// The patch turns back, or the walk did not start on it.
    Lost,
}

impl Walker<'_, '_, '_> {
    /// Walks to the rim in a half-plane, which is that of the plane `own` or upright; the first cell and the way
    /// through it.
    pub fn walk_to_rim(
        &mut self,
        half_plane: &HalfPlane,
        own: Option<usize>,
        stretches: &mut Vec<Stretch>,
    ) -> Result<(Cell, f64), Trouble> {
        self.set_out(half_plane);
        // Edges are planes without weight here.
        let edges = self.planes.iter_mut().filter(|plane| plane.owner == Owner::Edge);
        edges.for_each(|edge| edge.active = edge.at_origin > 0.0);
        if let Some(plane) = own.map(|place| &mut self.planes[place]) {
            // On its own curve a plane adds nothing, and is not met.
            (plane.at_origin, plane.along, plane.up, plane.active) = (0.0, 0.0, 0.0, false);
        }
        let (mut rho, mut zeta) = (0.0, 0.0);
        let mut first = None;
        for _ in 0..MOST_CELLS {
            let cell = self.cell(half_plane, rho, zeta);
            if !(cell.s.v < 1.0) {
                return Err(Trouble::Lost);
            }
            let CellEnd { h, k, next, is_folded } = self.end_of(&cell);
            let middle = cell.height(0.5 * h).filter(|_| !is_folded);
            let Some((middle, _)) = middle else { return Err(Trouble::Lost) };
            let end = half_plane.at(rho + h, zeta + k);
            let away = end.iter().map(|c| c * c).sum::<f64>().sqrt();
            if !(away <= self.field.loaded()) {
                return Err(Trouble::Far(away));
            }
            let active = self.planes.iter().enumerate().filter(|(_, plane)| plane.active);
            stretches.push(Stretch {
                id: next.map_or(RIM, |place| place as u32),
                end,
                middle: half_plane.at(rho + 0.5 * h, zeta + middle),
                active: active.fold(0, |bits, (place, _)| bits | 1 << place),
            });
            let first = *first.get_or_insert((cell, h));
            let Some(place) = next else { return Ok(first) };
            self.planes[place].active = !self.planes[place].active;
            (rho, zeta) = (rho + h, zeta + k);
        }
        Err(Trouble::Lost)
    }

    /// The curve of a plane through a point of it, from rim to rim: all places where it leaves a cell in `forwards`, of
    /// which the first is where it leaves the rim, and begins no stretch. `backwards`: a buffer.
    pub fn curve(
        &mut self,
        own: usize,
        through: [f64; 3],
        backwards: &mut Vec<Stretch>,
        forwards: &mut Vec<Stretch>,
    ) -> Result<(), Trouble> {
        backwards.clear();
        forwards.clear();
        let half_plane = HalfPlane::within(through, &self.field.planes[own].normal).ok_or(Trouble::Lost)?;
        let (_, back) = self.walk_to_rim(&half_plane.backwards(), Some(own), backwards)?;
        let count = backwards.len();
        // Each stretch now ends where it began.
        for i in (0..count).rev() {
            let Stretch { id, end, .. } = backwards[i];
            let from = backwards.get(i + 1).copied().unwrap_or(backwards[i]);
            forwards.push(Stretch { id, end, ..from });
        }
        let (cell, ahead) = self.walk_to_rim(&half_plane, Some(own), forwards)?;
        let h = 0.5 * (ahead - back);
        let (height, _) = cell.height(h).ok_or(Trouble::Lost)?;
        forwards[count].middle = half_plane.at(h, height);
        Ok(())
    }
}
