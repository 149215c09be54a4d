//! Contacts and poses as records of structured arrays: the numpy types `contact_type` and `pose_type`, laid out as the structs of the C interface.

use bytemuck::{Pod, Zeroable};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadwriteArray1};
use potential_particles::{BackEnd, Contact, Formulation, Kind};
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

/// A contact.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct ContactRecord {
    pub kind: i32,
    pub formulation: u32,
    pub back_end: u32,
    pub flags: u32,
    pub iterations: u32,
    pub reserved: u32,
    pub s: f64,
    pub s_b: f64,
    pub weight: f64,
    pub gap: f64,
    pub point_bound: f64,
    pub overlap: f64,
    pub normal: [f64; 3],
    pub point: [f64; 3],
    pub branch_a: [f64; 3],
    pub branch_b: [f64; 3],
    pub point_on_a: [f64; 3],
    pub point_on_b: [f64; 3],
    pub distance: f64,
}

/// Kinds of records: no answer, separated, overlapping.
pub const FAILED: i32 = 0;
pub const SEPARATED: i32 = 1;
pub const OVERLAPPING: i32 = 2;

impl ContactRecord {
    pub fn of(contact: &Contact) -> Self {
        Self {
            kind: match contact.kind {
                Kind::Separated => SEPARATED,
                Kind::Overlapping => OVERLAPPING,
            },
            formulation: (contact.formulation == Formulation::Closest).into(),
            back_end: (contact.back_end == BackEnd::ConeProgram).into(),
            flags: contact.flags.bits(),
            iterations: contact.iterations,
            reserved: 0,
            s: contact.s,
            s_b: contact.s_b,
            weight: contact.weight,
            gap: contact.gap,
            point_bound: contact.point_bound,
            overlap: contact.overlap,
            normal: contact.normal.into(),
            point: contact.point.into(),
            branch_a: contact.branch_a.into(),
            branch_b: contact.branch_b.into(),
            point_on_a: contact.point_on_a.into(),
            point_on_b: contact.point_on_b.into(),
            distance: contact.distance,
        }
    }

    /// Of a pair that has no answer.
    pub fn failed() -> Self {
        let (none, nan) = (f64::NAN, [f64::NAN; 3]);
        Self {
            kind: FAILED,
            s: none,
            s_b: none,
            weight: none,
            gap: none,
            point_bound: none,
            overlap: none,
            normal: nan,
            point: nan,
            branch_a: nan,
            branch_b: nan,
            point_on_a: nan,
            point_on_b: nan,
            distance: none,
            ..Self::zeroed()
        }
    }
}

/// Name, numpy's format and place of each field of a record.
macro_rules! fields {
    ($record:ty: $($name:ident $format:literal),+ $(,)?) => {
        &[$((stringify!($name), $format, offset_of!($record, $name))),+]
    };
}

type Field = (&'static str, &'static str, usize);

const OF_POSE: &[Field] = fields!(PoseRecord: position "3f8", orientation "4f8");

const OF_CONTACT: &[Field] = fields!(ContactRecord: kind "i4", formulation "u4", back_end "u4", flags "u4", iterations "u4", reserved "u4", s "f8",
    s_b "f8", weight "f8", gap "f8", point_bound "f8", overlap "f8", normal "3f8", point "3f8", branch_a "3f8", branch_b "3f8",
    point_on_a "3f8", point_on_b "3f8", distance "f8");

static POSE_TYPE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
static CONTACT_TYPE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();

fn record_type(py: Python<'_>, fields: &[Field], size: usize) -> PyResult<Py<PyAny>> {
    let layout = PyDict::new(py);
    layout.set_item("names", PyList::new(py, fields.iter().map(|field| field.0))?)?;
    layout.set_item("formats", PyList::new(py, fields.iter().map(|field| field.1))?)?;
    layout.set_item("offsets", PyList::new(py, fields.iter().map(|field| field.2))?)?;
    layout.set_item("itemsize", size)?;
    Ok(py.import("numpy")?.call_method1("dtype", (layout,))?.unbind())
}

pub fn pose_type(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    let made = POSE_TYPE.get_or_try_init(py, || record_type(py, OF_POSE, size_of::<PoseRecord>()))?;
    Ok(made.bind(py))
}

pub fn contact_type(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
    let made = CONTACT_TYPE.get_or_try_init(py, || record_type(py, OF_CONTACT, size_of::<ContactRecord>()))?;
    Ok(made.bind(py))
}

/// The bytes of a contiguous array of one dimension and this type, or for `width` doubles a record of an array (n, width) of doubles.
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
