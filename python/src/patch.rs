//! Contact patches.

use crate::arrays::{to_rows, to_vector};
use crate::boundary::{PyFlatContact, PyTriangle};
use crate::contact::{PyContact, getters, names};
use crate::errors::refused;
use crate::particle::PyParticle;
use crate::pickles::pickled;
use crate::pose::PyPose;
use numpy::{PyArray1, PyArray2};
use potential_particles::{
    Patch, PatchError, PatchPoint, PatchScratch, PatchSettings, patch_of_contact, patch_on_plane, patch_on_triangle,
};
use pyo3::prelude::*;
use std::cell::RefCell;

/// The surface {s_A = s_B <= 1} on which two bodies press on each other with p = K l (1 - s), world axes, on B; what is
/// proportional to the stiffness K per area (force/length^3) is given over K. c: the contact point of two bodies;
/// on_boundary of a contact with a plane or triangle, which stands for B.
///
/// length: l, the sum of both depth_length (of A alone on a boundary). force: integral of p n, length^3. torque:
/// integral of (x - c) x p n, length^4. pressure_centre: of the axis of the wrench the point in the plane of the patch,
/// world frame; branch_a, branch_b: it minus the position of A, of B (on a boundary: of A again). couple: along that
/// axis, length^4. area: length^2. centroid: minus pressure_centre. second_moment: integral of y y^T about the
/// centroid; polar_moment: of |y|^2 about the axis, length^4. twist_lever: integral of p |y| over that of p, length.
/// mean_depth, largest_depth: of l (1 - s), length. energy: length^4, NaN unless asked for. stiffness (6, 6): change of
/// force and torque (rows) with a shift and a turn of A about c (columns), NaN unless asked for. error, area_error:
/// estimated, relative. points: rows of x - c (3), area, depth l (1 - s) and normal (3) of the points of quadrature.
/// flags: names of what else is to be known.
#[pyclass(name = "Patch", module = "potential_particles", frozen)]
pub struct PyPatch(pub Patch, Vec<PatchPoint>);

getters!(PyPatch: length, couple, area, polar_moment, twist_lever, mean_depth, largest_depth, energy, error, area_error;
    force, torque, pressure_centre, branch_a, branch_b, centroid);

#[pymethods]
impl PyPatch {
    #[getter]
    fn flags(&self) -> Vec<String> {
        names(self.0.flags.bits(), self.0.flags)
    }

    #[getter]
    fn second_moment<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, (0..3).map(|i| [0, 1, 2].map(|j| self.0.second_moment[(i, j)])))
    }

    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, (0..6).map(|i| [0, 1, 2, 3, 4, 5].map(|j| self.0.stiffness[(i, j)])))
    }

    /// Rows of position (3, from the contact point; on a boundary from on_boundary), area, depth and normal (3) of each
    /// point of quadrature.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let row = |point: &PatchPoint| {
            let ([x, y, z], [a, b, c]) = (point.position.into(), point.normal.into());
            [x, y, z, point.area, point.depth, a, b, c]
        };
        to_rows(py, self.1.iter().map(row))
    }

    fn __repr__(&self) -> String {
        let Patch { force: f, area, .. } = self.0;
        format!("<Patch: area {area:.6e}, force/K ({:.4e}, {:.4e}, {:.4e})>", f.x, f.y, f.z)
    }
}

pickled!(PyPatch: (Patch, Vec<PatchPoint>), |object| (object.0, &object.1), |_py, (patch, points)| Self(patch, points));

thread_local! {
    pub static SCRATCH: RefCell<PatchScratch> = RefCell::new(PatchScratch::new());
}

fn made(
    (tolerance, energy, stiffness): (f64, bool, bool),
    find: impl FnOnce(&PatchSettings, &mut PatchScratch, &mut Vec<PatchPoint>) -> Result<Patch, PatchError>,
) -> PyResult<PyPatch> {
    let settings = PatchSettings { tolerance, with_energy: energy, with_stiffness: stiffness };
    let mut points = Vec::new();
    let patch = SCRATCH.with_borrow_mut(|scratch| find(&settings, scratch, &mut points)).map_err(refused)?;
    Ok(PyPatch(patch, points))
}

/// The patch {s_A = s_B <= 1} of an overlapping contact, with the pressure K l (1 - s) on it, as a Patch; world axes,
/// all over K.
///
/// tolerance: relative, of force and torque, in [1e-12, 0.1]. energy, stiffness: whether these are computed, too. Its
/// points are the points of quadrature. ValueError: the contact is separated, or the tolerance out of range.
#[pyfunction(name = "patch_of_contact")]
#[pyo3(signature = (a, pose_a, b, pose_b, contact, *, tolerance=1e-4, energy=false, stiffness=false))]
#[allow(clippy::too_many_arguments)]
fn of_contact(
    a: &PyParticle,
    pose_a: &PyPose,
    b: &PyParticle,
    pose_b: &PyPose,
    contact: &PyContact,
    tolerance: f64,
    energy: bool,
    stiffness: bool,
) -> PyResult<PyPatch> {
    let contact = contact.at(pose_a, pose_b)?;
    made((tolerance, energy, stiffness), |settings, scratch, points| {
        let visit = |point| points.push(point);
        patch_of_contact(&a.0, &pose_a.0, &b.0, &pose_b.0, contact, settings, scratch, visit)
    })
}

/// The patch of an overlapping contact with a plane: the part of the plane inside A. Otherwise as patch_of_contact.
#[pyfunction(name = "patch_on_plane")]
#[pyo3(signature = (a, pose, contact, *, tolerance=1e-4, energy=false, stiffness=false))]
fn on_plane(
    a: &PyParticle,
    pose: &PyPose,
    contact: &PyFlatContact,
    tolerance: f64,
    energy: bool,
    stiffness: bool,
) -> PyResult<PyPatch> {
    made((tolerance, energy, stiffness), |settings, scratch, points| {
        patch_on_plane(&a.0, &pose.0, &contact.0, settings, scratch, |point| points.push(point))
    })
}

/// The patch of an overlapping contact with a triangle: the part of the triangle inside A. Otherwise as
/// patch_of_contact.
///
/// from_front: A counts as in front, where the vertices run counter-clockwise, as for the mesh of a closed body seen
/// from outside.
#[pyfunction(name = "patch_on_triangle")]
#[pyo3(signature = (a, pose, triangle, contact, *, from_front=true, tolerance=1e-4, energy=false, stiffness=false))]
#[allow(clippy::too_many_arguments)]
fn on_triangle(
    a: &PyParticle,
    pose: &PyPose,
    triangle: &PyTriangle,
    contact: &PyFlatContact,
    from_front: bool,
    tolerance: f64,
    energy: bool,
    stiffness: bool,
) -> PyResult<PyPatch> {
    made((tolerance, energy, stiffness), |settings, scratch, points| {
        let visit = |point| points.push(point);
        patch_on_triangle(&a.0, &pose.0, &triangle.triangle, from_front, &contact.0, settings, scratch, visit)
    })
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPatch>()?;
    module.add_function(wrap_pyfunction!(of_contact, module)?)?;
    module.add_function(wrap_pyfunction!(on_plane, module)?)?;
    module.add_function(wrap_pyfunction!(on_triangle, module)?)
}
