//! Numbers and rows from Python, vectors and matrices to it.

use crate::errors::refused;
use bytemuck::{AnyBitPattern, NoUninit};
use numpy::ndarray::Array2;
use numpy::ndarray::Dimension;
use numpy::{
    Element, PyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray, PyReadonlyArray2, PyUntypedArrayMethods,
    ToPyArray,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What numpy makes of any rows of numbers: an array of doubles (n, W), as rows.
pub fn rows<const W: usize>(values: &Bound<'_, PyAny>, name: &str, meaning: &str) -> PyResult<Vec<[f64; W]>> {
    let array: PyReadonlyArray2<'_, f64> = two_dimensional(values, "float64", W, name, meaning)?;
    Ok(array.as_slice()?.chunks_exact(W).map(|row| std::array::from_fn(|i| row[i])).collect())
}

/// The same of indices.
pub fn index_rows<const W: usize>(values: &Bound<'_, PyAny>, name: &str, meaning: &str) -> PyResult<Vec<[u32; W]>> {
    let array: PyReadonlyArray2<'_, u32> = two_dimensional(values, "uint32", W, name, meaning)?;
    Ok(array.as_slice()?.chunks_exact(W).map(|row| std::array::from_fn(|i| row[i])).collect())
}

fn two_dimensional<'py, T: Element>(
    values: &Bound<'py, PyAny>,
    kind: &str,
    width: usize,
    name: &str,
    meaning: &str,
) -> PyResult<PyReadonlyArray2<'py, T>> {
    let py = values.py();
    let numpy = py.import("numpy")?;
    let wrong = |reason: String| refused(format!("{name} must be rows of {meaning}: {reason}"));
    let found =
        numpy.call_method1("ascontiguousarray", (values,)).map_err(|error| wrong(error.value(py).to_string()))?;
    // Of a part of a buffer it may begin anywhere.
    let is_aligned: bool = found.getattr("flags")?.getattr("aligned")?.extract()?;
    let found = if is_aligned { found } else { found.call_method0("copy")? };
    let options = PyDict::new(py);
    options.set_item("casting", "same_kind")?;
    options.set_item("copy", false)?;
    // Whole numbers of any kind will do for indices and for doubles; an empty list is of doubles.
    let size: usize = found.getattr("size")?.extract()?;
    let is_whole = ["i", "u"].contains(&found.getattr("dtype")?.getattr("kind")?.extract::<String>()?.as_str());
    if size > 0 && is_whole && kind == "uint32" {
        // numpy drops the upper digits of what is beyond 32 bits.
        let (least, largest) = (found.call_method0("min")?, found.call_method0("max")?);
        if let Some(index) =
            [least.lt(0)?.then_some(least), largest.gt(u32::MAX)?.then_some(largest)].into_iter().flatten().next()
        {
            return Err(wrong(format!("{index} is no index: they lie between 0 and {}", u32::MAX)));
        }
    }
    if size == 0 || (is_whole && kind == "uint32") {
        options.set_item("casting", "unsafe")?;
    }
    let found =
        found.call_method("astype", (kind,), Some(&options)).map_err(|error| wrong(error.value(py).to_string()))?;
    let found = if size == 0 { found.call_method1("reshape", ((0, width),))? } else { found };
    let array = found.cast_into::<PyArray2<T>>().map_err(|_| wrong("the array is not two-dimensional".into()))?;
    if array.shape()[1] != width {
        return Err(wrong(format!("the array has {} columns", array.shape()[1])));
    }
    read(&array, name)
}

/// An array to read from; not one that a call of another thread writes meanwhile.
pub fn read<'py, T: Element, D: Dimension>(
    array: &Bound<'py, PyArray<T, D>>,
    name: &str,
) -> PyResult<PyReadonlyArray<'py, T, D>> {
    array
        .try_readonly()
        .map_err(|_| refused(format!("{name} is written as out of another call: give each thread arrays of its own")))
}

/// The elements of an array as rows or records that lie in its memory. Of none, the place in memory does not matter: it
/// may be any.
pub fn in_place<'a, A: NoUninit, B: AnyBitPattern>(elements: &'a [A], name: &str) -> PyResult<&'a [B]> {
    if elements.is_empty() {
        return Ok(&[]);
    }
    bytemuck::try_cast_slice(elements).map_err(|_| misplaced(name))
}

/// The same, to write.
pub fn in_place_mut<'a, A: NoUninit + AnyBitPattern, B: NoUninit + AnyBitPattern>(
    elements: &'a mut [A],
    name: &str,
) -> PyResult<&'a mut [B]> {
    if elements.is_empty() {
        return Ok(&mut []);
    }
    bytemuck::try_cast_slice_mut(elements).map_err(|_| misplaced(name))
}

/// Numpy makes such arrays of parts of buffers.
fn misplaced(name: &str) -> PyErr {
    refused(format!("{name} does not begin at a multiple of 8 bytes in memory: give a copy of it, {name}.copy()"))
}

/// So many numbers.
pub fn vector<const N: usize>(values: &Bound<'_, PyAny>, name: &str) -> PyResult<[f64; N]> {
    values.extract::<[f64; N]>().map_err(|_| refused(format!("{name} must be {N} numbers")))
}

/// As an array (n,).
pub fn to_vector<'py>(py: Python<'py>, values: &[f64]) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, values)
}

/// Rows as an array (n, W).
pub fn to_rows<'py, T: Element + Copy, const W: usize>(
    py: Python<'py>,
    rows: impl ExactSizeIterator<Item = [T; W]>,
) -> Bound<'py, PyArray2<T>> {
    let count = rows.len();
    let values: Vec<T> = rows.flatten().collect();
    let array = Array2::from_shape_vec((count, W), values).expect("so many rows of this width");
    array.to_pyarray(py)
}
