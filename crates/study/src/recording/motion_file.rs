//! Records a motion file of any origin.

use std::path::{Path, PathBuf};

use foldmotion_check::CollisionReport;
use foldmotion_pattern::{FoldError, FoldFile, LayerOrder, Motion};
use foldmotion_record::Marks;

use super::marks::marks;
use super::page::LARGEST_FOLD;
use super::{PageContent, Recorder, Recording, SourceInfo};
use crate::certificate::check_file::{LARGEST, MotionReader, TooFewStates, read_header};
use crate::certificate::statement::claim;
use crate::certificate::verify_file::read_certificate;
use crate::resolve::input::{Input, printable};
use crate::resolve::recording::recording as resolved;
use crate::results::{CERTIFICATE, Command, Destination, Published, Results};
use crate::scene::{ColourChoice, OutputChoice, RecordScene};
use crate::{Phase, Progress};
use crate::{Scene, SceneSource, StudyError, input_file};

/// The largest number of positions held in memory: 2.4 GB.
const MOST_POSITIONS: usize = 100_000_000;

/// The result of recording a motion file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MotionRecord {
    /// The names of the files in the folder.
    pub files: Vec<String>,
    /// Whether penetrations are marked, because the motion was checked or has a certificate in its folder.
    pub is_checked: bool,
    /// Whether there is a penetration to mark.
    pub penetrates: bool,
    /// What happened to other files in the folder.
    pub published: Published,
}

/// Records the motion in the FOLD file at `path` with the settings `record`, whose keys appear as flags in errors.
///
/// Without `foldmotion:time` in the file, its frames become one stage with evenly spaced times from t = 1 to t = 2. The first
/// penetration is marked if the folder of the motion has its `certificate.json`. Other files in the output folder are kept.
///
/// # Errors
/// [`StudyError`] of a file that is not a motion or too large, of values that cannot be used, and of outputs that need a scene.
pub fn record_file<'a>(
    path: &Path,
    record: &RecordScene,
    destination: impl Into<Destination<'a>>,
    progress: Progress<'_>,
) -> Result<MotionRecord, StudyError> {
    // Wrong settings are refused before a long file is read.
    recording(record)?;
    LoadedMotion::read(path, progress)?.record_into(destination.into(), record, None, progress)
}

/// Opens the folder of a recording, after a check for files of the user that it would replace.
pub(super) fn open_record(
    recording: &Recording,
    destination: Destination<'_>,
) -> Result<Results, StudyError> {
    let results = Results::open(destination, Command::Record, None)?;
    results.require_clear(&|name| recording.plans(name))?;
    Ok(results)
}

/// Moves the files recorded from the motion `sha256` into the output folder; returns their names and what happened to other
/// files. Numbered files of an earlier recording are removed, because a longer one would leave some; other files are kept.
pub(super) fn publish_record(
    mut results: Results,
    recording: &Recording,
    sha256: &str,
) -> Result<(Vec<String>, Published), StudyError> {
    let skipped = results.skip_conflicts();
    let files = results.written().to_vec();
    let published = results.publish(Some(sha256), &|file| recording.replaces(&file.name))?;
    let published = Published { skipped, others: Vec::new(), ..published };
    Ok((files, published))
}

/// Resolves the settings `record` of the recording of a motion file.
pub(super) fn recording(record: &RecordScene) -> Result<Recording, StudyError> {
    let mut record = record.clone();
    let outputs = record.outputs.get_or_insert_with(|| vec![OutputChoice::Gif]);
    let needs_scene = [OutputChoice::Fold, OutputChoice::Csv];
    let refused = outputs.iter().find(|o| needs_scene.contains(o)).copied();
    let source = SceneSource::from_flags(&record);
    if let Some(output) = refused {
        let message = format!(
            "{} is written only by running a scene (foldmotion run); a motion can be recorded as gif, mp4, png, svg, pdf, glb, obj, stl, html or vtk",
            output.name()
        );
        return Err(source.value_error("record.outputs", message));
    }
    if record.profile == Some(true) {
        let message = "a motion file has no profile; run the scene instead".to_owned();
        return Err(source.value_error("record.profile", message));
    }
    let scene = Scene { record, ..Scene::default() };
    let input = Input::new(&source, &scene);
    resolved(&input, input.title(None))
}

/// A motion read from a file.
#[derive(Debug)]
pub(crate) struct LoadedMotion {
    pub(crate) motion: Motion,
    pub(crate) sha256: String,
    pub(crate) path: PathBuf,
    /// The name of the motion file.
    pub(crate) name: String,
    pub(crate) title: Option<String>,
    pub(crate) unit: Option<String>,
    /// How the run that wrote the file ended; `None` if it folded, or if the file does not say.
    ending: Option<String>,
    pub(super) marks: Marks,
    is_checked: bool,
    /// Whether the key frame is the flat crease pattern, so that rest lengths are known.
    pub(crate) is_flat: bool,
    /// Whether the file gives the times of its frames.
    pub(crate) has_times: bool,
}

impl LoadedMotion {
    pub(crate) fn read(path: &Path, progress: Progress<'_>) -> Result<Self, StudyError> {
        let (file, sha256) = read_header(path, progress)?;
        Self::read_frames(path, file, sha256, progress)
    }

    /// Reads the frames of `file`, which was read from `path` when that had the SHA-256 `sha256`.
    pub(crate) fn read_frames(
        path: &Path,
        file: FoldFile,
        sha256: String,
        progress: Progress<'_>,
    ) -> Result<Self, StudyError> {
        let mut input = MotionReader::open(path, Phase::Read, progress)?;
        let positions = file.frame_count().saturating_mul(file.sheet.vertices.len());
        if positions > MOST_POSITIONS {
            let message = format!(
                "the motion has {positions} positions of vertices, and at most {MOST_POSITIONS} can be recorded; remove frames"
            );
            return Err(input.failure(&message));
        }
        let (mut frames, mut claimed) = (Vec::new(), LayerOrder::default());
        let read = file.frames::<FoldError>(&mut input, &mut |frame, order| {
            frames.push(frame);
            if !order.is_empty() {
                claimed = order.clone();
            }
            Ok(())
        });
        input.unless_stopped(read)?;
        input.require_unchanged(&sha256)?;
        if frames.len() < 2 {
            return Err(input.failure(&TooFewStates(frames.len())));
        }
        if let Some(k) = (1..frames.len()).find(|&k| frames[k].time <= frames[k - 1].time) {
            let message = format!("frame {k} of the motion is not later than the one before");
            return Err(input.failure(&message));
        }
        let compact_order = of_triangles(&claimed, &file);
        let mut motion = Motion { sheet: file.sheet, frames, compact_order };
        let marks = certificate_marks(path, &motion, &sha256, file.has_times);
        if !file.has_times {
            as_one_stage(&mut motion);
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Ok(Self {
            sha256,
            path: path.to_owned(),
            name: name.into_owned(),
            title: file.title.as_deref().map(printable),
            unit: file.unit,
            ending: file.outcome.filter(|outcome| outcome != "folded"),
            is_checked: marks.is_some(),
            marks: marks.unwrap_or_default(),
            is_flat: file.rest.iter().all(|p| p.z == file.rest[0].z),
            has_times: file.has_times,
            motion,
        })
    }

    /// Records the motion with the settings `record`. Penetrations of `collision` are marked instead of those of the certificate
    /// in the folder of the motion.
    pub(crate) fn record_into(
        &self,
        destination: Destination<'_>,
        record: &RecordScene,
        collision: Option<&CollisionReport>,
        progress: Progress<'_>,
    ) -> Result<MotionRecord, StudyError> {
        let recording = recording(record)?;
        self.require_states(&recording)?;
        let mut results = open_record(&recording, destination)?;
        let frames = self.motion.frames.len();
        let space = |films| recording.space(&self.motion.sheet, frames, films);
        if results.available()? < space(None).total() && recording.has_films() {
            let films = recording.sample_films(&self.motion, progress)?;
            results.require(&space(Some(films)))?;
        } else {
            results.require(&space(None))?;
        }
        let marks = collision.map(|collision| marks(&self.motion, collision, |time| time));
        let is_checked = self.is_checked || marks.is_some();
        let marks = marks.unwrap_or_else(|| self.marks.clone());
        let penetrates = !marks.is_empty();
        self.record(&recording, marks, &mut results, progress)?;
        let (files, published) = publish_record(results, &recording, &self.sha256)?;
        Ok(MotionRecord { files, is_checked, penetrates, published })
    }

    /// Records the motion into `results`.
    pub(super) fn record(
        &self,
        recording: &Recording,
        marks: Marks,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<(), StudyError> {
        let record = &recording.scene.record;
        let recorder = Recorder {
            recording,
            motion: &self.motion,
            marks,
            title: self.title.as_deref().unwrap_or(&self.name),
            unit: self.unit.as_deref().unwrap_or("unit"),
            units: None,
            source_info: SourceInfo::of_motion(self.name.clone(), record, self.sha256.clone()),
            has_rest_lengths: self.is_flat,
            page_content: self.page_content(recording)?,
            ending: self.ending.clone(),
        };
        recorder.write(results, progress)
    }

    /// What a page shows next to the motion; empty if the recording has no page.
    fn page_content(&self, recording: &Recording) -> Result<PageContent, StudyError> {
        if !recording.has(OutputChoice::Html) {
            return Ok(PageContent::default());
        }
        let read = |path: &Path| input_file::read(path, LARGEST);
        let bytes = read(&self.path)?;
        let certificate = if self.is_checked {
            String::from_utf8(read(&self.path.with_file_name(CERTIFICATE))?).ok()
        } else {
            None
        };
        Ok(PageContent {
            fold: (bytes.len() as u64 <= LARGEST_FOLD).then_some(bytes),
            certificate,
            ..PageContent::default()
        })
    }

    /// Refuses settings that need what this motion does not have.
    fn require_states(&self, recording: &Recording) -> Result<(), StudyError> {
        let source = SceneSource::from_flags(&recording.scene.record);
        let ends = [self.motion.frames.first(), self.motion.frames.last()];
        let [first, last] = ends.map(|frame| frame.map_or(0.0, |f| f.time));
        let outside = |t: &&f64| !(first..=last).contains(*t);
        if let Some(time) = recording.at.iter().flatten().find(outside) {
            let message = format!(
                "t = {time} is not in {}, which runs from t = {first} to {last}",
                self.name
            );
            return Err(source.value_error("record.at", message));
        }
        if recording.colour == ColourChoice::Strain && !self.is_flat {
            let message = format!(
                "the key frame of {} is not a flat crease pattern, so rest lengths are unknown; use bending or paper",
                self.name
            );
            return Err(source.value_error("record.colour", message));
        }
        Ok(())
    }
}

/// The order of the triangles, from the `order` of the faces they were cut from.
fn of_triangles(order: &LayerOrder, file: &FoldFile) -> LayerOrder {
    let mut of_face = vec![Vec::new(); file.polygons.len()];
    for (triangle, &face) in (0..).zip(&file.triangle_faces) {
        of_face[face as usize].push(triangle);
    }
    let mut triangles = LayerOrder::default();
    for (f, g, sign) in order.iter() {
        for &a in &of_face[f as usize] {
            for &b in &of_face[g as usize] {
                triangles.insert(a, b, sign);
            }
        }
    }
    triangles
}

/// The marks of the certificate in the folder of the motion; `None` if there is no certificate of this file.
fn certificate_marks(path: &Path, motion: &Motion, sha256: &str, has_times: bool) -> Option<Marks> {
    let certificate_path = path.parent()?.join(CERTIFICATE);
    let certificate = read_certificate(&certificate_path).ok()?;
    if certificate.sha256 != sha256 {
        return None;
    }
    let report = claim(&certificate);
    let faces = motion.sheet.faces.len();
    let frames = motion.frames.len();
    let mut penetrations = report.penetrations.iter();
    let is_of_motion =
        penetrations.all(|p| p.frame < frames && p.faces.iter().all(|&f| (f as usize) < faces));
    if !is_of_motion {
        return None;
    }
    // Without times in the file, the times of the certificate count frames.
    Some(marks(motion, &report, |time| if has_times { time } else { stage_time(time, frames) }))
}

/// Converts times that count frames into motion times of one stage, from planar to compact.
fn as_one_stage(motion: &mut Motion) {
    let count = motion.frames.len();
    for frame in &mut motion.frames {
        frame.time = stage_time(frame.time, count);
    }
}

/// The motion time of frame `index` of `count` frames without times.
pub(crate) fn stage_time(index: f64, count: usize) -> f64 {
    1.0 + index / count.saturating_sub(1).max(1) as f64
}
