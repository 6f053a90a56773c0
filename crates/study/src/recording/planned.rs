//! The names of the files that a recording will write.

use foldmotion_record::{FilmOptions, Playback};

use super::models::state_name;
use super::vtk::COLLECTION;
use crate::Recording;
use crate::resolve::recording::STATES;
use crate::results::{CERTIFICATE, FRAMES, MOTION, is_picture, is_vtk_frame};
use crate::scene::OutputChoice;

impl Recording {
    /// Whether the recording will write a file called `name`. If the motion ends early, some states have other names.
    pub(crate) fn plans(&self, name: &str) -> bool {
        self.outputs.iter().any(|&output| match output {
            OutputChoice::Fold => [MOTION, CERTIFICATE].contains(&name),
            OutputChoice::Csv => ["motion.csv", "plots.svg"].contains(&name),
            OutputChoice::Gif | OutputChoice::Mp4 | OutputChoice::Glb | OutputChoice::Html => {
                name.strip_prefix("motion.") == Some(output.name())
            }
            OutputChoice::Svg | OutputChoice::Pdf => {
                name.strip_prefix("figure.") == Some(output.name())
            }
            OutputChoice::Png => picture_number(name).is_some_and(|n| n <= pictures(&self.film)),
            OutputChoice::Vtk => name == COLLECTION || is_vtk_frame(name),
            OutputChoice::Obj | OutputChoice::Stl => {
                let times = self.at.as_deref().unwrap_or(&STATES);
                times.iter().any(|&time| state_name(time, output) == name)
            }
        })
    }

    /// Whether `name` is numbered and of an output that numbers its files: of an earlier recording, some would be left.
    pub(crate) fn replaces(&self, name: &str) -> bool {
        self.has(OutputChoice::Png) && is_picture(name)
            || self.has(OutputChoice::Vtk) && is_vtk_frame(name)
    }
}

/// The number in the name of a picture.
fn picture_number(name: &str) -> Option<u64> {
    let file = name.strip_prefix(FRAMES)?.strip_prefix('/')?;
    file.strip_suffix(".png")?.parse().ok()
}

/// The largest number of pictures of a film.
pub(super) fn pictures(film: &FilmOptions) -> u64 {
    in_seconds(film, film.seconds.iter().chain(&film.hold).sum())
}

/// The largest number of pictures of a film that differ from the one before.
pub(super) fn moving_pictures(film: &FilmOptions) -> u64 {
    in_seconds(film, film.seconds.iter().sum())
}

#[expect(clippy::cast_sign_loss, reason = "the film's options were checked to be positive")]
fn in_seconds(film: &FilmOptions, seconds: f64) -> u64 {
    let passes = match film.playback {
        Playback::Once => 1.0,
        Playback::BackAndForth => 2.0,
    };
    (passes * seconds * film.fps).ceil() as u64 + 3
}
