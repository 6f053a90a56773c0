//! `Pattern`: the crease pattern of a study.

use std::sync::Arc;

use foldmotion_study::{
    CutOptions, PatternFormat, PatternOptions, PatternScale, PatternStudy, SceneSource, Study,
};
use numpy::{IntoPyArray as _, PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::error::exception;
use crate::sheet;

/// The width of a drawing in a notebook, in millimetres.
const DRAWN_WIDTH: f64 = 160.0;

/// A crease pattern: the flat sheet, cut into triangles, with the fold angle each edge is to take.
///
/// ``_repr_svg_`` draws it in notebooks: mountains red, valleys blue.
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Pattern {
    source: SceneSource,
    study: Arc<Study>,
}

impl Pattern {
    pub(crate) fn new(source: SceneSource, study: Arc<Study>) -> Self {
        Self { source, study }
    }
}

#[pymethods]
impl Pattern {
    /// The vertices of the flat sheet, (vertices, 2) ndarray of float64 in the unit of length.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        sheet::plane(py, &self.study.subject.sheet().vertices)
    }

    /// The vertices of each edge, (edges, 2) ndarray of uint32.
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        sheet::edges(py, self.study.subject.sheet())
    }

    /// The letter of each edge as in FOLD, (edges,) ndarray of str: M mountain, V valley, B border, F inside a facet, U free.
    #[getter]
    fn assignment<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        sheet::assignment(py, self.study.subject.sheet())
    }

    /// The vertices of each triangle, counter-clockwise seen from the front, (faces, 3) ndarray of uint32.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        sheet::faces(py, self.study.subject.sheet())
    }

    /// The facet of each triangle, (faces,) ndarray of uint32.
    #[getter]
    fn face_facets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        sheet::face_facets(py, self.study.subject.sheet())
    }

    /// The fold angle of each edge at the end of the motion, (edges,) ndarray of float64 in degrees: mountain negative.
    #[getter]
    fn fold_angles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let angles = self.study.subject.end_angles().iter();
        angles.map(|angle| angle.to_degrees()).collect::<Vec<f64>>().into_pyarray(py)
    }

    /// The pattern as SVG, for notebooks.
    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<String> {
        let options = PatternOptions {
            formats: vec![PatternFormat::Svg],
            scale: PatternScale::Width(DRAWN_WIDTH),
            paper: None,
            overlap: 0.0,
            lines: CutOptions { margin: 5.0, ..CutOptions::new(1.0) },
        };
        let svg = py.detach(|| PatternStudy::resolve(&self.source)?.svg(&options));
        svg.map_err(|e| exception(py, &e))
    }

    fn __repr__(&self) -> String {
        let sheet = self.study.subject.sheet();
        let [vertices, edges, faces] = [sheet.vertices.len(), sheet.edges.len(), sheet.faces.len()];
        format!("<foldmotion.Pattern {vertices} vertices, {edges} edges, {faces} triangles>")
    }
}
