//! Builders of shapes.

use crate::arrays::{index_rows, rows, to_vector, vector};
use crate::errors::refused;
use crate::particle::{PyMassProperties, PyParticle, planes};
use crate::pickles::pickled;
use crate::pose::PyPose;
use numpy::PyArray1;
use potential_particles::shapes::{self, Rounding, Shape, ShapeError};
use pyo3::exceptions::{PyFutureWarning, PyUserWarning};
use pyo3::prelude::*;
use std::ffi::{CStr, CString};

/// A particle about its centroid along its principal axes, and where that frame lies in the builder's.
#[pyclass(name = "Shape", module = "potential_particles.builders", frozen)]
pub struct PyShape {
    shape: Shape,
    particle: Py<PyParticle>,
}

impl PyShape {
    pub fn of(py: Python<'_>, shape: Shape) -> PyResult<Self> {
        let particle = Py::new(py, PyParticle(shape.particle.clone()))?;
        Ok(Self { shape, particle })
    }
}

#[pymethods]
impl PyShape {
    #[getter]
    fn particle(&self, py: Python<'_>) -> Py<PyParticle> {
        self.particle.clone_ref(py)
    }

    #[getter]
    fn mass(&self) -> PyMassProperties {
        PyMassProperties(self.shape.mass)
    }

    #[getter]
    fn volume(&self) -> f64 {
        self.shape.mass.volume
    }

    #[getter]
    fn sharp_volume(&self) -> f64 {
        self.shape.sharp_volume
    }

    #[getter]
    fn centroid<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, self.shape.centroid.as_slice())
    }

    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, &self.shape.orientation)
    }

    #[getter]
    fn pose(&self) -> PyPose {
        PyPose(self.shape.pose())
    }

    fn __repr__(&self) -> String {
        format!("<Shape of {} planes, volume {:.6}>", self.shape.particle.plane_count(), self.shape.mass.volume)
    }
}

pickled!(PyShape: Shape, |object| object.shape, |py, shape| PyShape::of(py, shape)?);

/// The keywords of rounding: the share of the size, k, and r and R, lengths.
type Keywords = (Option<f64>, f64, Option<f64>, Option<f64>);

/// For scripts written for version 0.1, until December 2027.
const LENGTHS: &CStr =
    c"r and R of builders are lengths; until version 0.1 they were shares of the size: r=0.05 of then is \
      rounding=0.05 (docs/wheel.md)";

fn built(
    py: Python<'_>,
    (share, k, r, shadow_radius): Keywords,
    make: impl FnOnce(&Rounding) -> Result<Shape, ShapeError> + Send,
) -> PyResult<PyShape> {
    if r.is_some() || shadow_radius.is_some() {
        PyErr::warn(py, &py.get_type::<PyFutureWarning>(), LENGTHS, 1)?;
    }
    let rounding = match (share, r) {
        (Some(share), Some(r)) => {
            return Err(refused(format!(
                "rounding={share:?} and r={r:?} both give the rounding radius: leave out one"
            )));
        }
        (None, Some(r)) => Rounding::of_radius(r, k),
        (Some(share), None) => Rounding::new(share, k),
        (None, None) => Rounding::chosen(k),
    };
    let rounding = shadow_radius.map_or(rounding, |length| rounding.with_shadow_radius(length));
    let shape = py.detach(|| make(&rounding)).map_err(refused)?;
    if let Some(end) = shadow_radius.map(|radius| radius / k.sqrt()) {
        if shape.particle.bounding_radius() >= (1.0 - 1e-9) * end {
            let told = format!(
                "R={shadow_radius:?}: a sphere of radius R/sqrt(k)={end:.6} cuts off what lies beyond; leave R out, or \
                 take a larger one",
                shadow_radius = shadow_radius.unwrap_or_default()
            );
            let told = CString::new(told).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &told, 1)?;
        }
    }
    PyShape::of(py, shape)
}

/// Of half-spaces, rows (a, b, c, h) with a x + b y + c z <= h inside, or (normals, offsets): the faces of the particle
/// are where these planes are.
///
/// Planes that make no face are left out. rounding: r as a share of the size, the diameter of the largest ball that
/// fits in the sharp shape, 0.05, or in its place r, a length; k: sphericity; R: a length. ValueError: no volume, or no
/// point inside.
#[pyfunction]
#[pyo3(signature = (planes, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn half_spaces(
    py: Python<'_>,
    planes: &Bound<'_, PyAny>,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let planes = self::planes(planes)?;
    built(py, (rounding, k, r, R), |rounding| shapes::half_spaces(&planes, rounding))
}

/// Of the convex hull of points (n, 3), rounded inwards: no part lies outside the hull.
///
/// Triangles that are coplanar to 1e-6 of the extent, or to known, are one face. known: the length to which the
/// coordinates are known, where that is less than all their digits. rounding: r as a share of the size, the diameter of
/// the largest ball that fits in the sharp shape, 0.05, or in its place r, a length; k: sphericity; R: a length.
/// ValueError: flat points.
#[pyfunction]
#[pyo3(signature = (points, *, known=0.0, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn hull(
    py: Python<'_>,
    points: &Bound<'_, PyAny>,
    known: f64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let (points, known) = (rows::<3>(points, "points", "three numbers x, y, z")?, length(known, "known")?);
    built(py, (rounding, k, r, R), |rounding| shapes::known_hull(&points, None, known, rounding))
}

/// Of a closed convex surface: points (n, 3) and triangles (m, 3), numbers of points.
///
/// known: the length to which the coordinates are known, where that is less than all their digits. rounding: r as a
/// share of the size, the diameter of the largest ball that fits in the sharp shape, 0.05, or in its place r, a length;
/// k: sphericity; R: a length. ValueError: a surface that is open, not convex or crosses itself; hull makes its convex
/// hull.
#[pyfunction]
#[pyo3(signature = (points, triangles, *, known=0.0, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn surface(
    py: Python<'_>,
    points: &Bound<'_, PyAny>,
    triangles: &Bound<'_, PyAny>,
    known: f64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let (points, known) = (rows::<3>(points, "points", "three numbers x, y, z")?, length(known, "known")?);
    let triangles = index_rows::<3>(triangles, "triangles", "three indices of points")?;
    built(py, (rounding, k, r, R), |rounding| shapes::known_hull(&points, Some(&triangles), known, rounding))
}

/// Python's negative numbers would be an OverflowError.
pub fn count(value: i64, name: &str) -> PyResult<usize> {
    usize::try_from(value).map_err(|_| refused(format!("{name}={value} must not be negative")))
}

/// A length, 0 or more.
fn length(value: f64, name: &str) -> PyResult<f64> {
    let is_length = value >= 0.0 && value.is_finite();
    is_length.then_some(value).ok_or_else(|| refused(format!("{name}={value:?} must be finite and at least 0")))
}

/// A sphere about the origin: k = 1.
#[pyfunction]
fn sphere(py: Python<'_>, radius: f64) -> PyResult<PyShape> {
    PyShape::of(py, shapes::sphere(radius).map_err(refused)?)
}

/// A cuboid about the origin with these edges along x, y, z, length.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, 0.05, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (edges, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn cuboid(
    py: Python<'_>,
    edges: &Bound<'_, PyAny>,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let edges = vector(edges, "edges")?;
    built(py, (rounding, k, r, R), |rounding| shapes::cuboid(edges, rounding))
}

/// A regular prism along z from -height/2 to height/2; radius: of the circle within its section; the first side faces
/// x.
///
/// top_radius: that at the upper end, a frustum; 0 makes a pyramid. rounding: r as a share of the size, the diameter of
/// the largest ball that fits in the sharp shape, 0.05, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (sides=6, radius=0.5, height=1.0, top_radius=None, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn prism(
    py: Python<'_>,
    sides: i64,
    radius: f64,
    height: f64,
    top_radius: Option<f64>,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let sides = count(sides, "sides")?;
    built(py, (rounding, k, r, R), |rounding| {
        shapes::frustum(sides, radius, top_radius.unwrap_or(radius), height, rounding)
    })
}

/// A cylinder along z as a prism of as many sides, whose section, rounded as it is, has the area pi radius^2.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, 0.05, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (radius=0.5, height=1.0, sides=48, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn cylinder(
    py: Python<'_>,
    radius: f64,
    height: f64,
    sides: i64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let sides = count(sides, "sides")?;
    built(py, (rounding, k, r, R), |rounding| shapes::cylinder(radius, height, sides, rounding))
}

/// A cone along z from -height/2 to its tip at height/2, as a pyramid of as many sides whose base has the area pi
/// radius^2.
///
/// rounding: r as a share of the size, or in its place r, a length: without both so small that base and height lose no
/// more than 0.1 %; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (radius=0.5, height=1.0, sides=48, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn cone(
    py: Python<'_>,
    radius: f64,
    height: f64,
    sides: i64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let sides = count(sides, "sides")?;
    built(py, (rounding, k, r, R), |rounding| shapes::cone(radius, height, sides, rounding))
}

/// An ellipsoid about the origin with these semi-axes along x, y, z, length: exact, of 6 planes.
#[pyfunction]
fn ellipsoid(py: Python<'_>, axes: &Bound<'_, PyAny>) -> PyResult<PyShape> {
    PyShape::of(py, shapes::ellipsoid(vector(axes, "axes")?).map_err(refused)?)
}

/// All points within radius of a segment of this length along z, about the origin: exact, of 6 planes.
#[pyfunction]
fn capsule(py: Python<'_>, radius: f64, length: f64) -> PyResult<PyShape> {
    PyShape::of(py, shapes::capsule(radius, length).map_err(refused)?)
}

/// A superquadric about the origin, (|x/a|^(2/e) + |y/b|^(2/e))^(e/n) + |z/c|^(2/n) <= 1, with the semi-axes a, b, c
/// and the exponents n, e from 0.1, nearly a box, over 1, an ellipsoid, to 2, an octahedron; fitted with its volume.
///
/// planes: at most so many. rounding: r as a share of the size, or in its place r, a length: without both what comes
/// nearest; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (axes, exponents, *, planes=48, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn superquadric(
    py: Python<'_>,
    axes: &Bound<'_, PyAny>,
    exponents: (f64, f64),
    planes: i64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let (axes, planes) = (vector(axes, "axes")?, count(planes, "planes")?);
    built(py, (rounding, k, r, R), |rounding| shapes::superquadric(axes, exponents.into(), planes, rounding))
}

/// Of the convex hull of points (n, 3), as those of a scan: at most so many planes that come near to it, and its
/// volume.
///
/// rounding: r as a share of the size, or in its place r, a length: without both what comes nearest; k: sphericity; R:
/// a length. ValueError: flat points.
#[pyfunction]
#[pyo3(signature = (points, planes=60, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn fitted(
    py: Python<'_>,
    points: &Bound<'_, PyAny>,
    planes: i64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let (points, planes) = (rows::<3>(points, "points", "three numbers x, y, z")?, count(planes, "planes")?);
    built(py, (rounding, k, r, R), |rounding| shapes::fitted(&points, planes, rounding))
}

/// The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, 0.05, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (faces, edge=1.0, *, rounding=None, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn regular_solid(
    py: Python<'_>,
    faces: i64,
    edge: f64,
    rounding: Option<f64>,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let faces = count(faces, "faces")?;
    built(py, (rounding, k, r, R), |rounding| shapes::regular_solid(faces, edge, rounding))
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_builders")?;
    module.add_class::<PyShape>()?;
    module.add_function(wrap_pyfunction!(half_spaces, &module)?)?;
    module.add_function(wrap_pyfunction!(hull, &module)?)?;
    module.add_function(wrap_pyfunction!(surface, &module)?)?;
    module.add_function(wrap_pyfunction!(sphere, &module)?)?;
    module.add_function(wrap_pyfunction!(cuboid, &module)?)?;
    module.add_function(wrap_pyfunction!(prism, &module)?)?;
    module.add_function(wrap_pyfunction!(cylinder, &module)?)?;
    module.add_function(wrap_pyfunction!(cone, &module)?)?;
    module.add_function(wrap_pyfunction!(ellipsoid, &module)?)?;
    module.add_function(wrap_pyfunction!(capsule, &module)?)?;
    module.add_function(wrap_pyfunction!(superquadric, &module)?)?;
    module.add_function(wrap_pyfunction!(fitted, &module)?)?;
    module.add_function(wrap_pyfunction!(regular_solid, &module)?)?;
    parent.add_submodule(&module)
}
