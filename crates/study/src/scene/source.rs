//! The text of a scene file with its `--set` overrides: parses into a [`Scene`] and knows the line of every key.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use foldmotion_geometry::Number;
use foldmotion_pattern::{ImportError, LARGEST_IMPORT_FILE};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::input_file::LARGEST_SCENE;
use crate::scene::RecordScene;
use crate::{Scene, StudyError, input_file};

/// A commented scene to start from: a shelter, with every key and its default. It can be run without changes.
pub const FIRST_SCENE: &str = include_str!("first_scene.toml");

/// The text of a scene file with values from the command line.
#[derive(Debug, Clone)]
pub struct SceneSource {
    path: PathBuf,
    text: String,
    overrides: Vec<Override>,
    /// The content of the crease pattern, if it is in memory instead of a file.
    pattern: Option<Arc<[u8]>>,
}

/// A value from the command line.
#[derive(Debug, Clone)]
struct Override {
    /// `--set`, or the flag that gave it.
    flag: String,
    key: String,
    value: Value,
}

impl SceneSource {
    /// Reads a scene file. For a crease pattern, by its extension or its content, the scene has only `[pattern]` with this
    /// file.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::LargeFile`] above 16 MiB, and [`StudyError::Unrecognised`] for a file with
    /// another extension than .toml that is neither TOML nor a crease pattern.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        if let Some(pattern) = Self::for_pattern(path) {
            return Ok(pattern);
        }
        let may_be_scene =
            path.extension().is_none_or(|ending| ending.eq_ignore_ascii_case("toml"));
        let text = match input_file::read_text(path, LARGEST_SCENE) {
            Ok(text) if may_be_scene || text.parse::<Table>().is_ok() => text,
            Err(error) if may_be_scene || !input_file::is_not_text(&error) => return Err(error),
            _ => {
                let error = Box::new(ImportError::Format);
                return Err(StudyError::Unrecognised { path: path.to_owned(), error });
            }
        };
        Ok(Self::new(path, text))
    }

    /// A scene from text; errors name `path`, and results its stem.
    pub fn new(path: &Path, text: String) -> Self {
        Self { path: path.to_owned(), text, overrides: Vec::new(), pattern: None }
    }

    /// A scene that only has `[pattern]` with a crease pattern in memory, which errors and results call `name`.
    pub fn of_pattern(name: &str, content: Vec<u8>) -> Self {
        let mut source = Self::new(Path::new(name), String::new());
        source.set_by_file("pattern.file", name);
        source.pattern = Some(content.into());
        source
    }

    /// The content of the crease pattern at `path`.
    ///
    /// # Errors
    /// [`StudyError::Read`] and [`StudyError::LargeFile`].
    pub(crate) fn read_pattern(&self, path: &Path) -> Result<Vec<u8>, StudyError> {
        let limit = LARGEST_IMPORT_FILE as u64;
        match &self.pattern {
            Some(content) if content.len() as u64 > limit => {
                let size = content.len() as u64;
                Err(StudyError::LargeFile { path: path.to_owned(), size, limit })
            }
            Some(content) => Ok(content.to_vec()),
            None => input_file::read(path, limit),
        }
    }

    /// Adds a `--set key=value`: a dotted key and a TOML value; anything else is a string.
    ///
    /// # Errors
    /// [`StudyError::Parse`] without `=` or with an empty key.
    pub fn set(&mut self, assignment: &str) -> Result<(), StudyError> {
        let error = |message: String| StudyError::Parse {
            location: format!("--set {assignment}"),
            message,
        };
        let Some((key, value)) = assignment.split_once('=') else {
            return Err(error("expected key=value, such as sheet.columns=3".to_owned()));
        };
        let (key, value) = (key.trim(), value.trim());
        if key.split('.').any(str::is_empty) {
            return Err(error(
                "the key is empty; write table.key=value, such as sheet.columns=3".to_owned(),
            ));
        }
        let parsed =
            format!("value = {value}").parse::<Table>().ok().and_then(|mut t| t.remove("value"));
        let value = parsed.unwrap_or_else(|| Value::String(value.to_owned()));
        self.overrides.push(Override { flag: "--set".to_owned(), key: key.to_owned(), value });
        Ok(())
    }

    /// Adds the value of the command line flag `--name` for `key`.
    pub fn set_by_flag(&mut self, name: &str, key: &str, value: &str) {
        self.overrides.push(Override {
            flag: format!("--{name}"),
            key: key.to_owned(),
            value: Value::String(value.to_owned()),
        });
    }

    /// A scene with only `[record]` from the command line: errors name each key as a flag.
    pub(crate) fn from_flags(record: &RecordScene) -> Self {
        let mut source = Self::new(Path::new("record"), String::new());
        // A struct of plain values with string keys always serialises.
        let table = Table::try_from(record).unwrap_or_default();
        let flags = table.into_iter().map(|(key, value)| Override {
            flag: format!("--{key}"),
            key: format!("record.{key}"),
            value,
        });
        source.overrides.extend(flags);
        source
    }

    /// Sets a key to the text `value`, which stands for the file itself.
    pub(crate) fn set_by_file(&mut self, key: &str, value: &str) {
        self.overrides.push(Override {
            flag: self.path.display().to_string(),
            key: key.to_owned(),
            value: Value::String(value.to_owned()),
        });
    }

    /// The text, without its overrides.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text of a scene file for this scene: the text itself or, with overrides, every key that is set.
    ///
    /// # Errors
    /// Those of [`Self::scene`].
    pub fn to_toml(&self) -> Result<String, StudyError> {
        if self.overrides.is_empty() {
            return Ok(self.text.clone());
        }
        // A struct of plain values with string keys always serialises.
        Ok(toml::to_string(&self.scene()?).unwrap_or_default())
    }

    /// The path of a file that the scene names, relative to the folder of the scene.
    pub(crate) fn resolve_path(&self, path: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(path)
    }

    /// The name of the file without its extension.
    pub fn stem(&self) -> String {
        self.path
            .file_stem()
            .map_or_else(|| "scene".to_owned(), |s| s.to_string_lossy().into_owned())
    }

    /// Parses the text, then applies the overrides.
    ///
    /// # Errors
    /// [`StudyError::Parse`] for invalid TOML, unknown keys and wrong types; [`StudyError::Value`] for a title of several lines.
    pub fn scene(&self) -> Result<Scene, StudyError> {
        let parse_error = |error: &toml::de::Error| StudyError::Parse {
            location: error
                .span()
                .map_or_else(|| self.path.display().to_string(), |span| self.location(span.start)),
            message: self.message(error),
        };
        let mut table: Table = toml::from_str(&self.text).map_err(|e| parse_error(&e))?;
        for Override { key, value, .. } in &self.overrides {
            insert(&mut table, key, value.clone()).map_err(|message| StudyError::Parse {
                location: format!("--set {key}"),
                message,
            })?;
        }
        // The file is parsed by itself first, so that its own errors have a line.
        let scene: Result<Scene, _> = toml::from_str(&self.text);
        if self.overrides.is_empty() {
            return self.with_valid_title(scene.map_err(|e| parse_error(&e))?);
        }
        match Scene::deserialize_table(table) {
            Ok(overridden) => self.with_valid_title(overridden),
            Err(error) => match scene {
                Err(own) => Err(parse_error(&own)),
                Ok(_) => Err(StudyError::Parse { location: self.override_names(), message: error }),
            },
        }
    }

    /// The message of a TOML error, with the name of a duplicate key.
    fn message(&self, error: &toml::de::Error) -> String {
        let message = error.message();
        let key = error.span().and_then(|span| self.text.get(span));
        match key {
            Some(key) if message == "duplicate key" => {
                format!("the key `{}` is already set above", shortened(key.trim()))
            }
            _ => message.to_owned(),
        }
    }

    /// Refuses a title with control characters.
    fn with_valid_title(&self, scene: Scene) -> Result<Scene, StudyError> {
        let mut letters = scene.title.iter().flat_map(|title| title.chars());
        if letters.any(char::is_control) {
            let message = "must be a single line without control characters".to_owned();
            return Err(self.value_error("title", message));
        }
        Ok(scene)
    }

    fn override_names(&self) -> String {
        let names: Vec<String> =
            self.overrides.iter().map(|over| format!("{} {}", over.flag, over.key)).collect();
        names.join(", ")
    }

    /// The error about the value of a key, with file, line and value, or with the flag that set it.
    pub fn value_error(&self, key: &str, message: String) -> StudyError {
        let overridden = self.overrides.iter().rev().find(|over| over.key == key);
        let (location, value) = match (overridden, self.locate(key)) {
            (Some(over), _) => (over.flag.clone(), format!(" = {}", shown(&over.value))),
            (None, Some((span, value))) => (self.location(span.start), format!(" = {value}")),
            (None, None) => (self.path.display().to_string(), String::new()),
        };
        StudyError::Value { location, key: key.to_owned(), value, message }
    }

    /// The location of a key: the flag that set it, `file:line:column`, or the file if the key is absent.
    pub fn location_of(&self, key: &str) -> String {
        if let Some(over) = self.overrides.iter().rev().find(|over| over.key == key) {
            return over.flag.clone();
        }
        self.locate(key)
            .map_or_else(|| self.path.display().to_string(), |(span, _)| self.location(span.start))
    }

    /// The location of a byte of the text as `file:line:column`.
    fn location(&self, byte: usize) -> String {
        let before = &self.text[..byte.min(self.text.len())];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        format!("{}:{line}:{column}", self.path.display())
    }

    /// The span and the text of the value of a dotted key, in which numbers are indices of lists.
    fn locate(&self, key: &str) -> Option<(std::ops::Range<usize>, String)> {
        let table = DeTable::parse(&self.text).ok()?;
        let mut parts = key.split('.');
        let mut value: &Spanned<DeValue<'_>> = table.get_ref().get(parts.next()?)?;
        for part in parts {
            value = match part.parse::<usize>() {
                Ok(index) => value.get_ref().as_array()?.get(index)?,
                Err(_) => value.get_ref().as_table()?.get(part)?,
            };
        }
        let span = value.span();
        Some((span.clone(), shortened(self.text.get(span)?)))
    }
}

/// The text of a value, shortened if it is long.
fn shown(value: &Value) -> String {
    match value {
        Value::Float(number) => Number(*number).to_string(),
        other => shortened(&other.to_string()),
    }
}

/// A text, shortened if it is long.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let head: String = text.chars().take(LONGEST).collect();
    format!("{head}…")
}

fn insert(table: &mut Table, key: &str, value: Value) -> Result<(), String> {
    match key.split_once('.') {
        None => {
            table.insert(key.to_owned(), value);
            Ok(())
        }
        Some((group, rest)) => {
            let entry = table.entry(group.to_owned()).or_insert_with(|| Value::Table(Table::new()));
            match entry {
                Value::Table(inner) => insert(inner, rest, value),
                _ => Err(format!("{group} is not a table, so {rest} cannot be set in it")),
            }
        }
    }
}

impl Scene {
    fn deserialize_table(table: Table) -> Result<Self, String> {
        table.try_into().map_err(|e: toml::de::Error| e.message().to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> SceneSource {
        SceneSource::new(Path::new("dir/test.toml"), text.to_owned())
    }

    #[test]
    fn an_unknown_key_is_refused_with_its_line() {
        let error = source("title = \"a\"\n[sheet]\nwidht = 5.0\n").scene().unwrap_err();
        assert_eq!(error.status(), 2);
        let text = error.to_string();
        assert!(text.contains("test.toml:3") && text.contains("widht"), "{text}");
    }

    #[test]
    fn a_wrong_type_is_refused_with_its_line() {
        let text = source("[sheet]\nrows = \"seven\"\n").scene().unwrap_err().to_string();
        assert!(text.contains("test.toml:2"), "{text}");
    }

    #[test]
    fn text_that_is_not_toml_is_refused_with_its_line() {
        let text = source("[sheet]\nrows = = 7\n").scene().unwrap_err().to_string();
        assert!(text.contains("test.toml:2"), "{text}");
    }

    #[test]
    fn set_overrides_a_key_and_takes_bare_words_as_strings() {
        let mut source = source("[sheet]\nrows = 7\n");
        source.set("sheet.rows=3").unwrap();
        source.set("sheet.case = SII").unwrap();
        source.set("profile.model=shelter").unwrap();
        let scene = source.scene().unwrap();
        assert_eq!(scene.sheet.rows, Some(3));
        assert_eq!(scene.sheet.case, Some(crate::scene::CaseChoice::SII));
        assert_eq!(scene.profile.model.as_deref(), Some("shelter"));
    }

    #[test]
    fn a_wrong_set_is_refused_by_name() {
        let mut unknown = source("");
        unknown.set("sheet.nonsense=1").unwrap();
        let text = unknown.scene().unwrap_err().to_string();
        assert!(text.contains("--set sheet.nonsense") && text.contains("nonsense"), "{text}");
        assert!(source("").set("nothing").is_err());
        assert!(source("").set("=3").is_err());
    }

    #[test]
    fn a_value_error_names_file_line_key_and_value() {
        let text = source("[sheet]\n\nwidth = -5.0\n")
            .value_error("sheet.width", "no".to_owned())
            .to_string();
        assert_eq!(text, "dir/test.toml:3:9: sheet.width = -5.0: no");
    }
}
