//! Whether a scene of blocks stands.

use crate::arrays::{rows, to_rows, to_vector, vector};
use crate::errors::refused;
use crate::pickles::pickled;
use numpy::{PyArray1, PyArray2};
use potential_particles::equilibrium::{self as library, Body, Contact, Equilibrium, EquilibriumError, Flow};
use potential_particles::equilibrium::{Load, Scene};
use potential_particles::nalgebra::{Matrix3, RowVector3, Vector3};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::cell::RefCell;

/// Rigid bodies and their contacts, filled by add_body and add_contact; rock.limit_scene makes that of a rock mass.
#[pyclass(name = "Scene", module = "potential_particles.equilibrium")]
pub struct PyScene(Scene);

/// An invalid scene raises a ValueError; a program that does not converge a RuntimeError, since the scene may stand or
/// fall.
fn raised(error: EquilibriumError) -> PyErr {
    match error {
        EquilibriumError::NotConverged { .. }
        | EquilibriumError::Undecided { .. }
        | EquilibriumError::NotFound { .. } => PyRuntimeError::new_err(error.to_string()),
        _ => refused(error),
    }
}

/// Refuses what can only be an angle in degrees.
fn coefficient(friction: f64) -> PyResult<()> {
    if friction > STEEPEST {
        let tangent = friction.to_radians().tan();
        let said =
            format!("friction={friction} is a coefficient, tan of the angle: {friction} degrees are {tangent:.4}");
        return Err(refused(said));
    }
    Ok(())
}

/// A coefficient of friction above that of 84 degrees is an angle.
const STEEPEST: f64 = 10.0;

fn flow(dilatant: bool) -> Flow {
    if dilatant { Flow::Associated } else { Flow::NonDilatant }
}

#[pymethods]
impl PyScene {
    #[new]
    fn new() -> Self {
        Self(Scene::default())
    }

    /// Adds a body and returns its index. force and torque about its centre are there; live ones are multiplied by the
    /// load factor.
    #[pyo3(signature = (centre, *, held=false, force=[0.0; 3], torque=[0.0; 3], live_force=[0.0; 3],
                        live_torque=[0.0; 3]))]
    fn add_body(
        &mut self,
        centre: &Bound<'_, PyAny>,
        held: bool,
        force: [f64; 3],
        torque: [f64; 3],
        live_force: [f64; 3],
        live_torque: [f64; 3],
    ) -> PyResult<usize> {
        let load = |force: [f64; 3], torque: [f64; 3]| Load { force: force.into(), torque: torque.into() };
        let centre = vector::<3>(centre, "centre")?.into();
        self.0.bodies.push(Body { centre, held, dead: load(force, torque), live: load(live_force, live_torque) });
        Ok(self.0.bodies.len() - 1)
    }

    /// Adds a contact of two bodies: corners (n, 3) in order, normal from the first to the second. friction = tan phi;
    /// cohesion and tension are stresses; stiffness: along the normal and across it, of which ratios alone count;
    /// initial: stress on the second body before any load, p times the normal where the contact is pressed by p.
    /// area: that of the convex polygon of the corners, if not given. A bolt is a point along its normal with the area
    /// of its steel, the yield stress as tension and that of shear as cohesion, friction 0.
    #[pyo3(signature = (first, second, corners, normal, *, friction, cohesion=0.0, tension=0.0, stiffness=[1.0; 2],
                        initial=[0.0; 3], area=None))]
    #[allow(clippy::too_many_arguments)]
    fn add_contact(
        &mut self,
        first: usize,
        second: usize,
        corners: &Bound<'_, PyAny>,
        normal: &Bound<'_, PyAny>,
        friction: f64,
        cohesion: f64,
        tension: f64,
        stiffness: [f64; 2],
        initial: [f64; 3],
        area: Option<f64>,
    ) -> PyResult<usize> {
        coefficient(friction)?;
        let corners = rows::<3>(corners, "corners", "x, y, z")?.into_iter().map(Vector3::from).collect();
        let normal = vector::<3>(normal, "normal")?.into();
        let contact = Contact::new([first, second], corners, normal, friction);
        let area = area.unwrap_or(contact.area);
        self.0.contacts.push(Contact { area, cohesion, tension, stiffness, initial: initial.into(), ..contact });
        Ok(self.0.contacts.len() - 1)
    }

    /// Gives each free body the live force acceleration times its dead force, along direction (3,): an earthquake as a
    /// share of gravity.
    fn push(&mut self, direction: &Bound<'_, PyAny>) -> PyResult<()> {
        let along = Vector3::from(vector::<3>(direction, "direction")?);
        for body in &mut self.0.bodies {
            body.live.force = along * body.dead.force.norm();
        }
        Ok(())
    }

    /// Adds a force (3,) at a place (3,) of a body, dead or live: water, a surcharge, an anchor (one force at either
    /// end).
    #[pyo3(signature = (body, place, force, *, live=false))]
    fn add_force(&mut self, body: usize, place: [f64; 3], force: [f64; 3], live: bool) -> PyResult<()> {
        let count = self.0.bodies.len();
        let Some(of) = self.0.bodies.get_mut(body) else {
            return Err(refused(format!("body={body}: the scene has {count} bodies")));
        };
        let load = Load::at(place.into(), force.into(), of.centre);
        if live {
            of.live.add(1.0, &load)
        } else {
            of.dead.add(1.0, &load)
        }
        Ok(())
    }

    /// Presses every contact by the stress there before any load, as it is in situ. stress: (3, 3), symmetric, pressure
    /// positive, or a function that gives it at a place (3,).
    fn press(&mut self, stress: &Bound<'_, PyAny>) -> PyResult<()> {
        let of = |given: &Bound<'_, PyAny>| -> PyResult<Matrix3<f64>> {
            let rows = rows::<3>(given, "stress", "x, y, z")?;
            match rows[..] {
                [a, b, c] => Ok(Matrix3::from_rows(&[a, b, c].map(RowVector3::from))),
                _ => Err(refused(format!("stress has {} rows: give (3, 3)", rows.len()))),
            }
        };
        if !stress.is_callable() {
            let stress = of(stress)?;
            self.0.press(|_| stress);
            return Ok(());
        }
        let failed = RefCell::new(None);
        let mut pressed = self.0.clone();
        pressed.press(|at| {
            let found = stress.call1((to_vector(stress.py(), at.as_slice()),)).and_then(|given| of(&given));
            found.unwrap_or_else(|error| {
                failed.borrow_mut().get_or_insert(error);
                Matrix3::zeros()
            })
        });
        match failed.into_inner() {
            Some(error) => Err(error),
            None => {
                self.0 = pressed;
                Ok(())
            }
        }
    }

    #[getter]
    fn body_count(&self) -> usize {
        self.0.bodies.len()
    }

    #[getter]
    fn contact_count(&self) -> usize {
        self.0.contacts.len()
    }

    /// (n, 3): the corners of all contacts, in the order of Equilibrium.forces.
    #[getter]
    fn corners<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let corners = self.0.contacts.iter().flat_map(|contact| &contact.corners);
        to_rows(py, corners.map(|&at| at.into()).collect::<Vec<_>>().into_iter())
    }

    /// (n,): the contact that each corner belongs to.
    #[getter]
    fn contact_of_corner<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        let of = |(i, contact): (usize, &Contact)| vec![i as u64; contact.corners.len()];
        PyArray1::from_vec(py, self.0.contacts.iter().enumerate().flat_map(of).collect())
    }

    /// Whether the bodies come to rest under their dead loads, from nothing: with the forces, or the motion.
    /// dilatant=True: whether any forces hold them, where joints open by friction times their slip. live: the multiple
    /// of the live loads that counts as dead.
    #[pyo3(signature = (*, dilatant=false, live=0.0))]
    fn stands(&self, py: Python<'_>, dilatant: bool, live: f64) -> PyResult<PyEquilibrium> {
        self.answer(py, |scene| library::stands(&scene.clone().under(live), flow(dilatant)))
    }

    /// The largest multiple of the live loads that can be borne, and its bound. dilatant=True: the bound alone, with
    /// its forces and mechanism, of joints that open as they slip.
    #[pyo3(signature = (*, dilatant=false))]
    fn load_factor(&self, py: Python<'_>, dilatant: bool) -> PyResult<PyEquilibrium> {
        self.answer(py, |scene| library::load_factor(scene, flow(dilatant)))
    }

    /// The factor of safety on tan phi and cohesion, and its bound. dilatant=True: the bound alone, with its forces and
    /// mechanism, of joints that open as they slip. live: as of stands().
    #[pyo3(signature = (*, dilatant=false, live=0.0))]
    fn strength_factor(&self, py: Python<'_>, dilatant: bool, live: f64) -> PyResult<PyEquilibrium> {
        self.answer(py, |scene| library::strength_factor(&scene.clone().under(live), flow(dilatant)))
    }

    fn __repr__(&self) -> String {
        format!("<Scene of {} bodies and {} contacts>", self.0.bodies.len(), self.0.contacts.len())
    }
}

impl PyScene {
    fn answer(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&Scene) -> Result<Equilibrium, EquilibriumError> + Send,
    ) -> PyResult<PyEquilibrium> {
        py.detach(|| ask(&self.0)).map(PyEquilibrium).map_err(raised)
    }
}

pickled!(PyScene: Scene);

/// Forces in equilibrium and the motion at the limit.
#[pyclass(name = "Equilibrium", module = "potential_particles.equilibrium", frozen)]
pub struct PyEquilibrium(Equilibrium);

#[pymethods]
impl PyEquilibrium {
    #[getter]
    fn stands(&self) -> bool {
        self.0.stands
    }

    #[getter]
    fn factor(&self) -> f64 {
        self.0.factor
    }

    /// (n, 3): force on the second body at each corner, contact after contact; no row where nothing stands.
    #[getter]
    fn forces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.forces.iter().map(|&force| force.into()))
    }

    /// (n, 6): linear and angular velocity of each body, the fastest at 1; no row where stands() is asked and it does.
    #[getter]
    fn mechanism<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let six = |v: &library::Velocity| {
            let ([a, b, c], [d, e, f]): ([f64; 3], [f64; 3]) = (v.linear.into(), v.angular.into());
            [a, b, c, d, e, f]
        };
        to_rows(py, self.0.mechanism.iter().map(six))
    }

    /// The largest force that is left on a body, over the mean load of one.
    #[getter]
    fn unbalanced(&self) -> f64 {
        self.0.unbalanced
    }

    /// The largest friction beyond its strength at a corner, over the mean load of a body.
    #[getter]
    fn excess(&self) -> f64 {
        self.0.excess
    }

    /// Number of matrices that were factorised, or of cone programs.
    #[getter]
    fn solves(&self) -> u32 {
        self.0.solves
    }

    /// Whether any forces hold the bodies, where joints open as they slip.
    #[getter]
    fn may_stand(&self) -> bool {
        self.0.may_stand
    }

    /// The factor of joints that open as they slip, which no state of equilibrium exceeds: inf without a limit, nan if
    /// it was not found.
    #[getter]
    fn bound(&self) -> f64 {
        self.0.bound
    }

    /// The largest force of a contact over the mean load of a body: far above 1 where blocks clamp each other.
    #[getter]
    fn largest(&self) -> f64 {
        self.0.largest
    }

    /// (contacts, 3): of each contact its force along the normal, across it, and that over friction and cohesion there;
    /// no row where nothing stands.
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        to_rows(py, self.0.contacts.iter().map(|of| [of.normal, of.shear, of.used]))
    }

    fn __repr__(&self) -> String {
        let Equilibrium { stands, factor, bound, .. } = self.0;
        format!("<Equilibrium stands={stands} factor={factor:.6}, at most {bound:.6}>")
    }
}

pickled!(PyEquilibrium: Equilibrium);

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_equilibrium")?;
    module.add_class::<PyScene>()?;
    module.add_class::<PyEquilibrium>()?;
    parent.add_submodule(&module)
}
