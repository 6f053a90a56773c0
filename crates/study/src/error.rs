//! What can go wrong between a scene file and its results, and the exit status it means.

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
        /// Why.
        source: io::Error,
    },
    /// The scene is no TOML, or a key is unknown, missing or of the wrong type.
    #[error("{place}: {message}")]
    Parse {
        /// File, line and column, or the `--set` at fault.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// A value is not usable.
    #[error("{place}: {key}{value}: {message}")]
    Value {
        /// File and line.
        place: String,
        /// The key, dotted.
        key: String,
        /// ` = value`, or nothing where the key is absent.
        value: String,
        /// What is wrong and what would be right.
        message: String,
    },
    /// The profile cannot be divided into equal segments.
    #[error(
        "{place}: the profile cannot be divided into {segments} equal segments: |R_max| = {:.2} after {iterations} iterations; {remedy}",
        Number(*residual)
    )]
    Undivided {
        /// File and line.
        place: String,
        /// Nr.
        segments: usize,
        /// |R_max| reached.
        residual: f64,
        /// Iterations made.
        iterations: usize,
        /// What would help.
        remedy: &'static str,
    },
    /// A motion file cannot be judged.
    #[error("{}: {message}", path.display())]
    Motion {
        /// The motion file.
        path: PathBuf,
        /// What is wrong, where, and what would be right.
        message: String,
    },
    /// A certificate cannot be read.
    #[error("{}: {message}", path.display())]
    Certificate {
        /// The certificate.
        path: PathBuf,
        /// What is wrong, and what would be right.
        message: String,
    },
    /// A recorded file cannot be made again.
    #[error("{}: {message}", path.display())]
    SourceInfo {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what would help.
        message: String,
    },
    /// A file is too large.
    #[error("{}: it has {size} bytes: at most {limit} are read", path.display())]
    LargeFile {
        /// The file.
        path: PathBuf,
        /// Its bytes.
        size: u64,
        /// The most.
        limit: u64,
    },
    /// A file is no crease pattern that can be read.
    #[error("{}: {error}", path.display())]
    Import {
        /// The file.
        path: PathBuf,
        /// What is wrong, and with which element.
        error: Box<ImportError>,
    },
    /// The crease pattern cannot be put on paper as asked.
    #[error("the pattern: {0}")]
    Cut(#[from] CutError),
    /// The output folder or a file in it cannot be written.
    #[error("{}: {action}: {source}; choose another folder with --out, or free space", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// What was tried.
        action: &'static str,
        /// Why it failed.
        source: io::Error,
    },
    /// Files of others stand where results go.
    #[error(
        "{}: in the way of the results: {names}; no earlier `foldmotion {command}` made them there, or they were changed since: \
         move them, choose another folder with --out, or replace them with --force",
        path.display()
    )]
    Conflict {
        /// The output folder.
        path: PathBuf,
        /// The files.
        names: String,
        /// The command whose results they would be.
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
        /// What they need, estimated.
        needed: String,
        /// What each output needs.
        parts: String,
        /// What is free.
        available: String,
        /// What would make them fit.
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
    /// Ctrl-C.
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
            | Self::Cut(_)
            | Self::Conflict { .. }
            | Self::Undivided { .. } => 2,
            _ => 3,
        }
    }

    /// The dotted key of the scene at fault, where it is one's.
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
