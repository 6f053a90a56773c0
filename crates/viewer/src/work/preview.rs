//! A quick look at the motion of a scene.

use std::sync::Arc;

use foldmotion_study::{Preview, Study};

use super::{Job, RepaintSignal};

/// Folds the sheet of `study` quickly, without contact; nothing is checked.
pub(crate) fn preview(study: Arc<Study>, repaint: RepaintSignal) -> Job<Preview> {
    Job::start("foldmotion preview", repaint, move |context| {
        Ok(study.preview(&|phase, done| context.report(phase, done))?)
    })
}
