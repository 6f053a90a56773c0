//! Runs: from a study to its result.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::result::Result;
use crate::scene::Scene;
use crate::study::Study;
use crate::supervised::Supervision;

#[pymethods]
impl Study {
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
        let supervision = Supervision::new(py, progress, threads)?;
        let study = self.native();
        let folded = supervision.run(py, |progress| study.compute(&progress))?;
        let result = Result::new(py, self.source().clone(), Arc::clone(study), folded)?;
        let result = Py::new(py, result)?;
        if check {
            result.bind(py).call_method0("raise_for_outcome")?;
        }
        Ok(result)
    }
}

/// Fold a crease pattern given as a file or as arrays: a short form of :meth:`Scene.from_pattern`, resolve and run.
///
/// Parameters
/// ----------
/// pattern, edges, assignment, fold_angles
///     As in :meth:`Scene.from_pattern`.
/// settings : dict, optional
///     Dotted keys of the scene with their values, as in :meth:`Scene.replace`.
/// progress, threads, check
///     As in :meth:`Study.run`.
///
/// Returns
/// -------
/// Result
#[pyfunction]
#[pyo3(signature = (
    pattern, edges=None, assignment=None, *, fold_angles=None, settings=None, progress=None, threads=None, check=false
))]
#[expect(clippy::too_many_arguments, reason = "each is a keyword of the function in Python")]
pub(crate) fn fold_pattern(
    py: Python<'_>,
    pattern: &Bound<'_, PyAny>,
    edges: Option<&Bound<'_, PyAny>>,
    assignment: Option<&Bound<'_, PyAny>>,
    fold_angles: Option<&Bound<'_, PyAny>>,
    settings: Option<&Bound<'_, PyDict>>,
    progress: Option<Bound<'_, PyAny>>,
    threads: Option<usize>,
    check: bool,
) -> PyResult<Py<Result>> {
    let mut scene = Scene::from_pattern(py, pattern, edges, assignment, fold_angles)?;
    if let Some(settings) = settings {
        scene = scene.replace(py, settings)?;
    }
    let study: Study = scene.resolve(py)?;
    study.run(py, progress, threads, check)
}
