//! Opening files and judging motions.

use std::path::PathBuf;
use std::sync::Arc;

use foldmotion_study::{Certificate, CheckOptions, Findings, Opened, OpenedMotion};

use super::{Job, Wake};

/// What is proved of a motion file.
#[derive(Debug)]
pub(crate) struct Judged {
    /// What was found.
    pub(crate) findings: Arc<Findings>,
    /// The same as a certificate.
    pub(crate) certificate: Certificate,
}

/// Reads the file at `path`, whatever it is.
pub(crate) fn open(path: PathBuf, wake: Wake) -> Job<Opened> {
    Job::start("foldmotion open", wake, move |ticket| {
        let progress = |phase, done| ticket.progress(phase, done);
        Ok(Opened::read(&path, &progress)?)
    })
}

/// Judges a motion that was opened.
pub(crate) fn judge(motion: Arc<OpenedMotion>, wake: Wake) -> Job<Judged> {
    Job::start("foldmotion check", wake, move |ticket| {
        let progress = |phase, done| ticket.progress(phase, done);
        let (findings, certificate) = motion.check(&CheckOptions::default(), &progress)?;
        Ok(Judged {
            findings: Arc::new(findings),
            certificate,
        })
    })
}
