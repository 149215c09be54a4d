//! The pairs of a step, from and into numpy arrays, with the states of pairs that come and go.

use crate::arrays::{in_place, in_place_mut, read, to_rows};
use crate::errors::{ContactError, of_contact, refused};
use crate::particle::PyParticle;
use crate::records::{self, PoseRecord, contact_type};
use crate::settings::{PySettings, or_default};
use bytemuck::{Pod, Zeroable};
use numpy::{PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use potential_particles::{Contact, DetectError, PairState, Particle, Pose, Settings, detect_batch_into};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The contacts of a scene, step after step: the particles of its bodies, and what each pair keeps from call to call.
///
/// The list of pairs may change: a pair keeps what it had as long as it is in the list. settings, threads: as of
/// detect_batch. remember=False keeps nothing. Threads of Python that share a Batch wait for each other, as each call
/// starts from the solutions of the last one: one Batch for each thread, or remember=False, lets them run side by side.
#[pyclass(name = "Batch", module = "potential_particles", frozen)]
pub struct PyBatch {
    particles: Vec<Py<PyParticle>>,
    settings: Settings,
    threads: usize,
    /// `None` with remember=False.
    memory: Option<Mutex<Memory>>,
}

/// A contact in the array of the caller.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Record([u64; size_of::<Contact>() / 8]);

/// Pairs of the last call, and the state of each.
#[derive(Default)]
struct Memory {
    pairs: Vec<[u32; 2]>,
    states: Vec<PairState>,
}

#[pymethods]
impl PyBatch {
    #[new]
    #[pyo3(signature = (particles, settings=None, *, threads=1, remember=true))]
    fn new(particles: Vec<Py<PyParticle>>, settings: Option<&PySettings>, threads: usize, remember: bool) -> Self {
        Self { particles, settings: or_default(settings), threads, memory: remember.then(Mutex::default) }
    }

    /// Contacts of pairs (m, 2) of bodies at their poses, as detect_batch gives them, each from the last solution of
    /// its pair.
    ///
    /// Arrays, out and errors as of detect_batch.
    #[pyo3(signature = (poses, pairs, out=None))]
    fn detect<'py>(
        &self,
        poses: &Bound<'py, PyAny>,
        pairs: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = poses.py();
        let pairs = pair_rows(pairs)?;
        let pairs: &[[u32; 2]] = in_place(pairs.as_slice()?, "pairs")?;
        let poses = records::poses(poses)?;
        let poses: &[PoseRecord] = in_place(poses.as_slice()?, "poses")?;
        if poses.len() != self.particles.len() {
            let (given, needed) = (poses.len(), self.particles.len());
            return Err(refused(format!("{given} poses given where {needed} are needed: one for each body")));
        }
        let out = match out {
            Some(out) => out.clone(),
            None => py.import("numpy")?.call_method1("empty", (pairs.len(), contact_type(py)?))?,
        };
        let mut bytes = records::contacts(&out)?;
        let contacts: &mut [Record] = in_place_mut(bytes.as_slice_mut()?, "out")?;
        if contacts.len() != pairs.len() {
            let (given, needed) = (contacts.len(), pairs.len());
            return Err(refused(format!("out has {given} records where {needed} are needed: one for each pair")));
        }
        // Nothing of Python runs while the memory is locked: it could ask for the same memory.
        let failures = match self.memory(py) {
            None => py.detach(|| self.solve(poses, pairs, &mut [], contacts)),
            Some(mut memory) => {
                let memory = &mut *memory;
                py.detach(|| {
                    memory.follow(pairs);
                    self.solve(poses, pairs, &mut memory.states, contacts)
                })
            }
        }?;
        drop(bytes);
        if failures.is_empty() { Ok(out) } else { Err(raised(&failures, pairs.len(), out)?) }
    }

    /// Pairs of the last call, as (m, 2).
    #[getter]
    fn pairs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        let pairs = self.memory(py).map(|memory| memory.pairs.clone()).unwrap_or_default();
        to_rows(py, pairs.into_iter())
    }

    /// What the pairs of the last call remember, as rows of eight numbers.
    #[getter]
    fn solutions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let states = self.memory(py).map(|memory| memory.states.clone()).unwrap_or_default();
        to_rows(py, states.iter().map(|state| state.into_raw()))
    }

    /// Forgets all pairs.
    fn forget(&self, py: Python<'_>) {
        if let Some(mut memory) = self.memory(py) {
            *memory = Memory::default();
        }
    }

    fn __len__(&self) -> usize {
        self.particles.len()
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let remembered = self.memory(py).map_or(0, |memory| memory.pairs.len());
        format!("<Batch of {} bodies, {remembered} pairs remembered>", self.particles.len())
    }
}

/// Pairs that have no answer, by number, with their reasons.
type Failures = Vec<(usize, DetectError)>;

impl PyBatch {
    /// The memory, once no other thread has it; the GIL is released meanwhile.
    fn memory(&self, py: Python<'_>) -> Option<MutexGuard<'_, Memory>> {
        let memory = self.memory.as_ref()?;
        Some(memory.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner))
    }

    /// Writes the contact of each pair.
    fn solve(
        &self,
        poses: &[PoseRecord],
        pairs: &[[u32; 2]],
        states: &mut [PairState],
        contacts: &mut [Record],
    ) -> PyResult<Failures> {
        let failures: Mutex<Failures> = Mutex::default();
        let write = |number: usize, Record(place): &mut Record, answer: Result<&Contact, DetectError>| {
            records::put(answer.as_ref().ok().copied(), bytemuck::bytes_of_mut(place));
            if let Err(error) = answer {
                failures.lock().unwrap_or_else(PoisonError::into_inner).push((number, error));
            }
        };
        let pose = |(body, record): (usize, &PoseRecord)| {
            Pose::new(record.position, record.orientation).map_err(|error| refused(format!("body {body}: {error}")))
        };
        let poses = poses.iter().enumerate().map(pose).collect::<PyResult<Vec<Pose>>>()?;
        let particles: Vec<&Particle> = self.particles.iter().map(|particle| &particle.get().0).collect();
        detect_batch_into(&particles, &poses, pairs, &self.settings, self.threads, states, contacts, write)
            .map_err(of_contact)?;
        let mut failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
        failures.sort_by_key(|failure| failure.0);
        Ok(failures)
    }
}

impl Memory {
    /// Each pair of the new list keeps the state that it had; of a pair that stands there twice, the first one does.
    fn follow(&mut self, pairs: &[[u32; 2]]) {
        if self.pairs == pairs {
            return;
        }
        let mut places: HashMap<[u32; 2], usize> =
            self.pairs.iter().enumerate().rev().map(|(place, pair)| (*pair, place)).collect();
        let state = |pair: &[u32; 2]| places.remove(pair).map(|place| self.states[place]).unwrap_or_default();
        let states = pairs.iter().map(state).collect();
        self.states = states;
        self.pairs = pairs.to_vec();
    }
}

/// Pairs as they are, if they are whole numbers of 32 bits in memory one after the other, else as numpy makes them so.
fn pair_rows<'py>(pairs: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray2<'py, u32>> {
    let in_place =
        |array: &&Bound<'py, PyArray2<u32>>| array.shape()[1] == 2 && array.is_c_contiguous() && !array.is_empty();
    if let Some(array) = pairs.cast::<PyArray2<u32>>().ok().filter(in_place) {
        let array = read(array, "pairs")?;
        // Of a part of a buffer it may begin anywhere.
        if array.as_slice().is_ok() {
            return Ok(array);
        }
    }
    let rows = crate::arrays::index_rows::<2>(pairs, "pairs", "two indices of bodies")?;
    read(&to_rows(pairs.py(), rows.into_iter()), "pairs")
}

/// Contacts of pairs (m, 2) of bodies, as an array (m,) of contact_type; body i is particles[i] at poses[i]. Without
/// memories: a Batch has those.
///
/// poses: an array of pose_type, or of doubles with rows x, y, z, w, x, y, z, read in place. pairs: first A, then B,
/// counted from 0; those of uint32 are read in place. threads: how many work on it, with the GIL released; no answer
/// depends on it. out: where the contacts are written. ContactError (IndexError where bodies do not exist): pairs
/// without an answer, whose kind is FAILED; `failures` lists them with their reasons, and `contacts` has all answers.
#[pyfunction]
#[pyo3(signature = (particles, poses, pairs, settings=None, *, threads=1, out=None))]
fn detect_batch<'py>(
    particles: Vec<Py<PyParticle>>,
    poses: &Bound<'py, PyAny>,
    pairs: &Bound<'py, PyAny>,
    settings: Option<&PySettings>,
    threads: usize,
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    PyBatch::new(particles, settings, threads, false).detect(poses, pairs, out)
}

/// The exception that tells of pairs without an answer, with all contacts.
fn raised(failures: &[(usize, DetectError)], pairs: usize, contacts: Bound<'_, PyAny>) -> PyResult<PyErr> {
    let (py, count, (pair, error)) = (contacts.py(), failures.len(), &failures[0]);
    let text = format!("{count} of {pairs} pairs have no answer; the first is pair {pair}: {error}");
    let is_missing = failures.iter().all(|(_, error)| matches!(error, DetectError::NoSuchBody { .. }));
    let raised = if is_missing { PyIndexError::new_err(text) } else { ContactError::new_err(text) };
    let reasons: Vec<(usize, String)> = failures.iter().map(|(pair, error)| (*pair, error.to_string())).collect();
    raised.value(py).setattr("failures", reasons)?;
    raised.value(py).setattr("contacts", contacts)?;
    Ok(raised)
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyBatch>()?;
    module.add_function(wrap_pyfunction!(detect_batch, module)?)
}
