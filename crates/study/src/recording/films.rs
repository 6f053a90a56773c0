//! `motion.gif`, `motion.mp4` and `frames/`, drawn in one pass.

use std::fs;

use foldmotion_record::{FilmOptions, Frames, Gif, Mp4, Reel, Scene, film};

use super::{Recorder, Shown};
use crate::StudyError;
use crate::results::{FRAMES, Results};
use crate::run::{Phase, Progress};
use crate::scene::OutputChoice;

impl Recorder<'_> {
    pub(super) fn films(
        &self,
        values: Shown<'_>,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<(), StudyError> {
        let has = |output| self.recording.has(output);
        let (mut gif, mut mp4, mut frames) = (None, None, None);
        if has(OutputChoice::Gif) {
            gif = Some(Gif::new(results.create_file("motion.gif")?));
        }
        if has(OutputChoice::Mp4) {
            mp4 = Some(Mp4::new(results.create_file("motion.mp4")?)?);
        }
        let mut names: Vec<String> = Vec::new();
        if has(OutputChoice::Png) {
            let (folder, names) = (results.create_subfolder(FRAMES)?, &mut names);
            frames = Some(Frames::new(move |name: &str, bytes: &[u8]| {
                names.push(format!("{FRAMES}/{name}"));
                fs::write(folder.join(name), bytes)
            }));
        }
        let mut reels: Vec<&mut dyn Reel> = Vec::new();
        reels.extend(gif.as_mut().map(|reel| reel as &mut dyn Reel));
        reels.extend(mp4.as_mut().map(|reel| reel as &mut dyn Reel));
        reels.extend(frames.as_mut().map(|reel| reel as &mut dyn Reel));
        if reels.is_empty() {
            return Ok(());
        }
        let scene = Scene {
            motion: self.motion,
            marks: &self.marks,
            values,
        };
        let options = FilmOptions {
            provenance: self.origin.text(),
            ending: self.ending.clone(),
            // Only pictures can show through.
            is_transparent: self.recording.film.is_transparent && has(OutputChoice::Png),
            ..self.recording.film.clone()
        };
        film(scene, &options, &mut reels, &|done| {
            progress(Phase::Record, done)
        })?;
        drop(frames);
        results.add(names);
        Ok(())
    }
}
