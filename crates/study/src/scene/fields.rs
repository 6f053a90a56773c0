//! What is said of every key of a scene, in one place.
//!
//! Meaning, default, unit and range stand at the fields of [`Scene`]: the doc comment, `default` or `x-default` (a default that
//! is computed, in words), `x-unit`, `minimum` and `maximum`. The JSON schema is made from them, and from the schema the
//! tooltips of the window, the help of the command line and the scene reference of the book. Tests hold the values to what
//! the program does.

use std::fmt::Write as _;
use std::sync::LazyLock;

use foldmotion_geometry::Number;
use schemars::schema_for;
use serde_json::Value;

use super::Scene;

/// A key of a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The dotted key, without indices of lists: `motion.step.creases`.
    pub key: String,
    /// What it means, in whole sentences.
    pub help: String,
    /// The value that holds if the key is omitted, as TOML.
    pub default: Option<Value>,
    /// What holds if the key is omitted, in words, where it is computed.
    pub default_words: Option<String>,
    /// The unit of its value.
    pub unit: Option<String>,
    /// The least value.
    pub minimum: Option<f64>,
    /// The largest value.
    pub maximum: Option<f64>,
    /// The names that are possible values, each with its meaning.
    pub choices: Vec<(String, String)>,
    /// Whether it is a table with keys of its own.
    pub is_table: bool,
    /// Meaning, unit and default on one line of plain text, for tooltips and the help of the command line.
    pub tip: String,
}

static FIELDS: LazyLock<Vec<Field>> = LazyLock::new(|| {
    let schema = schema_for!(Scene).to_value();
    let mut fields = Vec::new();
    Walk { schema: &schema }.properties(&schema, "", &mut fields);
    fields
});

/// Every key of a scene file, tables before their keys.
pub fn fields() -> &'static [Field] {
    &FIELDS
}

/// The dotted `key`, in which numbers stand for elements of a list.
pub fn field(key: &str) -> Option<&'static Field> {
    let parts = key.split('.').filter(|part| part.parse::<usize>().is_err());
    let key = parts.collect::<Vec<_>>().join(".");
    FIELDS.iter().find(|field| field.key == key)
}

/// What a tooltip says of the dotted `key`; empty if there is no such key.
pub fn tip(key: &str) -> &'static str {
    field(key).map_or("", |field| &field.tip)
}

/// The names that are possible values of `key`, each with its meaning.
pub fn choices(key: &str) -> Vec<(&'static str, &'static str)> {
    let choices = field(key).map(|field| &field.choices);
    let choices = choices.into_iter().flatten();
    choices.map(|(name, meaning)| (&**name, &**meaning)).collect()
}

impl Field {
    /// What holds if the key is omitted.
    pub fn default_text(&self) -> Option<String> {
        let value = self.default.as_ref().map(toml_text);
        value.or_else(|| self.default_words.clone())
    }

    /// [`Self::tip`].
    fn composed_tip(&self) -> String {
        let mut tip = self.help.clone();
        // Writing into a string cannot fail.
        if let Some(unit) = &self.unit {
            let _ = write!(tip, " Unit: {unit}.");
        }
        if let Some(default) = self.default_text() {
            let _ = write!(tip, " Default: {default}.");
        }
        tip.replace('`', "")
    }

    fn range(&self) -> String {
        match [self.minimum, self.maximum].map(|limit| limit.map(Number)) {
            [Some(least), Some(most)] => format!("{least} to {most}"),
            [Some(least), None] => format!("at least {least}"),
            [None, Some(most)] => format!("at most {most}"),
            [None, None] => String::new(),
        }
    }

    /// Its part of the reference.
    fn describe(&self, page: &mut String) {
        let heading = if self.is_table { "## `[" } else { "### `" };
        let end = if self.is_table { "]`" } else { "`" };
        // Writing into a string cannot fail.
        let _ = write!(page, "\n{heading}{}{end}\n\n{}\n", self.key, self.help);
        let facts = [
            ("Default", self.default_text().unwrap_or_default()),
            ("Unit", self.unit.clone().unwrap_or_default()),
            ("Range", self.range()),
        ];
        let facts = facts.iter().filter(|(_, text)| !text.is_empty());
        let facts: Vec<String> = facts.map(|(name, text)| format!("{name}: {text}.")).collect();
        if !facts.is_empty() {
            let _ = write!(page, "\n{}\n", facts.join(" "));
        }
        if !self.choices.is_empty() {
            page.push('\n');
        }
        for (name, meaning) in &self.choices {
            let _ = writeln!(page, "- `{name}`: {meaning}");
        }
    }
}

/// The tables of a scene, in the order of the reference.
const TABLES: [&str; 9] =
    ["title", "profile", "sheet", "division", "pattern", "material", "motion", "check", "record"];

/// The scene reference of the book.
pub fn reference() -> String {
    let mut page = "# Scene reference\n\nEvery key of a scene file, generated from the program. A scene is a TOML file. A key may be \
                    omitted if a default is given; unknown keys are refused. `foldmotion init` writes a commented scene to start \
                    from.\n"
        .to_owned();
    for table in TABLES {
        let prefix = format!("{table}.");
        let own =
            fields().iter().filter(|field| field.key == table || field.key.starts_with(&prefix));
        for field in own {
            field.describe(&mut page);
        }
    }
    page
}

/// A JSON value as TOML writes it on one line.
fn toml_text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(values) => {
            let values = values.iter().map(|value| match value {
                Value::String(text) => format!("{text:?}"),
                other => toml_text(other),
            });
            format!("[{}]", values.collect::<Vec<_>>().join(", "))
        }
        Value::Number(number) => number.as_f64().map_or_else(
            || number.to_string(),
            |value| {
                if number.is_f64() { format!("{value:?}") } else { number.to_string() }
            },
        ),
        other => other.to_string(),
    }
}

/// A walk over a schema and its definitions.
struct Walk<'a> {
    schema: &'a Value,
}

impl Walk<'_> {
    fn properties(&self, node: &Value, prefix: &str, fields: &mut Vec<Field>) {
        let keys = node.get("properties").and_then(Value::as_object);
        for (name, node) in keys.into_iter().flatten() {
            let key = format!("{prefix}{name}");
            let text = |name: &str| Some(line(node.get(name)?.as_str()?));
            let number = |name: &str| node.get(name)?.as_f64();
            let mut choices = Vec::new();
            self.choices(node, &mut choices);
            let mut inner = Vec::new();
            self.inside(node, &format!("{key}."), &mut inner);
            let mut field = Field {
                help: text("description").unwrap_or_default(),
                default: node
                    .get("default")
                    .filter(|value| !value.is_null() && !value.is_object())
                    .cloned(),
                default_words: text("x-default"),
                unit: text("x-unit"),
                minimum: number("minimum"),
                maximum: number("maximum"),
                choices,
                is_table: !inner.is_empty() && key != "record.camera",
                key,
                tip: String::new(),
            };
            field.tip = field.composed_tip();
            fields.push(field);
            fields.append(&mut inner);
        }
    }

    /// The keys of the tables that `node` may be or hold.
    fn inside(&self, node: &Value, prefix: &str, fields: &mut Vec<Field>) {
        self.properties(node, prefix, fields);
        for part in self.parts(node) {
            self.inside(part, prefix, fields);
        }
    }

    fn choices(&self, node: &Value, choices: &mut Vec<(String, String)>) {
        let variants = node.get("oneOf").and_then(Value::as_array);
        for variant in variants.into_iter().flatten() {
            if let Some(name) = variant.get("const").and_then(Value::as_str) {
                let meaning = variant.get("description").and_then(Value::as_str);
                choices.push((name.to_owned(), line(meaning.unwrap_or_default())));
            }
        }
        for part in self.parts(node) {
            self.choices(part, choices);
        }
    }

    /// What `node` refers to, its alternatives and its elements.
    fn parts<'b>(&'b self, node: &'b Value) -> impl Iterator<Item = &'b Value> {
        let path = node.get("$ref").and_then(Value::as_str);
        let definition = path.and_then(|path| self.schema.pointer(path.trim_start_matches('#')));
        let alternatives = node.get("anyOf").and_then(Value::as_array);
        let elements = node.get("items");
        let parts = definition.into_iter().chain(elements);
        parts.chain(alternatives.into_iter().flatten())
    }
}

/// A text on one line.
fn line(text: &str) -> String {
    text.replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::{SceneSource, Study};

    fn resolved(scene: &str) -> Result<Study, String> {
        let source = SceneSource::new(Path::new("scene.toml"), scene.to_owned());
        Study::resolve(&source).map_err(|e| e.to_string())
    }

    /// A scene in which `key`, at the end of a table, has `value`.
    fn scene(key: &str, value: &str) -> Option<String> {
        let (table, name) = key.rsplit_once('.')?;
        let pattern = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/imported/miura.svg");
        let base = "[profile]\nmodel = \"shelter\"\n[sheet]\ncase = \"E\"\n";
        let line = format!("{name} = {value}\n");
        Some(match table {
            "motion.step" => format!("{base}[[motion.step]]\nstage = \"fold\"\n{line}"),
            "pattern" => format!("[pattern]\nfile = {pattern:?}\n{line}"),
            "sheet" if name == "case" => format!("[profile]\nmodel = \"shelter\"\n[sheet]\n{line}"),
            "record.camera" => {
                format!(
                    "{base}[record]\ncamera = {{ azimuth = 1.0, elevation = 1.0, {name} = {value} }}\n"
                )
            }
            "profile" => format!("[profile]\nmodel = \"shelter\"\n{line}[sheet]\ncase = \"E\"\n"),
            "sheet" => format!("{base}{line}"),
            _ => format!("{base}[{table}]\n{line}"),
        })
    }

    fn quoted(value: &Value) -> String {
        match value {
            Value::String(text) => format!("{text:?}"),
            other => toml_text(other),
        }
    }

    #[test]
    fn a_default_in_the_schema_is_what_an_omitted_key_means() {
        let mut checked = 0;
        for field in fields() {
            let Some(default) = &field.default else {
                continue;
            };
            let with = scene(&field.key, &quoted(default)).unwrap();
            let (_, name) = field.key.rsplit_once('.').unwrap();
            let without = with
                .lines()
                .filter(|line| !line.starts_with(&format!("{name} =")))
                .collect::<Vec<_>>()
                .join("\n");
            let without = without.replace(&format!(", {name} = {}", quoted(default)), "");
            assert_ne!(with.trim(), without.trim(), "{}", field.key);
            let words = |scene: &str| {
                let mut study = resolved(scene).unwrap_or_else(|e| panic!("{}: {e}", field.key));
                study.recording.scene = Scene::default();
                if let crate::Subject::Units(units) = &mut study.subject {
                    units.division_seconds = 0.0;
                }
                format!("{study:?}")
            };
            assert!(words(&with) == words(&without), "{} = {default}", field.key);
            checked += 1;
        }
        assert!(checked > 30, "{checked}");
    }

    #[test]
    fn values_beyond_the_range_in_the_schema_are_refused_with_the_key() {
        let mut checked = 0;
        for field in fields() {
            let is_integer = ["rows", "columns", "max_iterations", "frames", "stop_at"];
            let (_, name) = field.key.rsplit_once('.').unwrap_or(("", &field.key));
            let beyond = |limit: f64, sign: f64| {
                let step = if limit == 0.0 { 1e-3 } else { 1e-3 * limit.abs() };
                if is_integer.contains(&name) {
                    format!("{}", limit + sign)
                } else {
                    format!("{:?}", limit + sign * step)
                }
            };
            let bounds = [(field.minimum, -1.0), (field.maximum, 1.0)];
            for (limit, sign) in bounds {
                let Some(limit) = limit else { continue };
                let text = scene(&field.key, &beyond(limit, sign)).unwrap();
                let text = if name == "lambda" {
                    text.replace("case = \"E\"", "case = \"SII\"")
                } else {
                    text
                };
                let error = resolved(&text).expect_err(&field.key);
                assert!(error.contains(name) || error.contains("camera"), "{}: {error}", field.key);
                checked += 1;
            }
        }
        assert!(checked > 30, "{checked}");
    }

    #[test]
    fn keys_are_found_with_the_indices_of_lists() {
        assert_eq!(field("motion.step.0.creases").unwrap().key, "motion.step.creases");
        assert_eq!(field("record.camera.azimuth").unwrap().unit.as_deref(), Some("degrees"));
        assert!(field("sheet.colour").is_none());
        let cases = &field("sheet.case").unwrap().choices;
        let names: Vec<_> = cases.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["E", "T", "S", "SII", "plain", "auto"]);
        assert_eq!(choices("record.outputs.0").len(), 12);
        assert!(choices("sheet.width").is_empty());
        assert!(tip("motion.frames").ends_with("Default: 240."));
        assert_eq!(tip("motion.engine.colour"), "");
    }

    #[test]
    fn the_commented_scene_of_init_has_known_keys_and_their_defaults() {
        let mut table = String::new();
        let mut checked = 0;
        for line in crate::FIRST_SCENE.lines() {
            let line = line.trim_start_matches("# ");
            if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
                table = name.trim_start_matches('[').to_owned();
                continue;
            }
            let Some((name, rest)) = line.split_once(" = ") else {
                continue;
            };
            if name.contains(' ') || table.is_empty() {
                continue;
            }
            let key = format!("{table}.{name}");
            let found = field(&key).unwrap_or_else(|| panic!("{key} is no key of a scene"));
            let (value, comment) = rest.split_once('#').unwrap_or((rest, ""));
            // Where the comment says so, or the scene has to differ to be of use, the value is an example.
            let is_example =
                comment.contains("default") || comment.contains("SII") || comment.contains("or ");
            if let Some(default) = &found.default
                && !is_example
                && table != "motion.step"
                && table != "sheet"
            {
                assert_eq!(value.trim(), quoted(default), "{key}");
                checked += 1;
            }
        }
        assert!(checked >= 10, "{checked}");
    }
}
