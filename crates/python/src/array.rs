//! Arrays of Python as numbers, with errors that name the array.

use numpy::ndarray::{ArrayD, Ix1, Ix2};
use numpy::{PyArrayDyn, PyArrayMethods as _};
use pyo3::prelude::*;

use crate::error::bad_input;

/// Reads the array-like `object`, called `name` in errors, as finite numbers with `columns` columns; 0 for one dimension.
pub(crate) fn numbers(
    name: &str,
    object: &Bound<'_, PyAny>,
    columns: usize,
) -> PyResult<Vec<Vec<f64>>> {
    let array = read(name, object, "iuf", "float64", "numbers")?;
    let rows = rows::<f64>(name, &array, columns)?;
    let is_infinite = |row: &Vec<f64>| row.iter().any(|number| !number.is_finite());
    match rows.iter().position(is_infinite) {
        Some(row) => {
            let message = format!("{name}[{row}]: {:?} is not finite", rows[row]);
            Err(bad_input(object.py(), message))
        }
        None => Ok(rows),
    }
}

/// Reads `object` as indices below `limit`, with `columns` columns.
pub(crate) fn indices(
    name: &str,
    object: &Bound<'_, PyAny>,
    columns: usize,
    limit: usize,
) -> PyResult<Vec<Vec<i64>>> {
    let array = read(name, object, "iu", "int64", "whole numbers")?;
    let rows = rows::<i64>(name, &array, columns)?;
    let is_known = |&index: &i64| usize::try_from(index).is_ok_and(|index| index < limit);
    match rows.iter().position(|row| !row.iter().all(is_known)) {
        Some(row) => {
            let message = format!(
                "{name}[{row}] = {:?}: there are the vertices 0 to {}",
                rows[row],
                limit - 1
            );
            Err(bad_input(object.py(), message))
        }
        None => Ok(rows),
    }
}

/// `object` as an array of type `target`; refuses types whose kind is not one of `kinds`.
fn read<'py>(
    name: &str,
    object: &Bound<'py, PyAny>,
    kinds: &str,
    target: &str,
    expected: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let py = object.py();
    let array = py.import("numpy")?.call_method1("asarray", (object,));
    let array = array.map_err(|e| bad_input(py, format!("{name}: {e}")))?;
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    if !kinds.contains(&kind) {
        return Err(bad_input(py, format!("{name}: dtype {dtype}, expected {expected}")));
    }
    array.call_method1("astype", (target,))
}

/// The rows of an array of one or two dimensions.
fn rows<T: numpy::Element + Clone>(
    name: &str,
    array: &Bound<'_, PyAny>,
    columns: usize,
) -> PyResult<Vec<Vec<T>>> {
    let py = array.py();
    let array = array.cast::<PyArrayDyn<T>>()?.readonly();
    let array: ArrayD<T> = array.as_array().to_owned();
    let shape = array.shape().to_vec();
    let read = match columns {
        0 => array
            .into_dimensionality::<Ix1>()
            .ok()
            .map(|a| a.into_iter().map(|x| vec![x]).collect()),
        columns => {
            let array = array.into_dimensionality::<Ix2>().ok().filter(|a| a.ncols() == columns);
            array.map(|a| a.rows().into_iter().map(|row| row.to_vec()).collect())
        }
    };
    read.ok_or_else(|| {
        let expected = if columns == 0 { "(n,)".to_owned() } else { format!("(n, {columns})") };
        let shape: Vec<String> = shape.iter().map(ToString::to_string).collect();
        let comma = if shape.len() == 1 { "," } else { "" };
        bad_input(py, format!("{name}: shape ({}{comma}), expected {expected}", shape.join(", ")))
    })
}
