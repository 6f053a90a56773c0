//! What every recorded file says of its source_info, and reading it back.

use std::path::Path;

use foldmotion_record::embedded;
use serde::{Deserialize, Serialize};

use crate::VERSION;
use crate::scene::RecordScene;
use crate::{Scene, StudyError, input_file};

/// The first line, for people who find the text in a file.
const GREETING: &str =
    "# made by foldmotion; `foldmotion record --again FILE` makes this file again\n";

/// The largest file whose source_info is read, bytes: 2 GiB.
pub(super) const LARGEST: u64 = 2 << 30;

/// Where a recorded file comes from: TOML text inside it.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SourceInfo {
    /// Version of foldmotion.
    pub(crate) version: String,
    /// SHA-256 of the motion as `motion.fold`; of the motion file where one was recorded.
    pub(crate) sha256: String,
    /// The name of the motion file; none where a scene was run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) motion: Option<String>,
    /// The motion time, of files that show one state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) state: Option<f64>,
    /// The scene that was run, `--set` included.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) scene: Option<Scene>,
    /// How the motion file was recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) record: Option<RecordScene>,
}

impl SourceInfo {
    /// Of a run of `scene`.
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

    /// Of a motion file called `name`.
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

    /// As text.
    pub(crate) fn text(&self) -> String {
        // Structs of plain values with string keys always serialise.
        format!("{GREETING}{}", toml::to_string(self).unwrap_or_default())
    }

    /// The text of a file that shows the state at `time`.
    pub(crate) fn text_at(&self, time: f64) -> String {
        let state = Self {
            state: Some(time),
            ..self.clone()
        };
        state.text()
    }

    /// What the file at `path` says of its source_info.
    pub(crate) fn read(path: &Path) -> Result<Self, StudyError> {
        let fault = |message: String| StudyError::SourceInfo {
            path: path.to_owned(),
            message,
        };
        let bytes = input_file::read(path, LARGEST)?;
        let text = embedded(&bytes).ok_or_else(|| {
            fault(
                "it says nothing of its source_info: gif, mp4, png, svg, pdf, glb, obj and html files of foldmotion do; of a stl use \
                 the obj or another file beside it"
                    .to_owned(),
            )
        })?;
        let source_info: Self = toml::from_str(&text).map_err(|e| {
            fault(format!(
                "what it says of its source_info cannot be read: {}",
                e.message()
            ))
        })?;
        match (&source_info.scene, &source_info.record, &source_info.motion) {
            (Some(_), None, None) | (None, Some(_), Some(_)) => Ok(source_info),
            _ => Err(fault("it names neither a scene nor a motion".to_owned())),
        }
    }
}
