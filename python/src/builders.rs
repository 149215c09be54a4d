//! Builders of shapes.

use crate::arrays::{index_rows, rows, to_vector, vector};
use crate::errors::refused;
use crate::particle::{PyMassProperties, PyParticle, planes};
use crate::pickles::pickled;
use crate::pose::PyPose;
use numpy::PyArray1;
use potential_particles::shapes::{self, Rounding, Shape, ShapeError};
use pyo3::exceptions::PyFutureWarning;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::ffi::CStr;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// A particle about its centroid along its principal axes, and where that frame lies in the builder's.
#[pyclass(name = "Shape", module = "potential_particles.builders", frozen)]
pub struct PyShape {
    shape: Shape,
    particle: Py<PyParticle>,
}

impl PyShape {
    fn of(py: Python<'_>, shape: Shape) -> PyResult<Self> {
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
type Keywords = (f64, f64, Option<f64>, Option<f64>);

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
    let rounding = r.map_or_else(|| Rounding::new(share, k), |r| Rounding::of_radius(r, k));
    let rounding = shadow_radius.map_or(rounding, |length| rounding.with_shadow_radius(length));
    let shape = py.detach(|| make(&rounding)).map_err(refused)?;
    PyShape::of(py, shape)
}

/// Of half-spaces, rows (a, b, c, h) with a x + b y + c z <= h inside, or (normals, offsets): the faces of the particle
/// are where these planes are.
///
/// Planes that make no face are left out. rounding: r as a share of the size, the diameter of the largest ball that
/// fits in the sharp shape, or in its place r, a length; k: sphericity; R: a length. ValueError: no volume, or no point
/// inside.
#[pyfunction]
#[pyo3(signature = (planes, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn half_spaces(
    py: Python<'_>,
    planes: &Bound<'_, PyAny>,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let planes = self::planes(planes)?;
    built(py, (rounding, k, r, R), |rounding| shapes::half_spaces(&planes, rounding))
}

/// Of the convex hull of points (n, 3), rounded inwards: no part lies outside the hull.
///
/// Triangles that are coplanar to 1e-6 of the extent are one face. rounding: r as a share of the size, the diameter of
/// the largest ball that fits in the sharp shape, or in its place r, a length; k: sphericity; R: a length. ValueError:
/// flat points.
#[pyfunction]
#[pyo3(signature = (points, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn hull(
    py: Python<'_>,
    points: &Bound<'_, PyAny>,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let points = rows::<3>(points, "points", "three numbers x, y, z")?;
    built(py, (rounding, k, r, R), |rounding| shapes::hull(&points, rounding))
}

/// Of a closed convex surface: points (n, 3) and triangles (m, 3), numbers of points.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, or in its place r, a length; k: sphericity; R: a length. ValueError: a surface that is open,
/// not convex or crosses itself; hull makes its convex hull.
#[pyfunction]
#[pyo3(signature = (points, triangles, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn surface(
    py: Python<'_>,
    points: &Bound<'_, PyAny>,
    triangles: &Bound<'_, PyAny>,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    let points = rows::<3>(points, "points", "three numbers x, y, z")?;
    let triangles = index_rows::<3>(triangles, "triangles", "three indices of points")?;
    built(py, (rounding, k, r, R), |rounding| shapes::surface(&points, &triangles, rounding))
}

/// Of a closed convex surface in a file, .stl (binary or text) or .obj, all lengths multiplied by scale.
///
/// hull=True takes the convex hull of its points. rounding: r as a share of the size, the diameter of the largest ball
/// that fits in the sharp shape, or in its place r, a length; k: sphericity; R: a length. ValueError: as of surface,
/// and files that cannot be read.
#[pyfunction]
#[pyo3(signature = (file, *, hull=false, scale=1.0, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn mesh(
    py: Python<'_>,
    file: PathBuf,
    hull: bool,
    scale: f64,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(refused(format!("scale={scale:?} must be finite and above 0")));
    }
    let name = file.display();
    let (points, triangles) = read(&file).map_err(|reason| refused(format!("{name}: {reason}")))?;
    if triangles.is_empty() {
        return Err(refused(format!("{name} holds no triangles: it is empty, or not what its ending says")));
    }
    let points: Vec<[f64; 3]> = points.into_iter().map(|point| point.map(|c| scale * c)).collect();
    if !points.iter().flatten().all(|c| c.is_finite()) {
        return Err(refused(format!("{name}: times scale={scale:?} its points are not finite")));
    }
    let known = known_to(&points, scale);
    built(py, (rounding, k, r, R), |rounding| {
        shapes::known_hull(&points, Some(&triangles[..]).filter(|_| !hull), known, rounding)
    })
    .map_err(|error| refused(format!("{name}: {}", error.value(py))))
}

/// How far from its plane four corners may put a face, over the largest coordinate, if each is off by half a unit of
/// the seventh digit, or of the last digit of single precision, as which files are read.
const OF_SEVEN_DIGITS: f64 = 4e-6;
const OF_SINGLE: f64 = 5e-7;

/// The length to which points of a file, times a scale, are known, by their digits.
fn known_to(points: &[[f64; 3]], scale: f64) -> f64 {
    let digits =
        |c: f64| format!("{:e}", c as f32).bytes().take_while(|b| *b != b'e').filter(u8::is_ascii_digit).count();
    let is_short = points.iter().take(1000).flatten().all(|c| digits(c / scale) <= 7);
    let largest = points.iter().flatten().fold(0.0_f64, |most, c| most.max(c.abs()));
    largest * if is_short { OF_SEVEN_DIGITS } else { OF_SINGLE }
}

type Surface = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Points, of which equal ones are one, and triangles without those that have lost a corner by that.
fn read(file: &Path) -> Result<Surface, String> {
    let bytes = fs::read(file).map_err(|error| error.to_string())?;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err("it is text in UTF-16: save it as UTF-8".into());
    }
    // Without the mark of UTF-8.
    let opened = || Cursor::new(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes));
    let ending = file.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
    let (points, triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>) = match ending.as_str() {
        "stl" => {
            let found =
                stl_io::read_stl(&mut opened()).map_err(|error| format!("it cannot be read as .stl: {error}"))?;
            let points = found.vertices.iter().map(|vertex| [0, 1, 2].map(|i| f64::from(vertex[i]))).collect();
            (points, found.faces.iter().map(|face| face.vertices.map(|i| i as u32)).collect())
        }
        "obj" => {
            let options =
                tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..Default::default() };
            let none = |_: &Path| Ok(Default::default());
            let (models, _) = tobj::load_obj_buf(&mut opened(), &options, none)
                .map_err(|error| format!("it cannot be read as .obj: {error}"))?;
            let (mut points, mut triangles) = (Vec::new(), Vec::new());
            for model in models {
                let first = points.len() as u32;
                points.extend(model.mesh.positions.chunks_exact(3).map(|p| [p[0], p[1], p[2]].map(f64::from)));
                triangles.extend(model.mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|i| first + i)));
            }
            (points, triangles)
        }
        _ => return Err("files that can be read are .stl (binary or text) and .obj".into()),
    };
    let mut places = HashMap::new();
    let mut once = Vec::new();
    // Adding 0 makes one zero of both.
    let place: Vec<u32> = points
        .iter()
        .map(|point| {
            *places.entry(point.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
                once.push(*point);
                once.len() as u32 - 1
            })
        })
        .collect();
    let place = |i: u32| place.get(i as usize).copied().unwrap_or(u32::MAX);
    let triangles =
        triangles.into_iter().map(|t| t.map(place)).filter(|[a, b, c]| a != b && b != c && c != a).collect();
    Ok((once, triangles))
}

/// A sphere about the origin: k = 1.
#[pyfunction]
fn sphere(py: Python<'_>, radius: f64) -> PyResult<PyShape> {
    built(py, (0.0, 1.0, None, None), |_| shapes::sphere(radius))
}

/// A cuboid about the origin with these edges along x, y, z, length.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (edges, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn cuboid(
    py: Python<'_>,
    edges: &Bound<'_, PyAny>,
    rounding: f64,
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
/// the largest ball that fits in the sharp shape, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (sides=6, radius=0.5, height=1.0, top_radius=None, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn prism(
    py: Python<'_>,
    sides: usize,
    radius: f64,
    height: f64,
    top_radius: Option<f64>,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    built(py, (rounding, k, r, R), |rounding| {
        shapes::frustum(sides, radius, top_radius.unwrap_or(radius), height, rounding)
    })
}

/// A cylinder along z as a prism of as many sides, whose section has the area pi radius^2.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (radius=0.5, height=1.0, sides=32, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case, clippy::too_many_arguments)]
fn cylinder(
    py: Python<'_>,
    radius: f64,
    height: f64,
    sides: usize,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    built(py, (rounding, k, r, R), |rounding| shapes::cylinder(radius, height, sides, rounding))
}

/// The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin.
///
/// rounding: r as a share of the size, the diameter of the largest ball that fits in the
/// sharp shape, or in its place r, a length; k: sphericity; R: a length.
#[pyfunction]
#[pyo3(signature = (faces, edge=1.0, *, rounding=0.05, k=0.02, r=None, R=None))]
#[allow(non_snake_case)]
fn regular_solid(
    py: Python<'_>,
    faces: usize,
    edge: f64,
    rounding: f64,
    k: f64,
    r: Option<f64>,
    R: Option<f64>,
) -> PyResult<PyShape> {
    built(py, (rounding, k, r, R), |rounding| shapes::regular_solid(faces, edge, rounding))
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_builders")?;
    module.add_class::<PyShape>()?;
    module.add_function(wrap_pyfunction!(half_spaces, &module)?)?;
    module.add_function(wrap_pyfunction!(hull, &module)?)?;
    module.add_function(wrap_pyfunction!(surface, &module)?)?;
    module.add_function(wrap_pyfunction!(mesh, &module)?)?;
    module.add_function(wrap_pyfunction!(sphere, &module)?)?;
    module.add_function(wrap_pyfunction!(cuboid, &module)?)?;
    module.add_function(wrap_pyfunction!(prism, &module)?)?;
    module.add_function(wrap_pyfunction!(cylinder, &module)?)?;
    module.add_function(wrap_pyfunction!(regular_solid, &module)?)?;
    parent.add_submodule(&module)
}
