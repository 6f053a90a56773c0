//! The collision check of a computed motion.

use foldmotion_check::{CheckError, Checker, CollisionReport};
use foldmotion_pattern::{Frame, LayerOrder, Motion};

use super::engine::EngineRun;
use super::folded::Findings;
use crate::{Phase, Progress, Study, StudyError};

impl Study {
    /// The motion of `frames`, placed as it is displayed and written.
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
        computed: &EngineRun,
        progress: Progress<'_>,
    ) -> Result<Findings, StudyError> {
        let (collision, layer_orders) = self.check_frames(motion, progress)?;
        Ok(Findings {
            series: self.series(motion, computed, &collision.separation_series),
            collision,
            layer_orders,
        })
    }

    /// The collision report, and the layer order of each frame in which triangles coincide.
    ///
    /// If the check stops early, later frames get no order. The order is claimed here as the motion file will claim it, so that
    /// a check of the file gives the same certificate. In the compact frame of a motion without penetration, layers that a gap
    /// keeps apart are in the exact order.
    fn check_frames(
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
            let mut current = match checker {
                Some(mut checker) => {
                    checker.advance(frame)?;
                    checker
                }
                None => Checker::new(&motion.sheet, frame, &self.collision)?,
            };
            if current.is_stopped() {
                checker = Some(current);
                break;
            }
            let mut order = current.layer_order();
            let is_last = index + 1 == motion.frames.len();
            if is_last && frame.time == 2.0 && current.is_clean() {
                for (f, g, sign) in current.without_false(&motion.compact_order).iter() {
                    if order.sign(f, g).is_none() {
                        order.insert(f, g, sign);
                    }
                }
            }
            current.claim(&order, &|triangle| triangle)?;
            if !order.is_empty() {
                orders.push((index, order));
            }
            checker = Some(current);
        }
        progress(Phase::Check, 1.0);
        let checker = checker.ok_or(CheckError::NoFrames)?;
        Ok((checker.finish(), orders))
    }
}
