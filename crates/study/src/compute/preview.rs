//! A preview of a motion: folded in equilibrium without contact, and not checked.

use foldmotion_check::FittedBox;
use foldmotion_pattern::Motion;
use foldmotion_solver::Budget;

use crate::resolve::budget::MotionBudget;
use crate::resolve::subject::Subject;
use crate::scene::EngineChoice;
use crate::{FrameFigures, Phase, Study, StudyError, Watch};

/// The number of frames of a preview, enough for a smooth display.
const FRAMES: usize = 120;
/// The preview of a pattern from a file ends after so many seconds, wherever it is: with 10 000 triangles, half way.
const MOST_SECONDS: f64 = 4.0;

/// A motion for display only.
#[derive(Debug, Clone)]
pub struct Preview {
    /// The motion, placed as it is displayed.
    pub motion: Motion,
    /// Strain, bending and energy of each frame; separations are unknown.
    pub series: Vec<FrameFigures>,
    /// The bounding box of each frame.
    pub boxes: Vec<FittedBox>,
}

impl Study {
    /// Folds the sheet as quickly as possible: quasi-static, without contact, with few frames.
    ///
    /// The result is the motion of this study with `motion.contact = false`; that of a pattern from a file as far as four
    /// seconds lead. It is for display only: nothing is proved about it.
    ///
    /// # Errors
    /// [`StudyError`] of the engine; [`StudyError::Interrupted`] if `watch` stopped it.
    pub fn preview(&self, watch: &dyn Watch) -> Result<Preview, StudyError> {
        let quick = Self {
            engine: EngineChoice::QuasiStatic,
            contact: None,
            frames: FRAMES,
            ..self.clone()
        };
        let start = self.subject.start_time();
        let times = self.subject.times_of_interest();
        let budget = match self.subject {
            Subject::Units(_) => Budget::Standard,
            Subject::Imported(_) => MotionBudget::Seconds(MOST_SECONDS).start(),
        };
        let mut computed = quick.fold(&times, budget, &|moment| {
            watch.state(moment);
            watch.progress(Phase::Fold, (moment.time - start) / (2.0 - start))
        })?;
        let motion = quick.place(std::mem::take(&mut computed.frames));
        Ok(Preview {
            series: quick.series(&motion, &computed, &[]),
            boxes: quick.boxes(&motion),
            motion,
        })
    }
}
