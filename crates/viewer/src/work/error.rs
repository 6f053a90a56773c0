//! Errors of background jobs.

use foldmotion_solver::SolverError;
use foldmotion_study::StudyError;

/// Why a job has no result.
#[derive(Debug, thiserror::Error)]
pub(crate) enum WorkError {
    #[error("{0}")]
    Study(StudyError),
    /// The engine cannot move the sheet by hand.
    #[error("the sheet cannot be moved by hand: {0}")]
    Interaction(#[from] SolverError),
    #[error("stopped")]
    Stopped,
    /// The system cannot start a thread.
    #[error("cannot start a thread: {message}; close other programs")]
    Thread { message: String },
    /// A bug in this program.
    #[error("internal error: {message}; please report it together with the scene")]
    Panic { message: String },
}

impl WorkError {
    /// The dotted key of the scene that is wrong, if the error belongs to one.
    pub(crate) fn key(&self) -> Option<&str> {
        match self {
            Self::Study(error) => error.key(),
            _ => None,
        }
    }
}

impl From<StudyError> for WorkError {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Interrupted => Self::Stopped,
            other => Self::Study(other),
        }
    }
}
