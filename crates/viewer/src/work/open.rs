//! Opening files and checking motions.

use std::path::PathBuf;
use std::sync::Arc;

use foldmotion_study::{Certificate, CheckOptions, Findings, OpenedFile, OpenedMotion};

use super::{Job, RepaintSignal};

/// The result of checking a motion file.
#[derive(Debug)]
pub(crate) struct CheckedMotion {
    pub(crate) findings: Arc<Findings>,
    pub(crate) certificate: Certificate,
}

/// Reads a file: a scene, a crease pattern or a motion.
pub(crate) fn open(path: PathBuf, repaint: RepaintSignal) -> Job<OpenedFile> {
    Job::start("foldmotion open", repaint, move |report| Ok(OpenedFile::read(&path, report)?))
}

/// Checks a motion file.
pub(crate) fn check_motion(
    motion: Arc<OpenedMotion>,
    repaint: RepaintSignal,
) -> Job<CheckedMotion> {
    Job::start("foldmotion check", repaint, move |report| {
        let (findings, certificate) = motion.check(&CheckOptions::default(), report)?;
        Ok(CheckedMotion { findings: Arc::new(findings), certificate })
    })
}
