//! `Pose`.

use crate::arrays::{to_rows, to_vector, vector};
use crate::errors::refused;
use crate::pickles::{reduced, state};
use numpy::{PyArray1, PyArray2};
use potential_particles::Pose;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

/// Where a body is: world = rotation local + position, with a quaternion (w, x, y, z) of any length. ValueError:
/// numbers that make no pose.
#[pyclass(name = "Pose", module = "potential_particles", frozen, eq)]
#[derive(PartialEq)]
pub struct PyPose(pub Pose);

#[pymethods]
impl PyPose {
    #[new]
    #[pyo3(signature = (position, orientation=None))]
    fn new(position: &Bound<'_, PyAny>, orientation: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let position = vector(position, "position")?;
        let orientation =
            orientation.map_or(Ok([1.0, 0.0, 0.0, 0.0]), |turn| vector(turn, "orientation (w, x, y, z)"))?;
        Pose::new(position, orientation).map(Self).map_err(refused)
    }

    /// Of a particle in the plane z = 0: a position (x, y) there, and an angle in radians, anticlockwise.
    #[staticmethod]
    #[pyo3(signature = (position, angle=0.0))]
    fn in_plane(position: &Bound<'_, PyAny>, angle: f64) -> PyResult<Self> {
        Pose::in_plane(vector(position, "position")?, angle).map(Self).map_err(refused)
    }

    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, self.0.position().as_slice())
    }

    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, &self.0.orientation())
    }

    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let rotation = self.0.rotation();
        to_rows(py, (0..3).map(|i| [0, 1, 2].map(|j| rotation[(i, j)])))
    }

    fn to_local<'py>(&self, py: Python<'py>, world: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(to_vector(py, self.0.to_local(&vector::<3>(world, "world")?.into()).as_slice()))
    }

    fn to_world<'py>(&self, py: Python<'py>, local: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let world = self.0.rotate(&vector::<3>(local, "local")?.into()) + self.0.position();
        Ok(to_vector(py, world.as_slice()))
    }

    fn __repr__(&self) -> String {
        let [x, y, z] = <[f64; 3]>::from(*self.0.position());
        let [w, i, j, k] = self.0.orientation();
        format!("Pose(({x:?}, {y:?}, {z:?}), ({w:?}, {i:?}, {j:?}, {k:?}))")
    }

    fn __reduce__<'py>(object: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let pose = &object.get().0;
        let (position, orientation): ([f64; 3], _) = ((*pose.position()).into(), pose.orientation());
        let is_given = Pose::new(position, orientation).is_ok_and(|made| made == *pose);
        if is_given {
            return (object.get_type(), (position, orientation)).into_bound_py_any(object.py());
        }
        // In the plane the angle is what was given.
        reduced(object.as_any(), pose)?.into_bound_py_any(object.py())
    }

    #[staticmethod]
    fn _of_state(bytes: &[u8]) -> PyResult<Self> {
        state(bytes).map(Self)
    }
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPose>()
}
