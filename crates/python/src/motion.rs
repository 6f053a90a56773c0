//! `Motion`: the frames of a run or of a file, as arrays.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use foldmotion_pattern::Motion as NativeMotion;
use foldmotion_study::{Folded, OpenedFile, OpenedMotion, Quantity, Study};
use glam::DVec3;
use numpy::ndarray::{Array2, Array3};
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;

use crate::borrowed::borrowed;
use crate::error::bad_input;
use crate::sheet;
use crate::supervised::Supervision;

/// Where a motion comes from.
pub(crate) enum Origin {
    /// A run.
    Run { study: Arc<Study>, folded: Arc<Folded> },
    /// A file.
    File { motion: Arc<OpenedMotion>, path: PathBuf },
}

/// A motion: a sheet and its frames in order of time. Between frames every vertex moves on a straight line.
///
/// Arrays are read-only. Those of one value a frame and vertex, edge or triangle are made once, at their first use, and
/// borrowed from then on: NumPy copies nothing, and they stay valid as long as an array of them lives.
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Motion {
    origin: Origin,
    positions: OnceLock<Array3<f64>>,
    fold_angles: OnceLock<Array2<f64>>,
    strain: OnceLock<Array2<f64>>,
    bending: OnceLock<Array2<f64>>,
}

impl Motion {
    pub(crate) fn new(origin: Origin) -> Self {
        Self {
            origin,
            positions: OnceLock::new(),
            fold_angles: OnceLock::new(),
            strain: OnceLock::new(),
            bending: OnceLock::new(),
        }
    }

    pub(crate) fn native(&self) -> &NativeMotion {
        match &self.origin {
            Origin::Run { folded, .. } => &folded.motion,
            Origin::File { motion, .. } => motion.motion(),
        }
    }

    pub(crate) fn origin(&self) -> &Origin {
        &self.origin
    }

    /// All positions in one buffer: frames × vertices × 3.
    fn buffer(&self) -> Array3<f64> {
        let motion = self.native();
        let mut buffer = Array3::zeros((motion.frames.len(), motion.sheet.vertices.len(), 3));
        let all = motion.frames.iter().flat_map(|frame| &frame.positions);
        let coordinates = all.flat_map(DVec3::to_array);
        buffer.iter_mut().zip(coordinates).for_each(|(to, from)| *to = from);
        buffer
    }

    /// The rows of `values`, one for each frame, of `columns` values each.
    fn table(&self, columns: usize, values: impl Iterator<Item = Vec<f64>>) -> Array2<f64> {
        let mut table = Array2::zeros((self.native().frames.len(), columns));
        table.iter_mut().zip(values.flatten()).for_each(|(to, from)| *to = from);
        table
    }

    fn of_triangles(&self, quantity: Quantity) -> Array2<f64> {
        let values = quantity.of_motion(self.native());
        self.table(self.native().sheet.faces.len(), values.frames.into_iter())
    }
}

#[pymethods]
impl Motion {
    /// The motion time of each frame, (frames,) ndarray of float64: 0 deployed, 1 planar, 2 compact.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.native().frames.iter().map(|frame| frame.time))
    }

    /// The positions of all vertices in all frames, (frames, vertices, 3) ndarray of float64 in the unit of length.
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        borrowed(slf, |this| this.positions.get_or_init(|| this.buffer()))
    }

    /// The fold angle of each edge in each frame, (frames, edges) ndarray of float64 in degrees: valley positive, mountain
    /// negative, NaN at the border.
    #[getter]
    fn fold_angles<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let table = |this: &Self| {
            let sheet = &this.native().sheet;
            let frames = this.native().frames.iter();
            let angles = frames.map(|frame| sheet::fold_angles(sheet, &frame.positions));
            this.table(sheet.edges.len(), angles)
        };
        borrowed(slf, |this| this.fold_angles.get_or_init(|| table(this)))
    }

    /// The strain of each triangle in each frame, (frames, faces) ndarray of float64: the largest \|l / l₀ − 1\| of its
    /// edges, with l₀ the length in the crease pattern, in percent; NaN in a file that is not a flat crease pattern.
    #[getter]
    fn strain<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let table = |this: &Self| {
            let mut strain = this.of_triangles(Quantity::Strain);
            if let Origin::File { motion, .. } = &this.origin
                && !motion.has_rest_lengths()
            {
                strain.fill(f64::NAN);
            }
            strain
        };
        borrowed(slf, |this| this.strain.get_or_init(|| table(this)))
    }

    /// The bend of the facet of each triangle in each frame, (frames, faces) ndarray of float64 in degrees: the largest
    /// \|fold angle\| of its edges inside the facet.
    #[getter]
    fn bending<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        borrowed(slf, |this| this.bending.get_or_init(|| this.of_triangles(Quantity::Bending)))
    }

    /// The vertices of the flat sheet, (vertices, 2) ndarray of float64.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        sheet::plane(py, &self.native().sheet.vertices)
    }

    /// The vertices of each triangle, (faces, 3) ndarray of uint32.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        sheet::faces(py, &self.native().sheet)
    }

    /// The vertices of each edge, (edges, 2) ndarray of uint32.
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        sheet::edges(py, &self.native().sheet)
    }

    /// The letter of each edge as in FOLD, (edges,) ndarray of str.
    #[getter]
    fn assignment<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        sheet::assignment(py, &self.native().sheet)
    }

    fn __len__(&self) -> usize {
        self.native().frames.len()
    }

    fn __repr__(&self) -> String {
        let motion = self.native();
        let (frames, vertices) = (motion.frames.len(), motion.sheet.vertices.len());
        format!("<foldmotion.Motion {frames} frames, {vertices} vertices>")
    }
}

/// Read the motion of a FOLD file with frames.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file. Without ``foldmotion:time`` its frames become one stage with evenly spaced times from 1 to 2.
/// progress : callable, optional
///     As in :meth:`Study.run`.
///
/// Returns
/// -------
/// Motion
///
/// Raises
/// ------
/// BadInput
///     The file cannot be read, or has no motion.
#[pyfunction]
#[pyo3(signature = (path, *, progress=None))]
pub(crate) fn read_fold(
    py: Python<'_>,
    path: PathBuf,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Motion> {
    let supervision = Supervision::new(py, progress, None)?;
    let opened = supervision.run(py, |progress| OpenedFile::read(&path, progress))?;
    match opened {
        OpenedFile::Motion(motion) => Ok(Motion::new(Origin::File { motion, path })),
        OpenedFile::Scene(_) => Err(no_motion(py, &path)),
    }
}

fn no_motion(py: Python<'_>, path: &Path) -> PyErr {
    let message = format!(
        "{}: the file has no motion; to fold a crease pattern use foldmotion.fold_pattern",
        path.display()
    );
    bad_input(py, message)
}
