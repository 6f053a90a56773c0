//! The frames of a run and their motion times.
//!
//! Frame k lies at t = 2k/frames. The ramp of a stage reaches its last target at the stage's last frame, which is
//! taken after settling. Where settling moves a node further than [`PATH_STEP`], the state at the end of the ramp and
//! states along the settling path are recorded too, so that the check sees the whole path: in the
//! last interval of the stage, [s₀, 1] in stage-local time, the ramp then ends at the middle and the j-th state of
//! the path after it lies at 1 − (1 − s₀) / (2 (1 + j)), a monotone map of the settling onto the second half.

use foldmotion_pattern::Frame;
use glam::DVec3;

use crate::{Model, Stage};

/// The largest displacement of a node between two recorded states of the settling path, unit lengths; at most that of
/// one step more.
pub(super) const PATH_STEP: f64 = 0.02;

/// The frames recorded so far.
#[derive(Debug)]
pub(super) struct Recorder<'m> {
    model: &'m Model,
    frames: Vec<Frame>,
    /// The stage-local time left at the last frame that lies on the ramp.
    left: f64,
    /// The last state of the settling path that is recorded or, at first, the end of the ramp.
    path: Vec<DVec3>,
    path_states: usize,
}

impl<'m> Recorder<'m> {
    /// A recorder without frames.
    pub(super) fn new(model: &'m Model) -> Self {
        Self { model, frames: Vec::new(), left: 1.0, path: Vec::new(), path_states: 0 }
    }

    /// Records `positions` (unit lengths) as the frame at stage-local time `s`, which lies on the ramp or ends it.
    pub(super) fn push(&mut self, stage: Stage, s: f64, positions: &[DVec3]) {
        self.push_frame(stage, s, positions);
        self.left = if s < 1.0 { 1.0 - s } else { 1.0 };
    }

    /// The ramp of a stage ended at `positions`; settling begins.
    pub(super) fn begin_settling(&mut self, positions: &[DVec3]) {
        self.path.clear();
        self.path.extend_from_slice(positions);
        self.path_states = 0;
    }

    /// Settling has come to `positions`: records them where they lie far enough from the last state of the path.
    pub(super) fn settling(&mut self, stage: Stage, positions: &[DVec3]) {
        let is_far = |(a, b): (&DVec3, &DVec3)| a.distance_squared(*b) > PATH_STEP * PATH_STEP;
        if !self.path.iter().zip(positions).any(is_far) {
            return;
        }
        if self.path_states == 0 {
            let ramp_end = std::mem::take(&mut self.path);
            self.push_path_state(stage, &ramp_end);
            self.path = ramp_end;
        }
        self.push_path_state(stage, positions);
        self.path.copy_from_slice(positions);
    }

    /// The frames, in order of time.
    pub(super) fn into_frames(self) -> Vec<Frame> {
        self.frames
    }

    fn push_path_state(&mut self, stage: Stage, positions: &[DVec3]) {
        let left = 0.5 * self.left / (1.0 + self.path_states as f64);
        self.path_states += 1;
        self.push_frame(stage, 1.0 - left, positions);
    }

    fn push_frame(&mut self, stage: Stage, s: f64, positions: &[DVec3]) {
        let time = stage.start_time() + s;
        self.frames.push(Frame { time, positions: self.model.to_sheet(positions) });
    }
}
