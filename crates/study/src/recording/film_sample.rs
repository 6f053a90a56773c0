//! The sizes of films, estimated from a few of their pictures.

use foldmotion_pattern::{Frame, Motion};
use foldmotion_record::{
    FilmOptions, FilmWriter, Frames, Gif, Marks, Mp4, Playback, Scene, film, timeline,
};

use super::Recording;
use super::planned::{moving_pictures, pictures};
use crate::scene::OutputChoice;
use crate::{Phase, Progress};
use crate::{StudyError, Subject};

/// The seconds of each stage of a sample and its frame rate: five pictures for each stage.
const SECONDS: [f64; 2] = [1.0; 2];
const PICTURES_A_SECOND: f64 = 4.0;

/// The turn of the camera of a sample in degrees, so that no two pictures are the same.
const TURN: f64 = 60.0;

/// Safety factors of GIF, MP4 and PNG: other pictures may be richer than those of the sample; consecutive pictures of an MP4 are
/// more alike, and take less.
const MARGINS: [f64; 3] = [1.5, 0.8, 1.5];

/// The estimated sizes of the films of a recording, in bytes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FilmSizes {
    pub(super) gif: u64,
    pub(super) mp4: u64,
    pub(super) png: u64,
}

impl Recording {
    /// The estimated sizes of the films of `motion`.
    pub(crate) fn sample_films(
        &self,
        motion: &Motion,
        progress: Progress<'_>,
    ) -> Result<FilmSizes, StudyError> {
        let options = FilmOptions {
            seconds: SECONDS,
            fps: PICTURES_A_SECOND,
            hold: [0.0; 3],
            playback: Playback::Once,
            turn: self.film.turn.max(TURN),
            is_transparent: self.film.is_transparent && self.has(OutputChoice::Png),
            ..self.film.clone()
        };
        let (mut gif, mut mp4, mut png) = (Vec::new(), Vec::new(), 0);
        let mut writers: Vec<Box<dyn FilmWriter + '_>> = Vec::new();
        if self.has(OutputChoice::Gif) {
            writers.push(Box::new(Gif::new(&mut gif)));
        }
        if self.has(OutputChoice::Mp4) {
            writers.push(Box::new(Mp4::new(&mut mp4)?));
        }
        if self.has(OutputChoice::Png) {
            writers.push(Box::new(Frames::new(|_: &str, bytes: &[u8]| {
                png += bytes.len();
                Ok(())
            })));
        }
        let scene = Scene { motion, marks: &Marks::default(), values: None };
        let mut borrowed: Vec<&mut dyn FilmWriter> = Vec::new();
        for writer in &mut writers {
            borrowed.push(writer.as_mut());
        }
        let should_continue = |_| progress(Phase::Read, 0.5);
        film(scene, &options, &mut borrowed, &should_continue)?;
        drop(borrowed);
        drop(writers);
        let shots = timeline(motion, &options)?.len();
        Ok(self.sizes([gif.len(), mp4.len(), png], shots))
    }

    #[expect(clippy::cast_sign_loss, reason = "sizes are positive")]
    fn sizes(&self, sampled: [usize; 3], shots: usize) -> FilmSizes {
        let still = pictures(&self.film);
        let moving = moving_pictures(&self.film);
        // Pictures that repeat the one before take no space in a GIF and little in an MP4.
        let [gif, mp4, png] = [moving, moving + still / 8, still].map(|n| n as f64 / shots as f64);
        let size = |k: usize, times: f64| (MARGINS[k] * sampled[k] as f64 * times) as u64;
        FilmSizes { gif: size(0, gif), mp4: size(1, mp4), png: size(2, png) }
    }
}

impl Subject {
    /// A motion through the exact states, which are known before the motion is computed.
    pub(crate) fn exact_motion(&self) -> Motion {
        let sheet = self.sheet().clone();
        let planar = sheet.planar();
        let states = match self.units() {
            Some(study) => vec![study.deployed.clone(), planar, study.units.compact()],
            None => vec![planar.clone(), planar],
        };
        let times = (0..).map(|k: u32| self.start_time() + f64::from(k));
        let frames = times.zip(states).map(|(time, positions)| Frame { time, positions });
        Motion {
            frames: frames.collect(),
            compact_order: self.compact_order().cloned().unwrap_or_default(),
            sheet,
        }
    }
}

#[cfg(feature = "mp4")]
#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use crate::{SceneSource, Study};

    /// The bytes of the files in `folder` with this extension.
    fn bytes(folder: &Path, ending: &str) -> u64 {
        let files = fs::read_dir(folder).unwrap().map(Result::unwrap);
        let of_kind = files.filter(|file| file.path().extension().is_some_and(|e| e == ending));
        of_kind.map(|file| file.metadata().unwrap().len()).sum()
    }

    #[test]
    fn sizes_of_files_are_estimated_within_a_factor_of_three() {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let mut source = SceneSource::read(&scenes.join("one-row.toml")).unwrap();
        for set in [
            "motion.frames=40",
            "record.size=[480, 360]",
            "record.fps=10.0",
            "record.outputs=[\"fold\", \"gif\", \"mp4\", \"png\", \"glb\", \"html\", \"obj\", \"stl\"]",
        ] {
            source.set(set).unwrap();
        }
        let study = Study::resolve(&source).unwrap();
        let home = tempfile::tempdir().unwrap();
        let report = study.run(home.path(), &|_, _| true).unwrap();
        let motion = study.subject.exact_motion();
        let films = study.recording.sample_films(&motion, &|_, _| true).unwrap();
        let about = study.space(&study.recording, report.path.frames, Some(films));
        let most = study.space(&study.recording, report.path.frames, None);
        for ((output, about), (_, most)) in about.each().zip(most.each()) {
            let folder = match output.name() {
                "png" => home.path().join("frames"),
                _ => home.path().to_owned(),
            };
            let written = bytes(&folder, output.name());
            let name = output.name();
            assert!(written <= most, "{name}: {written} bytes, at most {most}");
            let bounds = written * 3 / 4..=written * 5 / 2 + 2_000_000;
            assert!(bounds.contains(&about), "{name}: {written} bytes, about {about}");
        }
    }
}
