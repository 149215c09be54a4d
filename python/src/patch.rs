//! Contact patches.

use crate::arrays::{to_rows, to_vector};
use crate::boundary::{PyFlatContact, PyTriangle};
use crate::contact::{PyContact, getters, names};
use crate::errors::refused;
use crate::particle::PyParticle;
use crate::pose::PyPose;
use numpy::{PyArray1, PyArray2};
use potential_particles::{
    Patch, PatchError, PatchPoint, PatchScratch, PatchSettings, patch_of_contact, patch_on_plane, patch_on_triangle,
};
use pyo3::prelude::*;
use std::cell::RefCell;

/// The surface on which two bodies press on each other; what is proportional to the stiffness K per area is given over K.
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

    /// Rows of position (3, from the contact point), area, depth and normal (3) of each point of quadrature.
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

/// The patch {s_A = s_B <= 1} of an overlapping contact, with the pressure K l (1 - s) on it, as a Patch; world axes, all over K.
///
/// tolerance: relative, of force and torque, in [1e-12, 0.1]. energy, stiffness: whether these are computed, too. Its points are the points of
/// quadrature. ValueError: the contact is separated, or the tolerance out of range.
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
    made((tolerance, energy, stiffness), |settings, scratch, points| {
        let visit = |point| points.push(point);
        patch_of_contact(&a.0, &pose_a.0, &b.0, &pose_b.0, &contact.0, settings, scratch, visit)
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

/// The patch of an overlapping contact with a triangle: the part of the triangle inside A. Otherwise as patch_of_contact.
///
/// from_front: A counts as in front, where the vertices run counter-clockwise, as for the mesh of a closed body seen from outside.
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
