//! `Study`: a scene with everything resolved, and the built-in profiles.

use std::sync::Arc;

use foldmotion_study::{ProfileModel, SceneSource, Study as NativeStudy, UnitStudy};
use glam::DVec2;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::error::bad_input;
use crate::pattern::Pattern;
use crate::result::Result;
use crate::scene::Scene;
use crate::sheet;
use crate::supervised::Supervision;

/// A scene with everything resolved, ready to run.
///
/// Made by :meth:`Scene.resolve`. It does not change, and several threads may use it.
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Study {
    source: SceneSource,
    study: Arc<NativeStudy>,
}

impl Study {
    pub(crate) fn new(source: SceneSource, study: NativeStudy) -> Self {
        Self { source, study: Arc::new(study) }
    }

    /// Folds and checks under supervision.
    pub(crate) fn fold(&self, py: Python<'_>, supervision: &Supervision) -> PyResult<Result> {
        let study = &self.study;
        let folded = supervision.run(py, |progress| study.compute(&progress))?;
        Result::new(py, self.source.clone(), Arc::clone(study), folded)
    }

    fn units(&self) -> Option<&UnitStudy> {
        self.study.subject.units()
    }
}

#[pymethods]
impl Study {
    /// The scene it was resolved from.
    #[getter]
    fn scene(&self) -> Scene {
        Scene::new(self.source.clone())
    }

    /// The title of the scene.
    #[getter]
    fn title(&self) -> &str {
        &self.study.title
    }

    /// The name of the unit of length, as in FOLD.
    #[getter]
    fn unit(&self) -> &str {
        self.study.unit_name
    }

    /// Values of the scene that are not used or were changed, and why; one line each.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.study.notes.clone()
    }

    /// The crease pattern: the flat sheet with its target fold angles.
    #[getter]
    fn pattern(&self) -> Pattern {
        Pattern::new(self.source.clone(), Arc::clone(&self.study))
    }

    /// Points of the profile Γ, evenly spaced in its parameter.
    ///
    /// Parameters
    /// ----------
    /// count : int, optional
    ///     The number of points, at least 2.
    ///
    /// Returns
    /// -------
    /// (count, 2) ndarray of float64, or None
    ///     x and z in the unit of length; None for an imported pattern, which has no profile.
    #[pyo3(signature = (count=201))]
    fn profile_points<'py>(
        &self,
        py: Python<'py>,
        count: usize,
    ) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        /// More points than this are a mistake.
        const MOST: usize = 10_000_000;
        if !(2..=MOST).contains(&count) {
            return Err(bad_input(py, format!("count = {count}: must be between 2 and {MOST}")));
        }
        let Some(units) = self.units() else { return Ok(None) };
        let point = |k: usize| units.profile.position(k as f64 / (count - 1) as f64);
        let points: Vec<DVec2> = (0..count).map(point).collect();
        Ok(Some(sheet::plane(py, &points)))
    }

    /// The points that divide the profile into segments of equal length, one segment for each row.
    ///
    /// (rows + 1, 2) ndarray of float64: x and z; None for an imported pattern.
    #[getter]
    fn division<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        Some(sheet::plane(py, &self.units()?.division.points))
    }

    /// The state at which the motion starts: deployed on the profile, or flat for an imported pattern.
    ///
    /// (vertices, 3) ndarray of float64.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        sheet::space(py, &self.study.subject.start())
    }

    /// The exact deployed state, (vertices, 3) ndarray of float64; None for an imported pattern.
    #[getter]
    fn deployed<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        Some(sheet::space(py, &self.units()?.deployed))
    }

    /// The exact planar state, (vertices, 3) ndarray of float64 with z = 0.
    #[getter]
    fn planar<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        sheet::space(py, &self.study.subject.sheet().planar())
    }

    /// The exact compact state, (vertices, 3) ndarray of float64; None for an imported pattern.
    #[getter]
    fn compact<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        Some(sheet::space(py, &self.units()?.units.compact()))
    }

    /// The size of the compact box by the paper's closed form (equations 3 to 7).
    ///
    /// (3,) ndarray of float64 in the unit of length; None where there is no closed form.
    #[getter]
    fn closed_form<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        Some(PyArray1::from_slice(py, &self.study.subject.closed_form()?.extents))
    }

    /// Fold the sheet and prove whether it passes through itself; writes no files.
    ///
    /// A jam, a stop and a penetration are results: :attr:`Result.outcome` names them.
    ///
    /// Parameters
    /// ----------
    /// progress : callable, optional
    ///     Called with the name of a phase and the share of it that is done, from 0 to 1, up to 20 times a second, in the
    ///     calling thread. If it returns ``False`` the run stops; what it raises is raised here.
    /// threads : int, optional
    ///     The number of threads, 1 to 1024. Default: one for each core. The motion is the same for any number.
    /// check : bool, optional
    ///     Whether to call :meth:`Result.raise_for_outcome`.
    ///
    /// Returns
    /// -------
    /// Result
    ///
    /// Raises
    /// ------
    /// KeyboardInterrupt
    ///     Ctrl-C was pressed.
    /// Interrupted
    ///     `progress` returned ``False``.
    /// RunFailed
    ///     The engine or the check failed.
    /// OutcomeError
    ///     With ``check=True``: the motion jammed, stopped, did not converge or stayed undecided.
    #[pyo3(signature = (*, progress=None, threads=None, check=false))]
    pub(crate) fn run(
        &self,
        py: Python<'_>,
        progress: Option<Bound<'_, PyAny>>,
        threads: Option<usize>,
        check: bool,
    ) -> PyResult<Py<Result>> {
        let result = Py::new(py, self.fold(py, &Supervision::new(py, progress, threads)?)?)?;
        if check {
            result.bind(py).call_method0("raise_for_outcome")?;
        }
        Ok(result)
    }

    fn __repr__(&self) -> String {
        let sheet = self.study.subject.sheet();
        let (vertices, faces) = (sheet.vertices.len(), sheet.faces.len());
        format!("<foldmotion.Study {}: {vertices} vertices, {faces} triangles>", self.study.title)
    }
}

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
