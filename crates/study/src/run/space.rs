//! Checks the disk space before anything is computed.

use foldmotion_pattern::{LayerOrder, Motion};

use crate::recording::FilmSizes;
use crate::results::{Results, Space};
use crate::scene::OutputChoice;
use crate::{Progress, Recording, Study, StudyError};

/// The largest average number of bytes for an entry of `faceOrders`.
const BYTES_AN_ORDER: u64 = 20;

impl Study {
    /// The bytes of the files of `recording` for a motion of `frames` frames: an upper bound, or an estimate if `films` are given.
    pub(crate) fn space(
        &self,
        recording: &Recording,
        frames: usize,
        films: Option<FilmSizes>,
    ) -> Space {
        let sheet = self.subject.sheet();
        let orders =
            BYTES_AN_ORDER * self.subject.compact_order().map_or(0, LayerOrder::len) as u64;
        let mut space = recording.space(sheet, frames, films);
        if recording.has(OutputChoice::Fold) {
            let fold = Motion::fold_file_size(sheet, frames) + orders;
            space.add(OutputChoice::Fold, fold);
        }
        space
    }

    /// The bytes of the files of `recording`. If the upper bound exceeds the free space, the films are estimated from a few pictures.
    pub(crate) fn space_in(
        &self,
        results: &Results,
        recording: &Recording,
        frames: usize,
        progress: Progress<'_>,
    ) -> Result<Space, StudyError> {
        let bound = self.space(recording, frames, None);
        if bound.total() <= results.available()? || !recording.has_films() {
            return Ok(bound);
        }
        let films = recording.sample_films(&self.subject.exact_motion(), progress)?;
        Ok(self.space(recording, frames, Some(films)))
    }

    pub(super) fn require_space(
        &self,
        results: &Results,
        progress: Progress<'_>,
    ) -> Result<(), StudyError> {
        let needed = self.space_in(results, &self.recording, self.frames, progress)?;
        let available = results.available()?;
        if needed.total() <= available {
            return Ok(());
        }
        let least = self.space(&self.recording, 2, None).total();
        let most = self.space(&self.recording, self.frames, None).total();
        // The part that does not depend on the frames may be less than its bound.
        let rest = needed.total().saturating_sub(most - least);
        let a_frame = (most - least).div_ceil(self.frames as u64 - 1).max(1);
        let frames = 2 + (available.saturating_sub(rest) / a_frame) as usize;
        let frames = (frames - frames % 2).min(self.frames - 2);
        let remedy = if rest <= available && frames >= 2 {
            format!("set motion.frames to {frames} or less")
        } else {
            needed.remedy()
        };
        Err(results.too_small(&needed, available, remedy))
    }
}
