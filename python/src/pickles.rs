//! Pickles and copies of what has no constructor, or none that gives it back to the bit: as bytes of what it holds.

use crate::errors::refused;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};
use serde::{Serialize, de::DeserializeOwned};

/// What `__reduce__` returns: a function, and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>, &'static str, Bound<'py, PyBytes>));

/// Of another version the bytes may mean something else.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Of an object with this state.
pub fn reduced<'py>(object: &Bound<'py, PyAny>, state: &impl Serialize) -> PyResult<Reduced<'py>> {
    let py = object.py();
    let bytes = postcard::to_stdvec(state).map_err(refused)?;
    let make = py.import("potential_particles._core")?.getattr("_unpickled")?;
    Ok((make, (object.get_type(), VERSION, PyBytes::new(py, &bytes))))
}

/// The state of these bytes.
pub fn state<T: DeserializeOwned>(bytes: &[u8]) -> PyResult<T> {
    postcard::from_bytes(bytes).map_err(|error| refused(format!("these bytes are no pickle: {error}")))
}

/// Pickles of a class: its state, and the object of a state.
macro_rules! pickled {
    ($class:ident: $state:ty, |$object:ident| $to:expr, |$py:ident, $found:pat_param| $from:expr) => {
        #[pymethods]
        impl $class {
            fn __reduce__<'py>(object: &Bound<'py, Self>) -> PyResult<$crate::pickles::Reduced<'py>> {
                let $object = object.borrow();
                $crate::pickles::reduced(object.as_any(), &$to)
            }

            #[staticmethod]
            fn _of_state($py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
                let $found: $state = $crate::pickles::state(bytes)?;
                let _ = $py;
                Ok($from)
            }
        }
    };
    // Of a class that holds one thing alone.
    ($class:ident: $state:ty) => {
        $crate::pickles::pickled!($class: $state, |object| object.0, |_py, found| Self(found));
    };
}
pub(crate) use pickled;

/// An object of a class from the bytes of its pickle.
#[pyfunction]
fn _unpickled<'py>(
    class: &Bound<'py, PyType>,
    version: &str,
    state: &Bound<'py, PyBytes>,
) -> PyResult<Bound<'py, PyAny>> {
    if version != VERSION {
        return Err(refused(format!(
            "a pickle of potential_particles {version}: this is {VERSION}, and reads its own"
        )));
    }
    class.call_method1("_of_state", (state,))
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(_unpickled, module)?)
}
