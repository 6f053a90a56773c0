//! Errors between a scene file and its results, and the exit status of each.

use std::io;
use std::path::PathBuf;

use foldmotion_check::CheckError;
use foldmotion_geometry::Number;
use foldmotion_pattern::{CutError, ImportError};
use foldmotion_record::RecordError;
use foldmotion_solver::SolverError;
use thiserror::Error;

/// Errors of a study. Each names the file, the line or key, the value and the remedy.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The scene file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The scene file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The scene is not valid TOML, or a key is unknown, missing or of the wrong type.
    #[error("{location}: {message}")]
    Parse {
        /// File, line and column, or the `--set` that is wrong.
        location: String,
        /// What is wrong.
        message: String,
    },
    /// A value cannot be used.
    #[error("{location}: {key}{value}: {message}")]
    Value {
        /// The file and the line.
        location: String,
        /// The dotted key, such as `sheet.columns`.
        key: String,
        /// ` = value`, or empty if the key is absent.
        value: String,
        /// What is wrong, and which values are valid.
        message: String,
    },
    /// The profile cannot be divided into equal segments.
    #[error(
        "{location}: the profile cannot be divided into {segments} equal segments: |R_max| = {:.2} after {iterations} iterations; {remedy}",
        Number(*residual)
    )]
    Undivided {
        /// The file and the line.
        location: String,
        /// Nr, the number of segments.
        segments: usize,
        /// The |R_max| that was reached.
        residual: f64,
        /// The number of iterations.
        iterations: usize,
        /// What to change.
        remedy: &'static str,
    },
    /// A motion file cannot be checked.
    #[error("{}: {message}", path.display())]
    Motion {
        /// The motion file.
        path: PathBuf,
        /// What is wrong and where, and what to change.
        message: String,
    },
    /// A certificate cannot be read.
    #[error("{}: {message}", path.display())]
    Certificate {
        /// The certificate.
        path: PathBuf,
        /// What is wrong, and what to change.
        message: String,
    },
    /// A recorded file cannot be reproduced.
    #[error("{}: {message}", path.display())]
    SourceInfo {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what to change.
        message: String,
    },
    /// A file is too large.
    #[error("{}: the file has {size} bytes; the limit is {limit}", path.display())]
    LargeFile {
        /// The file.
        path: PathBuf,
        /// Its size in bytes.
        size: u64,
        /// The largest size in bytes.
        limit: u64,
    },
    /// A file is not a crease pattern that can be read.
    #[error("{}: {error}", path.display())]
    Import {
        /// The file.
        path: PathBuf,
        /// What is wrong, and with which element.
        error: Box<ImportError>,
    },
    /// A file is neither a scene nor a crease pattern.
    #[error("{}: this is no scene (TOML); {error}", path.display())]
    Unrecognised {
        /// The file.
        path: PathBuf,
        /// Which crease patterns are read.
        error: Box<ImportError>,
    },
    /// The crease pattern cannot be drawn on paper with these options.
    #[error("the pattern: {0}")]
    Cut(#[from] CutError),
    /// The output folder or a file in it cannot be written.
    #[error("{}: {action}: {source}; choose another folder with --out, or free space", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// What failed, such as "cannot be written".
        action: &'static str,
        /// The error of the operating system.
        source: io::Error,
    },
    /// Files that foldmotion did not make have names of results.
    #[error(
        "{}: these files have names of results, but `foldmotion {command}` did not make them, or they were changed since: {names}; \
         move them, choose another folder with --out, or replace them with --force",
        path.display()
    )]
    Conflict {
        /// The output folder.
        path: PathBuf,
        /// The names of the files.
        names: String,
        /// The command that would write them.
        command: &'static str,
    },
    /// The disk cannot hold the results.
    #[error(
        "{}: the results need about {needed} ({parts}), but only {available} are free: {remedy}, or choose another folder with \
         --out",
        path.display()
    )]
    DiskTooSmall {
        /// The output folder.
        path: PathBuf,
        /// The estimated size of the results.
        needed: String,
        /// The estimated size of each output.
        parts: String,
        /// The free space.
        available: String,
        /// What makes the results smaller.
        remedy: String,
    },
    /// The engine failed.
    #[error("the motion could not be computed: {0}")]
    Solver(SolverError),
    /// The check failed.
    #[error("the motion could not be checked: {0}")]
    Check(CheckError),
    /// The film failed.
    #[error("the motion could not be recorded: {0}")]
    Record(RecordError),
    /// The user interrupted the command.
    #[error("interrupted; earlier results are untouched")]
    Interrupted,
}

impl StudyError {
    /// The exit status: 2 bad input or usage, 3 the run failed.
    pub fn status(&self) -> u8 {
        match self {
            Self::Read { .. }
            | Self::Parse { .. }
            | Self::Motion { .. }
            | Self::Certificate { .. }
            | Self::SourceInfo { .. }
            | Self::LargeFile { .. }
            | Self::Value { .. }
            | Self::Import { .. }
            | Self::Unrecognised { .. }
            | Self::Cut(_)
            | Self::Conflict { .. }
            | Self::Undivided { .. } => 2,
            _ => 3,
        }
    }

    /// The dotted scene key that the error is about, if there is one.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Value { key, .. } => Some(key),
            Self::Undivided { .. } => Some("division"),
            Self::Import { .. } => Some("pattern.file"),
            _ => None,
        }
    }
}

impl From<SolverError> for StudyError {
    fn from(error: SolverError) -> Self {
        match error {
            SolverError::Cancelled { .. } => Self::Interrupted,
            other => Self::Solver(other),
        }
    }
}

impl From<CheckError> for StudyError {
    fn from(error: CheckError) -> Self {
        match error {
            CheckError::Cancelled { .. } => Self::Interrupted,
            other => Self::Check(other),
        }
    }
}

impl From<RecordError> for StudyError {
    fn from(error: RecordError) -> Self {
        match error {
            RecordError::Interrupted => Self::Interrupted,
            other => Self::Record(other),
        }
    }
}
