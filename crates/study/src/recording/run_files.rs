//! The files of a run beside its report.

use std::io::{self, Write};

use foldmotion_check::{CollisionReport, penetration_spans};
use foldmotion_pattern::{FoldHeader, Motion};
use foldmotion_record::{Marks, plots};

use super::page::LARGEST_FOLD;
use super::{Beside, Origin, Recorder};
use crate::certify::{CheckedMotion, MotionFile};
use crate::digest::HashedWriter;
use crate::refinement::Folded;
use crate::report::SecondsReport;
use crate::results::{CERTIFICATE, MOTION, Results, write_error};
use crate::run::{Checked, Progress, VERSION};
use crate::scene::OutputChoice;
use crate::series::{panels, write_csv};
use crate::{Study, StudyError, UnitStudy};

impl Study {
    /// Writes everything the scene asks for and answers the SHA-256 of the motion.
    pub(crate) fn record(
        &self,
        folded: &Folded,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let (motion, checked) = (&folded.motion, &folded.checked);
        let sha256 = self.record_fold(motion, checked, results)?;
        if self.recording.has(OutputChoice::Csv) {
            record_series(checked, results)?;
        }
        let recorder = Recorder {
            recording: &self.recording,
            motion,
            marks: marks(motion, &checked.collision),
            title: &self.title,
            unit: self.unit_name,
            known: self.subject.units().map(UnitStudy::known),
            origin: Origin::of_scene(&self.recording.scene, sha256.clone()),
            has_rest_lengths: true,
            beside: self.beside(folded, &sha256, results)?,
        };
        recorder.write(results, progress)?;
        Ok(sha256)
    }

    fn write_fold(
        &self,
        motion: &Motion,
        checked: &Checked,
        out: impl Write,
    ) -> io::Result<String> {
        let header = FoldHeader {
            title: &self.title,
            creator: &format!("foldmotion {VERSION}"),
            unit: self.unit_name,
            target_angles: self.subject.end_angles(),
            layer_orders: &checked.layer_orders,
            keys: &self.subject.kept_keys(),
        };
        let mut out = HashedWriter::new(out);
        motion.write_fold(&header, &mut out)?;
        Ok(out.digest())
    }

    /// Writes the motion and its certificate where they are asked for, and answers the SHA-256 of the motion.
    fn record_fold(
        &self,
        motion: &Motion,
        checked: &Checked,
        results: &mut Results,
    ) -> Result<String, StudyError> {
        let folder = results.folder().to_owned();
        let failed = |e| write_error(&folder, MOTION, e);
        if !self.recording.has(OutputChoice::Fold) {
            return self.write_fold(motion, checked, io::sink()).map_err(failed);
        }
        let mut sha256 = String::new();
        results.write(MOTION, |out| {
            sha256 = self.write_fold(motion, checked, out).map_err(failed)?;
            Ok(())
        })?;
        let certificate = self.certificate(motion, checked, &sha256);
        results.write(CERTIFICATE, |out| {
            out.write_all(certificate.as_bytes())
                .map_err(|e| write_error(&folder, CERTIFICATE, e))
        })?;
        Ok(sha256)
    }

    fn certificate(&self, motion: &Motion, checked: &Checked, sha256: &str) -> String {
        let times: Vec<f64> = motion.frames.iter().map(|f| f.time).collect();
        let checked = CheckedMotion {
            name: MOTION,
            sha256: sha256.to_owned(),
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
            collision: &checked.collision,
        };
        checked.certificate().to_json()
    }

    /// What a page shows beside the motion; nothing where none is asked for.
    fn beside(
        &self,
        folded: &Folded,
        sha256: &str,
        results: &Results,
    ) -> Result<Beside, StudyError> {
        if !self.recording.has(OutputChoice::Html) {
            return Ok(Beside::default());
        }
        let (motion, checked) = (&folded.motion, &folded.checked);
        let mut fold = None;
        if Motion::fold_file_size(&motion.sheet, motion.frames.len()) <= LARGEST_FOLD {
            let mut bytes = Vec::new();
            self.write_fold(motion, checked, &mut bytes)
                .map_err(|e| write_error(results.folder(), MOTION, e))?;
            fold = Some(bytes);
        }
        let first = checked.collision.first.as_ref().map(|p| p.time);
        // A page leaves out seconds and files.
        let report = self.report(folded, SecondsReport::NONE, &[]);
        Ok(Beside {
            report: Some(report.to_json()),
            certificate: Some(self.certificate(motion, checked, sha256)),
            fold,
            panels: panels(&checked.series, first),
        })
    }
}

/// `motion.csv` and `plots.svg`.
fn record_series(checked: &Checked, results: &mut Results) -> Result<(), StudyError> {
    let first = checked.collision.first.as_ref().map(|p| p.time);
    let folder = results.folder().to_owned();
    results.write("motion.csv", |out| {
        write_csv(&checked.series, out).map_err(|e| write_error(&folder, "motion.csv", e))
    })?;
    let svg = plots(&panels(&checked.series, first))?;
    results.write("plots.svg", |out| {
        out.write_all(svg.as_bytes())
            .map_err(|e| write_error(&folder, "plots.svg", e))
    })
}

/// The facets that penetrate each other, while they do.
pub(super) fn marks(motion: &Motion, collision: &CollisionReport) -> Marks {
    let mut marks = Marks::default();
    for span in penetration_spans(motion, collision) {
        for face in span.faces {
            marks.insert(face, span.from, span.to);
        }
    }
    marks
}
