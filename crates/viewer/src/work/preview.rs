//! Previews of motions.

use std::sync::Arc;

use foldmotion_study::{Preview, Study};

use super::{Job, RepaintSignal};

/// Folds the sheet of `study` quickly, without contact and without a check.
pub(crate) fn preview(study: Arc<Study>, repaint: RepaintSignal) -> Job<Preview> {
    Job::start("foldmotion preview", repaint, move |report| {
        Ok(study.preview(&|phase, done| report(phase, done))?)
    })
}
