//! Reports and certificates as objects of Python: their JSON, with attributes.

use pyo3::prelude::*;

/// The object of class `class` of the document with this JSON.
pub(crate) fn document<'py>(
    py: Python<'py>,
    class: &str,
    json: &str,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("foldmotion._document")?.getattr(class)?.call1((json,))
}
