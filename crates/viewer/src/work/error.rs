//! What can go wrong in the background.

use std::any::Any;

use foldmotion_solver::SolverError;
use foldmotion_study::StudyError;

use crate::error::panic_message;

/// Why a worker has no result.
#[derive(Debug, thiserror::Error)]
pub(crate) enum WorkError {
    /// The study failed.
    #[error("{0}")]
    Study(StudyError),
    /// The sheet cannot be taken in the hand.
    #[error("the sheet cannot be moved by hand: {0}")]
    Interaction(#[from] SolverError),
    /// The user stopped it.
    #[error("stopped")]
    Stopped,
    /// No thread can be started.
    #[error("no thread can be started for it: {message}; close other programs")]
    Thread {
        /// What the system said.
        message: String,
    },
    /// A fault of this program.
    #[error("a fault of this program ended it: {message}; please report it with the scene")]
    Panic {
        /// What the panic said.
        message: String,
    },
}

impl WorkError {
    /// Of a panic's payload.
    pub(super) fn of_panic(payload: &(dyn Any + Send)) -> Self {
        Self::Panic {
            message: panic_message(payload),
        }
    }

    /// The dotted key of the scene at fault, where it is one's.
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
