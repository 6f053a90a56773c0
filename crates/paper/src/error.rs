//! Errors of the paper, and the exit status of each.

use foldmotion_check::CheckError;
use foldmotion_geometry::GeometryError;
use foldmotion_pattern::PatternError;
use foldmotion_record::RecordError;
use foldmotion_study::StudyError;
use thiserror::Error;

/// Errors of tables and figures.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PaperError {
    /// A study failed, or the folder cannot be written.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A name is not that of a part of the paper.
    #[error("{name:?} is not a part of the paper; the parts are: {known}")]
    Part {
        /// The name that was given.
        name: String,
        /// The names of all parts.
        known: String,
    },
    /// A name is not that of a built-in profile.
    #[error("{0:?} is not a built-in profile")]
    Model(String),
    /// A profile cannot be divided.
    #[error("{model}: {source}")]
    Geometry {
        /// The built-in profile.
        model: String,
        /// The error of the division or the sheet.
        source: GeometryError,
    },
    /// A sheet of units cannot be laid out.
    #[error("{what}: {source}")]
    Pattern {
        /// The profile or figure it is for.
        what: String,
        /// The error of the division or the sheet.
        source: PatternError,
    },
}

impl PaperError {
    /// The error of an interrupted run.
    pub(crate) const INTERRUPTED: Self = Self::Study(StudyError::Interrupted);

    pub(crate) fn model(name: &str) -> Self {
        Self::Model(name.to_owned())
    }

    pub(crate) fn geometry(model: &str, source: GeometryError) -> Self {
        let model = model.to_owned();
        Self::Geometry { model, source }
    }

    pub(crate) fn pattern(what: impl Into<String>, source: PatternError) -> Self {
        let what = what.into();
        Self::Pattern { what, source }
    }

    /// The exit status: 2 bad input or usage, 3 the run failed.
    pub fn status(&self) -> u8 {
        match self {
            Self::Study(error) => error.status(),
            Self::Part { .. } => 2,
            _ => 3,
        }
    }
}

impl From<CheckError> for PaperError {
    fn from(error: CheckError) -> Self {
        Self::Study(error.into())
    }
}

impl From<RecordError> for PaperError {
    fn from(error: RecordError) -> Self {
        Self::Study(error.into())
    }
}
