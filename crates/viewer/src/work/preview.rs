//! A quick look at the motion of a scene.

use std::sync::Arc;

use foldmotion_study::{Preview, Study};

use super::{Job, Wake};

/// Folds the sheet of `study` quickly, without contact; nothing is checked.
pub(crate) fn preview(study: Arc<Study>, wake: Wake) -> Job<Preview> {
    Job::start("foldmotion preview", wake, move |ticket| {
        Ok(study.preview(&|phase, done| ticket.progress(phase, done))?)
    })
}
