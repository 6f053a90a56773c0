//! Arrays of NumPy that borrow what an object of Rust owns.

use numpy::PyArray;
use numpy::ndarray::{Array, Dimension};
use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;

/// A read-only array over the numbers that `table` returns, made once and kept by the owner.
pub(crate) fn borrowed<'py, T, D>(
    owner: &Bound<'py, T>,
    table: impl for<'a> Fn(&'a T) -> &'a Array<f64, D> + Sync,
) -> PyResult<Bound<'py, PyArray<f64, D>>>
where
    T: PyClass<Frozen = True> + Sync,
    D: Dimension + 'py,
{
    let object = owner.get();
    let numbers = owner.py().detach(|| table(object));
    #[expect(unsafe_code, reason = "numbers are borrowed, not copied")]
    // SAFETY: the numbers are part of the owner, which is frozen and which the array keeps alive, behind a `OnceLock` that
    // never changes them.
    let array = unsafe { PyArray::borrow_from_array(numbers, owner.clone().into_any()) };
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array)
}
