//! The pairs of a step, from and into numpy arrays, with the states of pairs that come and go.

use crate::arrays::to_rows;
use crate::errors::{ContactError, of_contact, refused};
use crate::particle::PyParticle;
use crate::records::{self, ContactRecord, PoseRecord, contact_type};
use crate::settings::{PySettings, or_default};
use numpy::{PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use potential_particles::{Contact, DetectError, PairState, Particle, Pose, Settings, detect_batch_into};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// The contacts of a scene, step after step: the particles of its bodies, and what each pair keeps from call to call.
///
/// The list of pairs may change: a pair keeps what it had as long as it is in the list. settings, threads: as of detect_batch.
/// remember=False keeps nothing.
#[pyclass(name = "Batch", module = "potential_particles")]
pub struct PyBatch {
    particles: Vec<Py<PyParticle>>,
    settings: Settings,
    threads: usize,
    remembers: bool,
    /// Of the last call, and the state of each.
    pairs: Vec<[u32; 2]>,
    states: Vec<PairState>,
}

#[pymethods]
impl PyBatch {
    #[new]
    #[pyo3(signature = (particles, settings=None, *, threads=1, remember=true))]
    fn new(particles: Vec<Py<PyParticle>>, settings: Option<&PySettings>, threads: usize, remember: bool) -> Self {
        let settings = or_default(settings);
        Self { particles, settings, threads, remembers: remember, pairs: Vec::new(), states: Vec::new() }
    }

    /// Contacts of pairs (m, 2) of bodies at their poses, as detect_batch gives them, each from the last solution of its pair.
    ///
    /// Arrays, out and errors as of detect_batch.
    #[pyo3(signature = (poses, pairs, out=None))]
    fn detect<'py>(
        &mut self,
        poses: &Bound<'py, PyAny>,
        pairs: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = poses.py();
        let given = pair_rows(pairs)?;
        let given = bytemuck::try_cast_slice::<u32, [u32; 2]>(given.as_slice()?).map_err(refused)?;
        if self.remembers && self.pairs != given {
            py.detach(|| self.follow(given));
        }
        let particles: Vec<&Particle> = self.particles.iter().map(|particle| &particle.get().0).collect();
        let states = if self.remembers { &mut self.states[..] } else { &mut [] };
        contacts_of(&particles, poses, given, (&self.settings, self.threads), states, out)
    }

    /// Pairs of the last call, as (m, 2).
    #[getter]
    fn pairs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        to_rows(py, self.pairs.iter().copied())
    }

    /// What the pairs of the last call remember, as rows of eight numbers.
    #[getter]
    fn solutions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.states.iter().map(|state| state.into_raw()))
    }

    /// Forgets all pairs.
    fn forget(&mut self) {
        self.pairs.clear();
        self.states.clear();
    }

    fn __len__(&self) -> usize {
        self.particles.len()
    }

    fn __repr__(&self) -> String {
        format!("<Batch of {} bodies, {} pairs remembered>", self.particles.len(), self.pairs.len())
    }
}

impl PyBatch {
    /// Each pair of the new list keeps the state that it had; of a pair that stands there twice, the first one does.
    fn follow(&mut self, pairs: &[[u32; 2]]) {
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
    if let Ok(array) = pairs.cast::<PyArray2<u32>>()
        && array.shape()[1] == 2
        && array.is_c_contiguous()
    {
        return Ok(array.readonly());
    }
    let rows = crate::arrays::index_rows::<2>(pairs, "pairs", "two indices of bodies")?;
    Ok(to_rows(pairs.py(), rows.into_iter()).readonly())
}

/// Contacts of pairs (m, 2) of bodies, as an array (m,) of contact_type; body i is particles[i] at poses[i]. Without memories: a Batch has those.
///
/// poses: an array of pose_type, or of doubles with rows x, y, z, w, x, y, z, read in place. pairs: first A, then B, counted from 0; those of uint32
/// are
/// read in place. threads: how many work on it, with the GIL released; no answer depends on it. out: where the contacts are written.
/// ContactError (IndexError where bodies do not exist): pairs without an answer, whose kind is FAILED; `failures` lists them with their reasons,
/// and `contacts` has all answers.
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

fn contacts_of<'py>(
    particles: &[&Particle],
    poses: &Bound<'py, PyAny>,
    pairs: &[[u32; 2]],
    (settings, threads): (&Settings, usize),
    states: &mut [PairState],
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    let given = records::poses(poses)?;
    let given: &[PoseRecord] =
        bytemuck::try_cast_slice(given.as_slice()?).map_err(|error| refused(format!("poses: {error}")))?;
    if given.len() != particles.len() {
        return Err(refused(format!(
            "{} poses given where {} are needed: one for each body",
            given.len(),
            particles.len()
        )));
    }
    let out = match out {
        Some(out) => out.clone(),
        None => py.import("numpy")?.call_method1("empty", (pairs.len(), contact_type(py)?))?,
    };
    let mut bytes = records::contacts(&out)?;
    let contacts: &mut [ContactRecord] =
        bytemuck::try_cast_slice_mut(bytes.as_slice_mut()?).map_err(|error| refused(format!("out: {error}")))?;
    if contacts.len() != pairs.len() {
        return Err(refused(format!(
            "out has {} records where {} are needed: one for each pair",
            contacts.len(),
            pairs.len()
        )));
    }
    let failures: Mutex<Vec<(usize, DetectError)>> = Mutex::default();
    let write = |number: usize, place: &mut ContactRecord, answer: Result<Contact, DetectError>| match answer {
        Ok(contact) => *place = ContactRecord::of(&contact),
        Err(error) => {
            *place = ContactRecord::failed();
            failures.lock().unwrap_or_else(PoisonError::into_inner).push((number, error));
        }
    };
    py.detach(|| {
        let pose = |(body, record): (usize, &PoseRecord)| {
            Pose::new(record.position, record.orientation).map_err(|error| refused(format!("body {body}: {error}")))
        };
        let poses = given.iter().enumerate().map(pose).collect::<PyResult<Vec<Pose>>>()?;
        detect_batch_into(particles, &poses, pairs, settings, threads, states, contacts, write).map_err(of_contact)
    })?;
    let mut failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    failures.sort_by_key(|failure| failure.0);
    match failures.first() {
        None => Ok(out),
        Some((pair, error)) => {
            let text = format!(
                "{} of {} pairs have no answer; the first is pair {pair}: {error}",
                failures.len(),
                pairs.len()
            );
            let is_missing = failures.iter().all(|(_, error)| matches!(error, DetectError::NoSuchBody { .. }));
            let raised = if is_missing { PyIndexError::new_err(text) } else { ContactError::new_err(text) };
            let reasons: Vec<(usize, String)> =
                failures.iter().map(|(pair, error)| (*pair, error.to_string())).collect();
            raised.value(py).setattr("failures", reasons)?;
            raised.value(py).setattr("contacts", &out)?;
            Err(raised)
        }
    }
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyBatch>()?;
    module.add_function(wrap_pyfunction!(detect_batch, module)?)
}
