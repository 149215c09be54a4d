//! Packings.

use crate::errors::refused;
use crate::particle::PyParticle;
use potential_particles::Particle;
use potential_particles::packing::{Arrangement, Container, Packing, Placement, Sizes};
use pyo3::prelude::*;

/// A body: index of its shape, scale, position, orientation (w, x, y, z) of its centroid and principal axes.
type Row = (usize, f64, [f64; 3], [f64; 4]);

fn row(body: &Placement) -> Row {
    (body.shape, body.scale, (*body.pose.position()).into(), body.pose.orientation())
}

/// Fills a box, or the upright cylinder in it, with bodies of random orientation that do not overlap.
///
/// container: "box" or "cylinder", lower and upper: of the box. sizes: rows of a diameter and a share, [] for shapes
/// as they are; shares: "number", "mass" or "passing". settled: each as low as it gets, else anywhere, the largest
/// first. number: None for as many as fit. margin: least distance, length. placed: a function that takes new bodies in
/// turn, as rows of index, scale, position and orientation, and returns whether to go on. ValueError for what cannot be
/// packed.
#[pyfunction]
#[pyo3(signature = (shapes, container, lower, upper, sizes, shares, placed, *, settled, number, margin, seed, threads))]
#[allow(clippy::too_many_arguments)]
fn pack(
    py: Python<'_>,
    shapes: Vec<PyRef<'_, PyParticle>>,
    container: &str,
    lower: [f64; 3],
    upper: [f64; 3],
    sizes: Vec<[f64; 2]>,
    shares: &str,
    placed: Py<PyAny>,
    settled: bool,
    number: Option<usize>,
    margin: f64,
    seed: u64,
    threads: usize,
) -> PyResult<()> {
    let particles: Vec<Particle> = shapes.iter().map(|shape| shape.0.clone()).collect();
    drop(shapes);
    let container = match container {
        "box" => Container::cuboid(lower, upper),
        "cylinder" => {
            let middle = |axis: usize| lower[axis] + 0.5 * (upper[axis] - lower[axis]);
            let radius = 0.5 * (upper[0] - lower[0]).min(upper[1] - lower[1]);
            Container::cylinder([middle(0), middle(1), lower[2]], radius, upper[2] - lower[2])
        }
        other => return Err(refused(format!("container={other:?} must be \"box\" or \"cylinder\""))),
    };
    let sizes = match shares {
        _ if sizes.is_empty() => Ok(Sizes::as_given()),
        "number" => Sizes::by_number(&sizes),
        "mass" => Sizes::by_mass(&sizes),
        "passing" => Sizes::passing(&sizes),
        other => return Err(refused(format!("shares={other:?} must be \"number\", \"mass\" or \"passing\""))),
    };
    let (container, sizes) = (container.map_err(refused)?, sizes.map_err(refused)?);
    let arrangement = if settled { Arrangement::Settled } else { Arrangement::Scattered };
    let how = Packing { arrangement, number, margin, seed, threads };
    let (mut handed_over, mut raised) = (0, None);
    let told = |all: &[Placement]| {
        let new: Vec<Row> = all[handed_over..].iter().map(row).collect();
        handed_over = all.len();
        let answer = Python::attach(|py| placed.call1(py, (new,))?.is_truthy(py));
        answer.unwrap_or_else(|error| {
            raised = Some(error);
            false
        })
    };
    let packed = py.detach(|| potential_particles::packing::pack(&container, &particles, &sizes, &how, told));
    match raised {
        Some(error) => Err(error),
        None => packed.map(drop).map_err(refused),
    }
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_packing")?;
    module.add_function(wrap_pyfunction!(pack, &module)?)?;
    parent.add_submodule(&module)
}
