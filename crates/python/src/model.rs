//! `Model`: a built-in profile.

use foldmotion_study::ProfileModel;
use pyo3::prelude::*;

/// A built-in profile.
#[pyclass(frozen, get_all, module = "foldmotion")]
pub(crate) struct Model {
    /// The name in scenes.
    name: &'static str,
    /// A short description.
    title: &'static str,
    /// Whether the profile is closed.
    is_closed: bool,
    /// The number of rows.
    rows: usize,
    /// The number of columns in the cases E, T, and S or SII.
    columns: (usize, usize, usize),
    /// The source of its shape.
    source: &'static str,
}

impl From<&ProfileModel> for Model {
    fn from(model: &ProfileModel) -> Self {
        let columns = model.columns;
        Self {
            name: model.name,
            title: model.title,
            is_closed: model.is_closed(),
            rows: model.rows,
            columns: (columns.e, columns.t, columns.s),
            source: model.source,
        }
    }
}

#[pymethods]
impl Model {
    fn __repr__(&self) -> String {
        format!("<foldmotion.Model {}>", self.name)
    }
}

/// The built-in profiles.
///
/// Returns
/// -------
/// list of Model
#[pyfunction]
pub(crate) fn models() -> Vec<Model> {
    foldmotion_study::models().iter().map(Model::from).collect()
}
