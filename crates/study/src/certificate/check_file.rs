//! Checks a motion file, which is read twice as a stream, and writes its certificate.

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use foldmotion_check::{CheckError, Checker, CollisionOptions, CollisionReport};
use foldmotion_geometry::Number;
use foldmotion_pattern::{FoldError, FoldFile, Frame, LayerOrder};
use sha2::{Digest as _, Sha256};

use crate::certificate::Certificate;
use crate::certificate::certify::{CertificateSource, MotionFile};
use crate::certificate::checked::CheckedFile;
use crate::digest::hexadecimal;
use crate::results::{CERTIFICATE, Command, Destination, Results, list_names};
use crate::{Phase, Progress, StudyError, input_file};

/// The largest motion file, bytes: 16 GiB.
pub(crate) const LARGEST: u64 = 16 << 30;

/// How a motion file is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckOptions {
    /// The tolerance τ, in units of the sheet's unit of length.
    pub tolerance: f64,
    /// The check ends at the next frame once more pairs of triangles than this penetrate; 0 means no limit.
    pub stop_at: usize,
}

impl Default for CheckOptions {
    fn default() -> Self {
        let options = CollisionOptions::default();
        Self { tolerance: options.touch_tolerance, stop_at: options.stop_at }
    }
}

/// Checks the motion in the FOLD file at `path`, of any origin, and returns its certificate with counts of the work done.
///
/// The file is read twice: first everything but the frames, then one frame at a time. Memory is that of the sheet and
/// a few frames, whatever their number.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::Motion`] and [`StudyError::LargeFile`] if the file is not a motion that can be
/// checked; [`StudyError::Interrupted`] if `progress` returned false.
pub fn check_file(
    path: &Path,
    options: &CheckOptions,
    progress: Progress<'_>,
) -> Result<CheckedFile, StudyError> {
    let check = check_motion_file(path, *options, progress)?;
    progress(Phase::Check, 1.0);
    let collision = &check.collision;
    Ok(CheckedFile {
        certificate: check.certificate(path),
        pairs_tested: collision.pairs_tested,
        decided_by: collision.decided_by,
        touching_pairs: collision.touching_pairs,
    })
}

/// A motion file with its collision report.
pub(crate) struct FileCheck {
    file: FoldFile,
    pub(crate) sha256: String,
    pub(crate) times: Vec<f64>,
    pub(crate) collision: CollisionReport,
}

impl FileCheck {
    /// The certificate of the file at `path`.
    pub(crate) fn certificate(&self, path: &Path) -> Certificate {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let motion = CertificateSource {
            name: &name,
            sha256: self.sha256.clone(),
            file: MotionFile::from(&self.file),
            times: &self.times,
            collision: &self.collision,
        };
        motion.certificate()
    }
}

/// Reads the file at `path` twice and checks its motion.
pub(crate) fn check_motion_file(
    path: &Path,
    options: CheckOptions,
    progress: Progress<'_>,
) -> Result<FileCheck, StudyError> {
    let (file, sha256) = read_header(path, progress)?;
    let mut input = MotionReader::open(path, Phase::Check, progress)?;
    let checker = RefCell::new(FrameChecker::new(&file, options));
    let read =
        file.frames(&mut input, &mut |frame, order| checker.borrow_mut().check(&frame, order));
    let checker = checker.into_inner();
    if input.is_stopped {
        return Err(StudyError::Interrupted);
    }
    read.map_err(|e| checker.explain(path, &e))?;
    input.require_unchanged(&sha256)?;
    if checker.times.len() < 2 {
        return Err(input.failure(&TooFewStates(checker.times.len())));
    }
    let (collision, times) = checker.finish().map_err(|e| motion_error(path, &e))?;
    Ok(FileCheck { file, sha256, times, collision })
}

impl Certificate {
    /// Writes `certificate.json` into a folder, whose other files are kept.
    ///
    /// # Errors
    /// [`StudyError::Output`], and [`StudyError::Conflict`] if the folder has another certificate that foldmotion did not
    /// write, which is then left unchanged.
    pub fn write<'a>(&self, destination: impl Into<Destination<'a>>) -> Result<(), StudyError> {
        let mut results = Results::open(destination.into(), Command::Check, Some(CERTIFICATE))?;
        let folder = results.folder().to_owned();
        results.write_bytes(CERTIFICATE, self.to_json().as_bytes())?;
        match results.publish(Some(&self.sha256), &|_| false)?.skipped {
            skipped if skipped.is_empty() => Ok(()),
            skipped => Err(StudyError::Conflict {
                path: folder,
                names: list_names(&skipped),
                command: Command::Check.name(),
            }),
        }
    }
}

/// A motion file that is hashed while it is read; reading stops if the user wants.
pub(crate) struct MotionReader<'a> {
    path: &'a Path,
    file: File,
    size: u64,
    read: u64,
    hash: Sha256,
    phase: Phase,
    progress: Progress<'a>,
    is_stopped: bool,
}

impl<'a> MotionReader<'a> {
    pub(crate) fn open(
        path: &'a Path,
        phase: Phase,
        progress: Progress<'a>,
    ) -> Result<Self, StudyError> {
        let (file, size) = input_file::open(path, LARGEST)?;
        Ok(Self {
            path,
            file,
            size,
            read: 0,
            hash: Sha256::new(),
            phase,
            progress,
            is_stopped: false,
        })
    }

    /// `outcome`, or [`StudyError::Interrupted`] if the user stopped the reading.
    pub(crate) fn unless_stopped<T>(&self, outcome: Result<T, FoldError>) -> Result<T, StudyError> {
        if self.is_stopped {
            return Err(StudyError::Interrupted);
        }
        outcome.map_err(|e| self.failure(&e))
    }

    pub(crate) fn failure(&self, message: &dyn std::fmt::Display) -> StudyError {
        motion_error(self.path, message)
    }

    /// Refuses a file that did not have the SHA-256 `sha256` now that all of it was read.
    pub(crate) fn require_unchanged(&self, sha256: &str) -> Result<(), StudyError> {
        if self.digest() == sha256 {
            return Ok(());
        }
        Err(self.failure(&"the file changed while it was read"))
    }

    fn digest(&self) -> String {
        hexadecimal(&self.hash.clone().finalize())
    }
}

/// Reads everything but the frames of the motion file at `path`; returns it with the SHA-256 of the file.
pub(crate) fn read_header(
    path: &Path,
    progress: Progress<'_>,
) -> Result<(FoldFile, String), StudyError> {
    let mut input = MotionReader::open(path, Phase::Read, progress)?;
    let file = FoldFile::read(&mut input);
    Ok((input.unless_stopped(file)?, input.digest()))
}

impl Read for MotionReader<'_> {
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
            return Err(io::Error::other("the file grew beyond 16 GiB"));
        }
        Ok(count)
    }
}

pub(crate) fn motion_error(path: &Path, message: &dyn std::fmt::Display) -> StudyError {
    StudyError::Motion { path: path.to_owned(), message: message.to_string() }
}

/// The error of a file with fewer states than a motion needs, and their number.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[error(
    "the file has {0} state(s) in file_frames and the key frame, and a motion needs two or more; to fold a crease pattern use \
     `foldmotion run`"
)]
pub(crate) struct TooFewStates(pub(crate) usize);

/// Why the second pass over the file ended.
#[derive(Debug, thiserror::Error)]
enum FrameError {
    #[error("{0}")]
    Fold(#[from] FoldError),
    #[error("{0}")]
    Check(#[from] CheckError),
}

/// Checks the frames of a motion file one by one.
struct FrameChecker<'a> {
    file: &'a FoldFile,
    options: CollisionOptions,
    checker: Option<Checker<'a>>,
    times: Vec<f64>,
}

impl<'a> FrameChecker<'a> {
    fn new(file: &'a FoldFile, options: CheckOptions) -> Self {
        Self {
            file,
            options: CollisionOptions {
                touch_tolerance: options.tolerance,
                stop_at: options.stop_at,
                ..CollisionOptions::default()
            },
            checker: None,
            times: Vec::new(),
        }
    }

    fn check(&mut self, frame: &Frame, order: &LayerOrder) -> Result<(), FrameError> {
        let before = self.times.last().copied();
        if let Some(before) = before.filter(|&before| before >= frame.time) {
            // A check that has stopped ignores later frames, so the order is checked here.
            return Err(FrameError::Check(CheckError::TimeOrder {
                frame: self.times.len(),
                time: frame.time,
                before,
            }));
        }
        if let Some(checker) = &mut self.checker {
            checker.advance(frame)?;
        } else {
            self.checker = Some(Checker::new(&self.file.sheet, frame, &self.options)?);
        }
        if let Some(checker) = &mut self.checker {
            let faces = &self.file.triangle_faces;
            checker.claim(order, &|triangle| faces[triangle as usize])?;
        }
        self.times.push(frame.time);
        Ok(())
    }

    /// The error with the indices of the file.
    fn explain(&self, path: &Path, error: &FrameError) -> StudyError {
        let at = self.file.frame_number(self.times.len());
        match (error, at) {
            (
                FrameError::Check(CheckError::DegenerateFace { face, height, limit, .. }),
                Some(at),
            ) => {
                let face = self.file.triangle_faces[*face];
                let message = format!(
                    "{at}: faces_vertices[{face}] has no area: the height of a triangle is {:.3}, and more than {:.3} is \
                     needed to tell its sides",
                    Number(*height),
                    Number(*limit)
                );
                motion_error(path, &message)
            }
            (FrameError::Check(CheckError::DuplicateFace { f, g }), _) => {
                let [f, g] = [f, g].map(|&t| self.file.triangle_faces[t as usize]);
                let message = format!("faces_vertices[{f}] and [{g}] have the same corners");
                motion_error(path, &message)
            }
            (FrameError::Check(error), Some(at)) => motion_error(path, &format!("{at}: {error}")),
            (error, _) => motion_error(path, error),
        }
    }

    fn finish(self) -> Result<(CollisionReport, Vec<f64>), CheckError> {
        let checker = self.checker.ok_or(CheckError::NoFrames)?;
        Ok((checker.finish(), self.times))
    }
}
