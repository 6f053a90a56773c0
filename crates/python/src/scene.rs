//! `Scene`: what the user wrote.

use std::path::PathBuf;

use foldmotion_study::SceneSource;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{exception, failed};
use crate::pattern_arrays::PatternArrays;
use crate::value::{table, value};

/// What is folded and how, as in a scene file.
///
/// A scene does not change: :meth:`replace` returns another one, and a study keeps the scene it was resolved from.
///
/// See Also
/// --------
/// Scene.from_file, Scene.from_toml, Scene.from_dict, Scene.from_pattern
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Scene {
    source: SceneSource,
}

impl Scene {
    pub(crate) fn new(source: SceneSource) -> Self {
        Self { source }
    }

    pub(crate) fn source(&self) -> &SceneSource {
        &self.source
    }
}

#[pymethods]
impl Scene {
    /// Read a scene file (TOML) or a crease pattern (.fold, .svg, .cp, .opx, .orh, .obj, .dxf).
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     The file cannot be read or is neither.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let source = SceneSource::read(&path).map_err(|e| exception(py, &e))?;
        Ok(Self { source })
    }

    /// A scene from the text of a scene file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     TOML; the keys are those of scene files.
    /// path : str or os.PathLike, optional
    ///     Where the text stands: errors name this file, results its stem, and files that the scene names lie beside it.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     The text is no TOML, or a key is unknown or of the wrong type.
    #[staticmethod]
    #[pyo3(signature = (text, path=PathBuf::from("scene.toml")))]
    fn from_toml(py: Python<'_>, text: String, path: PathBuf) -> PyResult<Self> {
        let source = SceneSource::new(&path, text);
        source.scene().map_err(|e| exception(py, &e))?;
        Ok(Self { source })
    }

    /// A scene from nested dictionaries, with the keys of scene files.
    ///
    /// Parameters
    /// ----------
    /// values : dict
    ///     Numbers, strings, booleans, lists, dictionaries and arrays of NumPy. ``None`` leaves a key at its default.
    /// path : str or os.PathLike, optional
    ///     As in :meth:`from_toml`.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     A number is not finite, a value has a type that scenes do not have, or a key is unknown.
    #[staticmethod]
    #[pyo3(signature = (values, path=PathBuf::from("scene.toml")))]
    fn from_dict(py: Python<'_>, values: &Bound<'_, PyDict>, path: PathBuf) -> PyResult<Self> {
        let text = toml::to_string(&table(values)?).map_err(failed)?;
        Self::from_toml(py, text, path)
    }

    /// A scene that folds a crease pattern given as a file or as arrays.
    ///
    /// Parameters
    /// ----------
    /// pattern : str, os.PathLike or (n, 2) array_like of float
    ///     A file, or the vertices of the flat pattern.
    /// edges : (m, 2) array_like of int, optional
    ///     The vertices of each edge; required with an array of vertices.
    /// assignment : sequence of str, optional
    ///     The letter of each edge as in FOLD: ``"M"``, ``"V"``, ``"B"``, ``"F"``, ``"U"``, ``"C"``; required with an array.
    /// fold_angles : (m,) array_like of float, optional
    ///     The fold angle of each edge at the end, in degrees: mountain negative, valley positive. Default: ±180.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     An array has another shape or type, a number is not finite, or a vertex does not exist.
    #[staticmethod]
    #[pyo3(signature = (pattern, edges=None, assignment=None, *, fold_angles=None))]
    pub(crate) fn from_pattern(
        py: Python<'_>,
        pattern: &Bound<'_, PyAny>,
        edges: Option<&Bound<'_, PyAny>>,
        assignment: Option<&Bound<'_, PyAny>>,
        fold_angles: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        if let Ok(path) = pattern.extract::<PathBuf>() {
            return Self::from_file(py, path);
        }
        let arrays = PatternArrays::read(py, pattern, edges, assignment, fold_angles)?;
        let source = SceneSource::of_pattern("pattern.fold", arrays.fold().into_bytes());
        Ok(Self { source })
    }

    /// Another scene with some values changed, as with ``--set`` on the command line.
    ///
    /// Parameters
    /// ----------
    /// values : dict
    ///     Dotted keys with their values, such as ``{"sheet.columns": 5}``.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     A key is unknown or a value has the wrong type.
    pub(crate) fn replace(&self, py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut source = self.source.clone();
        for (key, object) in values {
            let key: String = key.extract()?;
            let assignment = format!("{key}={}", value(&key, &object)?);
            source.set(&assignment).map_err(|e| exception(py, &e))?;
        }
        source.scene().map_err(|e| exception(py, &e))?;
        Ok(Self { source })
    }

    /// The text of the scene as a scene file.
    ///
    /// Returns
    /// -------
    /// str
    ///     The text it was made from, with its comments; after :meth:`replace` all its keys, without comments.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        self.source.to_toml().map_err(|e| exception(py, &e))
    }

    fn __repr__(&self) -> String {
        format!("<foldmotion.Scene {}>", self.source.stem())
    }
}
