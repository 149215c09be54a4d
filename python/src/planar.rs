//! Particles of the plane.

use crate::arrays::{rows, to_rows, to_vector, vector};
use crate::contact::{PyPairState, attributes, getters, getters_of_contact, names};
use crate::errors::{of_contact, refused};
use crate::patch::SCRATCH;
use crate::pickles::pickled;
use crate::settings::{PySettings, or_default};
use numpy::{PyArray1, PyArray2};
use potential_particles::Kind;
use potential_particles::PatchSettings;
use potential_particles::planar::{
    AreaProperties, Contact, Line, Particle, Patch, PatchPoint, Pose, Section, patch_of_contact,
};
use pyo3::prelude::*;

/// A validated potential particle of the plane, immutable.
#[pyclass(name = "Particle", module = "potential_particles.planar", frozen)]
pub struct PyPlanarParticle(Particle);

#[pymethods]
impl PyPlanarParticle {
    #[new]
    #[pyo3(signature = (lines, r, k=0.0, R=1.0))]
    #[allow(non_snake_case)]
    fn new(lines: &Bound<'_, PyAny>, r: f64, k: f64, R: f64) -> PyResult<Self> {
        let lines: Vec<Line> =
            rows::<3>(lines, "lines", "three numbers a, b, d")?.into_iter().map(Line::from).collect();
        Particle::new(&lines, r, k, R).map(Self).map_err(refused)
    }

    #[staticmethod]
    fn circle(radius: f64) -> PyResult<Self> {
        Particle::circle(radius).map(Self).map_err(refused)
    }

    #[staticmethod]
    #[pyo3(signature = (points, r, k=0.0))]
    fn polygon(points: &Bound<'_, PyAny>, r: f64, k: f64) -> PyResult<Self> {
        let points = rows::<2>(points, "points", "two numbers x, y")?;
        Particle::polygon(&points, r, k).map(Self).map_err(refused)
    }

    #[staticmethod]
    #[pyo3(signature = (width, height, r, k=0.0))]
    fn rectangle(width: f64, height: f64, r: f64, k: f64) -> PyResult<Self> {
        Particle::rectangle(width, height, r, k).map(Self).map_err(refused)
    }

    #[getter]
    fn lines<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.lines().map(|line| [line.normal.x, line.normal.y, line.offset]))
    }

    #[getter]
    fn r(&self) -> f64 {
        self.0.rounding_radius()
    }

    #[getter]
    fn k(&self) -> f64 {
        self.0.sphericity()
    }

    #[getter]
    #[allow(non_snake_case)]
    fn R(&self) -> f64 {
        self.0.shadow_radius()
    }

    #[getter]
    fn bounding_radius(&self) -> f64 {
        self.0.bounding_radius()
    }

    fn potential(&self, x: &Bound<'_, PyAny>) -> PyResult<f64> {
        Ok(self.0.potential(&vector::<2>(x, "x")?.into()))
    }

    /// Area, centroid and second moments for unit density, in closed form; where rounding leaves more than tolerance,
    /// relative, by a polygon of points of the boundary.
    #[pyo3(signature = (tolerance=1e-6))]
    fn area_properties(&self, py: Python<'_>, tolerance: f64) -> PyResult<PyAreaProperties> {
        py.detach(|| self.0.area_properties(tolerance)).map(PyAreaProperties).map_err(refused)
    }

    fn outline<'py>(&self, py: Python<'py>, tolerance: f64) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = py.detach(|| self.0.outline(tolerance)).map_err(refused)?;
        Ok(to_rows(py, points.into_iter().map(|point| point.into())))
    }

    fn __repr__(&self) -> String {
        format!(
            "<planar.Particle of {} lines, r={:?}, k={:?}, R={:?}>",
            self.0.lines().len(),
            self.r(),
            self.k(),
            self.R()
        )
    }

    fn __getnewargs__<'py>(&self, py: Python<'py>) -> (Bound<'py, PyArray2<f64>>, f64, f64, f64) {
        (self.lines(py), self.r(), self.k(), self.R())
    }
}

/// Area and moments of a particle of unit density.
#[pyclass(name = "AreaProperties", module = "potential_particles.planar", frozen)]
pub struct PyAreaProperties(AreaProperties);

getters!(PyAreaProperties: area, error; centroid);

#[pymethods]
impl PyAreaProperties {
    #[getter]
    fn second_moment<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, (0..2).map(|i| [0, 1].map(|j| self.0.second_moment[(i, j)])))
    }
}

pickled!(PyAreaProperties: AreaProperties);

/// Where a body of the plane is.
#[pyclass(name = "Pose", module = "potential_particles.planar", frozen)]
pub struct PyPlanarPose {
    pose: Pose,
    angle: f64,
}

#[pymethods]
impl PyPlanarPose {
    #[new]
    #[pyo3(signature = (position, angle=0.0))]
    fn new(position: &Bound<'_, PyAny>, angle: f64) -> PyResult<Self> {
        let pose = Pose::new(vector(position, "position")?, angle).map_err(refused)?;
        Ok(Self { pose, angle })
    }

    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, self.pose.position().as_slice())
    }

    #[getter]
    fn angle(&self) -> f64 {
        self.angle
    }

    fn __repr__(&self) -> String {
        let p = self.pose.position();
        format!("planar.Pose(({:?}, {:?}), {:?})", p.x, p.y, self.angle)
    }

    fn __getnewargs__(&self) -> ([f64; 2], f64) {
        ((*self.pose.position()).into(), self.angle)
    }
}

/// The answer for one pair of the plane.
#[pyclass(name = "Contact", module = "potential_particles.planar", frozen)]
pub struct PyPlanarContact(Contact);

getters_of_contact!(PyPlanarContact);

#[pymethods]
impl PyPlanarContact {
    fn __repr__(&self) -> String {
        match self.0.kind {
            Kind::Separated => format!("<planar.Contact: separated, s={:.6}>", self.0.s),
            Kind::Overlapping => format!("<planar.Contact: overlapping by {:.6e}, s={:.6}>", self.0.overlap, self.0.s),
        }
    }
}

pickled!(PyPlanarContact: Contact);

/// The contact of particle A at pose_a with particle B at pose_b, as a planar.Contact; settings, state and errors as of
/// detect in space.
#[pyfunction]
#[pyo3(signature = (a, pose_a, b, pose_b, settings=None, state=None))]
fn detect(
    a: &PyPlanarParticle,
    pose_a: &PyPlanarPose,
    b: &PyPlanarParticle,
    pose_b: &PyPlanarPose,
    settings: Option<&PySettings>,
    mut state: Option<PyRefMut<'_, PyPairState>>,
) -> PyResult<PyPlanarContact> {
    let state = state.as_mut().map(|state| &mut state.0);
    let found =
        potential_particles::planar::detect(&a.0, &pose_a.pose, &b.0, &pose_b.pose, &or_default(settings), state);
    found.map(PyPlanarContact).map_err(of_contact)
}

/// How much of the line through the contact point normal to the contact normal lies in both particles, length; 0 when
/// separated.
#[pyfunction]
fn contact_length(
    a: &PyPlanarParticle,
    pose_a: &PyPlanarPose,
    b: &PyPlanarParticle,
    pose_b: &PyPlanarPose,
    contact: &PyPlanarContact,
) -> PyResult<f64> {
    if contact.0.kind == Kind::Separated {
        return Ok(0.0);
    }
    let length = Section::from(&contact.0).length(&a.0, &pose_a.pose, &b.0, &pose_b.pose);
    length.ok_or_else(|| refused("the contact has no finite point and normal"))
}

/// The curve on which two bodies press on each other; what is proportional to the stiffness K per area is given over K,
/// all per unit of thickness.
#[pyclass(name = "Patch", module = "potential_particles.planar", frozen)]
pub struct PyPlanarPatch(Patch, Vec<PatchPoint>);

getters!(PyPlanarPatch: depth_length, torque, length, second_moment, mean_depth, largest_depth, energy, error;
    force, pressure_centre, branch_a, branch_b, centroid);

#[pymethods]
impl PyPlanarPatch {
    #[getter]
    fn flags(&self) -> Vec<String> {
        names(self.0.flags.bits(), self.0.flags)
    }

    /// Change of force and torque on B about the contact point, over K, with a shift and a turn of A: rows and columns
    /// x, y and angle.
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, (0..3).map(|i| [0, 1, 2].map(|j| self.0.stiffness[(i, j)])))
    }

    /// Rows of position (2, from the contact point), length, depth and normal (2) of each point of quadrature.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let row = |p: &PatchPoint| [p.position.x, p.position.y, p.length, p.depth, p.normal.x, p.normal.y];
        to_rows(py, self.1.iter().map(row))
    }

    fn __repr__(&self) -> String {
        let Patch { force: f, length, .. } = self.0;
        format!("<planar.Patch: length {length:.6e}, force/K ({:.4e}, {:.4e})>", f.x, f.y)
    }
}

pickled!(
    PyPlanarPatch: (Patch, Vec<PatchPoint>),
    |object| (object.0, &object.1),
    |_py, (patch, points)| Self(patch, points)
);

/// The patch {s_A = s_B <= 1} of an overlapping contact of the plane, as a planar.Patch; otherwise as patch_of_contact
/// in space.
#[pyfunction(name = "patch_of_contact")]
#[pyo3(signature = (a, pose_a, b, pose_b, contact, *, tolerance=1e-4, energy=false))]
fn patch(
    a: &PyPlanarParticle,
    pose_a: &PyPlanarPose,
    b: &PyPlanarParticle,
    pose_b: &PyPlanarPose,
    contact: &PyPlanarContact,
    tolerance: f64,
    energy: bool,
) -> PyResult<PyPlanarPatch> {
    let settings = PatchSettings { tolerance, with_energy: energy, with_stiffness: true };
    let mut points = Vec::new();
    let visit = |point| points.push(point);
    let patch = SCRATCH.with_borrow_mut(|scratch| {
        patch_of_contact(&a.0, &pose_a.pose, &b.0, &pose_b.pose, &contact.0, &settings, scratch, visit)
    });
    Ok(PyPlanarPatch(patch.map_err(refused)?, points))
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_planar")?;
    module.add_class::<PyPlanarParticle>()?;
    module.add_class::<PyAreaProperties>()?;
    module.add_class::<PyPlanarPose>()?;
    module.add_class::<PyPlanarContact>()?;
    attributes!(module.py(), PyPlanarContact: Contact);
    module.add_class::<PyPlanarPatch>()?;
    module.add_function(wrap_pyfunction!(detect, &module)?)?;
    module.add_function(wrap_pyfunction!(contact_length, &module)?)?;
    module.add_function(wrap_pyfunction!(patch, &module)?)?;
    parent.add_submodule(&module)
}
