//! The curve on the patch where a plane goes on, walked over in the plane itself from rim to rim.

use super::cell::Cell;
use super::field::{Owner, dot};
use super::half_plane::{HalfPlane, Tilt};
use super::numbers::{COINCIDENT, GENTLE, Limits};
use super::ray::{CellEnd, RIM, Walker};

/// In the place of the number of a plane: the axes of the walk are turned there.
pub(super) const ONWARDS: u32 = u32::MAX - 1;

/// The part of a walk in one cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Number of the plane that goes on or off at its end, [`RIM`], or [`ONWARDS`].
    pub id: u32,
    pub end: [f64; 3],
    pub middle: [f64; 3],
    /// Whether it is straight, or lies beyond an edge of the triangle: nothing strays from it.
    pub is_exact: bool,
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
    /// through it, if the axes were not turned there.
    ///
    /// An upright walk that would have to be turned is lost: the patch turns back.
    pub fn walk_to_rim(
        &mut self,
        mut half_plane: HalfPlane,
        own: Option<usize>,
        stretches: &mut Vec<Stretch>,
    ) -> Result<Option<(Cell, f64)>, Trouble> {
        self.set_out(&half_plane);
        // Edges are planes without weight here.
        let edges = self.planes.iter_mut().filter(|plane| plane.owner == Owner::Edge);
        edges.for_each(|edge| edge.active = edge.at_origin > 0.0);
        if let Some(plane) = own.map(|place| &mut self.planes[place]) {
            // On its own curve a plane adds nothing, and is not met.
            (plane.at_origin, plane.along, plane.up, plane.active) = (0.0, 0.0, 0.0, false);
        }
        let (mut rho, mut zeta) = (0.0, 0.0);
        let (mut first, mut is_first) = (None, true);
        let (mut last, mut since) = (usize::MAX, 0.0);
        for _ in 0..Limits::CURVE_CELLS {
            let cell = self.cell(&half_plane, rho, zeta);
            if !(cell.s.v < 1.0) {
                return Err(Trouble::Lost);
            }
            let CellEnd { mut h, mut k, next, is_folded } = self.end_of(&cell);
            if is_folded {
                own.ok_or(Trouble::Lost)?;
                let incline = cell.incline(0.0, 0.0);
                if incline.abs() > GENTLE {
                    let (_, by) = Tilt::UPRIGHT.onwards(incline);
                    half_plane = half_plane.turned(by);
                    [rho, zeta] = [by[0] * rho + by[1] * zeta, by[0] * zeta - by[1] * rho];
                    self.turn(by);
                    is_first = false;
                    continue;
                }
                (h, k) = cell.half_turned(h);
                if !(h > 0.0) {
                    return Err(Trouble::Lost);
                }
            }
            let Some((middle, _)) = cell.height(0.5 * h) else { return Err(Trouble::Lost) };
            let end = half_plane.at(rho + h, zeta + k);
            let away = end.iter().map(|c| c * c).sum::<f64>().sqrt();
            if !(away <= self.field.loaded()) {
                return Err(Trouble::Far(away));
            }
            let id = if is_folded { ONWARDS } else { next.map_or(RIM, |place| place as u32) };
            stretches.push(Stretch {
                id,
                end,
                middle: half_plane.at(rho + 0.5 * h, zeta + middle),
                is_exact: cell.is_flat || self.planes.iter().any(|plane| plane.active && plane.owner == Owner::Edge),
            });
            if is_first {
                first = Some((cell, h));
                is_first = false;
            }
            (rho, zeta, since) = (rho + h, zeta + k, since + h);
            match next {
                _ if is_folded => (),
                Some(place) if place == last && since <= COINCIDENT * self.field.radius() => {
                    // It switches twice at once: its curve coincides with this one.
                    let plane = &mut self.planes[place];
                    (plane.at_origin, plane.along, plane.up, plane.active) = (0.0, 0.0, 0.0, false);
                }
                Some(place) => {
                    self.planes[place].active = !self.planes[place].active;
                    (last, since) = (place, 0.0);
                }
                None => return Ok(first),
            }
        }
        Err(Trouble::Lost)
    }

    /// The curve of a plane through a point of it, from rim to rim. `forwards` gets all places where it leaves a cell,
    /// after its start on the rim, which ends no stretch. `backwards`: a buffer.
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
        // Along the curve, and upwards as D rises.
        let (_, rises) = self.field.look(&through).difference(self.field.b.is_some());
        let [along, up] = [dot(&rises, &half_plane.along), dot(&rises, &half_plane.up)];
        let length = (along * along + up * up).sqrt();
        let half_plane = half_plane.turned([up / length, -along / length]);
        let back = self.walk_to_rim(half_plane.backwards(), Some(own), backwards)?;
        let count = backwards.len();
        // Each stretch now ends where it began.
        for i in (0..count).rev() {
            let Stretch { id, end, .. } = backwards[i];
            let from = backwards.get(i + 1).copied().unwrap_or(backwards[i]);
            forwards.push(Stretch { id, end, ..from });
        }
        let first = backwards[0];
        let ahead = self.walk_to_rim(half_plane, Some(own), forwards)?;
        let (Some((_, back)), Some((cell, ahead))) = (back, ahead) else {
            // The point is one of the curve's.
            forwards.insert(count, Stretch { id: ONWARDS, end: through, ..first });
            return Ok(());
        };
        let h = 0.5 * (ahead - back);
        let (height, _) = cell.height(h).ok_or(Trouble::Lost)?;
        forwards[count].middle = half_plane.at(h, height);
        Ok(())
    }
}
