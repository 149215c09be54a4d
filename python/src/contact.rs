//! One pair: `detect`, `closest_point`, `contact_area`, and the `PairState` that leads from one call to the next.

use crate::arrays::to_vector;
use crate::errors::{of_contact, refused};
use crate::particle::PyParticle;
use crate::pickles::pickled;
use crate::pose::PyPose;
use crate::records::contact_type;
use crate::settings::{PySettings, or_default};
use numpy::PyArray1;
use potential_particles::internals::comment_with;
use potential_particles::{ClosestPoint, Contact, Kind, PairState, Role, Section};
use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use pyo3::types::{PyBytes, PyCFunction, PyDict, PyTuple};

/// What an ordered pair keeps from call to call. Copied and pickled, it keeps the solution, from which the next call
/// starts.
#[pyclass(name = "PairState", module = "potential_particles")]
#[derive(Default)]
pub struct PyPairState(pub PairState);

#[pymethods]
impl PyPairState {
    #[new]
    #[pyo3(signature = (solution=None))]
    fn new(solution: Option<[f64; 8]>) -> Self {
        Self(solution.map_or_else(PairState::default, PairState::from_raw))
    }

    #[getter]
    fn solution<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        to_vector(py, &self.0.into_raw())
    }

    fn __repr__(&self) -> &'static str {
        if self.0.into_raw()[0] == 1.0 { "<PairState with a solution>" } else { "<PairState, empty>" }
    }

    fn __getnewargs__(&self) -> ([f64; 8],) {
        (self.0.into_raw(),)
    }
}

/// The answer for one pair, world frame, lengths in the caller's unit. What does not apply is NaN. Each number has a
/// docstring of its own.
///
/// kind: "separated" (s >= 1) or "overlapping", as a boolean `overlapping`. flags: names of what else is to be known.
/// formulation: that which was answered. iterations: quadratics solved. record(): as a record of contact_type.
#[pyclass(name = "Contact", module = "potential_particles", frozen)]
pub struct PyContact(pub Contact);

impl PyContact {
    /// The contact, unless its branches belong to another relative position of the bodies.
    pub fn at(&self, pose_a: &PyPose, pose_b: &PyPose) -> PyResult<&Contact> {
        let Contact { branch_a, branch_b, .. } = &self.0;
        let off = (branch_a - branch_b - (pose_b.0.position() - pose_a.0.position())).norm();
        // NaN where the contact has no geometry.
        if off > SAME_POSE * (branch_a.norm() + branch_b.norm()) {
            return Err(refused(format!(
                "the contact is of other poses: one body has moved by {off:.3e} against the other since: detect it anew"
            )));
        }
        Ok(&self.0)
    }
}

/// Rounding of branches, over their length.
const SAME_POSE: f64 = 1e-9;

/// Getters of numbers and of vectors.
macro_rules! getters {
    ($class:ident: $($number:ident),*; $($vector:ident),*) => {
        #[pymethods]
        impl $class {
            $(#[getter]
            fn $number(&self) -> f64 {
                self.0.$number
            })*
            $(#[getter]
            fn $vector<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
                to_vector(py, self.0.$vector.as_slice())
            })*
        }
    };
}
pub(crate) use getters;

/// Attributes of an answer of the library: the numbers and vectors that its layout lists.
macro_rules! attributes {
    ($py:expr, $class:ident: $answer:ty) => {
        for (name, .., doc) in <$answer>::LAYOUT.iter().filter(|(_, format, ..)| *format == "f8") {
            let doc = $crate::contact::comment_in_python(doc);
            $crate::contact::attribute::<$class>($py, (name, doc), |object| object.0.numbers(name))?;
        }
    };
}
pub(crate) use attributes;

/// A comment of the library as a docstring: in the place of links the names of flags and of choices.
pub fn comment_in_python(comment: &str) -> String {
    let lines: Vec<_> = comment.lines().map(str::trim_start).collect();
    comment_with(&lines.join("\n"), |link| match link.split_once("::") {
        Some(("Flags", name)) => format!("{:?}", name.to_lowercase().replace('_', " ")),
        Some((_, name)) => {
            let apart = |c: char| if c.is_uppercase() { format!("_{}", c.to_lowercase()) } else { c.to_string() };
            format!("{:?}", name.chars().map(apart).collect::<String>().trim_start_matches('_'))
        }
        None => link.into(),
    })
}

/// Adds one attribute to a class, with its docstring: a double, or an array of doubles.
pub fn attribute<T: PyClass<Frozen = True> + Sync>(
    py: Python<'_>,
    (name, doc): (&'static str, String),
    numbers: impl Fn(&T) -> &[f64] + Send + Sync + 'static,
) -> PyResult<()> {
    let get = move |args: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| {
        let object = args.get_item(0)?.cast_into::<T>()?;
        match *numbers(object.get()) {
            [number] => Ok(number.into_pyobject(args.py())?.into_any().unbind()),
            ref vector => Ok(to_vector(args.py(), vector).into_any().unbind()),
        }
    };
    let get = PyCFunction::new_closure(py, None, None, move |args, named| -> PyResult<Py<PyAny>> { get(args, named) })?;
    let none = py.None();
    py.get_type::<T>().setattr(name, py.import("builtins")?.call_method1("property", (get, &none, &none, doc))?)
}

/// Getters that the contacts of two particles, and with a boundary have in common.
macro_rules! getters_of_contact {
    ($class:ident) => {
        #[pymethods]
        impl $class {
            #[getter]
            fn kind(&self) -> String {
                self.0.kind.to_string()
            }

            #[getter]
            fn overlapping(&self) -> bool {
                self.0.kind == Kind::Overlapping
            }

            #[getter]
            fn flags(&self) -> Vec<String> {
                names(self.0.flags.bits(), self.0.flags)
            }

            #[getter]
            fn iterations(&self) -> u32 {
                self.0.iterations
            }
        }
    };
}
pub(crate) use getters_of_contact;

getters_of_contact!(PyContact);

#[pymethods]
impl PyContact {
    #[getter]
    fn formulation(&self) -> String {
        self.0.formulation.to_string()
    }

    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let bytes = PyBytes::new_with(py, size_of::<Contact>(), |bytes| {
            self.0.put(bytes);
            Ok(())
        })?;
        let array = py.import("numpy")?.call_method1("frombuffer", (bytes, contact_type(py)?))?;
        array.call_method0("copy")?.get_item(0)
    }

    fn __repr__(&self) -> String {
        let Contact { s, overlap, normal: n, .. } = self.0;
        match self.0.kind {
            Kind::Separated => format!("<Contact: separated, s={s:.6}>"),
            Kind::Overlapping => {
                format!(
                    "<Contact: overlapping by {overlap:.6e}, s={s:.6}, normal ({:.4}, {:.4}, {:.4})>",
                    n.x, n.y, n.z
                )
            }
        }
    }
}

pickled!(PyContact: Contact);

/// The names of the flags that are set.
pub fn names(bits: u32, flags: impl std::fmt::Display) -> Vec<String> {
    if bits == 0 { Vec::new() } else { flags.to_string().split(", ").map(String::from).collect() }
}

/// The contact of particle A at pose_a with particle B at pose_b, as a Contact: world axes, normal from A to B.
///
/// Midway: the least t with s_A <= t and s_B <= t; they overlap if it is below 1 (Boon, Houlsby & Utili, eqs 4, 44).
/// Closest: s_A at its least where s_B <= 1, and the swap (eqs 3, 9). state: a PairState of this ordered pair, read,
/// and updated on success. ContactError: no solver reached an answer; that does not mean separated.
#[pyfunction]
#[pyo3(signature = (a, pose_a, b, pose_b, settings=None, state=None))]
fn detect(
    a: &PyParticle,
    pose_a: &PyPose,
    b: &PyParticle,
    pose_b: &PyPose,
    settings: Option<&PySettings>,
    state: Option<PyRefMut<'_, PyPairState>>,
) -> PyResult<PyContact> {
    let settings = or_default(settings);
    let mut state = state;
    let state = state.as_mut().map(|state| &mut state.0);
    potential_particles::detect(&a.0, &pose_a.0, &b.0, &pose_b.0, &settings, state).map(PyContact).map_err(of_contact)
}

/// One closest point.
#[pyclass(name = "ClosestPoint", module = "potential_particles", frozen)]
pub struct PyClosestPoint(ClosestPoint);

pickled!(PyClosestPoint: ClosestPoint);

/// The point on one particle, on="a" or "b", where the scale of the other is least (eqs 3, 9), as a ClosestPoint.
///
/// None where there is none: the other particle's centre (for k = 0, its core) lies inside this one. ContactError as of
/// detect.
#[pyfunction]
#[pyo3(signature = (a, pose_a, b, pose_b, on, settings=None))]
fn closest_point(
    a: &PyParticle,
    pose_a: &PyPose,
    b: &PyParticle,
    pose_b: &PyPose,
    on: &str,
    settings: Option<&PySettings>,
) -> PyResult<Option<PyClosestPoint>> {
    let role = match on {
        "a" | "A" => Role::A,
        "b" | "B" => Role::B,
        _ => return Err(refused(format!("on={on:?} must be \"a\" or \"b\""))),
    };
    let found = potential_particles::closest_point(&a.0, &pose_a.0, &b.0, &pose_b.0, role, &or_default(settings));
    found.map(|point| point.map(PyClosestPoint)).map_err(of_contact)
}

/// Area, length^2, that the plane through the contact point normal to the contact normal cuts out of both particles; 0
/// when separated.
///
/// It is in closed form; tolerance, in [1e-12, 0.1], counts where rounding forbids that. ValueError: the contact is of
/// other positions, or its point outside of a body.
#[pyfunction]
#[pyo3(signature = (a, pose_a, b, pose_b, contact, tolerance=1e-6))]
fn contact_area(
    a: &PyParticle,
    pose_a: &PyPose,
    b: &PyParticle,
    pose_b: &PyPose,
    contact: &PyContact,
    tolerance: f64,
) -> PyResult<f64> {
    if !Section::TOLERANCES.contains(&tolerance) {
        return Err(refused(format!("tolerance={tolerance:?} must lie in [1e-12, 0.1]")));
    }
    if contact.0.kind == Kind::Separated {
        return Ok(0.0);
    }
    let area = Section::from(contact.at(pose_a, pose_b)?).area(&a.0, &pose_a.0, &b.0, &pose_b.0, tolerance);
    area.ok_or_else(|| {
        refused("the contact point lies outside a particle: take the contact of the same bodies and poses")
    })
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPairState>()?;
    module.add_class::<PyContact>()?;
    module.add_class::<PyClosestPoint>()?;
    attributes!(module.py(), PyContact: Contact);
    attributes!(module.py(), PyClosestPoint: ClosestPoint);
    module.add_function(wrap_pyfunction!(detect, module)?)?;
    module.add_function(wrap_pyfunction!(closest_point, module)?)?;
    module.add_function(wrap_pyfunction!(contact_area, module)?)
}
