//! `motion.gif`, `motion.mp4` and `frames/`, drawn in one pass.

use std::fs;

use foldmotion_record::{FilmOptions, FilmWriter, Frames, Gif, Mp4, Scene, Style, film};

use super::{ColourValues, Recorder};
use crate::StudyError;
use crate::results::{FRAMES, Results};
use crate::scene::OutputChoice;
use crate::{Phase, Progress};

/// The shorter side, in pixels, of pictures in which lines have the width of their style; in other pictures the width is
/// scaled in proportion.
const STYLED_SIDE: f64 = 720.0;

/// The smallest width to which the widest lines are scaled, in pixels.
const NARROWEST: f64 = 0.5;

impl Recorder<'_> {
    pub(super) fn films(
        &self,
        values: ColourValues<'_>,
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
        let mut writers: Vec<&mut dyn FilmWriter> = Vec::new();
        writers.extend(gif.as_mut().map(|writer| writer as &mut dyn FilmWriter));
        writers.extend(mp4.as_mut().map(|writer| writer as &mut dyn FilmWriter));
        writers.extend(frames.as_mut().map(|writer| writer as &mut dyn FilmWriter));
        if writers.is_empty() {
            return Ok(());
        }
        let scene = Scene { motion: self.motion, marks: &self.marks, values };
        let film_options = &self.recording.film;
        let options = FilmOptions {
            style: Style { line_width: line_width(film_options), ..film_options.style.clone() },
            provenance: self.source_info.text(),
            ending: self.ending.clone(),
            // Only PNG pictures can be transparent.
            is_transparent: film_options.is_transparent && has(OutputChoice::Png),
            ..film_options.clone()
        };
        film(scene, &options, &mut writers, &|done| progress(Phase::Record, done))?;
        drop(frames);
        results.add(names);
        Ok(())
    }
}

/// The width of the widest lines of a film in pixels, scaled so that small and large films look alike.
fn line_width(film: &FilmOptions) -> f64 {
    let [across, down] = film.size.map(f64::from);
    let width = film.style.line_width;
    (width * across.min(down) / STYLED_SIDE).max(NARROWEST.min(width))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_in_proportion_to_the_picture_and_never_vanish() {
        let width = |size| line_width(&FilmOptions { size, ..FilmOptions::default() });
        let standard = FilmOptions::default().style.line_width;
        assert_eq!(width([960, 720]), standard);
        assert_eq!(width([1440, 2000]), 2.0 * standard);
        assert_eq!(width([640, 480]), standard * 480.0 / 720.0);
        assert_eq!(width([64, 48]), NARROWEST);
    }
}
