//! `Settings`.

use crate::contact::attributes;
use crate::errors::refused;
use potential_particles::{Formulation, Settings};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// How to solve; immutable.
///
/// formulation: "midway" or "closest". solve_separated: solve separated pairs to the end as well. The numbers are
/// keywords, each with a docstring of its own. ValueError: a number out of range.
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
    #[pyo3(signature = (formulation="midway", *, solve_separated=false, **numbers))]
    fn new(formulation: &str, solve_separated: bool, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut settings =
            Settings::default().with_formulation(self::formulation(formulation)?).with_solve_separated(solve_separated);
        for (name, number) in numbers.into_iter().flatten() {
            let name: String = name.extract()?;
            let Some((_, with)) = Settings::NUMBERS.iter().find(|(known, _)| *known == name) else {
                let known: String = Settings::NUMBERS.iter().map(|(known, _)| format!(", {known}")).collect();
                let known = format!("formulation, solve_separated{known}");
                return Err(PyTypeError::new_err(format!("Settings has no {name:?}; it has {known}")));
            };
            let number = number.extract().map_err(|error| PyTypeError::new_err(format!("{name}: {error}")))?;
            settings = with(settings, number);
        }
        settings.validate().map_err(refused)?;
        Ok(Self(settings))
    }

    /// "midway" or "closest".
    #[getter]
    fn formulation(&self) -> String {
        self.0.formulation.to_string()
    }

    /// Whether separated pairs are solved to the end as well.
    #[getter]
    fn solve_separated(&self) -> bool {
        self.0.solve_separated()
    }

    fn __repr__(&self) -> String {
        let number = |name: &str| self.0.numbers(name)[0];
        let numbers = Settings::NUMBERS.iter().map(|(name, _)| format!(", {name}={:?}", number(name)));
        let solved = if self.0.solve_separated() { "True" } else { "False" };
        format!("Settings({:?}, solve_separated={solved}{})", self.formulation(), numbers.collect::<String>())
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((String,), Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("solve_separated", self.0.solve_separated())?;
        for (name, _) in Settings::NUMBERS {
            keywords.set_item(name, self.0.numbers(name)[0])?;
        }
        Ok(((self.formulation(),), keywords))
    }
}

/// Those given, or the defaults.
pub fn or_default(settings: Option<&PySettings>) -> Settings {
    settings.map_or_else(Settings::default, |settings| settings.0)
}

pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PySettings>()?;
    attributes!(module.py(), PySettings: Settings);
    let class = module.py().get_type::<PySettings>();
    let default = |name: &str| Settings::DEFAULT.numbers(name)[0];
    let numbers: String = Settings::NUMBERS.iter().map(|(name, _)| format!(", {name}={:?}", default(name))).collect();
    let signature = format!("(formulation=\"midway\", *, solve_separated=False{numbers})");
    class.setattr("__doc__", format!("Settings{signature}\n\n{}", class.getattr("__doc__")?))
}
