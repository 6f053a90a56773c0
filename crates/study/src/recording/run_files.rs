//! The files of a run, except its report.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use foldmotion_pattern::{FoldHeader, Motion};
use foldmotion_record::plots;

use super::marks::marks;
use super::motion_file::{open_record, publish_record};
use super::page::LARGEST_FOLD;
use super::{PageContent, Recorder, Recording, SourceInfo};
use crate::certificate::certify::{CertificateSource, MotionFile};
use crate::compute::folded::{Findings, Folded};
use crate::compute::series::{csv, panels};
use crate::digest::HashedWriter;
use crate::report::{OutcomeKind, SecondsReport};
use crate::resolve::input::Input;
use crate::resolve::recording::recording as resolved;
use crate::results::{CERTIFICATE, MOTION, Results, write_error};
use crate::scene::{OutputChoice, RecordScene};
use crate::{Certificate, Destination, Scene, SceneSource, Study, StudyError};
use crate::{Progress, VERSION};

impl Study {
    /// Records `folded` into `destination` with the settings `record` instead of the scene's `[record]`; returns the names of
    /// the files. Other files in the folder are kept, except for the pictures of an earlier film if there are new ones.
    ///
    /// # Errors
    /// [`StudyError`] of values that cannot be used, with the key as a flag, and of files that cannot be written; the folder is
    /// then unchanged.
    pub fn record_as<'a>(
        &self,
        folded: &Folded,
        record: &RecordScene,
        destination: impl Into<Destination<'a>>,
        progress: Progress<'_>,
    ) -> Result<Vec<String>, StudyError> {
        let recording = self.recording_as(record)?;
        let mut results = open_record(&recording, destination.into())?;
        let frames = folded.motion.frames.len();
        results.require(&self.space_in(&results, &recording, frames, progress)?)?;
        let sha256 = self.record(&recording, folded, &mut results, progress)?;
        publish_record(results, &recording, &sha256).map(|(files, _)| files)
    }

    /// The recording with `record` instead of the scene's `[record]`.
    fn recording_as(&self, record: &RecordScene) -> Result<Recording, StudyError> {
        let source = SceneSource::from_flags(record);
        let scene = Scene { record: record.clone(), ..self.recording.scene.clone() };
        let input = Input::new(&source, &scene);
        resolved(&input, self.title.clone())
    }

    /// Writes all outputs of `recording`; returns the SHA-256 of the motion.
    pub(crate) fn record(
        &self,
        recording: &Recording,
        folded: &Folded,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let (motion, findings) = (&folded.motion, &folded.findings);
        let outcome = &folded.outcome;
        let (sha256, page_content) = self.record_fold(recording, folded, results)?;
        if recording.has(OutputChoice::Csv) {
            record_series(findings, results)?;
        }
        let recorder = Recorder {
            recording,
            motion,
            marks: marks(motion, &findings.collision, |time| time),
            title: &self.title,
            unit: self.unit_name,
            units: self.subject.units(),
            source_info: SourceInfo::of_scene(&recording.scene, sha256.clone()),
            has_rest_lengths: true,
            page_content,
            ending: (outcome.kind != OutcomeKind::Folded).then(|| outcome.headline()),
        };
        recorder.write(results, progress)?;
        Ok(sha256)
    }

    fn write_fold(&self, folded: &Folded, out: impl Write) -> io::Result<String> {
        let mut keys = self.subject.preserved_keys();
        let outcome = folded.outcome.headline().into();
        keys.insert("foldmotion:outcome".to_owned(), outcome);
        let header = FoldHeader {
            title: &self.title,
            creator: &format!("foldmotion {VERSION}"),
            unit: self.unit_name,
            target_angles: self.subject.end_angles(),
            layer_orders: &folded.findings.layer_orders,
            keys: &keys,
        };
        let mut out = HashedWriter::new(out);
        folded.motion.write_fold(&header, &mut out)?;
        Ok(out.digest())
    }

    /// Writes the motion of `folded` as the FOLD file `path`, with the bytes of a run's `motion.fold`.
    ///
    /// # Errors
    /// [`StudyError::Output`].
    pub fn write_motion(&self, folded: &Folded, path: &Path) -> Result<(), StudyError> {
        let write = || {
            let mut out = BufWriter::new(File::create(path)?);
            self.write_fold(folded, &mut out)?;
            out.flush()
        };
        write().map_err(|e| write_error(path.parent().unwrap_or(Path::new("")), MOTION, e))
    }

    /// The SHA-256 of the motion file of `folded`.
    pub(crate) fn digest(&self, folded: &Folded) -> Result<String, StudyError> {
        let failed = |e| write_error(Path::new(""), MOTION, e);
        self.write_fold(folded, io::sink()).map_err(failed)
    }

    /// Writes the motion file and its certificate if the recording has them; returns the SHA-256 of the motion and what a page
    /// shows next to the motion.
    fn record_fold(
        &self,
        recording: &Recording,
        folded: &Folded,
        results: &mut Results,
    ) -> Result<(String, PageContent), StudyError> {
        let folder = results.folder().to_owned();
        let failed = |e| write_error(&folder, MOTION, e);
        let [has_file, has_page] =
            [OutputChoice::Fold, OutputChoice::Html].map(|o| recording.has(o));
        let motion = &folded.motion;
        let size = Motion::fold_file_size(&motion.sheet, motion.frames.len());
        let mut sha256 = String::new();
        let mut fold = None;
        if has_page && size <= LARGEST_FOLD {
            let mut bytes = Vec::new();
            sha256 = self.write_fold(folded, &mut bytes).map_err(failed)?;
            if has_file {
                results.write_bytes(MOTION, &bytes)?;
            }
            fold = Some(bytes);
        } else if has_file {
            results.write(MOTION, |out| {
                sha256 = self.write_fold(folded, out).map_err(failed)?;
                Ok(())
            })?;
        } else {
            sha256 = self.digest(folded)?;
        }
        if !has_file && !has_page {
            return Ok((sha256, PageContent::default()));
        }
        let certificate = self.certificate(folded, sha256.clone()).to_json();
        if has_file {
            results.write_bytes(CERTIFICATE, certificate.as_bytes())?;
        }
        if !has_page {
            return Ok((sha256, PageContent::default()));
        }
        let content = self.page_content(folded, certificate, fold);
        Ok((sha256, content))
    }

    /// The certificate of `folded`, as it is written next to its motion file.
    ///
    /// # Errors
    /// [`StudyError::Output`] if the motion has a position that is not finite.
    pub fn certificate_of(&self, folded: &Folded) -> Result<Certificate, StudyError> {
        Ok(self.certificate(folded, self.digest(folded)?))
    }

    pub(crate) fn certificate(&self, folded: &Folded, sha256: String) -> Certificate {
        let motion = &folded.motion;
        let times: Vec<f64> = motion.frames.iter().map(|f| f.time).collect();
        let checked = CertificateSource {
            name: MOTION,
            sha256,
            file: MotionFile {
                title: Some(self.title.clone()),
                sheet: &motion.sheet,
                faces: motion.sheet.faces.len(),
                cut_faces: 0,
                triangle_faces: None,
                has_facets: true,
                has_unit_length: true,
            },
            times: &times,
            collision: &folded.findings.collision,
        };
        checked.certificate()
    }

    /// What a page shows next to the motion.
    fn page_content(
        &self,
        folded: &Folded,
        certificate: String,
        fold: Option<Vec<u8>>,
    ) -> PageContent {
        let findings = &folded.findings;
        let first = findings.collision.first.as_ref().map(|p| p.time);
        // A page omits seconds and files.
        let report = self.report(folded, SecondsReport::NONE, &[]);
        PageContent {
            report: Some(report.to_json()),
            certificate: Some(certificate),
            fold,
            panels: panels(&findings.series, first),
        }
    }
}

/// `motion.csv` and `plots.svg`.
fn record_series(findings: &Findings, results: &mut Results) -> Result<(), StudyError> {
    let first = findings.collision.first.as_ref().map(|p| p.time);
    results.write_bytes("motion.csv", csv(&findings.series).as_bytes())?;
    let svg = plots(&panels(&findings.series, first))?;
    results.write_bytes("plots.svg", svg.as_bytes())
}
