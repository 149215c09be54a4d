//! Derivatives of contacts and patches in poses and shapes.

use crate::arrays::{to_rows, to_vector, vector};
use crate::boundary::{PyFlatContact, PyTriangle};
use crate::contact::{PyContact, names};
use crate::errors::{of_contact, refused};
use crate::particle::PyParticle;
use crate::patch::PyPatch;
use crate::pickles::pickled;
use crate::pose::PyPose;
use crate::settings::{PySettings, or_default};
use numpy::{PyArray1, PyArray2};
use potential_particles::nalgebra::Vector3;
use potential_particles::{
    ContactDerivatives, ContactWeights, DerivativeError, DerivativeFlags, PatchDerivatives, PoseGradient, PoseRow,
    PoseRows, ShapeGradient, boundary_derivatives, boundary_gradient, contact_derivatives, contact_gradient,
    patch_derivatives,
};
use pyo3::prelude::*;

fn of_derivative(error: DerivativeError) -> PyErr {
    match error {
        DerivativeError::Detect(error) => of_contact(error),
        error => refused(error),
    }
}

fn row<'py>(py: Python<'py>, row: &PoseRow) -> Bound<'py, PyArray1<f64>> {
    to_vector(py, row.as_slice())
}

fn rows<'py>(py: Python<'py>, rows: &PoseRows) -> Bound<'py, PyArray2<f64>> {
    to_rows(py, (0..3).map(|i| std::array::from_fn::<f64, 12, _>(|column| rows[(i, column)])))
}

/// Getters of rows (12,) and (3, 12) of a field.
macro_rules! row_getters {
    ($class:ident: $($number:ident),*; $($vector:ident),*) => {
        #[pymethods]
        impl $class {
            $(#[getter]
            fn $number<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
                row(py, &self.0.$number)
            })*
            $(#[getter]
            fn $vector<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
                rows(py, &self.0.$vector)
            })*
        }
    };
}

/// Derivatives of a contact in the poses of A and B: numbers (12,), vectors (3, 12), world axes. Columns: a shift of A
/// along x, y, z, a turn of A about its position and x, y, z in radians, then the same of B. What is NaN in the contact
/// is NaN here.
#[pyclass(name = "ContactDerivatives", module = "potential_particles", frozen)]
pub struct PyContactDerivatives(ContactDerivatives);

row_getters!(PyContactDerivatives: s, s_b, overlap; normal, point, point_on_a, point_on_b);

#[pymethods]
impl PyContactDerivatives {
    #[getter]
    fn flags(&self) -> Vec<String> {
        names(self.0.flags.bits(), self.0.flags)
    }

    fn __repr__(&self) -> String {
        format!("<ContactDerivatives: flags {}>", self.0.flags)
    }
}

pickled!(PyContactDerivatives: ContactDerivatives);

/// Derivatives of a patch in the poses of A and B over K, as of ContactDerivatives: minus the second derivative of its
/// energy.
#[pyclass(name = "PatchDerivatives", module = "potential_particles", frozen)]
pub struct PyPatchDerivatives(PatchDerivatives);

row_getters!(PyPatchDerivatives: ; force, torque_on_a, torque_on_b);

pickled!(PyPatchDerivatives: PatchDerivatives);

/// Derivatives of a cost in the poses and shapes of a contact.
#[pyclass(name = "ContactGradient", module = "potential_particles", frozen)]
pub struct PyContactGradient {
    poses: [PoseGradient; 2],
    shapes: [Option<ShapeGradient>; 2],
    flags: DerivativeFlags,
}

impl PyContactGradient {
    fn planes<'py>(&self, py: Python<'py>, body: usize) -> Option<Bound<'py, PyArray2<f64>>> {
        let shape = self.shapes[body].as_ref()?;
        Some(to_rows(py, shape.planes.iter().map(|p| [p.normal.x, p.normal.y, p.normal.z, p.offset])))
    }

    fn numbers<'py>(&self, py: Python<'py>, body: usize) -> Option<Bound<'py, PyArray1<f64>>> {
        let shape = self.shapes[body].as_ref()?;
        Some(to_vector(py, &[shape.r, shape.k, shape.shadow_radius]))
    }
}

#[pymethods]
impl PyContactGradient {
    /// In the poses, (12,), columns as of ContactDerivatives.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let parts = self.poses.map(|pose| [pose.shift, pose.turn]);
        to_vector(py, &parts.iter().flatten().flat_map(|v| v.iter().copied()).collect::<Vec<f64>>())
    }

    /// In a, b, c and d of each plane of A, (n, 4).
    #[getter]
    fn planes_a<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        self.planes(py, 0)
    }

    /// In r, k and R of A, (3,).
    #[getter]
    fn rounding_a<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.numbers(py, 0)
    }

    /// Of B; None of a boundary.
    #[getter]
    fn planes_b<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        self.planes(py, 1)
    }

    /// Of B; None of a boundary.
    #[getter]
    fn rounding_b<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.numbers(py, 1)
    }

    #[getter]
    fn flags(&self) -> Vec<String> {
        names(self.flags.bits(), self.flags)
    }

    fn __repr__(&self) -> String {
        format!("<ContactGradient: flags {}>", self.flags)
    }
}

type GradientState = ([PoseGradient; 2], [Option<ShapeGradient>; 2], DerivativeFlags);
pickled!(PyContactGradient: GradientState, |object| (object.poses, &object.shapes, object.flags),
    |_py, (poses, shapes, flags)| Self { poses, shapes, flags });

fn weights(numbers: [f64; 3], vectors: [(Option<&Bound<'_, PyAny>>, &str); 4]) -> PyResult<ContactWeights> {
    let [s, s_b, overlap] = numbers;
    let mut found = [Vector3::zeros(); 4];
    for (found, (given, name)) in found.iter_mut().zip(vectors) {
        if let Some(given) = given {
            *found = Vector3::from(vector::<3>(given, name)?);
        }
    }
    let all = numbers.iter().chain(found.iter().flat_map(|v| v.iter()));
    if let Some(wrong) = all.copied().find(|v: &f64| !v.is_finite()) {
        return Err(refused(format!(
            "a weight is {wrong:?}: weights must be finite, and 0 on what is NaN in the contact"
        )));
    }
    let [normal, point, point_on_a, point_on_b] = found;
    Ok(ContactWeights { s, s_b, overlap, normal, point, point_on_a, point_on_b })
}

/// The derivatives of a contact in the poses of both bodies, as ContactDerivatives.
///
/// contact: the answer of detect for the same bodies, poses and settings; it is not solved again. By the implicit
/// function theorem on the optimality conditions at the contact point. ValueError: the contact has no point, or no
/// derivative there.
#[pyfunction(name = "contact_derivatives")]
#[pyo3(signature = (a, pose_a, b, pose_b, contact, settings=None))]
fn of_pair(
    a: &PyParticle,
    pose_a: &PyPose,
    b: &PyParticle,
    pose_b: &PyPose,
    contact: &PyContact,
    settings: Option<&PySettings>,
) -> PyResult<PyContactDerivatives> {
    contact_derivatives(&a.0, &pose_a.0, &b.0, &pose_b.0, contact.at(pose_a, pose_b)?, &or_default(settings))
        .map(PyContactDerivatives)
        .map_err(of_derivative)
}

/// The derivatives of a cost in poses and shapes of both bodies, from its derivatives in the numbers of their contact,
/// as a ContactGradient.
///
/// s, s_b, overlap, normal, ...: derivatives of the cost in these numbers of the contact, 0 unless given. The work is
/// linear in the number of active planes. contact, errors: as of contact_derivatives.
#[pyfunction(name = "contact_gradient")]
#[pyo3(signature = (a, pose_a, b, pose_b, contact, settings=None, *, s=0.0, s_b=0.0, overlap=0.0, normal=None,
                   point=None, point_on_a=None, point_on_b=None))]
#[allow(clippy::too_many_arguments)]
fn gradient_of_pair(
    a: &PyParticle,
    pose_a: &PyPose,
    b: &PyParticle,
    pose_b: &PyPose,
    contact: &PyContact,
    settings: Option<&PySettings>,
    s: f64,
    s_b: f64,
    overlap: f64,
    normal: Option<&Bound<'_, PyAny>>,
    point: Option<&Bound<'_, PyAny>>,
    point_on_a: Option<&Bound<'_, PyAny>>,
    point_on_b: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyContactGradient> {
    let vectors = [(normal, "normal"), (point, "point"), (point_on_a, "point_on_a"), (point_on_b, "point_on_b")];
    let weights = weights([s, s_b, overlap], vectors)?;
    let (mut of_a, mut of_b) = (ShapeGradient::zeros(&a.0), ShapeGradient::zeros(&b.0));
    let settings = or_default(settings);
    let shapes = (Some(&mut of_a), Some(&mut of_b));
    let contact = contact.at(pose_a, pose_b)?;
    let (poses, flags) =
        contact_gradient(&a.0, &pose_a.0, &b.0, &pose_b.0, contact, &settings, &weights, shapes.0, shapes.1)
            .map_err(of_derivative)?;
    Ok(PyContactGradient { poses, shapes: [Some(of_a), Some(of_b)], flags })
}

/// The derivatives of a contact with a plane, or with the given triangle, as ContactDerivatives: point_on_a is
/// on_particle, point_on_b is on_boundary, and the boundary stands in place of B. It turns about the position of A,
/// too. ValueError: as of contact_derivatives.
#[pyfunction(name = "boundary_derivatives")]
#[pyo3(signature = (a, pose, contact, triangle=None, settings=None))]
fn of_boundary(
    a: &PyParticle,
    pose: &PyPose,
    contact: &PyFlatContact,
    triangle: Option<&PyTriangle>,
    settings: Option<&PySettings>,
) -> PyResult<PyContactDerivatives> {
    let triangle = triangle.map(|triangle| &triangle.triangle);
    boundary_derivatives(&a.0, &pose.0, triangle, &contact.0, &or_default(settings))
        .map(PyContactDerivatives)
        .map_err(of_derivative)
}

/// The derivatives of a cost in the pose and shape of A and in the pose of a boundary, as a ContactGradient; otherwise
/// as contact_gradient and boundary_derivatives.
#[pyfunction(name = "boundary_gradient")]
#[pyo3(signature = (a, pose, contact, triangle=None, settings=None, *, s=0.0, overlap=0.0, normal=None, point=None,
                   on_particle=None, on_boundary=None))]
#[allow(clippy::too_many_arguments)]
fn gradient_of_boundary(
    a: &PyParticle,
    pose: &PyPose,
    contact: &PyFlatContact,
    triangle: Option<&PyTriangle>,
    settings: Option<&PySettings>,
    s: f64,
    overlap: f64,
    normal: Option<&Bound<'_, PyAny>>,
    point: Option<&Bound<'_, PyAny>>,
    on_particle: Option<&Bound<'_, PyAny>>,
    on_boundary: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyContactGradient> {
    let vectors = [(normal, "normal"), (point, "point"), (on_particle, "on_particle"), (on_boundary, "on_boundary")];
    let weights = weights([s, 0.0, overlap], vectors)?;
    let mut shape = ShapeGradient::zeros(&a.0);
    let triangle = triangle.map(|triangle| &triangle.triangle);
    let settings = or_default(settings);
    let (poses, flags) = boundary_gradient(&a.0, &pose.0, triangle, &contact.0, &settings, &weights, Some(&mut shape))
        .map_err(of_derivative)?;
    Ok(PyContactGradient { poses, shapes: [Some(shape), None], flags })
}

/// The derivatives of force and torques of a patch that was found with stiffness=True, as PatchDerivatives.
///
/// contact: the Contact, or FlatContact, of which it is the patch. ValueError: the patch has no stiffness.
#[pyfunction(name = "patch_derivatives")]
fn of_patch(patch: &PyPatch, contact: &Bound<'_, PyAny>) -> PyResult<PyPatchDerivatives> {
    let to_point = if let Ok(contact) = contact.extract::<PyRef<'_, PyContact>>() {
        [contact.0.branch_a, contact.0.branch_b]
    } else {
        let contact = contact.extract::<PyRef<'_, PyFlatContact>>()?;
        [contact.0.branch - 0.5 * contact.0.overlap * contact.0.normal; 2]
    };
    let found = patch_derivatives(&patch.0, to_point);
    found.map(PyPatchDerivatives).ok_or_else(|| refused("the patch has no stiffness: ask for it with stiffness=True"))
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyContactDerivatives>()?;
    module.add_class::<PyPatchDerivatives>()?;
    module.add_class::<PyContactGradient>()?;
    module.add_function(wrap_pyfunction!(of_pair, module)?)?;
    module.add_function(wrap_pyfunction!(gradient_of_pair, module)?)?;
    module.add_function(wrap_pyfunction!(of_boundary, module)?)?;
    module.add_function(wrap_pyfunction!(gradient_of_boundary, module)?)?;
    module.add_function(wrap_pyfunction!(of_patch, module)?)
}
