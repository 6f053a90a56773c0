//! Makes a recorded file again, from what it says of its source_info.

use std::path::{Path, PathBuf};

use super::models::state_name;
use super::motion_file::{LoadedMotion, recording};
use super::source_info::{LARGEST, SourceInfo};
use crate::results::{Command, FRAMES, Results, output_error};
use crate::scene::OutputChoice;
use crate::{Progress, VERSION};
use crate::{Scene, SceneSource, Study, StudyError, input_file};

/// A file made again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reproduction {
    /// Where it stands.
    pub path: PathBuf,
    /// Whether it has the same bytes as the file it was made after.
    pub is_same: bool,
    /// Why the bytes may differ, for the user.
    pub warnings: Vec<String>,
}

/// Makes `file` again: into the folder `out` under its own name, or beside it as `NAME-again`.
///
/// A file of a run runs its scene again; paths in it are taken beside the file. A file of a motion needs that motion:
/// `motion`, or the file of that name beside `file`, in the folder above it, or in the working folder. Another version,
/// another motion or another kind of processor may give other bytes; [`Reproduction`] says so.
///
/// # Errors
/// [`StudyError::SourceInfo`] where the file does not say where it comes from or the motion is not found; those of a run
/// and of `record_file`.
pub fn reproduce_file(
    file: &Path,
    motion: Option<&Path>,
    out: Option<&Path>,
    replaces_all: bool,
    progress: Progress<'_>,
) -> Result<Reproduction, StudyError> {
    let source_info = SourceInfo::read(file)?;
    let asked = Original::new(file, &source_info)?;
    let target = asked.target(out);
    let folder = target.parent().unwrap_or(Path::new(""));
    let earlier = input_file::read(file, LARGEST)?;
    require_clear(&target, &earlier, replaces_all)?;
    let mut results = Results::open((&folder.join("again")).into(), Command::Record, None)?;
    let mut warnings = Vec::new();
    if source_info.version != VERSION {
        warnings.push(format!(
            "the file was made by foldmotion {}, this is {VERSION}: the bytes may differ",
            source_info.version
        ));
    }
    if let (Some(_), Some(motion)) = (&source_info.scene, motion) {
        return Err(asked.fault(format!(
            "it was made by running a scene, which it holds; no motion is needed: leave out {}",
            motion.display()
        )));
    }
    let found = match &source_info.scene {
        Some(scene) => asked.run(scene, &mut results, progress)?,
        None => asked.record(&source_info, motion, &mut results, progress)?,
    };
    if found != source_info.sha256 {
        warnings.push(format!(
            "the motion has the SHA-256 {found}, that of the file had {}: the bytes may differ",
            source_info.sha256
        ));
    }
    let name = asked.name()?;
    if !results.written().contains(&name) {
        return Err(asked.fault(format!(
            "the recording has no {name}: give the file its first name back"
        )));
    }
    let made = results.take(&name, &target, replaces_all)?;
    Ok(Reproduction {
        path: target,
        is_same: made == earlier,
        warnings,
    })
}

/// A file to be made again.
struct Original<'a> {
    file: &'a Path,
    output: OutputChoice,
    state: Option<f64>,
}

impl<'a> Original<'a> {
    fn new(file: &'a Path, source_info: &SourceInfo) -> Result<Self, StudyError> {
        let ending = file.extension().unwrap_or_default().to_string_lossy();
        let output = OutputChoice::ALL
            .into_iter()
            .find(|output| output.name() == ending.to_ascii_lowercase());
        let output = output.ok_or_else(|| StudyError::SourceInfo {
            path: file.to_owned(),
            message: "its ending tells no kind of file; call it as it was: gif, mp4, png, svg, pdf, glb, obj or html".to_owned(),
        })?;
        Ok(Self {
            file,
            output,
            state: source_info.state,
        })
    }

    fn fault(&self, message: String) -> StudyError {
        StudyError::SourceInfo {
            path: self.file.to_owned(),
            message,
        }
    }

    fn file_name(&self) -> String {
        let name = self.file.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    fn beside(&self) -> &Path {
        self.file.parent().unwrap_or(Path::new(""))
    }

    /// Its name among the results.
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
            _ => return Err(self.fault("files of this kind are not made again".to_owned())),
        })
    }

    /// Where it is made again.
    fn target(&self, out: Option<&Path>) -> PathBuf {
        let Some(out) = out else {
            let stem = self.file.file_stem().unwrap_or_default().to_string_lossy();
            let name = format!("{stem}-again.{}", self.output.name());
            return self.beside().join(name);
        };
        out.join(self.file.file_name().unwrap_or_default())
    }

    /// Runs `scene` and records into `results`; answers the SHA-256 of the motion.
    fn run(
        &self,
        scene: &Scene,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let text = toml::to_string(scene).map_err(|e| self.fault(e.to_string()))?;
        let source = SceneSource::new(self.file, text);
        let mut study = Study::resolve(&source)?;
        study.recording.outputs = vec![self.output];
        let folded = study.compute(&progress)?;
        study.record(&study.recording, &folded, results, progress)
    }

    /// Records the motion it was made from into `results`; answers its SHA-256.
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
        // It may have been renamed since.
        name.clone_into(&mut read.name);
        read.record(&recording, read.marks.clone(), results, progress)?;
        Ok(read.sha256)
    }

    /// The motion called `name`. It is a name, not a path: what a file says must not reach elsewhere.
    fn find(&self, name: &str) -> Result<PathBuf, StudyError> {
        let only_name = Path::new(name).file_name().unwrap_or_default();
        let places = [
            self.beside().to_owned(),
            self.beside().join(".."),
            PathBuf::new(),
        ];
        let mut places = places.into_iter().map(|place| place.join(only_name));
        places.find(|path| path.is_file()).ok_or_else(|| {
            self.fault(format!(
                "it was recorded from {name}, which is not beside it: name the motion after --again FILE"
            ))
        })
    }
}

impl Results {
    /// Moves one of the files to `target` and gives up the others; answers its bytes. Another file there stays, unless
    /// it `replaces` it.
    fn take(self, name: &str, target: &Path, replaces: bool) -> Result<Vec<u8>, StudyError> {
        let path = self.temporary().join(name);
        let bytes = std::fs::read(&path).map_err(|e| output_error(&path, "cannot be read", e))?;
        require_clear(target, &bytes, replaces)?;
        std::fs::rename(&path, target)
            .map_err(|e| output_error(target, "cannot be moved into place", e))?;
        Ok(bytes)
    }
}

/// Refuses to replace a file that does not hold `bytes` already, unless asked to.
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
