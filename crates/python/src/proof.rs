//! Checks of motions and second proofs of certificates.

use std::path::{Path, PathBuf};

use foldmotion_study::{
    CheckOptions, CheckedFile, Progress, StudyError, VerifiedCertificate, check_file, verify_file,
};
use pyo3::prelude::*;

use crate::document::document;
use crate::error::{bad_input, failed};
use crate::motion::{Motion, Origin};
use crate::result::Result as RunResult;
use crate::supervised::Supervision;

/// A motion to be checked: a file, or a run whose motion file is written for the check.
enum Subject<'py> {
    File(PathBuf),
    Motion(Bound<'py, Motion>),
}

impl<'py> Subject<'py> {
    fn of(object: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Ok(result) = object.cast::<RunResult>() {
            return Ok(Self::Motion(result.get().motion_object().bind(object.py()).clone()));
        }
        if let Ok(motion) = object.cast::<Motion>() {
            return Ok(Self::Motion(motion.clone()));
        }
        object.extract().map(Self::File).map_err(|_| {
            bad_input(object.py(), "motion: expected a FOLD file, a motion or a result")
        })
    }

    /// Does `job` with the motion file.
    fn with_file<T: Send>(
        &self,
        py: Python<'_>,
        supervision: &Supervision,
        job: impl FnOnce(&Path, Progress<'_>) -> Result<T, StudyError> + Send,
    ) -> PyResult<T> {
        let motion = match self {
            Self::File(path) => return supervision.run(py, |progress| job(path, progress)),
            Self::Motion(motion) => motion.get(),
        };
        match motion.origin() {
            Origin::File { path, .. } => supervision.run(py, |progress| job(path, progress)),
            Origin::Run { study, folded } => {
                let folder = tempfile::tempdir().map_err(failed)?;
                let path = folder.path().join("motion.fold");
                supervision.run(py, |progress| {
                    study.write_motion(folded, &path)?;
                    job(&path, progress)
                })
            }
        }
    }
}

/// Decide whether a motion passes through itself.
///
/// Parameters
/// ----------
/// motion : str, os.PathLike, Motion or Result
///     A FOLD file with frames, a motion that was read from one, or a result, which is checked again.
/// tolerance : float, optional
///     Facets that overlap by no more than this touch, in unit lengths; above 0 and below 0.1. Default: 1e-6.
/// stop_at : int, optional
///     The check ends at the next frame once more than this many pairs penetrate; 0 means no limit. Default: 4096.
/// progress, threads
///     As in :meth:`Study.run`.
///
/// Returns
/// -------
/// Certificate
///     What was proved; ``certificate.verdict`` is free, touching, penetrating or undecided.
///
/// Raises
/// ------
/// BadInput
///     The file is not a motion that can be checked.
#[pyfunction]
#[pyo3(signature = (motion, *, tolerance=None, stop_at=None, progress=None, threads=None))]
pub(crate) fn check<'py>(
    py: Python<'py>,
    motion: &Bound<'py, PyAny>,
    tolerance: Option<f64>,
    stop_at: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
    threads: Option<usize>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut options = CheckOptions::default();
    if let Some(tolerance) = tolerance {
        if !(tolerance > 0.0 && tolerance < 0.1) {
            let message =
                format!("tolerance = {tolerance}: expected a number above 0 and below 0.1");
            return Err(bad_input(py, message));
        }
        options.tolerance = tolerance;
    }
    options.stop_at = stop_at.unwrap_or(options.stop_at);
    let supervision = Supervision::new(py, progress, threads)?;
    let checked: CheckedFile =
        Subject::of(motion)?
            .with_file(py, &supervision, |path, progress| check_file(path, &options, progress))?;
    document(py, "Certificate", &checked.certificate.to_json())
}

/// Prove the statement of a certificate again, by a second method.
///
/// Parameters
/// ----------
/// motion : str, os.PathLike, Motion or Result
///     The motion that the certificate is about.
/// certificate : str, os.PathLike or Certificate
///     ``certificate.json``, or a certificate of this package.
/// progress, threads
///     As in :meth:`Study.run`.
///
/// Returns
/// -------
/// Verification
///
/// Raises
/// ------
/// BadInput
///     The motion or the certificate cannot be read.
#[pyfunction]
#[pyo3(signature = (motion, certificate, *, progress=None, threads=None))]
pub(crate) fn verify(
    py: Python<'_>,
    motion: &Bound<'_, PyAny>,
    certificate: &Bound<'_, PyAny>,
    progress: Option<Bound<'_, PyAny>>,
    threads: Option<usize>,
) -> PyResult<Verification> {
    let supervision = Supervision::new(py, progress, threads)?;
    let folder = tempfile::tempdir().map_err(failed)?;
    let path = if let Ok(path) = certificate.extract::<PathBuf>() {
        path
    } else {
        let path = folder.path().join("certificate.json");
        let json = certificate.call_method0("to_json");
        let json = json
            .and_then(|json| json.extract::<String>())
            .map_err(|_| bad_input(py, "certificate: expected a file or a certificate"))?;
        std::fs::write(&path, json).map_err(failed)?;
        path
    };
    let verified = Subject::of(motion)?
        .with_file(py, &supervision, |motion, progress| verify_file(motion, &path, progress))?;
    Ok(Verification { verified })
}

/// What the second proof says of a certificate.
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Verification {
    verified: VerifiedCertificate,
}

#[pymethods]
impl Verification {
    /// Whether every claim of the certificate was proved.
    #[getter]
    fn is_verified(&self) -> bool {
        let verification = &self.verified.verification;
        verification.refuted.is_empty() && verification.unproved.is_empty()
    }

    /// The exit status of ``foldmotion check --verify``: 0 or 1 verified, 2 false, 3 not verified.
    #[getter]
    fn status(&self) -> u8 {
        self.verified.status()
    }

    /// The result on one line.
    #[getter]
    fn line(&self) -> String {
        self.verified.line()
    }

    /// The certificate that was verified.
    #[getter]
    fn certificate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        document(py, "Certificate", &self.verified.certificate.to_json())
    }

    fn __str__(&self) -> String {
        self.verified.table()
    }

    fn __repr__(&self) -> String {
        format!("<foldmotion.Verification {}>", self.verified.line())
    }
}
