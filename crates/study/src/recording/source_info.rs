//! Source information: how each recorded file was made, as text inside the file.

use std::path::Path;

use foldmotion_record::embedded;
use serde::{Deserialize, Serialize};

use crate::VERSION;
use crate::scene::RecordScene;
use crate::{Scene, StudyError, input_file};

/// The first line of the text, for people who find it in a file.
const GREETING: &str =
    "# made by foldmotion; `foldmotion record --again FILE` makes this file again\n";

/// The largest file whose source information is read, in bytes: 2 GiB.
pub(super) const LARGEST: u64 = 2 << 30;

/// How a recorded file was made: TOML text inside the file.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SourceInfo {
    /// The version of foldmotion.
    pub(crate) version: String,
    /// The SHA-256 of the motion file, or of the `motion.fold` that a run would write.
    pub(crate) sha256: String,
    /// The name of the motion file; `None` if a scene was run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) motion: Option<String>,
    /// The motion time of a file that shows one state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) state: Option<f64>,
    /// The scene that was run, with the values of `--set`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) scene: Option<Scene>,
    /// The settings with which the motion file was recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) record: Option<RecordScene>,
}

impl SourceInfo {
    /// The source information of a run of `scene`.
    pub(crate) fn of_scene(scene: &Scene, sha256: String) -> Self {
        Self {
            version: VERSION.to_owned(),
            sha256,
            motion: None,
            state: None,
            scene: Some(scene.clone()),
            record: None,
        }
    }

    /// The source information of a recording of the motion file `name`.
    pub(crate) fn of_motion(name: String, record: &RecordScene, sha256: String) -> Self {
        Self {
            version: VERSION.to_owned(),
            sha256,
            motion: Some(name),
            state: None,
            scene: None,
            record: Some(record.clone()),
        }
    }

    /// The text inside the file.
    pub(crate) fn text(&self) -> String {
        // Structs of plain values with string keys always serialise.
        format!("{GREETING}{}", toml::to_string(self).unwrap_or_default())
    }

    /// The text of a file that shows the state at `time`.
    pub(crate) fn text_at(&self, time: f64) -> String {
        let state = Self { state: Some(time), ..self.clone() };
        state.text()
    }

    /// Reads the source information of the file at `path`.
    pub(crate) fn read(path: &Path) -> Result<Self, StudyError> {
        let error = |message: String| StudyError::SourceInfo { path: path.to_owned(), message };
        let bytes = input_file::read(path, LARGEST)?;
        let text = embedded(&bytes).ok_or_else(|| {
            error(
                "the file has no source information, which gif, mp4, png, svg, pdf, glb, obj and html files of foldmotion have; for \
                 an stl file, use the obj or another file next to it"
                    .to_owned(),
            )
        })?;
        let info: Self = toml::from_str(&text).map_err(|e| {
            error(format!("its source information cannot be read: {}", e.message()))
        })?;
        match (&info.scene, &info.record, &info.motion) {
            (Some(_), None, None) | (None, Some(_), Some(_)) => Ok(info),
            _ => Err(error("its source information names neither a scene nor a motion".to_owned())),
        }
    }
}
