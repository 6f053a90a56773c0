//! Opens a file of any kind: a scene, a crease pattern or a motion.

use std::path::Path;
use std::sync::Arc;

use foldmotion_check::{CollisionReport, bar_strain, facet_bending};
use foldmotion_pattern::{Frame, Motion};
use foldmotion_solver::{EnergyByKind, Stage};

use crate::certificate::check_file::{CheckOptions, check_motion_file, motion_error, read_header};
use crate::compute::folded::Findings;
use crate::compute::series::FrameFigures;
use crate::recording::{LoadedMotion, stage_time};
use crate::scene::RecordScene;
use crate::{Certificate, Destination, MotionRecord, Phase, Progress, SceneSource, StudyError};

/// A file, by its content.
#[derive(Debug)]
pub enum OpenedFile {
    /// A scene, or a crease pattern as a scene that only names this file.
    Scene(SceneSource),
    /// A motion file.
    Motion(Arc<OpenedMotion>),
}

impl OpenedFile {
    /// Reads the file at `path`: a FOLD file with frames in which a vertex moves is a motion; other FOLD files and
    /// files in the formats of crease patterns are crease patterns; every other file is a scene.
    ///
    /// # Errors
    /// [`StudyError::Read`]; for a motion [`StudyError::Motion`] and [`StudyError::LargeFile`]; [`StudyError::Interrupted`]
    /// if `progress` returned false. Errors in a scene or a pattern are reported when it is resolved.
    pub fn read(path: &Path, progress: Progress<'_>) -> Result<Self, StudyError> {
        let may_be_fold = |ending: &std::ffi::OsStr| {
            ["fold", "json"].iter().any(|known| ending.eq_ignore_ascii_case(known))
        };
        let is_fold = path.extension().is_some_and(may_be_fold);
        if is_fold && let Some(motion) = OpenedMotion::read(path, progress)? {
            return Ok(Self::Motion(Arc::new(motion)));
        }
        SceneSource::read(path).map(Self::Scene)
    }
}

/// The motion of a file.
#[derive(Debug)]
pub struct OpenedMotion {
    read: LoadedMotion,
}

impl OpenedMotion {
    /// The motion in the file; `None` if the file is a crease pattern.
    fn read(path: &Path, progress: Progress<'_>) -> Result<Option<Self>, StudyError> {
        let (file, sha256) = match read_header(path, progress) {
            Ok(header) => header,
            Err(StudyError::Motion { .. }) => return Ok(None),
            Err(error) => return Err(error),
        };
        if file.frame_count() < 2 {
            return Ok(None);
        }
        let read = LoadedMotion::read_frames(path, file, sha256, progress)?;
        let mut pairs = read.motion.frames.windows(2);
        let moves = pairs.any(|pair| pair[0].positions != pair[1].positions);
        Ok(moves.then_some(Self { read }))
    }

    /// The motion, with the times of the file or, if it has none, as one stage from t = 1 to t = 2. Its layer order is the
    /// last one that the file claims.
    pub fn motion(&self) -> &Motion {
        &self.read.motion
    }

    /// The title of the motion, or the name of its file if it has none.
    pub fn title(&self) -> &str {
        self.read.title.as_deref().unwrap_or(&self.read.name)
    }

    /// FOLD's name of the unit of length.
    pub fn unit_name(&self) -> &str {
        self.read.unit.as_deref().unwrap_or("unit")
    }

    /// Whether the rest lengths of the edges are known, so that strain can be computed.
    pub fn has_rest_lengths(&self) -> bool {
        self.read.is_flat
    }

    /// Checks the motion as `foldmotion check` does, and measures its frames. The file is read again, in bounded memory.
    ///
    /// # Errors
    /// Those of [`check_file`](crate::check_file), and [`StudyError::Motion`] if the file has changed since it was opened.
    pub fn check(
        &self,
        options: &CheckOptions,
        progress: Progress<'_>,
    ) -> Result<(Findings, Certificate), StudyError> {
        let path = &self.read.path;
        let check = check_motion_file(path, *options, progress)?;
        if check.sha256 != self.read.sha256 {
            return Err(motion_error(path, &"it has changed since it was opened"));
        }
        let certificate = check.certificate(path);
        let mut collision = check.collision;
        if !self.read.has_times {
            as_one_stage(&mut collision, check.times.len());
        }
        let motion = self.motion();
        let order = &motion.compact_order;
        let last = motion.frames.len().saturating_sub(1);
        let findings = Findings {
            series: self.series(&collision),
            layer_orders: (!order.is_empty()).then(|| (last, order.clone())).into_iter().collect(),
            collision,
        };
        progress(Phase::Check, 1.0);
        Ok((findings, certificate))
    }

    /// Records the motion into `destination` with the settings `record`, whose keys appear as flags in errors. Other files
    /// in the folder are kept. Penetrations of `findings` are marked or, without findings, those of a certificate in the
    /// folder of the motion.
    ///
    /// # Errors
    /// Those of [`record_file`](crate::record_file).
    pub fn record_as<'a>(
        &self,
        findings: Option<&Findings>,
        record: &RecordScene,
        destination: impl Into<Destination<'a>>,
        progress: Progress<'_>,
    ) -> Result<MotionRecord, StudyError> {
        let collision = findings.map(|findings| &findings.collision);
        self.read.record_into(destination.into(), record, collision, progress)
    }

    fn series(&self, collision: &CollisionReport) -> Vec<FrameFigures> {
        let motion = self.motion();
        let separations = &collision.separation_series;
        let figures = |(index, frame): (usize, &Frame)| {
            let strain =
                self.has_rest_lengths().then(|| bar_strain(&motion.sheet, &frame.positions));
            FrameFigures {
                time: frame.time,
                stage: if frame.time < 1.0 { Stage::Unfold } else { Stage::Fold },
                peak_strain: strain.as_ref().map_or(f64::NAN, |s| s.peak),
                mean_strain: strain.as_ref().map_or(f64::NAN, |s| s.mean),
                peak_bending_deg: facet_bending(&motion.sheet, &frame.positions).peak_deg(),
                energy: EnergyByKind::default(),
                contact_energy: 0.0,
                contacts: 0,
                separation: separations.get(index).copied().unwrap_or(f64::NAN),
            }
        };
        motion.frames.iter().enumerate().map(figures).collect()
    }
}

/// Converts times that count frames into motion times of one stage, as for the motion.
fn as_one_stage(collision: &mut CollisionReport, frames: usize) {
    let penetrations = collision.first.iter_mut().chain(&mut collision.penetrations);
    for penetration in penetrations {
        penetration.time = stage_time(penetration.time, frames);
        penetration.passed = stage_time(penetration.passed, frames);
    }
    for undecided in &mut collision.undecided {
        undecided.time = stage_time(undecided.time, frames);
    }
    if let Some(stopped) = &mut collision.stopped {
        stopped.time = stage_time(stopped.time, frames);
    }
    if let Some(separation) = &mut collision.min_separation {
        separation.time = stage_time(separation.time, frames);
    }
}
