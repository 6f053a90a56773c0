//! Opening files and judging motions.

use std::path::PathBuf;
use std::sync::Arc;

use foldmotion_study::{Certificate, CheckOptions, Findings, Opened, OpenedMotion};

use super::{Job, RepaintSignal};

/// What is proved of a motion file.
#[derive(Debug)]
pub(crate) struct CheckedMotion {
    /// What was found.
    pub(crate) findings: Arc<Findings>,
    /// The same as a certificate.
    pub(crate) certificate: Certificate,
}

/// Reads the file at `path`, whatever it is.
pub(crate) fn open(path: PathBuf, repaint: RepaintSignal) -> Job<Opened> {
    Job::start("foldmotion open", repaint, move |context| {
        let progress = |phase, done| context.report(phase, done);
        Ok(Opened::read(&path, &progress)?)
    })
}

/// Judges a motion that was opened.
pub(crate) fn check_motion(
    motion: Arc<OpenedMotion>,
    repaint: RepaintSignal,
) -> Job<CheckedMotion> {
    Job::start("foldmotion check", repaint, move |context| {
        let progress = |phase, done| context.report(phase, done);
        let (findings, certificate) = motion.check(&CheckOptions::default(), &progress)?;
        Ok(CheckedMotion {
            findings: Arc::new(findings),
            certificate,
        })
    })
}
