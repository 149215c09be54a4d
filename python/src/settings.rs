//! `Settings`.

use crate::errors::refused;
use potential_particles::{Formulation, Settings};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// How to solve; immutable.
///
/// formulation: "midway" or "closest". solve_separated: solve separated pairs to the end as well. gap_tolerance:
/// relative gap of s^2 at which the solver may stop, in (0, 0.1]; below 1e-13 it goes on in extended precision.
/// weight_on_a: of the point on A in the contact point of closest, in [0, 1]. flat_regularisation: sphericity below
/// which the position on a flat face is regularised, in [0, 0.1]. carry_tolerance: to what part of the smaller bounding
/// radius the point of a contact has to be known that is carried on from the last step, in [0, 0.1]; 0: every contact
/// is solved. ValueError: a number out of range.
#[pyclass(name = "Settings", module = "potential_particles", frozen, eq)]
#[derive(PartialEq)]
pub struct PySettings(pub Settings);

fn formulation(name: &str) -> PyResult<Formulation> {
    match name {
        "midway" => Ok(Formulation::Midway),
        "closest" => Ok(Formulation::Closest),
        _ => Err(refused(format!("formulation={name:?} must be \"midway\" or \"closest\""))),
    }
}

#[pymethods]
impl PySettings {
    #[new]
    #[pyo3(signature = (formulation="midway", *, solve_separated=false, gap_tolerance=1e-12, weight_on_a=0.5, flat_regularisation=1e-13,
                        carry_tolerance=0.0))]
    fn new(
        formulation: &str,
        solve_separated: bool,
        gap_tolerance: f64,
        weight_on_a: f64,
        flat_regularisation: f64,
        carry_tolerance: f64,
    ) -> PyResult<Self> {
        let settings = Settings::default()
            .with_formulation(self::formulation(formulation)?)
            .with_solve_separated(solve_separated)
            .with_gap_tolerance(gap_tolerance)
            .with_weight_on_a(weight_on_a)
            .with_flat_regularisation(flat_regularisation)
            .with_carry_tolerance(carry_tolerance);
        settings.validate().map_err(refused)?;
        Ok(Self(settings))
    }

    #[getter]
    fn formulation(&self) -> String {
        self.0.formulation.to_string()
    }

    #[getter]
    fn solve_separated(&self) -> bool {
        self.0.solve_separated()
    }

    #[getter]
    fn gap_tolerance(&self) -> f64 {
        self.0.gap_tolerance
    }

    #[getter]
    fn weight_on_a(&self) -> f64 {
        self.0.weight_on_a
    }

    #[getter]
    fn flat_regularisation(&self) -> f64 {
        self.0.flat_regularisation
    }

    #[getter]
    fn carry_tolerance(&self) -> f64 {
        self.0.carry_tolerance
    }

    fn __repr__(&self) -> String {
        let Settings { gap_tolerance, weight_on_a, flat_regularisation, carry_tolerance, .. } = self.0;
        let solved = if self.0.solve_separated() { "True" } else { "False" };
        format!(
            "Settings({:?}, solve_separated={solved}, gap_tolerance={gap_tolerance:?}, weight_on_a={weight_on_a:?}, \
             flat_regularisation={flat_regularisation:?}, carry_tolerance={carry_tolerance:?})",
            self.formulation()
        )
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((String,), Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("solve_separated", self.0.solve_separated())?;
        keywords.set_item("gap_tolerance", self.0.gap_tolerance)?;
        keywords.set_item("weight_on_a", self.0.weight_on_a)?;
        keywords.set_item("flat_regularisation", self.0.flat_regularisation)?;
        keywords.set_item("carry_tolerance", self.0.carry_tolerance)?;
        Ok(((self.formulation(),), keywords))
    }
}

/// Those given, or the defaults.
pub fn or_default(settings: Option<&PySettings>) -> Settings {
    settings.map_or_else(Settings::default, |settings| settings.0)
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PySettings>()
}
