//! Errors of the programs as exceptions.

use std::io;

use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use ugparse::Diagnostics;
use ugpipe::{Failure, Words};

/// The failure of a program, or the errors in a scene.
pub enum Refused {
    Failure(Failure),
    Scene(Diagnostics),
}

impl From<Failure> for Refused {
    fn from(failure: Failure) -> Self {
        Self::Failure(failure)
    }
}

impl From<Diagnostics> for Refused {
    fn from(findings: Diagnostics) -> Self {
        Self::Scene(findings)
    }
}

impl Refused {
    /// The failure for an error of a program.
    pub fn of(error: impl Words) -> Self {
        Self::Failure(Failure::of(error))
    }

    /// The exception: `OSError` for files, else `uglorentz.Error`.
    pub fn exception(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Failure(Failure::Read { name, error } | Failure::Write { name, error }) => {
                of_system(py, &name, &error)
            }
            Self::Failure(failure) => exception(py, &failure.to_string(), None, None),
            Self::Scene(findings) => {
                let findings = findings.worded();
                let place =
                    findings.locations().into_iter().next().map(|at| (at.file, at.line, at.column));
                let remedy = findings.list.first().and_then(|first| first.help.clone());
                exception(py, &findings.render(false), place, remedy)
            }
        }
    }
}

fn of_system(py: Python<'_>, name: &str, error: &io::Error) -> PyErr {
    // Of the number the class makes a `FileNotFoundError` and the like.
    let number = error.raw_os_error().or(match error.kind() {
        io::ErrorKind::NotFound => Some(2),
        io::ErrorKind::PermissionDenied => Some(13),
        io::ErrorKind::IsADirectory => Some(21),
        io::ErrorKind::StorageFull => Some(28),
        _ => None,
    });
    let text = error.to_string();
    let text = text.split(" (os error ").next().unwrap_or_default();
    let made = py.get_type::<PyOSError>().call1((number, text, name));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// `uglorentz.Error`, which names options as Python does.
fn exception(
    py: Python<'_>,
    text: &str,
    place: Option<(String, usize, usize)>,
    remedy: Option<String>,
) -> PyErr {
    let class = py.import("uglorentz._error").and_then(|module| module.getattr("Error"));
    let made = class.and_then(|class| class.call_method1("_of", (text, place, remedy)));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// The exception for wrong arguments of the compiled module itself.
pub fn wrong(text: impl Into<String>) -> PyErr {
    PyValueError::new_err(text.into())
}
