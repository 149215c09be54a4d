//! Python module `potential_particles._core`: the library with numpy arrays in and out.
//!
//! Each file makes Python classes or functions of one part of the library, and only those above it are used:
//!
//! | file | holds |
//! |---|---|
//! | `errors` | the library's errors as exceptions, in its own sentences |
//! | `arrays` | numbers and rows from Python, vectors and matrices to it |
//! | `records` | contacts and poses as records of structured arrays |
//! | `pickles` | pickles and copies of answers |
//! | `settings` | `Settings` |
//! | `particle` | `Particle`, `MassProperties`, `SurfaceMesh` |
//! | `pose` | `Pose` |
//! | `contact` | `detect` and its like for one pair |
//! | `boundary` | planes and triangles |
//! | `patch` | contact patches |
//! | `derivative` | derivatives of contacts and patches |
//! | `batch` | the pairs of a step |
//! | `polyhedron` | sharp bodies, and shapes of them by lengths |
//! | `packing` | packings |
//! | `slicing` | rock masses |
//! | `equilibrium` | whether a scene of blocks stands |

mod arrays;
mod batch;
mod boundary;
mod contact;
mod derivative;
mod equilibrium;
mod errors;
mod packing;
mod particle;
mod patch;
mod pickles;
mod polyhedron;
mod pose;
mod records;
mod settings;
mod slicing;

use pyo3::prelude::*;

#[pymodule(gil_used = true)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    errors::add(module)?;
    pickles::add(module)?;
    records::add(module)?;
    settings::add(module)?;
    particle::add(module)?;
    pose::add(module)?;
    contact::add(module)?;
    boundary::add(module)?;
    patch::add(module)?;
    derivative::add(module)?;
    batch::add(module)?;
    polyhedron::add(module)?;
    packing::add(module)?;
    slicing::add(module)?;
    equilibrium::add(module)
}
