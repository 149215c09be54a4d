//! Contacts with planes and triangles.

use crate::arrays::vector;
use crate::contact::{PyPairState, attributes, getters_of_contact, names};
use crate::errors::{of_contact, refused};
use crate::particle::PyParticle;
use crate::pickles::pickled;
use crate::pose::PyPose;
use crate::settings::{PySettings, or_default};
use potential_particles::{FlatContact, Kind, Triangle, Wall, contact_with_plane, contact_with_triangle};
use pyo3::prelude::*;

/// A plane, which a particle touches from either side.
#[pyclass(name = "Wall", module = "potential_particles", frozen)]
pub struct PyWall {
    pub wall: Wall,
    given: [[f64; 3]; 2],
}

#[pymethods]
impl PyWall {
    #[new]
    fn new(point: &Bound<'_, PyAny>, normal: &Bound<'_, PyAny>) -> PyResult<Self> {
        let given = [vector(point, "point")?, vector(normal, "normal")?];
        Ok(Self { wall: Wall::new(given[0], given[1]).map_err(refused)?, given })
    }

    fn __repr__(&self) -> String {
        format!("Wall({:?}, {:?})", self.given[0], self.given[1])
    }

    fn __getnewargs__(&self) -> ([f64; 3], [f64; 3]) {
        (self.given[0], self.given[1])
    }
}

/// A closed triangle.
#[pyclass(name = "Triangle", module = "potential_particles", frozen)]
pub struct PyTriangle {
    pub triangle: Triangle,
    given: [[f64; 3]; 3],
}

#[pymethods]
impl PyTriangle {
    #[new]
    fn new(a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>, c: &Bound<'_, PyAny>) -> PyResult<Self> {
        let given = [vector(a, "a")?, vector(b, "b")?, vector(c, "c")?];
        Ok(Self { triangle: Triangle::new(given).map_err(refused)?, given })
    }

    fn __repr__(&self) -> String {
        format!("Triangle({:?}, {:?}, {:?})", self.given[0], self.given[1], self.given[2])
    }

    fn __getnewargs__(&self) -> ([f64; 3], [f64; 3], [f64; 3]) {
        (self.given[0], self.given[1], self.given[2])
    }
}

/// The answer for a particle A and a plane or triangle T, world frame, lengths in the caller's unit. What does not
/// apply is NaN.
///
/// Each number has a docstring of its own. flags, iterations, kind, overlapping: as of Contact. feature: where on T
/// s_A is least: ("interior", 0), ("edge", i) or ("vertex", i).
#[pyclass(name = "FlatContact", module = "potential_particles", frozen)]
pub struct PyFlatContact(pub FlatContact);

getters_of_contact!(PyFlatContact);

#[pymethods]
impl PyFlatContact {
    #[getter]
    fn feature(&self) -> (&'static str, usize) {
        let feature = self.0.feature;
        feature.edge().map(|i| ("edge", i)).or(feature.vertex().map(|i| ("vertex", i))).unwrap_or(("interior", 0))
    }

    fn __repr__(&self) -> String {
        match self.0.kind {
            Kind::Separated => format!("<FlatContact: separated, s={:.6}>", self.0.s),
            Kind::Overlapping => format!("<FlatContact: overlapping by {:.6e}, s={:.6}>", self.0.overlap, self.0.s),
        }
    }
}

pickled!(PyFlatContact: FlatContact);

/// The contact of particle A with a plane, which it may touch from either side, as a FlatContact: the least S_A on it.
///
/// state: a PairState of A and this boundary, read, and updated on success. ContactError: no answer, which does not
/// mean separated.
#[pyfunction(name = "contact_with_plane")]
#[pyo3(signature = (a, pose, wall, settings=None, state=None))]
fn with_plane(
    a: &PyParticle,
    pose: &PyPose,
    wall: &PyWall,
    settings: Option<&PySettings>,
    mut state: Option<PyRefMut<'_, PyPairState>>,
) -> PyResult<PyFlatContact> {
    let state = state.as_mut().map(|state| &mut state.0);
    contact_with_plane(&a.0, &pose.0, &wall.wall, &or_default(settings), state).map(PyFlatContact).map_err(of_contact)
}

/// The contact of particle A with a closed triangle, which it may touch from either side, as a FlatContact: the least
/// S_A on it.
///
/// Of the triangles of a mesh, the one with the least s owns the contact at a seam. state and errors as of
/// contact_with_plane.
#[pyfunction(name = "contact_with_triangle")]
#[pyo3(signature = (a, pose, triangle, settings=None, state=None))]
fn with_triangle(
    a: &PyParticle,
    pose: &PyPose,
    triangle: &PyTriangle,
    settings: Option<&PySettings>,
    mut state: Option<PyRefMut<'_, PyPairState>>,
) -> PyResult<PyFlatContact> {
    let state = state.as_mut().map(|state| &mut state.0);
    let found = contact_with_triangle(&a.0, &pose.0, &triangle.triangle, &or_default(settings), state);
    found.map(PyFlatContact).map_err(of_contact)
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyWall>()?;
    module.add_class::<PyTriangle>()?;
    module.add_class::<PyFlatContact>()?;
    attributes!(module.py(), PyFlatContact: FlatContact);
    module.add_function(wrap_pyfunction!(with_plane, module)?)?;
    module.add_function(wrap_pyfunction!(with_triangle, module)?)
}
