//! The options of the programs, from which Python makes keyword arguments.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use ugfilm::TOOLS;
use ugimage::Format;
use ugparse::{EXAMPLE_FILES, example_subject};
use ugpicture::Channel;
use ugpipe::{Entry, Manual, manual};

use crate::error::wrong;

/// The options of the program `name`, in the order of its help: a dictionary for each.
#[pyfunction]
pub fn options<'py>(py: Python<'py>, name: &str) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let of_frame = TOOLS.iter().find(|tool| tool.name() == name).map(|tool| (tool.manual)());
    let manual = match name {
        "ugfilm" => Some(manual::<ugfilm::Args>()),
        _ => of_frame,
    };
    let manual = manual.ok_or_else(|| wrong(format!("there is no program `{name}`")))?;
    described(py, &manual)
}

fn described<'py>(py: Python<'py>, manual: &Manual) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let option = |entry: &Entry| {
        let option = PyDict::new(py);
        let n_needed = entry.values.iter().filter(|value| !value.is_optional).count();
        let values: Vec<&str> = entry.values.iter().map(|value| value.name.as_str()).collect();
        let words: Vec<&str> = entry.words.iter().map(|(word, _)| word.as_str()).collect();
        option.set_item("names", &entry.names)?;
        option.set_item("values", values)?;
        option.set_item("n_needed", n_needed)?;
        option.set_item("is_repeated", entry.is_repeated)?;
        option.set_item("words", words)?;
        option.set_item("about", &entry.about)?;
        option.set_item("details", &entry.details)?;
        option.set_item("default", &entry.default)?;
        option.set_item("is_common", entry.is_common)?;
        Ok(option)
    };
    manual.options().map(option).collect()
}

/// The names of the formats of pictures.
#[pyfunction]
pub fn formats() -> Vec<&'static str> {
    Format::ALL.map(Format::name).to_vec()
}

/// The names of the channels that a picture may have besides light.
#[pyfunction]
pub fn channels() -> Vec<&'static str> {
    Channel::NAMES.map(|(name, _)| name).to_vec()
}

/// The names of the example files, and what they show.
#[pyfunction]
pub fn examples() -> Vec<(&'static str, String)> {
    EXAMPLE_FILES.map(|(name, text)| (name, example_subject(text))).to_vec()
}

/// The bytes of an example file.
#[pyfunction]
pub fn example<'py>(py: Python<'py>, name: &str) -> Option<Bound<'py, PyBytes>> {
    let (_, bytes) = EXAMPLE_FILES.iter().find(|(other, _)| *other == name)?;
    Some(PyBytes::new(py, bytes))
}
