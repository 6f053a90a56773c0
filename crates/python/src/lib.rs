//! The native part of the Python package `foldmotion`: scenes, studies and results as frozen objects.
//!
//! It binds `foldmotion-study` and decides nothing itself. `foldmotion/__init__.py` gives its names to users.

mod array;
mod borrowed;
mod document;
mod error;
mod model;
mod motion;
mod pattern;
mod pattern_arrays;
mod proof;
mod result;
mod run;
mod scene;
mod series;
mod sheet;
mod study;
mod supervised;
mod value;

use pyo3::prelude::*;

/// The native part of foldmotion.
#[pymodule(name = "_native")]
fn native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", foldmotion_study::VERSION)?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<study::Study>()?;
    module.add_class::<model::Model>()?;
    module.add_class::<pattern::Pattern>()?;
    module.add_class::<motion::Motion>()?;
    module.add_class::<result::Result>()?;
    module.add_class::<series::Series>()?;
    module.add_class::<proof::Verification>()?;
    module.add_function(wrap_pyfunction!(model::models, module)?)?;
    module.add_function(wrap_pyfunction!(proof::check, module)?)?;
    module.add_function(wrap_pyfunction!(proof::verify, module)?)?;
    module.add_function(wrap_pyfunction!(motion::read_fold, module)?)?;
    module.add_function(wrap_pyfunction!(run::fold_pattern, module)?)?;
    module.add_function(wrap_pyfunction!(main, module)?)
}

/// Runs the command line `arguments`, the first of which is the name of the program, and returns its exit status.
///
/// Ctrl-C ends the process, as it ends the program.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
    py.detach(|| foldmotion_cli::run(arguments))
}
