//! The patch of bodies without a sphere in pieces that need no search: a polygon with strips and caps around it, the
//! strips and caps of an edge, or a disc.

use super::field::{Field, Owner};
use super::local_coordinates::{Vector, normal};
use super::numbers::{ErrorBudget, LOADED_AT_ONCE};
use super::piece::Piece;
use super::polygon::{Corner, integrate};
use super::ray::Node;
use super::zones::Zones;

/// Buffers.
#[derive(Debug, Default)]
pub(super) struct PieceScratch {
    corners: [Vec<Corner>; 2],
    pieces: Vec<Piece>,
}

/// Estimated errors of force and area.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Estimate {
    pub force: f64,
    pub area: f64,
    /// Number of rays.
    pub rays: usize,
}

/// Fills `nodes` with points of the patch, on which `start` lies and `deepest` is the least S; `None` where it is not
/// made of such pieces or its error is above the tolerance.
pub(super) fn pieces(
    field: &mut Field,
    start: &[f64; 3],
    deepest: f64,
    tolerance: f64,
    scratch: &mut PieceScratch,
    nodes: &mut Vec<Node>,
) -> Option<Estimate> {
    nodes.clear();
    scratch.pieces.clear();
    if field.a.sphere_weight > 0.0 || field.b.is_some_and(|b| b.sphere_weight > 0.0) {
        return None;
    }
    if field.plane_count() <= LOADED_AT_ONCE && field.loaded() < field.radius() {
        field.load(field.radius());
    }
    let at = Vector::from(*start);
    let mut active = [[usize::MAX; 3]; 2];
    let mut count = [0; 2];
    for (k, plane) in field.planes.iter().enumerate() {
        if plane.owner != Owner::Edge && plane.excess + normal(plane).dot(&at) > 0.0 {
            let body = usize::from(plane.owner == Owner::B);
            *active[body].get_mut(count[body])? = k;
            count[body] += 1;
        }
    }
    if count[0] == 0 || field.b.is_some() != (count[1] > 0) {
        return None;
    }
    let mut zones = Zones { field, pieces: &mut scratch.pieces };
    let active = [&active[0][..count[0]], &active[1][..count[1]]];
    if let Some((level, sides)) = zones.face(active, &mut scratch.corners)? {
        let polygon = &scratch.corners[0];
        integrate(&level, polygon, nodes)?;
        zones.around(&level, polygon, sides)?;
    } else {
        zones.edge_or_disc(active, &at, tolerance)?;
    }
    refine(&mut scratch.pieces, tolerance, deepest, nodes)
}

/// Integrates over all pieces, with finer rules where the error is above its share; `deepest`: the least S.
fn refine(pieces: &mut [Piece], tolerance: f64, deepest: f64, nodes: &mut Vec<Node>) -> Option<Estimate> {
    for piece in pieces.iter_mut() {
        piece.integrate(tolerance, deepest, nodes)?;
    }
    loop {
        let force: f64 = nodes.iter().map(|node| node.weight * node.pressure).sum();
        if !(force > 0.0) {
            return None;
        }
        let limit = ErrorBudget::MAIN * tolerance * force;
        let neglected: f64 = pieces.iter().map(|piece| piece.neglected).sum();
        let [force, area] = [0, 1].map(|i| pieces.iter().map(|piece| piece.errors[i]).sum::<f64>());
        if force + neglected <= limit {
            // Points that a finer rule has replaced have no weight.
            nodes.retain(|node| node.weight > 0.0);
            return Some(Estimate { force: force + neglected, area, rays: 0 });
        }
        if !(neglected <= 0.9 * limit) {
            return None;
        }
        // Below half of the worst, so that every round refines a piece and the last rule ends it.
        let worst = pieces.iter().map(|piece| piece.errors[0]).fold(0.0, f64::max);
        let allowed = limit / pieces.len() as f64;
        let share = (0.15 * allowed).min(0.5 * worst);
        for piece in pieces.iter_mut().filter(|piece| piece.errors[0] > share) {
            piece.refine(allowed);
            piece.integrate(tolerance, deepest, nodes)?;
        }
    }
}
