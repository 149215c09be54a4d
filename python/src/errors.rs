//! The library's errors as exceptions, in its own sentences.

use potential_particles::DetectError;
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::fmt::Display;

pyo3::create_exception!(
    potential_particles,
    ContactError,
    PyRuntimeError,
    "No solver reached an answer: the contact is unknown, which does not mean separated. Of a batch, `failures` has the pairs that failed with \
     their reasons, and `contacts` all answers."
);

/// What was given is at fault.
pub fn refused(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Of a contact.
pub fn of_contact(error: DetectError) -> PyErr {
    match error {
        DetectError::Failed { .. } => ContactError::new_err(error.to_string()),
        DetectError::NoSuchBody { .. } => PyIndexError::new_err(error.to_string()),
        _ => refused(error),
    }
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("ContactError", module.py().get_type::<ContactError>())
}
