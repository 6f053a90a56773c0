//! Errors of background jobs.

use std::any::Any;

use foldmotion_solver::SolverError;
use foldmotion_study::StudyError;

use crate::error::panic_message;

/// Why a job has no result.
#[derive(Debug, thiserror::Error)]
pub(crate) enum WorkError {
    /// The study failed.
    #[error("{0}")]
    Study(StudyError),
    /// The engine cannot move the sheet by hand.
    #[error("the sheet cannot be moved by hand: {0}")]
    Interaction(#[from] SolverError),
    /// The user stopped the job.
    #[error("stopped")]
    Stopped,
    /// The system cannot start a thread.
    #[error("cannot start a thread: {message}; close other programs")]
    Thread {
        /// The error of the system.
        message: String,
    },
    /// A bug in this program.
    #[error("internal error: {message}; please report it together with the scene")]
    Panic {
        /// The message of the panic.
        message: String,
    },
}

impl WorkError {
    /// The error for the payload of a panic.
    pub(super) fn of_panic(payload: &(dyn Any + Send)) -> Self {
        Self::Panic {
            message: panic_message(payload),
        }
    }

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
