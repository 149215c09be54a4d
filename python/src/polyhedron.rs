//! Sharp bodies, and shapes that are made of them and of round forms, with lengths for r and R.

use crate::arrays::{index_rows, rows, to_rows, to_vector, vector};
use crate::errors::refused;
use crate::particle::{PyMassProperties, PyParticle, planes};
use numpy::{PyArray1, PyArray2};
use potential_particles::nalgebra::Matrix3;
use potential_particles::shapes::{self, Rounding, Shape, SharpBody};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::OnceLock;

/// A particle about its centroid along its principal axes, and where that frame lies in the builder's.
#[pyclass(name = "BuiltShape", module = "potential_particles._core", frozen)]
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
}

/// The convex body {n.x <= h}, in the frame of the planes or points of which it is made.
#[pyclass(name = "Polyhedron", module = "potential_particles.polyhedron", frozen)]
pub struct PyPolyhedron {
    body: SharpBody,
    size: OnceLock<f64>,
}

impl PyPolyhedron {
    fn of(made: Result<SharpBody, shapes::ShapeError>) -> PyResult<Self> {
        Ok(Self { body: made.map_err(refused)?, size: OnceLock::new() })
    }
}

/// r, where it is given, else what a builder chooses, and R likewise, lengths.
fn lengths(r: Option<f64>, k: f64, shadow_radius: Option<f64>) -> Rounding {
    let rounding = r.map_or(Rounding::chosen(k), |r| Rounding::of_radius(r, k));
    shadow_radius.map_or(rounding, |length| rounding.with_shadow_radius(length))
}

/// Python's negative numbers would be an OverflowError.
fn count(value: i64, name: &str) -> PyResult<usize> {
    usize::try_from(value).map_err(|_| refused(format!("{name}={value} must not be negative")))
}

#[pymethods]
impl PyPolyhedron {
    /// {n_i.x <= h_i}, normals (n, 3) of any length, offsets (n,); planes that make no face of their own are left out.
    ///
    /// ValueError where that is empty or has no end.
    #[staticmethod]
    fn of_planes<'py>(normals: Bound<'py, PyAny>, offsets: Bound<'py, PyAny>) -> PyResult<Self> {
        let pair = PyTuple::new(normals.py(), [&normals, &offsets])?;
        Self::of(SharpBody::of_planes(&planes(pair.as_any())?))
    }

    /// The convex hull of points (n, 3); ValueError where it has no volume.
    ///
    /// Triangles that lie within 1e-6 of the extent of the plane of a larger one are one face with it, or within
    /// known, the length to which the points are known.
    #[staticmethod]
    #[pyo3(signature = (points, known=0.0))]
    fn of_points(points: &Bound<'_, PyAny>, known: f64) -> PyResult<Self> {
        Self::of(SharpBody::of_points(&rows::<3>(points, "points", "three numbers x, y, z")?, known))
    }

    /// What a closed convex surface encloses: points (n, 3), triangles (m, 3), numbers of points.
    ///
    /// ValueError that says where it is open, not convex or crosses itself.
    #[staticmethod]
    #[pyo3(signature = (points, triangles, known=0.0))]
    fn of_surface(points: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>, known: f64) -> PyResult<Self> {
        let points = rows::<3>(points, "points", "three numbers x, y, z")?;
        let triangles = index_rows::<3>(triangles, "triangles", "three indices of points")?;
        Self::of(SharpBody::of_surface(&points, &triangles, known))
    }

    /// A regular prism, frustum or pyramid along z from -height/2 to height/2; the first side faces x.
    ///
    /// radius, top_radius: of the circles within its ends.
    #[staticmethod]
    fn prism(sides: i64, radius: f64, top_radius: f64, height: f64) -> PyResult<Self> {
        Self::of(shapes::sharp_frustum(count(sides, "sides")?, radius, top_radius, height))
    }

    /// The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin.
    #[staticmethod]
    fn regular_solid(faces: i64, edge: f64) -> PyResult<Self> {
        Self::of(shapes::sharp_regular_solid(count(faces, "faces")?, edge))
    }

    /// Rows (n, 4) of a, b, c, h, unit normals: half-spaces in the order given, else the largest face first.
    #[getter]
    fn planes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let (planes, origin) = (&self.body.planes, &self.body.origin);
        to_rows(py, planes.iter().map(|p| [p.normal.x, p.normal.y, p.normal.z, p.offset + p.normal.dot(origin)]))
    }

    /// (n, 3), of unit length
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.body.planes.iter().map(|plane| plane.normal.into()))
    }

    /// (n,) h, length
    #[getter]
    fn offsets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let (planes, origin) = (&self.body.planes, &self.body.origin);
        to_vector(py, &planes.iter().map(|p| p.offset + p.normal.dot(origin)).collect::<Vec<_>>())
    }

    /// (m, 3)
    #[getter]
    fn corners<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.body.corners.iter().map(|corner| (corner + self.body.origin).into()))
    }

    /// (l, 3) numbers of corners, counter-clockwise from outside; those of a face may be several.
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        to_rows(py, self.body.triangles.iter().copied())
    }

    #[getter]
    fn volume(&self) -> f64 {
        self.body.volume
    }

    /// (3,) of the volume
    #[getter]
    fn centroid<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, (self.body.centroid + self.body.origin).as_slice())
    }

    /// (3, 3) about the centroid for density 1
    #[getter]
    fn inertia<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let inertia = self.body.inertia();
        to_rows(py, (0..3).map(|i| [0, 1, 2].map(|j| inertia[(i, j)])))
    }

    /// The diameter of the largest ball that fits inside.
    #[getter]
    fn size(&self) -> PyResult<f64> {
        if let Some(known) = self.size.get() {
            return Ok(*known);
        }
        let found = self.body.size().map_err(refused)?;
        Ok(*self.size.get_or_init(|| found))
    }

    /// The Shape whose faces are here, with rounding radius r (length), sphericity k and shadow radius R (length).
    ///
    /// R=None: to the farthest corner.
    #[pyo3(signature = (r, k, R=None))]
    #[allow(non_snake_case)]
    fn rounded(&self, py: Python<'_>, r: f64, k: f64, R: Option<f64>) -> PyResult<PyShape> {
        let rounding = lengths(Some(r), k, R);
        PyShape::of(py, py.detach(|| Shape::of_body(&self.body, &rounding, None)).map_err(refused)?)
    }

    /// The Shape of at most so many planes that comes nearest and has this volume; r=None: what comes nearest.
    ///
    /// tolerance: of its volume and inertia, relative.
    #[pyo3(signature = (planes, volume, r, k, R, tolerance))]
    #[allow(non_snake_case, clippy::too_many_arguments)]
    fn fitted(
        &self,
        py: Python<'_>,
        planes: i64,
        volume: f64,
        r: Option<f64>,
        k: f64,
        R: Option<f64>,
        tolerance: f64,
    ) -> PyResult<PyShape> {
        let (planes, rounding) = (count(planes, "planes")?, lengths(r, k, R));
        let made = py.detach(|| shapes::of_hull(&self.body, volume, planes, &rounding, Some(tolerance)));
        PyShape::of(py, made.map_err(refused)?)
    }
}

/// The Shape of the size of a "cylinder", "cone", "ellipsoid", "capsule" or "superquadric".
///
/// sizes: its lengths, and for the last its two exponents; planes, r, k and R: of those that are not exact, None for
/// what keeps the size.
#[pyfunction]
#[pyo3(signature = (form, sizes, planes=0, r=None, k=0.0, R=None))]
#[allow(non_snake_case)]
fn round_form(
    py: Python<'_>,
    form: &str,
    sizes: Vec<f64>,
    planes: i64,
    r: Option<f64>,
    k: f64,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let (planes, rounding) = (count(planes, "planes")?, lengths(r, k, R));
    let made = py.detach(|| match (form, &sizes[..]) {
        ("cylinder", &[radius, height]) => Some(shapes::cylinder(radius, height, planes, &rounding)),
        ("cone", &[radius, height]) => Some(shapes::cone(radius, height, planes, &rounding)),
        ("ellipsoid", &[a, b, c]) => Some(shapes::ellipsoid([a, b, c])),
        ("capsule", &[radius, length]) => Some(shapes::capsule(radius, length)),
        ("superquadric", &[a, b, c, n, e]) => Some(shapes::superquadric([a, b, c], [n, e], planes, &rounding)),
        _ => None,
    });
    let made = made.ok_or_else(|| refused(format!("there is no round form {form:?} of {} sizes", sizes.len())))?;
    PyShape::of(py, made.map_err(refused)?)
}

/// ValueError that says where, if an edge of a surface does not join two triangles.
#[pyfunction]
fn refuse_open(points: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> PyResult<()> {
    let points = rows::<3>(points, "points", "three numbers x, y, z")?;
    let triangles = index_rows::<3>(triangles, "triangles", "three indices of points")?;
    shapes::refuse_open(&points, &triangles).map_err(refused)
}

/// (w, x, y, z), w >= 0, from the principal axes of a symmetric matrix (3, 3) to its frame, each the axis nearest to
/// one of the frame.
#[pyfunction]
fn principal_orientation<'py>(inertia: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let flat = inertia.call_method0("ravel").and_then(|flat| vector::<9>(&flat, "inertia"))?;
    if !flat.iter().all(|number| number.is_finite()) {
        return Err(refused("inertia must be finite"));
    }
    Ok(to_vector(inertia.py(), &shapes::principal_orientation(&Matrix3::from_row_slice(&flat)).1))
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_shapes")?;
    module.add_class::<PyPolyhedron>()?;
    module.add_function(wrap_pyfunction!(round_form, &module)?)?;
    module.add_function(wrap_pyfunction!(refuse_open, &module)?)?;
    module.add_function(wrap_pyfunction!(principal_orientation, &module)?)?;
    parent.add_submodule(&module)
}
