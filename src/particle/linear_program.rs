//! Whether planes enclose a volume (lines an area), and how large it is: small linear programs for clarabel.
//!
//! Only particles with k = 0 need them, once, when they are made.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::Vector3;

/// What clarabel's extents may be off, in units of the farthest face.
const TOLERANCE: f64 = 1e-7;

/// Half the edge of a cube about the origin that holds {x : n·x ≤ h for every face}, |n| = 1; `None` if unbounded.
/// With two dimensions, of a square in the plane z = 0, to which x is then confined.
///
/// First the recession cone {v : n·v ≤ 0}: cut by the unit cube it reaches either 0 or 1 along some
/// axis, so that the answer does not depend on scale. Then the extent along each axis; once more without the faces that
/// the cube cannot reach, if they set the scale.
pub(crate) fn half_cube(faces: &[(Vector3<f64>, f64)], dimensions: usize) -> Option<f64> {
    let axes = || (0..dimensions).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
    let mut unit = faces.to_vec();
    if unit.is_empty() {
        return None;
    }
    let cone: Vec<_> = unit.iter().map(|(n, _)| (*n, 0.0)).chain(axes().map(|e| (e, 1.0))).collect();
    for e in axes() {
        // 0 when bounded, 1 when not; a failed program is taken for unbounded.
        if maximum(&cone, &e, dimensions)? > 0.5 {
            return None;
        }
    }
    loop {
        let scale = unit.iter().map(|(_, h)| h.abs()).fold(0.0, f64::max);
        if !(scale > 0.0) {
            return None;
        }
        let scaled: Vec<_> = unit.iter().map(|(n, h)| (*n, h / scale)).collect();
        let mut extents = axes().map(|e| maximum(&scaled, &e, dimensions));
        let most = extents.try_fold(0.0, |most: f64, extent| Some(most.max(extent?)))?;
        let half = (most + TOLERANCE) * scale;
        let before = unit.len();
        unit.retain(|(_, h)| *h < 2.0 * half);
        if unit.len() == before {
            return Some(half);
        }
    }
}

/// max e·x subject to n·x ≤ h, over the first coordinates of x.
fn maximum(faces: &[(Vector3<f64>, f64)], e: &Vector3<f64>, dimensions: usize) -> Option<f64> {
    let count = faces.len();
    let rows: Vec<usize> = (0..dimensions).flat_map(|_| 0..count).collect();
    let values: Vec<f64> = (0..dimensions).flat_map(|axis| faces.iter().map(move |(n, _)| n[axis])).collect();
    let starts = (0..=dimensions).map(|axis| axis * count).collect();
    let a = CscMatrix::new(count, dimensions, starts, rows, values);
    let h: Vec<f64> = faces.iter().map(|(_, h)| *h).collect();
    let settings = DefaultSettingsBuilder::default().verbose(false).build().ok()?;
    let p = CscMatrix::zeros((dimensions, dimensions));
    let objective = -e;
    let mut solver =
        DefaultSolver::new(&p, &objective.as_slice()[..dimensions], &a, &h, &[NonnegativeConeT(count)], settings)
            .ok()?;
    solver.solve();
    matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved)
        .then(|| e.iter().zip(&solver.solution.x).map(|(e, x)| e * x).sum())
}
