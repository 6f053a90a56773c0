//! `Study`: a scene with everything resolved.

use std::sync::Arc;

use foldmotion_study::{SceneSource, Study as NativeStudy, UnitStudy};
use glam::DVec2;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::error::{bad_input, exception};
use crate::pattern::Pattern;
use crate::scene::Scene;
use crate::sheet;

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

    pub(crate) fn source(&self) -> &SceneSource {
        &self.source
    }

    pub(crate) fn native(&self) -> &Arc<NativeStudy> {
        &self.study
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

    fn __repr__(&self) -> String {
        let sheet = self.study.subject.sheet();
        let (vertices, faces) = (sheet.vertices.len(), sheet.faces.len());
        format!("<foldmotion.Study {}: {vertices} vertices, {faces} triangles>", self.study.title)
    }
}

#[pymethods]
impl Scene {
    /// Resolve the scene: profile, division, sheet, mechanical model and schedule.
    ///
    /// Returns
    /// -------
    /// Study
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     The first unusable value, with file, line, key, value and remedy.
    pub(crate) fn resolve(&self, py: Python<'_>) -> PyResult<Study> {
        let source = self.source();
        let study = py.detach(|| NativeStudy::resolve(source));
        let study = study.map_err(|e| exception(py, &e))?;
        Ok(Study::new(source.clone(), study))
    }
}
