//! Errors as exceptions, with the text of the command line.

use std::fmt::Display;

use foldmotion_study::StudyError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// The module that defines the exceptions.
const MODULE: &str = "foldmotion._errors";

/// The exception of `error`.
pub(crate) fn exception(py: Python<'_>, error: &StudyError) -> PyErr {
    let name = match error {
        StudyError::Interrupted => "Interrupted",
        StudyError::Output { .. }
        | StudyError::Conflict { .. }
        | StudyError::DiskTooSmall { .. } => "OutputError",
        error if error.status() == 2 => "BadInput",
        _ => "RunFailed",
    };
    let made = py.import(MODULE).and_then(|module| {
        module.getattr(name)?.call1((error.to_string(), error.status(), error.key()))
    });
    made.map_or_else(|failure| failure, PyErr::from_value)
}

/// The exception of an input that is wrong in itself, which no command line can give.
pub(crate) fn bad_input(py: Python<'_>, message: impl Display) -> PyErr {
    let made = py
        .import(MODULE)
        .and_then(|module| module.getattr("BadInput")?.call1((message.to_string(),)));
    made.map_or_else(|failure| failure, PyErr::from_value)
}

/// The exception of something that failed though the input is right.
pub(crate) fn failed(error: impl Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
