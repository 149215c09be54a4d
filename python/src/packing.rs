//! Packings.

use crate::boundary::{PyTriangle, PyWall};
use crate::errors::refused;
use crate::particle::PyParticle;
use crate::pose::PyPose;
use potential_particles::packing::{Arrangement, Container, Obstacle, Packing, Placement, Sizes, Supply};
use potential_particles::{Particle, Pose};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use std::sync::{Arc, Mutex};

/// A body: index of its shape, scale, position, orientation (w, x, y, z) of its centroid and principal axes.
type Row = (usize, f64, [f64; 3], [f64; 4]);

fn row(body: &Placement) -> Row {
    (body.shape, body.scale, (*body.pose.position()).into(), body.pose.orientation())
}

/// Shapes and the sizes in which they are wanted, measured once. sizes: rows of a diameter and a share, [] for shapes
/// as they are; shares: "number", "mass" or "passing". margin: least distance, length.
#[pyclass(name = "Supply", module = "potential_particles._core._packing", frozen)]
struct PySupply(Supply);

#[pymethods]
impl PySupply {
    #[new]
    fn new(shapes: Vec<PyRef<'_, PyParticle>>, sizes: Vec<[f64; 2]>, shares: &str, margin: f64) -> PyResult<Self> {
        let shapes: Vec<Particle> = shapes.iter().map(|shape| shape.0.clone()).collect();
        let sizes = match shares {
            _ if sizes.is_empty() => Ok(Sizes::as_given()),
            "number" => Sizes::by_number(&sizes),
            "mass" => Sizes::by_mass(&sizes),
            "passing" => Sizes::passing(&sizes),
            other => return Err(refused(format!("shares={other:?} must be \"number\", \"mass\" or \"passing\""))),
        };
        Supply::new(&shapes, &sizes.map_err(refused)?, margin).map(Self).map_err(refused)
    }

    /// Index and scale of `count` bodies from number `first` on.
    fn sequence(&self, seed: u64, first: u64, count: usize) -> Vec<(usize, f64)> {
        self.0.sequence(seed, first).take(count).collect()
    }
}

/// What a function of Python raised where it could not be passed on at once.
type Raised = Arc<Mutex<Option<PyErr>>>;

fn raise(raised: &Raised, error: PyErr) {
    if let Ok(mut first) = raised.lock() {
        first.get_or_insert(error);
    }
}

/// kind: "box", "cylinder" (upright, in the box), "prism" with its corners (x, y) as outline, or "points" with a
/// function of a point as outline.
fn container(
    kind: &str,
    lower: [f64; 3],
    upper: [f64; 3],
    outline: &Bound<'_, PyAny>,
    raised: &Raised,
) -> PyResult<Container> {
    let made = match kind {
        "box" => Container::cuboid(lower, upper),
        "cylinder" => {
            let middle = |axis: usize| lower[axis] + 0.5 * (upper[axis] - lower[axis]);
            let radius = 0.5 * (upper[0] - lower[0]).min(upper[1] - lower[1]);
            Container::cylinder([middle(0), middle(1), lower[2]], radius, upper[2] - lower[2])
        }
        "prism" => Container::prism(&outline.extract::<Vec<[f64; 2]>>()?, lower[2], upper[2]),
        "points" => {
            let (inside, raised) = (outline.clone().unbind(), raised.clone());
            Container::of_points(lower, upper, move |point| {
                let [x, y, z] = point;
                let failed = raised.lock().map_or(true, |first| first.is_some());
                !failed
                    && Python::attach(|py| inside.call1(py, (x, y, z))?.is_truthy(py)).unwrap_or_else(|error| {
                        raise(&raised, error);
                        false
                    })
            })
        }
        other => {
            return Err(refused(format!("container={other:?} must be \"box\", \"cylinder\", \"prism\" or \"points\"")));
        }
    };
    made.map_err(refused)
}

/// A pair of Particle and Pose, a Triangle, a Wall, or a Wall with True if only the side of its normal is free.
fn obstacle(given: &Bound<'_, PyAny>) -> PyResult<Obstacle> {
    if let Ok(triangle) = given.extract::<PyRef<'_, PyTriangle>>() {
        return Ok(Obstacle::Triangle(triangle.triangle));
    }
    if let Ok(wall) = given.extract::<PyRef<'_, PyWall>>() {
        return Ok(Obstacle::Plane(wall.wall));
    }
    if let Ok((wall, one_sided)) = given.extract::<(PyRef<'_, PyWall>, bool)>() {
        return Ok(if one_sided { Obstacle::HalfSpace(wall.wall) } else { Obstacle::Plane(wall.wall) });
    }
    let (particle, pose) = body(given)?;
    Ok(Obstacle::Body(particle, pose))
}

fn body(given: &Bound<'_, PyAny>) -> PyResult<(Particle, Pose)> {
    match given.extract::<(PyRef<'_, PyParticle>, PyRef<'_, PyPose>)>() {
        Ok((particle, pose)) => Ok((particle.0.clone(), pose.0)),
        Err(_) => Err(PyTypeError::new_err("an obstacle is (Particle, Pose), a Triangle or a Wall")),
    }
}

fn obstacles(given: &[Bound<'_, PyAny>]) -> PyResult<Vec<Obstacle>> {
    given.iter().map(obstacle).collect()
}

/// Fills a container with bodies of random orientation that overlap neither each other nor obstacles.
///
/// arrangement: "settled", each as low as it gets; "scattered", anywhere, of a number of bodies the largest first; or
/// "in sequence", anywhere, up to the first that finds no place. number: None for as many as fit. first: number of the
/// first body. trials: poses tried for each, but settled ones. placed: a function that takes new bodies in turn, as
/// rows of index, scale, position and orientation, and returns whether to go on. ValueError for what cannot be packed.
#[pyfunction]
#[pyo3(signature = (supply, kind, lower, upper, outline, obstacles, placed, *, arrangement, number, first, trials, seed,
                    threads))]
#[allow(clippy::too_many_arguments)]
fn pack(
    py: Python<'_>,
    supply: PyRef<'_, PySupply>,
    kind: &str,
    lower: [f64; 3],
    upper: [f64; 3],
    outline: Bound<'_, PyAny>,
    obstacles: Vec<Bound<'_, PyAny>>,
    placed: Py<PyAny>,
    arrangement: &str,
    number: Option<usize>,
    first: u64,
    trials: usize,
    seed: u64,
    threads: usize,
) -> PyResult<()> {
    let raised = Raised::default();
    let container = container(kind, lower, upper, &outline, &raised)?;
    let obstacles = self::obstacles(&obstacles)?;
    let arrangement = match arrangement {
        "settled" => Arrangement::Settled,
        "scattered" => Arrangement::Scattered,
        "in sequence" => Arrangement::InSequence,
        other => return Err(refused(format!("arrangement={other:?} must be settled, scattered or in sequence"))),
    };
    let how = Packing { arrangement, number, first, trials, seed, threads };
    let mut handed_over = 0;
    let told = |all: &[Placement]| {
        let new: Vec<Row> = all[handed_over..].iter().map(row).collect();
        handed_over = all.len();
        let failed = raised.lock().map_or(true, |first| first.is_some());
        let answer = Python::attach(|py| placed.call1(py, (new,))?.is_truthy(py));
        !failed
            && answer.unwrap_or_else(|error| {
                raise(&raised, error);
                false
            })
    };
    let supply = &supply.0;
    let packed = py.detach(|| potential_particles::packing::pack(&container, supply, &obstacles, &how, told));
    match raised.lock().ok().and_then(|mut first| first.take()) {
        Some(error) => Err(error),
        None => packed.map(drop).map_err(refused),
    }
}

/// Of bodies, pairs of Particle and Pose, which ones overlap no obstacle.
#[pyfunction]
fn are_free(py: Python<'_>, bodies: Vec<Bound<'_, PyAny>>, obstacles: Vec<Bound<'_, PyAny>>) -> PyResult<Vec<bool>> {
    let bodies = bodies.iter().map(body).collect::<PyResult<Vec<_>>>()?;
    let obstacles = self::obstacles(&obstacles)?;
    Ok(py.detach(|| potential_particles::packing::are_free(&bodies, &obstacles)))
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_packing")?;
    module.add_class::<PySupply>()?;
    module.add_function(wrap_pyfunction!(pack, &module)?)?;
    module.add_function(wrap_pyfunction!(are_free, &module)?)?;
    parent.add_submodule(&module)
}
