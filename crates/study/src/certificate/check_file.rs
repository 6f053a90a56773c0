//! Checks a motion file: reads it twice as a stream, judges it, writes the certificate.

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Read, Write as _};
use std::path::Path;

use foldmotion_check::{CheckError, Checker, CollisionOptions, CollisionReport};
use foldmotion_geometry::Number;
use foldmotion_pattern::{FoldError, FoldFile, Frame, LayerOrder};
use sha2::{Digest as _, Sha256};

use crate::certificate::Certificate;
use crate::certificate::certify::{CheckedMotion, MotionFile};
use crate::certificate::checked::CheckedFile;
use crate::digest::hexadecimal;
use crate::results::{CERTIFICATE, Destination, Maker, Results, listed, write_error};
use crate::{Phase, Progress, StudyError, input_file};

/// The largest motion file, bytes: 16 GiB.
pub(crate) const LARGEST: u64 = 16 << 30;

/// How a motion file is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckOptions {
    /// τ, in units of the sheet's unit of length.
    pub tolerance: f64,
    /// Once more pairs of triangles than this penetrate, the check ends at the next frame; 0: no limit.
    pub stop_at: usize,
}

impl Default for CheckOptions {
    fn default() -> Self {
        let options = CollisionOptions::default();
        Self {
            tolerance: options.touch_tolerance,
            stop_at: options.stop_at,
        }
    }
}

/// Judges the motion in the FOLD file at `path`, whoever made it, and returns what is proved of it and the work done.
///
/// The file is read twice: first everything but the frames, then one frame at a time. Memory is that of the sheet and
/// a few frames, however many there are.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::Motion`] and [`StudyError::LargeFile`] where the file is no motion that can
/// be judged; [`StudyError::Interrupted`] where `progress` returned false.
pub fn check_file(
    path: &Path,
    options: &CheckOptions,
    progress: Progress<'_>,
) -> Result<CheckedFile, StudyError> {
    let judged = judge_file(path, *options, progress)?;
    progress(Phase::Check, 1.0);
    let collision = &judged.collision;
    Ok(CheckedFile {
        certificate: judged.certificate(path),
        pairs_tested: collision.pairs_tested,
        decided_by: collision.decided_by,
        touching_pairs: collision.touching_pairs,
    })
}

/// A motion file with what was found of it.
pub(crate) struct JudgedFile {
    file: FoldFile,
    pub(crate) sha256: String,
    pub(crate) times: Vec<f64>,
    pub(crate) collision: CollisionReport,
}

impl JudgedFile {
    /// The certificate of the file, which stands at `path`.
    pub(crate) fn certificate(&self, path: &Path) -> Certificate {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let motion = CheckedMotion {
            name: &name,
            sha256: self.sha256.clone(),
            file: MotionFile::from(&self.file),
            times: &self.times,
            collision: &self.collision,
        };
        motion.certificate()
    }
}

/// Reads the file at `path` twice and judges its motion.
pub(crate) fn judge_file(
    path: &Path,
    options: CheckOptions,
    progress: Progress<'_>,
) -> Result<JudgedFile, StudyError> {
    let (file, described) = {
        let mut input = MotionReader::open(path, Phase::Read, progress)?;
        let file = FoldFile::read(&mut input);
        (input.unless_stopped(file)?, input.digest())
    };
    let mut input = MotionReader::open(path, Phase::Check, progress)?;
    let judge = RefCell::new(Judge::new(&file, options));
    let read = file.frames(&mut input, &mut |frame, order| {
        judge.borrow_mut().take(&frame, order)
    });
    let judge = judge.into_inner();
    if input.is_stopped {
        return Err(StudyError::Interrupted);
    }
    read.map_err(|e| judge.explain(path, &e))?;
    let sha256 = input.digest();
    if sha256 != described {
        return Err(input.failure(&"it changed while it was read"));
    }
    if judge.times.len() < 2 {
        return Err(input.failure(&NoMotion(judge.times.len())));
    }
    let (collision, times) = judge.finish().map_err(|e| motion_error(path, &e))?;
    Ok(JudgedFile {
        file,
        sha256,
        times,
        collision,
    })
}

impl Certificate {
    /// Writes `certificate.json` into a folder; other files there stay.
    ///
    /// # Errors
    /// [`StudyError::Output`], and [`StudyError::InTheWay`] where a certificate stands there that says something else and
    /// that foldmotion did not write; it is then as it was.
    pub fn write<'a>(&self, destination: impl Into<Destination<'a>>) -> Result<(), StudyError> {
        let mut results = Results::open(destination.into(), Maker::Check, Some(CERTIFICATE))?;
        let folder = results.folder().to_owned();
        results.write(CERTIFICATE, |out| {
            out.write_all(self.to_json().as_bytes())
                .map_err(|e| write_error(&folder, CERTIFICATE, e))
        })?;
        match results.publish(Some(&self.sha256), &|_| false)?.aside {
            aside if aside.is_empty() => Ok(()),
            aside => Err(StudyError::InTheWay {
                path: folder,
                names: listed(&aside),
                command: Maker::Check.name(),
            }),
        }
    }
}

/// A motion file under way: hashed, measured, and ended where the user wants.
pub(crate) struct MotionReader<'a> {
    path: &'a Path,
    file: File,
    size: u64,
    read: u64,
    hash: Sha256,
    phase: Phase,
    progress: Progress<'a>,
    pub(crate) is_stopped: bool,
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
        hexadecimal(&self.hash.clone().finalize())
    }
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
            return Err(io::Error::other("it grew beyond 16 GiB"));
        }
        Ok(count)
    }
}

pub(crate) fn motion_error(path: &Path, message: &dyn std::fmt::Display) -> StudyError {
    StudyError::Motion {
        path: path.to_owned(),
        message: message.to_string(),
    }
}

/// A file with fewer states than a motion has: how many.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[error(
    "it has {0} state(s), in file_frames or the key frame: a motion needs two or more; to fold a crease pattern use \
     `foldmotion run`"
)]
pub(crate) struct NoMotion(pub(crate) usize);

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
                stop_at: options.stop_at,
                ..CollisionOptions::default()
            },
            checker: None,
            times: Vec::new(),
        }
    }

    fn take(&mut self, frame: &Frame, order: &LayerOrder) -> Result<(), Ended> {
        let before = self.times.last().copied();
        if let Some(before) = before.filter(|&before| before >= frame.time) {
            // A check that has stopped looks at no frame any more.
            return Err(Ended::Check(CheckError::TimeOrder {
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
                    "{at}: faces_vertices[{face}] has no area: the height of a triangle is {:.3}, more than {:.3} is \
                     needed to tell its sides",
                    Number(*height),
                    Number(*limit)
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
