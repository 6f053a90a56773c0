//! Films, figures and models of a motion: of a run, and of any motion file.

mod colours;
mod figure;
mod film_sample;
mod films;
mod marks;
mod models;
mod motion_file;
mod page;
mod planned;
mod reproduce;
mod run_files;
mod source_info;
mod space;
mod vtk;

use foldmotion_pattern::Motion;
use foldmotion_record::{Marks, Values};

use crate::resolve::recording::STATES;
use crate::results::Results;
use crate::scene::{LengthUnit, parse_choice};
use crate::{Phase, Progress, Recording, StudyError, UnitStudy};

pub(crate) use self::motion_file::{LoadedMotion, stage_time};
pub use self::motion_file::{MotionRecord, record_file};
pub use self::reproduce::{Reproduction, reproduce_file};

pub use self::colours::Quantity;
pub(crate) use self::film_sample::FilmSizes;
use self::page::PageContent;
use self::source_info::SourceInfo;

/// Records one motion.
pub(crate) struct Recorder<'a> {
    pub(crate) recording: &'a Recording,
    pub(crate) motion: &'a Motion,
    /// The facets of the first penetration, with its point.
    pub(crate) marks: Marks,
    pub(crate) title: &'a str,
    /// FOLD's name of the unit of length.
    pub(crate) unit: &'a str,
    /// The sheet of units with its exact states; `None` for an imported pattern and for a motion file.
    pub(crate) units: Option<&'a UnitStudy>,
    pub(crate) source_info: SourceInfo,
    /// Whether the rest lengths of the edges are known.
    pub(crate) has_rest_lengths: bool,
    /// What a page shows next to the motion.
    pub(crate) page_content: PageContent,
    /// How the motion ended; `None` if it folded.
    pub(crate) ending: Option<String>,
}

impl Recorder<'_> {
    /// Writes all figures, models, pages and films of the recording into `results`; the films in one pass.
    pub(crate) fn write(
        &self,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<(), StudyError> {
        let values = Quantity::of(self.recording.colour).map(|q| q.of_motion(self.motion));
        self.figures(values.as_ref(), results)?;
        require_progress(progress)?;
        self.models(results)?;
        require_progress(progress)?;
        self.page(results)?;
        require_progress(progress)?;
        self.vtk(results, progress)?;
        self.films(values.as_ref(), results, progress)
    }

    /// The motion times of the states in figures and models, limited to those of the motion.
    fn times(&self) -> Vec<f64> {
        let frames = &self.motion.frames;
        let (Some(first), Some(last)) = (frames.first(), frames.last()) else {
            return Vec::new();
        };
        let (first, last) = (first.time, last.time);
        let even = |k: i32| first + (last.min(2.0) - first) * f64::from(k) / 4.0;
        let requested = match &self.recording.at {
            Some(at) => at.clone(),
            None if first > 0.0 => (0..5).map(even).collect(),
            None => STATES.to_vec(),
        };
        let mut times: Vec<f64> = requested.into_iter().map(|t| t.clamp(first, last)).collect();
        times.dedup();
        times
    }

    /// The length of the motion's unit in metres.
    fn metres(&self) -> f64 {
        let unit: Option<LengthUnit> = parse_choice(self.unit).ok();
        let millimetres = unit.and_then(LengthUnit::millimetres);
        millimetres.map_or(1.0, |length| length / 1000.0)
    }
}

/// The values that films and figures show as colours.
type ColourValues<'a> = Option<&'a Values>;

fn require_progress(progress: Progress<'_>) -> Result<(), StudyError> {
    if progress(Phase::Record, 0.0) { Ok(()) } else { Err(StudyError::Interrupted) }
}
