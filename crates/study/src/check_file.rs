//! Checks a motion file: reads it twice as a stream, judges it, writes the certificate.

use std::cell::RefCell;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Read, Write as _};
use std::path::Path;

use foldmotion_check::{CheckError, Checker, CollisionOptions, CollisionReport, Separation};
use foldmotion_pattern::{FoldError, FoldFile, Frame};
use glam::DVec3;
use sha2::{Digest as _, Sha256};

use crate::certificate::{
    Certificate, DecidedBy, PairsTested, PenetrationEntry, SeparationEntry, TrianglePair,
    UndecidedEntry,
};
use crate::reporting::{kind_name, verdict_name};
use crate::results::{Results, write_error};
use crate::run::VERSION;
use crate::{Phase, Progress, StudyError};

/// The name under which the certificate stands.
const CERTIFICATE: &str = "certificate.json";

/// The largest motion file, bytes: 16 GiB.
const LARGEST: u64 = 16 << 30;

/// How a motion file is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckOptions {
    /// τ, in units of the sheet's unit of length.
    pub tolerance: f64,
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self {
            tolerance: CollisionOptions::default().touch_tolerance,
        }
    }
}

/// Judges the motion in the FOLD file at `path`, whoever made it, and returns what is proved of it.
///
/// The file is read twice: first everything but the frames, then one frame at a time. Memory is that of the sheet and
/// a few frames, however many there are.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::Motion`] and [`StudyError::LargeMotion`] where the file is no motion that can
/// be judged; [`StudyError::Interrupted`] where `progress` returned false.
pub fn check_file(
    path: &Path,
    options: &CheckOptions,
    progress: Progress<'_>,
) -> Result<Certificate, StudyError> {
    let (file, described) = {
        let mut input = Input::open(path, Phase::Read, progress)?;
        let file = FoldFile::read(&mut input);
        (input.unless_stopped(file)?, input.digest())
    };
    let mut input = Input::open(path, Phase::Check, progress)?;
    let judge = RefCell::new(Judge::new(&file, *options));
    let read = file.frames(&mut input, &mut |frame| judge.borrow_mut().take(&frame));
    let judge = judge.into_inner();
    if input.is_stopped {
        return Err(StudyError::Interrupted);
    }
    read.map_err(|e| judge.explain(path, &e))?;
    let sha256 = input.digest();
    if sha256 != described {
        return Err(input.failure(&"it changed while it was read"));
    }
    let (report, times) = judge.finish().map_err(|e| motion_error(path, &e))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let certificate = certificate(&file, &report, &times);
    progress(Phase::Check, 1.0);
    Ok(Certificate {
        file: name.into_owned(),
        sha256,
        ..certificate
    })
}

impl Certificate {
    /// Writes `certificate.json` into `folder`; other files there stay.
    ///
    /// # Errors
    /// [`StudyError::Output`]; an earlier certificate is then as it was.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let mut results = Results::of(folder, &[CERTIFICATE], CERTIFICATE)?;
        results.write(CERTIFICATE, |out| {
            out.write_all(self.to_json().as_bytes())
                .map_err(|e| write_error(folder, CERTIFICATE, e))
        })?;
        results.publish()
    }
}

/// A motion file under way: hashed, measured, and ended where the user wants.
pub(crate) struct Input<'a> {
    path: &'a Path,
    file: File,
    size: u64,
    read: u64,
    hash: Sha256,
    phase: Phase,
    progress: Progress<'a>,
    pub(crate) is_stopped: bool,
}

impl<'a> Input<'a> {
    pub(crate) fn open(
        path: &'a Path,
        phase: Phase,
        progress: Progress<'a>,
    ) -> Result<Self, StudyError> {
        let failed = |source| StudyError::Read {
            path: path.to_owned(),
            source,
        };
        let data = std::fs::metadata(path).map_err(failed)?;
        if !data.is_file() {
            let message = "it is no file; a motion is read twice";
            return Err(failed(io::Error::new(io::ErrorKind::InvalidInput, message)));
        }
        if data.len() > LARGEST {
            return Err(StudyError::LargeMotion {
                path: path.to_owned(),
                size: data.len(),
                limit: LARGEST,
            });
        }
        Ok(Self {
            path,
            file: File::open(path).map_err(failed)?,
            size: data.len(),
            read: 0,
            hash: Sha256::new(),
            phase,
            progress,
            is_stopped: false,
        })
    }

    pub(crate) fn unless_stopped<T>(&self, outcome: Result<T, FoldError>) -> Result<T, StudyError> {
        if self.is_stopped {
            return Err(StudyError::Interrupted);
        }
        outcome.map_err(|e| self.failure(&e))
    }

    pub(crate) fn failure(&self, message: &dyn std::fmt::Display) -> StudyError {
        motion_error(self.path, message)
    }

    pub(crate) fn digest(&self) -> String {
        let bytes = self.hash.clone().finalize();
        let mut text = String::with_capacity(2 * bytes.len());
        for byte in bytes {
            // Writing into a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}

impl Read for Input<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let share = self.read as f64 / self.size.max(1) as f64;
        if !(self.progress)(self.phase, share) {
            self.is_stopped = true;
            return Err(io::Error::other("interrupted"));
        }
        let count = self.file.read(buffer)?;
        self.hash.update(&buffer[..count]);
        self.read += count as u64;
        if self.read > LARGEST {
            return Err(io::Error::other("it grew beyond 16 GiB"));
        }
        Ok(count)
    }
}

fn motion_error(path: &Path, message: &dyn std::fmt::Display) -> StudyError {
    StudyError::Motion {
        path: path.to_owned(),
        message: message.to_string(),
    }
}

/// Why the second reading ended.
#[derive(Debug, thiserror::Error)]
enum Ended {
    #[error("{0}")]
    Fold(#[from] FoldError),
    #[error("{0}")]
    Check(#[from] CheckError),
}

/// The check under way.
struct Judge<'a> {
    file: &'a FoldFile,
    options: CollisionOptions,
    checker: Option<Checker<'a>>,
    times: Vec<f64>,
}

impl<'a> Judge<'a> {
    fn new(file: &'a FoldFile, options: CheckOptions) -> Self {
        Self {
            file,
            options: CollisionOptions {
                touch_tolerance: options.tolerance,
                ..CollisionOptions::default()
            },
            checker: None,
            times: Vec::new(),
        }
    }

    fn take(&mut self, frame: &Frame) -> Result<(), Ended> {
        match &mut self.checker {
            Some(checker) => checker.advance(frame)?,
            None => self.checker = Some(Checker::new(&self.file.sheet, frame, &self.options)?),
        }
        self.times.push(frame.time);
        Ok(())
    }

    /// The error in the numbers of the file.
    fn explain(&self, path: &Path, error: &Ended) -> StudyError {
        let at = self.file.frame_number(self.times.len());
        match (error, at) {
            (
                Ended::Check(CheckError::DegenerateFace {
                    face,
                    height,
                    limit,
                    ..
                }),
                Some(at),
            ) => {
                let face = self.file.triangle_faces[*face];
                let message = format!(
                    "{at}: faces_vertices[{face}] has no area: the height of a triangle is {height:e}, more than \
                     {limit:e} is needed to tell its sides"
                );
                motion_error(path, &message)
            }
            (Ended::Check(CheckError::DuplicateFace { f, g }), _) => {
                let [f, g] = [f, g].map(|&t| self.file.triangle_faces[t as usize]);
                let message = format!("faces_vertices[{f}] and [{g}] have the same corners");
                motion_error(path, &message)
            }
            (Ended::Check(error), Some(at)) => motion_error(path, &format!("{at}: {error}")),
            (error, _) => motion_error(path, error),
        }
    }

    fn finish(self) -> Result<(CollisionReport, Vec<f64>), CheckError> {
        let checker = self.checker.ok_or(CheckError::NoFrames)?;
        Ok((checker.finish(), self.times))
    }
}

fn certificate(file: &FoldFile, report: &CollisionReport, times: &[f64]) -> Certificate {
    let first_and_last = [times.first(), times.last()].map(|t| t.copied().unwrap_or(0.0));
    let pairs = report.pairs_tested;
    let by = report.decided_by;
    let quick = by.boxes + by.axis_at_rest + by.turning_axis;
    Certificate {
        version: VERSION.to_owned(),
        file: String::new(),
        sha256: String::new(),
        title: file.title.clone(),
        verdict: verdict_name(report.verdict).to_owned(),
        tolerance: report.tolerance,
        unit_length: file.sheet.unit_length,
        assumptions: assumptions(file),
        frames: times.len(),
        times: first_and_last,
        vertices: file.sheet.vertices.len(),
        faces: file.polygons.len(),
        triangles: file.sheet.faces.len(),
        pairs_tested: PairsTested {
            disjoint: pairs.disjoint,
            shared_vertex: pairs.shared_vertex,
            shared_crease: pairs.shared_crease,
            total: pairs.total(),
        },
        decided_by: DecidedBy {
            boxes: by.boxes,
            axis_at_rest: by.axis_at_rest,
            turning_axis: by.turning_axis,
            search: by.search,
            share_without_search: quick as f64 / (quick + by.search).max(1) as f64,
        },
        min_separation: report.min_separation.map(|s| separation(file, &s)),
        touching_pairs: report.touching_pairs,
        penetrations: penetrations(file, report, times),
        undecided: undecided(file, report, times),
    }
}

pub(crate) fn assumptions(file: &FoldFile) -> Vec<String> {
    let cut = file.polygons.iter().filter(|p| p.len() > 3).count();
    let polygons = match cut {
        0 => "All faces are triangles.".to_owned(),
        _ => format!(
            "{cut} faces with more than three corners were cut into triangles, convex ones from their first corner, \
             others ear by ear; each moves as its triangles do."
        ),
    };
    let unit = if file.has_unit_length {
        "The unit of length is the file's foldmotion:unitLength."
    } else {
        "The unit of length is the mean side of the faces in the key frame, or in the first frame where that has none."
    };
    [
        "Between frames every vertex moves on a straight line at constant speed.",
        "Nothing is said of motion before, after or other than the recorded frames.",
        "Coordinates are taken as the f64 numbers nearest to the decimals of the file.",
        "The material has no thickness.",
        "Facets that overlap by at most the tolerance and leave on the side they came from touch.",
        "Facets in contact at the first frame may lie on any side they allow there; creases folded by 180 degrees \
         there lie on the side of their assignment.",
        &polygons,
        unit,
    ]
    .map(str::to_owned)
    .to_vec()
}

pub(crate) fn triangle_pair(file: &FoldFile, triangles: [u32; 2]) -> TrianglePair {
    let facets = triangles.map(|t| file.sheet.face_facets[t as usize]);
    TrianglePair {
        triangles,
        faces: triangles.map(|t| file.triangle_faces[t as usize]),
        facets: file.has_facets.then_some(facets),
    }
}

fn separation(file: &FoldFile, s: &Separation) -> SeparationEntry {
    SeparationEntry {
        distance: s.distance,
        t: s.time,
        pair: triangle_pair(file, s.faces),
        points: s.points.map(DVec3::into),
    }
}

fn penetrations(file: &FoldFile, report: &CollisionReport, times: &[f64]) -> Vec<PenetrationEntry> {
    let entry = |p: &foldmotion_check::Penetration| {
        // What the first frame shows already is no interval's.
        let is_first = p.frame == 0 && p.passed == times[0];
        let frames = [p.frame, if is_first { 0 } else { p.frame + 1 }];
        PenetrationEntry {
            frames,
            interval: frames.map(|k| times[k]),
            t: p.time,
            passed_t: p.passed,
            kind: kind_name(p.kind).to_owned(),
            pair: triangle_pair(file, p.faces),
            vertices: p.vertices.clone(),
            point: p.point.into(),
            depth: p.depth,
        }
    };
    report.penetrations.iter().map(entry).collect()
}

fn undecided(file: &FoldFile, report: &CollisionReport, times: &[f64]) -> Vec<UndecidedEntry> {
    let entry = |u: &foldmotion_check::Undecided| {
        let frames = [u.frame, u.frame + 1];
        UndecidedEntry {
            frames,
            interval: frames.map(|k| times[k]),
            t: u.time,
            pair: triangle_pair(file, u.faces),
        }
    };
    report.undecided.iter().map(entry).collect()
}
