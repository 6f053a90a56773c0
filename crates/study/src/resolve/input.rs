//! The input of the resolution: a scene with its source.

use foldmotion_geometry::Number;

use crate::{Scene, SceneSource, StudyError};

/// The shortest and the longest length of a scene, in its unit.
const SHORTEST: f64 = 1e-9;
const LONGEST: f64 = 1e9;
/// The largest number of rows and of columns.
const MOST_ROWS_OR_COLUMNS: i64 = 1_000_000;

/// A scene with its source, so that errors name the line of a value.
pub(crate) struct Input<'a> {
    pub(crate) source: &'a SceneSource,
    pub(crate) scene: &'a Scene,
}

impl<'a> Input<'a> {
    pub(crate) fn new(source: &'a SceneSource, scene: &'a Scene) -> Self {
        Self { source, scene }
    }

    /// The title of the scene. Default: the title of the pattern or the name of the file.
    pub(crate) fn title(&self, for_pattern: Option<&String>) -> String {
        let own = self.scene.title.as_ref().or(for_pattern);
        own.map_or_else(|| self.source.stem(), |title| printable(title))
    }

    pub(crate) fn error(&self, key: &str, message: impl Into<String>) -> StudyError {
        self.source.value_error(key, message.into())
    }

    /// Refuses a length whose cube could overflow or underflow.
    pub(crate) fn length(&self, key: &str, value: f64) -> Result<f64, StudyError> {
        if (SHORTEST..=LONGEST).contains(&value) {
            return Ok(value);
        }
        let [least, most] = [SHORTEST, LONGEST].map(Number);
        let message = format!("must be positive, from {least} to {most}; use another profile.unit");
        Err(self.error(key, message))
    }

    pub(crate) fn count(
        &self,
        key: &str,
        value: Option<i64>,
        default: Option<usize>,
    ) -> Result<usize, StudyError> {
        match (value, default) {
            (Some(n), _) => usize::try_from(n)
                .ok()
                .filter(|_| (1..=MOST_ROWS_OR_COLUMNS).contains(&n))
                .ok_or_else(|| {
                    self.error(key, format!("must be between 1 and {MOST_ROWS_OR_COLUMNS}"))
                }),
            (None, Some(n)) => Ok(n),
            (None, None) => {
                Err(self
                    .error(key, "is missing; it is required unless the profile is a built-in one"))
            }
        }
    }
}

/// A text on one line without control characters.
pub(crate) fn printable(text: &str) -> String {
    let letter = |letter: char| if letter.is_control() { ' ' } else { letter };
    text.chars().map(letter).collect()
}
