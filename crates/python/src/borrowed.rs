//! Arrays of NumPy that borrow what an object of Rust owns.

use numpy::PyArray;
use numpy::ndarray::{Array, Dimension};
use pyo3::prelude::*;

use crate::motion::Motion;

/// A read-only array over the numbers that `table` returns, made once and kept by the motion.
pub(crate) fn borrowed<'py, D: Dimension + 'py>(
    owner: &Bound<'py, Motion>,
    table: impl for<'a> Fn(&'a Motion) -> &'a Array<f64, D> + Sync,
) -> PyResult<Bound<'py, PyArray<f64, D>>> {
    let motion = owner.get();
    let numbers = owner.py().detach(|| table(motion));
    #[expect(unsafe_code, reason = "numbers are borrowed, not copied")]
    // SAFETY: the numbers are part of the owner, which is frozen and which the array keeps alive, behind a `OnceLock` that
    // never changes them.
    let array = unsafe { PyArray::borrow_from_array(numbers, owner.clone().into_any()) };
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array)
}
