//! Reproduces a recorded file from the source information inside it.

use std::path::{Path, PathBuf};

use super::models::state_name;
use super::motion_file::{LoadedMotion, recording};
use super::source_info::{LARGEST, SourceInfo};
use crate::results::{Command, FRAMES, Results, output_error};
use crate::scene::OutputChoice;
use crate::{Progress, VERSION};
use crate::{Scene, SceneSource, Study, StudyError, input_file};

/// A reproduced file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reproduction {
    /// The path of the reproduced file.
    pub path: PathBuf,
    /// Whether it has the same bytes as the original.
    pub is_same: bool,
    /// Reasons why the bytes may differ, for the user.
    pub warnings: Vec<String>,
}

/// Reproduces `file` in the folder `out` under its own name, or next to it as `NAME-again`.
///
/// If the file was recorded by a run, its scene is run again; relative paths in the scene are resolved from the folder of
/// `file`. If it was recorded from a motion file, that is `motion` or the file of the recorded name in the folder of `file`,
/// in its parent folder, or in the working folder. The bytes may differ with another version, motion or kind of processor;
/// [`Reproduction::warnings`] then gives the reasons.
///
/// # Errors
/// [`StudyError::SourceInfo`] if the file has no source information or the motion is not found; those of a run and of
/// `record_file`.
pub fn reproduce_file(
    file: &Path,
    motion: Option<&Path>,
    out: Option<&Path>,
    replaces_all: bool,
    progress: Progress<'_>,
) -> Result<Reproduction, StudyError> {
    let source_info = SourceInfo::read(file)?;
    let original = Original::new(file, &source_info)?;
    let target = original.target(out);
    let folder = target.parent().unwrap_or(Path::new(""));
    let earlier = input_file::read(file, LARGEST)?;
    require_clear(&target, &earlier, replaces_all)?;
    let mut results = Results::open((&folder.join("again")).into(), Command::Record, None)?;
    let mut warnings = Vec::new();
    if source_info.version != VERSION {
        warnings.push(format!(
            "the file was recorded by foldmotion {}, and this is {VERSION}: the bytes may differ",
            source_info.version
        ));
    }
    if let (Some(_), Some(motion)) = (&source_info.scene, motion) {
        return Err(original.error(format!(
            "the file was recorded by running a scene, which it contains, so no motion is needed: omit {}",
            motion.display()
        )));
    }
    let found = match &source_info.scene {
        Some(scene) => original.run(scene, &mut results, progress)?,
        None => original.record(&source_info, motion, &mut results, progress)?,
    };
    if found != source_info.sha256 {
        warnings.push(format!(
            "the SHA-256 of the motion is {found}, but the file was recorded from {}: the bytes may differ",
            source_info.sha256
        ));
    }
    let name = original.name()?;
    if !results.written().contains(&name) {
        return Err(original
            .error(format!("the recording has no {name}: rename the file to its original name")));
    }
    let made = results.take(&name, &target, replaces_all)?;
    Ok(Reproduction { path: target, is_same: made == earlier, warnings })
}

/// The file to reproduce.
struct Original<'a> {
    file: &'a Path,
    output: OutputChoice,
    state: Option<f64>,
}

impl<'a> Original<'a> {
    fn new(file: &'a Path, source_info: &SourceInfo) -> Result<Self, StudyError> {
        let extension = file.extension().unwrap_or_default().to_string_lossy();
        let output = OutputChoice::ALL
            .into_iter()
            .find(|output| output.name() == extension.to_ascii_lowercase());
        let output = output.ok_or_else(|| StudyError::SourceInfo {
            path: file.to_owned(),
            message: "its extension is not gif, mp4, png, svg, pdf, glb, obj or html: rename the file to its original name".to_owned(),
        })?;
        Ok(Self { file, output, state: source_info.state })
    }

    fn error(&self, message: String) -> StudyError {
        StudyError::SourceInfo { path: self.file.to_owned(), message }
    }

    fn file_name(&self) -> String {
        let name = self.file.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    fn folder(&self) -> &Path {
        self.file.parent().unwrap_or(Path::new(""))
    }

    /// The name of the file in a folder of results.
    fn name(&self) -> Result<String, StudyError> {
        Ok(match (self.output, self.state) {
            (OutputChoice::Png, _) => format!("{FRAMES}/{}", self.file_name()),
            (OutputChoice::Svg | OutputChoice::Pdf, _) => {
                format!("figure.{}", self.output.name())
            }
            (OutputChoice::Obj, Some(time)) => state_name(time, self.output),
            (OutputChoice::Gif | OutputChoice::Mp4 | OutputChoice::Glb | OutputChoice::Html, _) => {
                format!("motion.{}", self.output.name())
            }
            _ => return Err(self.error("files of this kind cannot be reproduced".to_owned())),
        })
    }

    /// The path of the reproduced file.
    fn target(&self, out: Option<&Path>) -> PathBuf {
        let Some(out) = out else {
            let stem = self.file.file_stem().unwrap_or_default().to_string_lossy();
            let name = format!("{stem}-again.{}", self.output.name());
            return self.folder().join(name);
        };
        out.join(self.file.file_name().unwrap_or_default())
    }

    /// Runs `scene` and records into `results`; returns the SHA-256 of the motion.
    fn run(
        &self,
        scene: &Scene,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let text = toml::to_string(scene).map_err(|e| self.error(e.to_string()))?;
        let source = SceneSource::new(self.file, text);
        let mut study = Study::resolve(&source)?;
        study.recording.outputs = vec![self.output];
        let folded = study.compute(&progress)?;
        study.record(&study.recording, &folded, results, progress)
    }

    /// Records the motion of the original into `results`; returns its SHA-256.
    fn record(
        &self,
        source_info: &SourceInfo,
        motion: Option<&Path>,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let name = source_info.motion.as_deref().unwrap_or_default();
        let path = match motion {
            Some(motion) => motion.to_owned(),
            None => self.find(name)?,
        };
        let mut recording = recording(&source_info.record.clone().unwrap_or_default())?;
        recording.outputs = vec![self.output];
        let mut read = LoadedMotion::read(&path, progress)?;
        // The motion file may have been renamed since.
        name.clone_into(&mut read.name);
        read.record(&recording, read.marks.clone(), results, progress)?;
        Ok(read.sha256)
    }

    /// The motion file called `name`. Only the name counts: a recorded file must not lead to other folders.
    fn find(&self, name: &str) -> Result<PathBuf, StudyError> {
        let only_name = Path::new(name).file_name().unwrap_or_default();
        let folders = [self.folder().to_owned(), self.folder().join(".."), PathBuf::new()];
        let mut paths = folders.into_iter().map(|folder| folder.join(only_name));
        paths.find(|path| path.is_file()).ok_or_else(|| {
            self.error(format!(
                "the file was recorded from {name}, which is not next to it: specify the motion after --again FILE"
            ))
        })
    }
}

impl Results {
    /// Moves one of the files to `target`, discards the others, and returns its bytes. Refuses to replace another file
    /// unless `replaces` is set.
    fn take(self, name: &str, target: &Path, replaces: bool) -> Result<Vec<u8>, StudyError> {
        let path = self.temporary().join(name);
        let bytes = std::fs::read(&path).map_err(|e| output_error(&path, "cannot be read", e))?;
        require_clear(target, &bytes, replaces)?;
        std::fs::rename(&path, target)
            .map_err(|e| output_error(target, "cannot be moved into place", e))?;
        Ok(bytes)
    }
}

/// Refuses to replace a file that has other bytes than `bytes`, unless `replaces` is set.
fn require_clear(target: &Path, bytes: &[u8], replaces: bool) -> Result<(), StudyError> {
    if replaces || !target.exists() || std::fs::read(target).is_ok_and(|found| found == bytes) {
        return Ok(());
    }
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    Err(StudyError::Conflict {
        path: target.parent().unwrap_or(Path::new("")).to_owned(),
        names: name.into_owned(),
        command: Command::Record.name(),
    })
}
