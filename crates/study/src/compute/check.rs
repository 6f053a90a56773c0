//! The collision check of a motion as it was computed.

use foldmotion_check::{CheckError, Checker, CollisionReport};
use foldmotion_pattern::{Frame, LayerOrder, Motion};

use super::engine::Computed;
use super::folded::Findings;
use crate::{Phase, Progress, Study, StudyError};

impl Study {
    /// The motion where it is shown.
    pub(crate) fn place(&self, mut frames: Vec<Frame>) -> Motion {
        self.subject.place(&mut frames);
        Motion {
            sheet: self.subject.sheet().clone(),
            frames,
            compact_order: self.subject.compact_order().cloned().unwrap_or_default(),
        }
    }

    pub(crate) fn check(
        &self,
        motion: &Motion,
        computed: &Computed,
        progress: Progress<'_>,
    ) -> Result<Findings, StudyError> {
        let (collision, layer_orders) = self.judge(motion, progress)?;
        Ok(Findings {
            series: self.series(motion, computed, &collision.separation_series),
            collision,
            layer_orders,
        })
    }

    /// The verdict, and the order of the layers at every frame that has some.
    ///
    /// Where the check stops early, later frames get no order. The order is claimed as the motion file will claim it, so that its check gives the same certificate. In the
    /// compact frame of a motion without penetration, layers a gap apart lie in the exact order.
    fn judge(
        &self,
        motion: &Motion,
        progress: Progress<'_>,
    ) -> Result<(CollisionReport, Vec<(usize, LayerOrder)>), StudyError> {
        let mut orders = Vec::new();
        let mut checker: Option<Checker<'_>> = None;
        for (index, frame) in motion.frames.iter().enumerate() {
            if !progress(Phase::Check, index as f64 / motion.frames.len() as f64) {
                return Err(CheckError::Cancelled { intervals: index }.into());
            }
            let mut judged = match checker {
                Some(mut checker) => {
                    checker.advance(frame)?;
                    checker
                }
                None => Checker::new(&motion.sheet, frame, &self.collision)?,
            };
            if judged.is_stopped() {
                checker = Some(judged);
                break;
            }
            let mut order = judged.layer_order();
            let is_last = index + 1 == motion.frames.len();
            if is_last && frame.time == 2.0 && judged.is_clean() {
                for (f, g, sign) in judged.without_false(&motion.compact_order).iter() {
                    if order.sign(f, g).is_none() {
                        order.insert(f, g, sign);
                    }
                }
            }
            judged.claim(&order, &|triangle| triangle)?;
            if !order.is_empty() {
                orders.push((index, order));
            }
            checker = Some(judged);
        }
        progress(Phase::Check, 1.0);
        let checker = checker.ok_or(CheckError::NoFrames)?;
        Ok((checker.finish(), orders))
    }
}
