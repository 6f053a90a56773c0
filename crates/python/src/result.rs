//! `Result`: a folded and checked motion, with what can be written of it.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use foldmotion_study::report::OutcomeKind;
use foldmotion_study::scene::{OutputChoice, RecordScene, parse_choice};
use foldmotion_study::{Destination, Folded, SceneSource, Study as NativeStudy, StudyError};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use toml::{Table, Value};

use crate::document::document;
use crate::error::{bad_input, exception, failed};
use crate::motion::{Motion, Origin};
use crate::pattern::Pattern;
use crate::scene::Scene;
use crate::series::Series;
use crate::sheet;
use crate::supervised::Supervision;
use crate::value::table;

/// The height of a page in a notebook, in pixels.
const FRAME_HEIGHT: u32 = 640;

/// A folded sheet with what was proved about it. Nothing is written until it is asked for.
///
/// It does not change, and several threads may use it. In notebooks ``_repr_html_`` shows the motion as an offline page
/// in a sandboxed frame.
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Result {
    source: SceneSource,
    study: Arc<NativeStudy>,
    folded: Arc<Folded>,
    motion: Py<Motion>,
}

impl Result {
    pub(crate) fn new(
        py: Python<'_>,
        source: SceneSource,
        study: Arc<NativeStudy>,
        folded: Folded,
    ) -> PyResult<Self> {
        let folded = Arc::new(folded);
        let origin = Origin::Run { study: Arc::clone(&study), folded: Arc::clone(&folded) };
        let motion = Py::new(py, Motion::new(origin))?;
        Ok(Self { source, study, folded, motion })
    }

    pub(crate) fn motion_object(&self) -> &Py<Motion> {
        &self.motion
    }

    /// The scene's `[record]` with `settings` and other outputs.
    fn record_scene(
        &self,
        py: Python<'_>,
        outputs: &[OutputChoice],
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<RecordScene> {
        let scene = self.source.scene().map_err(|e| exception(py, &e))?;
        let mut record = Table::try_from(&scene.record).map_err(failed)?;
        if let Some(settings) = settings {
            record.extend(table(settings)?);
        }
        let record: std::result::Result<RecordScene, _> = Value::Table(record).try_into();
        let record = record.map_err(|error: toml::de::Error| bad_input(py, error.message()))?;
        Ok(RecordScene { outputs: Some(outputs.to_vec()), ..record })
    }

    /// Records one output into a folder of its own and hands its file `name` to `take`.
    fn one_file<T: Send>(
        &self,
        py: Python<'_>,
        output: OutputChoice,
        name: &str,
        settings: Option<&Bound<'_, PyDict>>,
        home: Option<&Path>,
        take: impl FnOnce(&Path) -> io::Result<T> + Send,
    ) -> PyResult<T> {
        let record = self.record_scene(py, &[output], settings)?;
        let folder = home.map_or_else(tempfile::tempdir, tempfile::tempdir_in);
        let unwritable = |source| {
            let path = home.unwrap_or(Path::new("")).to_owned();
            StudyError::Output { path, action: "cannot be written", source }
        };
        let folder = folder.map_err(|source| exception(py, &unwritable(source)))?;
        Supervision::new(py, None, None)?.run(py, |progress| {
            self.study.record_as(&self.folded, &record, folder.path(), progress)?;
            take(&folder.path().join(name)).map_err(unwritable)
        })
    }

    /// Records one output as the file `path`.
    fn write_file(
        &self,
        py: Python<'_>,
        output: OutputChoice,
        name: &str,
        path: &Path,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        let home = path.parent().filter(|home| !home.as_os_str().is_empty());
        let home = home.unwrap_or(Path::new("."));
        self.one_file(py, output, name, settings, Some(home), |file| std::fs::rename(file, path))
    }
}

#[pymethods]
impl Result {
    /// The scene that was run.
    #[getter]
    fn scene(&self) -> Scene {
        Scene::new(self.source.clone())
    }

    /// The frames of the motion, as arrays.
    #[getter]
    fn motion(&self, py: Python<'_>) -> Py<Motion> {
        self.motion.clone_ref(py)
    }

    /// The crease pattern.
    #[getter]
    fn pattern(&self) -> Pattern {
        Pattern::new(self.source.clone(), Arc::clone(&self.study))
    }

    /// The vertices of each triangle, (faces, 3) ndarray of uint32.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        sheet::faces(py, &self.folded.motion.sheet)
    }

    /// The vertices of each edge, (edges, 2) ndarray of uint32.
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        sheet::edges(py, &self.folded.motion.sheet)
    }

    /// The letter of each edge as in FOLD, (edges,) ndarray of str.
    #[getter]
    fn assignment<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        sheet::assignment(py, &self.folded.motion.sheet)
    }

    /// How the motion ended: folded, jammed, stopped, not-converged, collides or undecided.
    #[getter]
    fn outcome(&self) -> &'static str {
        match self.folded.outcome.kind {
            OutcomeKind::Folded => "folded",
            OutcomeKind::Jammed => "jammed",
            OutcomeKind::Stopped => "stopped",
            OutcomeKind::NotConverged => "not-converged",
            OutcomeKind::Collides => "collides",
            OutcomeKind::Undecided => "undecided",
        }
    }

    /// The outcome with its reason, on one line, as the command line prints it.
    #[getter]
    fn line(&self) -> String {
        self.folded.outcome.line()
    }

    /// Whether the sheet passes through itself: free, touching, penetrating or undecided.
    #[getter]
    fn verdict(&self) -> &'static str {
        self.folded.findings.collision.verdict.name()
    }

    /// The exit status of ``foldmotion run``: 0 folded, 1 collides, 3 anything else.
    #[getter]
    fn status(&self) -> u8 {
        self.folded.outcome.status()
    }

    /// The report: what ``report.json`` says, before any files are written.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let json = py.detach(|| self.study.report_of(&self.folded).to_json());
        document(py, "Report", &json)
    }

    /// The certificate of the motion, as it is written next to its motion file.
    #[getter]
    fn certificate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let certificate = py.detach(|| self.study.certificate_of(&self.folded));
        document(py, "Certificate", &certificate.map_err(|e| exception(py, &e))?.to_json())
    }

    /// Strain, bending, energy and separation of each frame.
    ///
    /// Returns
    /// -------
    /// Series
    ///     A table that pandas, polars and pyarrow take over by Arrow's PyCapsule interface.
    fn series(&self) -> PyResult<Series> {
        Series::new(&self.folded.findings.series)
    }

    /// Raise the exception of a motion that did not come to a decided end; a penetration is a result and raises nothing.
    ///
    /// Raises
    /// ------
    /// Jammed, Stopped, DidNotConverge, Undecided
    ///     With the line that the command line prints; its attribute ``result`` is this result.
    fn raise_for_outcome(slf: &Bound<'_, Self>) -> PyResult<()> {
        let outcome = &slf.get().folded.outcome;
        let name = match outcome.kind {
            OutcomeKind::Folded | OutcomeKind::Collides => return Ok(()),
            OutcomeKind::Jammed => "Jammed",
            OutcomeKind::Stopped => "Stopped",
            OutcomeKind::NotConverged => "DidNotConverge",
            OutcomeKind::Undecided => "Undecided",
        };
        let class = slf.py().import("foldmotion._errors")?.getattr(name)?;
        Err(PyErr::from_value(class.call1((outcome.line(), outcome.status(), slf))?))
    }

    /// Write the results of ``foldmotion run`` into a folder: the report and the outputs of the scene, with the same bytes.
    ///
    /// Parameters
    /// ----------
    /// folder : str or os.PathLike
    ///     Made if it does not exist. Files that foldmotion did not make are kept.
    /// force : bool, optional
    ///     Whether files that foldmotion did not make may be replaced.
    /// progress : callable, optional
    ///     As in :meth:`Study.run`.
    ///
    /// Returns
    /// -------
    /// Report
    ///     The report with the names of the files.
    ///
    /// Raises
    /// ------
    /// OutputError
    ///     A file cannot be written, or would replace one that foldmotion did not make.
    #[pyo3(signature = (folder, *, force=false, progress=None))]
    fn save<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
        force: bool,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let supervision = Supervision::new(py, progress, None)?;
        let report = supervision.run(py, |progress| {
            let destination = Destination::from(&folder).replacing(force);
            self.study.write(&self.folded, destination, progress)
        })?;
        document(py, "Report", &report.to_json())
    }

    /// Record outputs into a folder, with settings of your own.
    ///
    /// Parameters
    /// ----------
    /// folder : str or os.PathLike
    ///     Made if it does not exist.
    /// outputs : sequence of str
    ///     Of fold, gif, csv, mp4, png, svg, pdf, glb, obj, stl, html, vtk.
    /// **settings
    ///     Keys of the scene's ``[record]``, such as ``size=(640, 480)``, ``camera="front"``, ``fps=20``, ``caption=True``.
    ///     Default: those of the scene.
    ///
    /// Returns
    /// -------
    /// list of str
    ///     The names of the files.
    ///
    /// Raises
    /// ------
    /// BadInput
    ///     An output or a setting is unknown or cannot be used.
    /// OutputError
    ///     A file cannot be written.
    #[pyo3(signature = (folder, outputs, **settings))]
    fn record(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        outputs: Vec<String>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Vec<String>> {
        let outputs = outputs.iter().map(|name| parse_choice(name));
        let outputs: std::result::Result<Vec<OutputChoice>, String> = outputs.collect();
        let outputs = outputs.map_err(|error| bad_input(py, format!("outputs: {error}")))?;
        let record = self.record_scene(py, &outputs, settings)?;
        Supervision::new(py, None, None)?
            .run(py, |progress| self.study.record_as(&self.folded, &record, &folder, progress))
    }

    /// Write the film as GIF. `settings` as in :meth:`record`; so are those of the other ``write_`` methods.
    #[pyo3(signature = (path, **settings))]
    fn write_gif(
        &self,
        py: Python<'_>,
        path: PathBuf,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        self.write_file(py, OutputChoice::Gif, "motion.gif", &path, settings)
    }

    /// Write the film as MP4 (H.264).
    #[pyo3(signature = (path, **settings))]
    fn write_mp4(
        &self,
        py: Python<'_>,
        path: PathBuf,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        self.write_file(py, OutputChoice::Mp4, "motion.mp4", &path, settings)
    }

    /// Write states side by side as SVG.
    #[pyo3(signature = (path, **settings))]
    fn write_svg(
        &self,
        py: Python<'_>,
        path: PathBuf,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        self.write_file(py, OutputChoice::Svg, "figure.svg", &path, settings)
    }

    /// Write states side by side as PDF.
    #[pyo3(signature = (path, **settings))]
    fn write_pdf(
        &self,
        py: Python<'_>,
        path: PathBuf,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        self.write_file(py, OutputChoice::Pdf, "figure.pdf", &path, settings)
    }

    /// Write the motion as binary glTF, with morph targets.
    #[pyo3(signature = (path, **settings))]
    fn write_glb(
        &self,
        py: Python<'_>,
        path: PathBuf,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        self.write_file(py, OutputChoice::Glb, "motion.glb", &path, settings)
    }

    /// Write the motion with its report and certificate as one page for browsers.
    #[pyo3(signature = (path, **settings))]
    fn write_html(
        &self,
        py: Python<'_>,
        path: PathBuf,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        self.write_file(py, OutputChoice::Html, "motion.html", &path, settings)
    }

    /// Write the frames for ParaView and PyVista: ``motion.pvd`` and the folder ``vtk`` into the folder `folder`, with the
    /// fields strain_percent and facet_bending_deg.
    ///
    /// Returns
    /// -------
    /// list of str
    ///     The names of the files.
    fn write_vtk(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<String>> {
        self.record(py, folder, vec!["vtk".to_owned()], None)
    }

    /// The page of the motion in a sandboxed frame, for notebooks: no network, no extension.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let output = OutputChoice::Html;
        let page = self.one_file(py, output, "motion.html", None, None, |file| {
            std::fs::read_to_string(file)
        })?;
        let page = page.replace('&', "&amp;").replace('"', "&quot;");
        Ok(format!(
            "<iframe sandbox=\"allow-scripts\" style=\"width: 100%; border: 0\" height=\"{FRAME_HEIGHT}\" srcdoc=\"{page}\"></iframe>"
        ))
    }

    fn __repr__(&self) -> String {
        let (title, headline) = (&self.study.title, self.folded.outcome.headline());
        let frames = self.folded.motion.frames.len();
        format!("<foldmotion.Result {title}: {headline}, {}, {frames} frames>", self.verdict())
    }
}
