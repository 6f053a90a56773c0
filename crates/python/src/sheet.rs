//! The arrays of a sheet.

use foldmotion_pattern::Sheet;
use glam::{DVec2, DVec3};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray as _, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyList;

/// Points in the plane as an array (n, 2).
pub(crate) fn plane<'py>(py: Python<'py>, points: &[DVec2]) -> Bound<'py, PyArray2<f64>> {
    table(py, points.iter().map(DVec2::to_array))
}

/// Points in space as an array (n, 3).
pub(crate) fn space<'py>(py: Python<'py>, points: &[DVec3]) -> Bound<'py, PyArray2<f64>> {
    table(py, points.iter().map(DVec3::to_array))
}

/// The vertices of each triangle, (k, 3).
pub(crate) fn faces<'py>(py: Python<'py>, sheet: &Sheet) -> Bound<'py, PyArray2<u32>> {
    table(py, sheet.faces.iter().copied())
}

/// The vertices of each edge, (m, 2).
pub(crate) fn edges<'py>(py: Python<'py>, sheet: &Sheet) -> Bound<'py, PyArray2<u32>> {
    table(py, sheet.edges.iter().map(|edge| edge.vertices))
}

/// The facet of each triangle, (k,).
pub(crate) fn face_facets<'py>(py: Python<'py>, sheet: &Sheet) -> Bound<'py, PyArray1<u32>> {
    sheet.face_facets.clone().into_pyarray(py)
}

/// The letter of each edge as in FOLD, an array of strings (m,).
pub(crate) fn assignment<'py>(py: Python<'py>, sheet: &Sheet) -> PyResult<Bound<'py, PyAny>> {
    let letters =
        PyList::new(py, sheet.edges.iter().map(|edge| edge.assignment.letter().to_string()))?;
    py.import("numpy")?.call_method1("array", (letters, "<U1"))
}

/// The fold angle of each edge in degrees, NaN at the border.
pub(crate) fn fold_angles(sheet: &Sheet, positions: &[DVec3]) -> Vec<f64> {
    let angles = sheet.fold_angles(positions).into_iter();
    angles.map(|angle| angle.map_or(f64::NAN, f64::to_degrees)).collect()
}

/// Rows of `N` values as an array.
fn table<T: numpy::Element + Copy, const N: usize>(
    py: Python<'_>,
    rows: impl Iterator<Item = [T; N]>,
) -> Bound<'_, PyArray2<T>> {
    let rows: Vec<[T; N]> = rows.collect();
    Array2::from(rows).into_pyarray(py)
}
