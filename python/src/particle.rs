//! `Particle`, and what follows from it alone.

use crate::arrays::{rows, to_rows, to_vector, vector};
use crate::errors::refused;
use crate::pickles::{pickled, reduced, state};
use crate::pose::PyPose;
use numpy::{PyArray1, PyArray2};
use potential_particles::{MassProperties, Particle, Plane, SurfaceMesh};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

/// A validated potential particle, immutable: {x: (1-k)/r^2 sum <n.x - d>^2 + k/R^2 |x|^2 <= 1}, local frame.
///
/// planes: rows (a, b, c, d) with outward normals, or (normals, offsets); a face of the finished particle lies near d +
/// r. r: rounding radius, R: radius of the shadow sphere, lengths; k: sphericity, in [0, 1]. ValueError: says which
/// number is at fault.
#[pyclass(name = "Particle", module = "potential_particles", frozen)]
pub struct PyParticle(pub Particle);

/// Rows (a, b, c, d), or normals (n, 3) and offsets (n,).
pub fn planes(given: &Bound<'_, PyAny>) -> PyResult<Vec<Plane>> {
    let pair = |(normals, offsets): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let normals = rows::<3>(&normals, "normals", "three numbers a, b, c").ok()?;
        Some((normals, offsets.extract::<Vec<f64>>().ok()?))
    };
    if let Some((normals, offsets)) = given.extract().ok().and_then(pair) {
        if normals.len() != offsets.len() {
            return Err(refused(format!(
                "{} normals and {} offsets: as many are needed",
                normals.len(),
                offsets.len()
            )));
        }
        let plane = |([a, b, c], d): ([f64; 3], f64)| Plane::from([a, b, c, d]);
        return Ok(normals.into_iter().zip(offsets).map(plane).collect());
    }
    Ok(rows::<4>(given, "planes", "four numbers a, b, c, d, or the pair (normals, offsets)")?
        .into_iter()
        .map(Plane::from)
        .collect())
}

fn undirected(direction: [f64; 3]) -> PyErr {
    refused(format!("direction = {direction:?}: it must be finite and not zero"))
}

#[pymethods]
impl PyParticle {
    #[new]
    #[pyo3(signature = (planes, r, k=0.0, R=1.0))]
    #[allow(non_snake_case)]
    fn new(planes: &Bound<'_, PyAny>, r: f64, k: f64, R: f64) -> PyResult<Self> {
        Particle::new(&self::planes(planes)?, r, k, R).map(Self).map_err(refused)
    }

    #[staticmethod]
    fn sphere(radius: f64) -> PyResult<Self> {
        Particle::sphere(radius).map(Self).map_err(refused)
    }

    /// A particle in the plane z = 0: rows (a, b, d) of lines a x + b y = d with outward normals. It is used as any
    /// other, at poses that stay in the plane (Pose.in_plane), together with others in the plane; what it answers lies
    /// at z = 0, and areas, masses and forces of patches are per unit of depth.
    #[staticmethod]
    #[pyo3(signature = (lines, r, k=0.0, R=1.0))]
    #[allow(non_snake_case)]
    fn in_plane(lines: &Bound<'_, PyAny>, r: f64, k: f64, R: f64) -> PyResult<Self> {
        let lines = rows::<3>(lines, "lines", "three numbers a, b, d")?;
        Particle::in_plane(&lines, r, k, R).map(Self).map_err(refused)
    }

    /// A convex polygon with rounded corners in the plane z = 0, about its centroid: the convex hull of points (x, y).
    #[staticmethod]
    #[pyo3(signature = (points, r, k=0.0))]
    fn polygon(points: &Bound<'_, PyAny>, r: f64, k: f64) -> PyResult<Self> {
        Particle::polygon(&rows::<2>(points, "points", "two numbers x, y")?, r, k).map(Self).map_err(refused)
    }

    fn scaled(&self, factor: f64) -> PyResult<Self> {
        self.0.scaled(factor).map(Self).map_err(refused)
    }

    #[getter]
    fn planes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.planes().map(|plane| [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset]))
    }

    /// Whether it lies in the plane z = 0.
    #[getter]
    fn is_in_plane(&self) -> bool {
        self.0.is_in_plane()
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
    fn depth_length(&self) -> f64 {
        self.0.depth_length()
    }

    #[getter]
    fn planes_enclose(&self) -> bool {
        self.0.planes_enclose()
    }

    #[getter]
    fn bounding_radius(&self) -> f64 {
        self.0.bounding_radius()
    }

    #[getter]
    fn bounding_corners<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.bounding_corners().iter().map(|&corner| corner.into()))
    }

    fn bounding_box<'py>(&self, py: Python<'py>, pose: &PyPose) -> Bound<'py, PyArray2<f64>> {
        let (lower, upper) = self.0.bounding_box(&pose.0);
        to_rows(py, [lower.into(), upper.into()].into_iter())
    }

    fn potential(&self, x: &Bound<'_, PyAny>) -> PyResult<f64> {
        Ok(self.0.potential(&vector::<3>(x, "x")?.into()))
    }

    fn gradient<'py>(&self, py: Python<'py>, x: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(to_vector(py, self.0.gradient(&vector::<3>(x, "x")?.into()).as_slice()))
    }

    fn hessian<'py>(&self, py: Python<'py>, x: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let hessian = self.0.hessian(&vector::<3>(x, "x")?.into());
        Ok(to_rows(py, (0..3).map(|i| [0, 1, 2].map(|j| hessian[(i, j)]))))
    }

    /// Upper bound of max e.x over the particle, length, e the unit vector of a local direction of any length.
    fn support(&self, direction: &Bound<'_, PyAny>) -> PyResult<f64> {
        let direction = vector::<3>(direction, "direction")?;
        self.0.support(&direction.into()).ok_or_else(|| undirected(direction))
    }

    fn surface_distance(&self, start: &Bound<'_, PyAny>, direction: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
        let (start, direction) = (vector::<3>(start, "start")?, vector::<3>(direction, "direction")?);
        if self.0.support(&direction.into()).is_none() {
            return Err(undirected(direction));
        }
        if !start.iter().all(|x| x.is_finite()) {
            return Err(refused(format!("start = {start:?}: each number must be finite")));
        }
        Ok(self.0.surface_distance(&start.into(), &direction.into()))
    }

    #[pyo3(signature = (tolerance=1e-6))]
    fn mass_properties(&self, py: Python<'_>, tolerance: f64) -> PyResult<PyMassProperties> {
        py.detach(|| self.0.mass_properties(tolerance)).map(PyMassProperties).map_err(refused)
    }

    #[pyo3(signature = (tolerance=1e-3))]
    fn mesh(&self, py: Python<'_>, tolerance: f64) -> PyResult<PyMesh> {
        py.detach(|| SurfaceMesh::of(&self.0, tolerance)).map(PyMesh).map_err(refused)
    }

    fn __repr__(&self) -> String {
        let planes = if self.0.is_in_plane() { "lines in the plane" } else { "planes" };
        let count = self.0.plane_count();
        format!("<Particle of {count} {planes}, r={:?}, k={:?}, R={:?}>", self.r(), self.k(), self.R())
    }

    fn __eq__(&self, other: &Self) -> bool {
        let numbers = |one: &Self| [one.r(), one.k(), one.R()];
        let is_alike = numbers(self) == numbers(other) && self.0.is_in_plane() == other.0.is_in_plane();
        is_alike && self.0.planes().eq(other.0.planes())
    }

    fn __hash__(&self) -> u64 {
        let bits =
            |hash: u64, number: f64| (hash.rotate_left(5) ^ number.to_bits()).wrapping_mul(0x517c_c1b7_2722_0a95);
        let planes = self.0.planes().flat_map(|plane| [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset]);
        planes.chain([self.r(), self.k(), self.R()]).map(|number| number + 0.0).fold(0, bits)
    }

    fn __reduce__<'py>(object: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let (py, own) = (object.py(), object.get());
        if own.0.is_in_plane() {
            return reduced(object.as_any(), &own.0)?.into_bound_py_any(py);
        }
        (object.get_type(), (own.planes(py), own.r(), own.k(), own.R())).into_bound_py_any(py)
    }

    #[staticmethod]
    fn _of_state(bytes: &[u8]) -> PyResult<Self> {
        state(bytes).map(Self)
    }
}

/// Volume, centroid and inertia of a particle of unit density, local frame.
#[pyclass(name = "MassProperties", module = "potential_particles", frozen)]
pub struct PyMassProperties(pub MassProperties);

#[pymethods]
impl PyMassProperties {
    #[getter]
    fn volume(&self) -> f64 {
        self.0.volume
    }

    #[getter]
    fn centroid<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, self.0.centroid.as_slice())
    }

    #[getter]
    fn inertia<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, (0..3).map(|i| [0, 1, 2].map(|j| self.0.inertia[(i, j)])))
    }

    #[getter]
    fn error(&self) -> f64 {
        self.0.error
    }

    fn __repr__(&self) -> String {
        format!("<MassProperties: volume {:?} to {:.1e}>", self.0.volume, self.0.error)
    }
}

pickled!(PyMassProperties: MassProperties);

/// A closed mesh of triangles inside a particle with its corners on the surface, local frame.
#[pyclass(name = "SurfaceMesh", module = "potential_particles", frozen)]
pub struct PyMesh(pub SurfaceMesh);

#[pymethods]
impl PyMesh {
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.vertices.iter().map(|&vertex| vertex.into()))
    }

    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.normals.iter().map(|&normal| normal.into()))
    }

    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        to_rows(py, self.0.triangles.iter().copied())
    }

    #[getter]
    fn error(&self) -> f64 {
        self.0.error
    }

    fn __repr__(&self) -> String {
        format!("<SurfaceMesh of {} triangles, {:.1e} from the surface>", self.0.triangles.len(), self.0.error)
    }
}

pickled!(PyMesh: SurfaceMesh);

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyParticle>()?;
    module.add_class::<PyMassProperties>()?;
    module.add_class::<PyMesh>()
}
