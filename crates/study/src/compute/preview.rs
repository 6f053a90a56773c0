//! A preview of a motion: folded in equilibrium without contact, and not checked.

use foldmotion_check::FittedBox;
use foldmotion_pattern::Motion;
use foldmotion_solver::Budget;

use crate::scene::EngineChoice;
use crate::{FrameFigures, Phase, Study, StudyError, Watch};

/// The number of frames of a preview, enough for a smooth display.
const FRAMES: usize = 120;

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
    /// The result is the motion of this study with `motion.contact = false`. It is for display only: nothing is proved about it.
    ///
    /// # Errors
    /// [`StudyError`] of the engine; [`StudyError::Interrupted`] if `watch` stopped it.
    pub fn preview(&self, watch: &dyn Watch) -> Result<Preview, StudyError> {
        let quick = Self {
            engine: EngineChoice::QuasiStatic,
            contact_gap: None,
            frames: FRAMES,
            ..self.clone()
        };
        let start = self.subject.start_time();
        let times = self.subject.times_of_interest();
        let mut computed = quick.fold(&times, Budget::Standard, &|moment| {
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use foldmotion_check::fitted_box;

    use super::*;
    use crate::SceneSource;

    #[test]
    fn a_preview_of_a_scene_with_contact_reaches_the_exact_compact_state() {
        let scene = "[profile]\nmodel = \"shelter\"\n[sheet]\ncase = \"SII\"\nlambda = 0.7\n";
        let source = SceneSource::new(Path::new("a.toml"), scene.to_owned());
        let study = Study::resolve(&source).unwrap();
        assert!(study.contact_gap.is_some());
        let Preview {
            motion,
            series,
            boxes,
        } = study.preview(&|_, _| true).unwrap();
        assert_eq!(series.len(), motion.frames.len());
        assert_eq!(boxes.len(), motion.frames.len());
        assert!(series.iter().all(|f| f.separation.is_nan()));
        let last = motion.frames.last().unwrap();
        assert_eq!(last.time, 2.0);
        let exact = study.subject.units().unwrap().units.compact();
        let rms = fitted_box(&last.positions, &exact).rms_to_exact.unwrap();
        assert!(rms < 1e-6, "{rms}");
        let closed_form = study.subject.closed_form().unwrap();
        let reached = boxes.last().unwrap();
        assert!((reached.volume / closed_form.volume - 1.0).abs() < 1e-5);
        let flat = motion.frames.iter().position(|f| f.time == 1.0).unwrap();
        assert!(boxes[flat].volume < 1e-9 * boxes[0].volume);
        assert!(matches!(
            study.preview(&|_, _| false),
            Err(StudyError::Interrupted)
        ));
    }
}
