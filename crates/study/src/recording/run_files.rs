//! The files of a run beside its report.

use std::io::{self, Write};
use std::path::Path;

use foldmotion_check::{CollisionReport, penetration_spans};
use foldmotion_pattern::{FoldHeader, Motion};
use foldmotion_record::{Marks, Spot, plots};

use super::motion_file::{open_record, publish_record};
use super::page::LARGEST_FOLD;
use super::{Beside, Origin, Recorder, Recording};
use crate::certify::{CheckedMotion, MotionFile};
use crate::digest::HashedWriter;
use crate::folded::{Findings, Folded};
use crate::report::{OutcomeKind, SecondsReport};
use crate::results::{CERTIFICATE, MOTION, Results, write_error};
use crate::run::{Progress, VERSION};
use crate::scene::{OutputChoice, RecordScene};
use crate::series::{panels, write_csv};
use crate::study::Resolver;
use crate::{Certificate, Destination, Scene, SceneSource, Study, StudyError, UnitStudy};

impl Study {
    /// Records `folded` as `record` says, in the place of `[record]` of the scene, into `folder`; answers the names of the
    /// files. Other files there stay, but for pictures of an earlier film where there are new ones.
    ///
    /// # Errors
    /// [`StudyError`]: values that cannot be used, each named as a flag, and files that cannot be written; the folder is
    /// then as it was.
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

    /// `record` in the place of `[record]` of the scene.
    fn recording_as(&self, record: &RecordScene) -> Result<Recording, StudyError> {
        let source = SceneSource::of_flags(record);
        let scene = Scene {
            record: record.clone(),
            ..self.recording.scene.clone()
        };
        let resolver = Resolver {
            source: &source,
            scene: &scene,
        };
        resolver.recording(self.title.clone())
    }

    /// Writes everything that `recording` asks for and answers the SHA-256 of the motion.
    pub(crate) fn record(
        &self,
        recording: &Recording,
        folded: &Folded,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let (motion, findings) = (&folded.motion, &folded.findings);
        let outcome = &folded.outcome;
        let (sha256, beside) = self.record_fold(recording, folded, results)?;
        if recording.has(OutputChoice::Csv) {
            record_series(findings, results)?;
        }
        let recorder = Recorder {
            recording,
            motion,
            marks: marks(motion, &findings.collision, |time| time),
            title: &self.title,
            unit: self.unit_name,
            known: self.subject.units().map(UnitStudy::known),
            origin: Origin::of_scene(&recording.scene, sha256.clone()),
            has_rest_lengths: true,
            beside,
            ending: (outcome.kind != OutcomeKind::Folded).then(|| outcome.headline()),
        };
        recorder.write(results, progress)?;
        Ok(sha256)
    }

    fn write_fold(&self, folded: &Folded, out: impl Write) -> io::Result<String> {
        let mut keys = self.subject.kept_keys();
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

    /// The SHA-256 of the motion file of `folded`.
    pub(crate) fn digest(&self, folded: &Folded) -> Result<String, StudyError> {
        let failed = |e| write_error(Path::new(""), MOTION, e);
        self.write_fold(folded, io::sink()).map_err(failed)
    }

    /// Writes the motion and its certificate where they are asked for; answers the SHA-256 of the motion and what a page
    /// shows beside it.
    fn record_fold(
        &self,
        recording: &Recording,
        folded: &Folded,
        results: &mut Results,
    ) -> Result<(String, Beside), StudyError> {
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
                results.write(MOTION, |out| out.write_all(&bytes).map_err(failed))?;
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
            return Ok((sha256, Beside::default()));
        }
        let certificate = self.certificate(folded, sha256.clone()).to_json();
        if has_file {
            results.write(CERTIFICATE, |out| {
                out.write_all(certificate.as_bytes())
                    .map_err(|e| write_error(&folder, CERTIFICATE, e))
            })?;
        }
        if !has_page {
            return Ok((sha256, Beside::default()));
        }
        let beside = self.beside(folded, certificate, fold);
        Ok((sha256, beside))
    }

    pub(crate) fn certificate(&self, folded: &Folded, sha256: String) -> Certificate {
        let motion = &folded.motion;
        let times: Vec<f64> = motion.frames.iter().map(|f| f.time).collect();
        let checked = CheckedMotion {
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

    /// What a page shows beside the motion.
    fn beside(&self, folded: &Folded, certificate: String, fold: Option<Vec<u8>>) -> Beside {
        let findings = &folded.findings;
        let first = findings.collision.first.as_ref().map(|p| p.time);
        // A page leaves out seconds and files.
        let report = self.report(folded, SecondsReport::NONE, &[]);
        Beside {
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
    let folder = results.folder().to_owned();
    results.write("motion.csv", |out| {
        write_csv(&findings.series, out).map_err(|e| write_error(&folder, "motion.csv", e))
    })?;
    let svg = plots(&panels(&findings.series, first))?;
    results.write("plots.svg", |out| {
        out.write_all(svg.as_bytes())
            .map_err(|e| write_error(&folder, "plots.svg", e))
    })
}

/// The two facets that are the first to penetrate each other, while they do, and where they begin to: all that cross later
/// would hide it. `shown`: the motion time of a time of `motion`.
pub(super) fn marks(
    motion: &Motion,
    collision: &CollisionReport,
    shown: impl Fn(f64) -> f64,
) -> Marks {
    let mut marks = Marks::default();
    let Some(first) = &collision.first else {
        return marks;
    };
    let [face, _] = first.faces;
    let spot = Spot::on(motion, face, first.point, first.passed, shown(first.time));
    if let Some(spot) = spot {
        marks.point_out(spot);
    }
    for span in penetration_spans(motion, collision) {
        if span.faces == first.faces {
            for face in span.faces {
                marks.insert(face, shown(span.from), shown(span.to));
            }
        }
    }
    marks
}

#[cfg(test)]
mod tests {
    use foldmotion_record::FigureState;

    use super::*;

    #[test]
    fn only_the_first_penetration_of_many_is_marked_and_its_place_is_pointed_out() {
        let scene = include_str!("../../../../scenes/shelter-short-plain.toml");
        let mut scene: toml::Table = scene.parse().unwrap();
        let motion: toml::Table = "contact = false\nframes = 48".parse().unwrap();
        scene.insert("motion".to_owned(), motion.into());
        let source = SceneSource::new(Path::new("scene.toml"), scene.to_string());
        let study = Study::resolve(&source).unwrap();
        let folded = study.compute(&|_, _| true).unwrap();
        let (motion, collision) = (&folded.motion, &folded.findings.collision);
        let first = collision.first.as_ref().unwrap();
        assert!(
            collision.penetrations.len() > 4,
            "it crosses in many places"
        );
        let marks = marks(motion, collision, |time| time);
        let facets = |time: f64| {
            let marked = FigureState::at(motion, &marks, time).marked;
            let faces = (0..marked.len()).filter(|&face| marked[face]);
            let mut facets: Vec<u32> = faces.map(|f| motion.sheet.face_facets[f]).collect();
            facets.sort_unstable();
            facets.dedup();
            facets
        };
        let mut pair = first.faces.map(|f| motion.sheet.face_facets[f as usize]);
        pair.sort_unstable();
        assert_eq!(facets(first.passed), pair);
        for frame in &motion.frames {
            assert!(facets(frame.time).iter().all(|facet| pair.contains(facet)));
        }
        let spot = |time| FigureState::at(motion, &marks, time).spot;
        let place = spot(first.passed).unwrap();
        let apart = place.distance(first.point) / motion.sheet.unit_length;
        assert!(apart < 10.0 * collision.tolerance, "{apart} h");
        assert!(spot(2.0).is_some() && spot(first.time - 1e-6).is_none());
    }
}
