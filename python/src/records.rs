//! Contacts and poses as records of structured arrays: the numpy types `contact_type` and `pose_type`, laid out as
//! the library has them.

use bytemuck::{NoUninit, Pod, Zeroable};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadwriteArray1};
use potential_particles::{Contact, Row};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList};
use std::mem::offset_of;

use crate::arrays::read;
use crate::errors::refused;

/// A place and a quaternion w, x, y, z.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct PoseRecord {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
}

/// Kinds of records: no answer, separated, overlapping.
pub const FAILED: i32 = 0;
pub const SEPARATED: i32 = 1;
pub const OVERLAPPING: i32 = 2;

/// Writes a contact as a record; of a pair without an answer, nothing that applies.
pub fn put(answer: Option<&Contact>, record: &mut [u8]) {
    if let Some(contact) = answer {
        return contact.put(record);
    }
    let mut none: Contact = Contact::UNKNOWN;
    none.distance = f64::NAN;
    none.put(record);
    record[offset_of!(Contact, kind)..][..4].copy_from_slice(&FAILED.to_ne_bytes());
}

const OF_POSE: &[Row] = &[
    ("position", "f8", 3, offset_of!(PoseRecord, position), ""),
    ("orientation", "f8", 4, offset_of!(PoseRecord, orientation), ""),
];

static POSE_TYPE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
static CONTACT_TYPE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();

fn record_type(py: Python<'_>, fields: &[Row], size: usize) -> PyResult<Py<PyAny>> {
    let layout = PyDict::new(py);
    layout.set_item("names", PyList::new(py, fields.iter().map(|field| field.0))?)?;
    let format = |&(_, format, count, ..): &Row| if count == 1 { format.into() } else { format!("{count}{format}") };
    layout.set_item("formats", PyList::new(py, fields.iter().map(format))?)?;
    layout.set_item("offsets", PyList::new(py, fields.iter().map(|field| field.3))?)?;
    layout.set_item("itemsize", size)?;
    Ok(py.import("numpy")?.call_method1("dtype", (layout,))?.unbind())
}

/// Records as an array (n,) of the type that these fields make.
pub fn structured<T: NoUninit>(py: Python<'_>, records: &[T], fields: &[Row]) -> PyResult<Py<PyAny>> {
    let kind = record_type(py, fields, size_of::<T>())?;
    let bytes = PyArray1::from_slice(py, bytemuck::cast_slice::<T, u8>(records));
    Ok(bytes.call_method1("view", (kind,))?.unbind())
}

pub fn pose_type(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    let made = POSE_TYPE.get_or_try_init(py, || record_type(py, OF_POSE, size_of::<PoseRecord>()))?;
    Ok(made.bind(py))
}

pub fn contact_type(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    let made = CONTACT_TYPE.get_or_try_init(py, || record_type(py, Contact::LAYOUT, size_of::<Contact>()))?;
    Ok(made.bind(py))
}

/// The bytes of a contiguous array of one dimension and this type, or for `width` doubles a record of an array (n,
/// width) of doubles.
fn bytes<'py>(
    array: &Bound<'py, PyAny>,
    kind: &Bound<'py, PyAny>,
    width: Option<usize>,
    name: &str,
    meaning: &str,
) -> PyResult<Bound<'py, PyArray1<u8>>> {
    let wrong = || refused(format!("{name} must be {meaning}, contiguous in memory"));
    let found = array.getattr("dtype").map_err(|_| wrong())?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let is_records = found.eq(kind)? && shape.len() == 1;
    let is_rows = width.is_some_and(|width| shape.len() == 2 && shape[1] == width) && found.eq("float64")?;
    let contiguous: bool = array.getattr("flags")?.getattr("c_contiguous")?.extract()?;
    if !(contiguous && (is_records || is_rows)) {
        return Err(wrong());
    }
    // Nothing is read or written, wherever that lies.
    if shape[0] == 0 {
        return Ok(PyArray1::zeros(array.py(), 0, false));
    }
    let flat = if is_rows { array.call_method1("reshape", (-1,))? } else { array.clone() };
    flat.call_method1("view", ("u1",))?.cast_into().map_err(|_| wrong())
}

/// Poses of an array, in place.
pub fn poses<'py>(array: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray1<'py, u8>> {
    let meaning = "an array of pose_type, or of doubles with rows x, y, z, w, x, y, z (position and quaternion)";
    read(&bytes(array, pose_type(array.py())?, Some(7), "poses", meaning)?, "poses")
}

/// Contacts of an array that can be written, in place.
pub fn contacts<'py>(array: &Bound<'py, PyAny>) -> PyResult<PyReadwriteArray1<'py, u8>> {
    let meaning = "an array of contact_type";
    let found = bytes(array, contact_type(array.py())?, None, "out", meaning)?;
    found.try_readwrite().map_err(|error| {
        let remedy = "give an array that can be written, and that no other argument or thread uses meanwhile";
        refused(format!("out: {error}; {remedy}"))
    })
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("pose_type", pose_type(py)?)?;
    module.add("contact_type", contact_type(py)?)?;
    module.add("FAILED", FAILED)?;
    module.add("SEPARATED", SEPARATED)?;
    module.add("OVERLAPPING", OVERLAPPING)
}
